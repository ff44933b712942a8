//! Many bubbles at once.

use super::{
    Film, FilmStateName,
    check::{Checked, Fault},
    section::section,
};
use crate::words::words;

section! {
    /// Many bubbles that share a few films: one `[[generator]]`.
    pub struct Generator, GeneratorKeys: [
        film: Film = Film::default(), "How the films begin; each has its own seed, counted from this one";
    ]
    layout: Layout = Layout::Cloud, [word], "Layout", "", "where bubbles begin";
    count: u32 = 100, [1 ..= 10000000], "Bubbles", "", "maximum number of bubbles at a time";
    seed: u64 = 1, [whole], "Seed", "", "random seed of the places, the sizes and the ways of the bubbles";
    center_m: [f64; 3] = [0.0; 3], [-1000.0 ..= 1000.0], "Center", " m", "center of the box, or the place of the wand, m";
    size_m: [f64; 3] = [1.0; 3], [0.0 ..= 1000.0], "Size", " m", "edges of the box that a cloud or a grid fills, m";
    radius_mm: f64 = 20.0, [0.1 ..= 5000.0], "Radius", " mm", "mean radius, mm";
    radius_spread: f64 = 0.5, [0.0 ..= 0.95], "Sizes", "", "by how much of the mean radius the smallest and the largest bubbles differ from it";
    films: u32 = 4, [1 ..= 16], "Films", "", "how many films there are; each bubble shows one of them, turned about the vertical";
    thickness_spread: f64 = 0.3, [0.0 ..= 0.9], "Thicknesses", "", "by how much of its thickness a film is thinner or thicker on different bubbles";
    life_s: f64 = 0.0, [0.0 ..= 1000000.0], "Life", " s", "mean life of a bubble, s; when one is gone, another begins elsewhere; 0: bubbles of a cloud or a grid stay for ever";
    direction: [f64; 3] = [1.0, 0.0, 0.0], [-1000.0 ..= 1000.0], "Direction", "", "where a wand blows to; its length does not matter";
    speed_m_s: f64 = 0.5, [0.0 ..= 20.0], "Speed", " m/s", "speed at which bubbles leave a wand, m/s";
    spread_deg: f64 = 15.0, [0.0 ..= 180.0], "Spread", "°", "largest angle between the direction and the ways on which bubbles leave a wand";
    wobble: f64 = 0.1, [0.0 ..= 0.3], "Wobble", "", "by how much a bubble is longer than round when it leaves a wand; it swings and calms down";
    wind_m_s: [f64; 3] = [0.0; 3], [-50.0 ..= 50.0], "Wind", " m/s", "velocity of the air, m/s; bubbles that stay for ever are carried away by it";
    rise_m_s: f64 = 0.0, [-10.0 ..= 10.0], "Rise", " m/s", "speed at which bubbles rise through the air, or sink, m/s; warm breath makes them rise, their film's weight makes them sink";
    wander_mm: f64 = 0.0, [0.0 ..= 10000.0], "Wander", " mm", "how far slow gusts carry bubbles to and fro, mm; those that are close to each other go the same way";
}

words! {
    /// Where the bubbles of a generator begin.
    pub enum Layout: "layout" {
        Cloud = "cloud", "At random places in a box";
        Grid = "grid", "On a lattice that fills a box";
        Wand = "wand", "At one place, one after the other: a stream";
    }
}

impl Generator {
    pub(super) fn check(&self) -> Checked {
        self.check_ranges()?;
        if self.layout == Layout::Wand && self.life_s == 0.0 {
            return Err(Fault::new("life_s", "is 0; a wand goes on blowing, so its bubbles need an end"));
        }
        if self.layout == Layout::Wand && self.direction == [0.0; 3] {
            return Err(Fault::new("direction", "is [0, 0, 0]; a wand must blow somewhere"));
        }
        self.film.check().map_err(|fault| fault.inside("film"))?;
        if self.film.state == FilmStateName::Uniform || self.film.thickness_nm * (1.0 - self.thickness_spread) >= 1.0 {
            return Ok(());
        }
        let reason = format!("is {}, and makes films thinner than 1 nm", self.thickness_spread);
        Err(Fault::new("thickness_spread", reason))
    }
}
