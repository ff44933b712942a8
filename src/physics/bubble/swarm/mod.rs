//! Many bubbles in the air, each on a way in closed form: where all of them are at a moment takes no look at the moments before.
//!
//! Air carries a bubble with a velocity w, wind and rise. It leaves its place p₀ with v₀ and takes on w at a rate 1/T,
//!
//! ```text
//! p(τ) = p₀ + w τ + (v₀ − w) T (1 − e^(−τ/T)),    T = (2 R + 4 h ρ/ρₐ)/(c U/2)
//! ```
//!
//! T is its inertia (of the air in it, of half as much around it, and of its film) over its drag, linear around a speed U with the drag
//! coefficient c of a sphere (Clift, Grace & Weber 1978, Bubbles, Drops and Particles, ch. 5). Slow gusts come on top: they
//! displace all bubbles at one place alike. They are a sum of transverse waves, so they bring no air together.

mod gust;
mod lending;

use std::f64::consts::TAU;

use glam::{DMat3, DVec3};

pub use lending::Lending;

use super::{
    life::blown,
    shape::{Oscillator, Shape, traceless},
};
use crate::physics::film::{
    pcg3d,
    properties::{AIR_DENSITY, DENSITY},
};
use gust::{GUSTS, Gust};
use lending::LIVES;

/// Drag coefficient of a sphere at Reynolds numbers of some hundreds.
const DRAG: f64 = 0.5;
/// The speed that its drag is linear around, m/s.
const DRAG_SPEED_M_S: f64 = 0.3;
/// How fast bubbles leave a wand, over the mean.
const SPEEDS: [f64; 2] = [0.8, 1.2];
/// Time after which gusts carry a bubble that has begun to move with the wand's air, s.
const GUSTS_TAKE_S: f64 = 1.0;

/// Where bubbles begin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Origin {
    /// At random places in a box.
    Cloud,
    /// On a lattice that fills a box.
    Grid,
    /// At one place, from which they are blown.
    Wand {
        /// Where to, a unit vector.
        direction: DVec3,
        /// How fast, m/s.
        speed_m_s: f64,
        /// The largest angle from the direction, radians.
        spread_rad: f64,
    },
}

/// What makes the bubbles of a swarm.
#[derive(Clone, Debug, PartialEq)]
pub struct Swarm {
    /// Where they begin.
    pub origin: Origin,
    /// How many there are at a time, at most.
    pub count: u32,
    /// Seed of all random numbers.
    pub seed: u32,
    /// Center of the box, or the wand's place, m.
    pub center_m: DVec3,
    /// Edges of the box, m.
    pub size_m: DVec3,
    /// Mean radius, m.
    pub radius_m: f64,
    /// By how much of it radii differ from it at most.
    pub radius_spread: f64,
    /// Mean thickness of the films, m.
    pub thickness_m: f64,
    /// By how much of it thicknesses differ from it at most.
    pub thickness_spread: f64,
    /// How long bubbles live and which films they show then.
    pub lending: Lending,
    /// Velocity that air gives a bubble, m/s.
    pub wind_m_s: DVec3,
    /// Amplitude of the gusts, m.
    pub wander_m: f64,
    /// By how much a bubble is longer than round when it leaves a wand.
    pub wobble: f64,
}

/// One bubble of a swarm at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Member {
    /// Its number among all that there are at a time.
    pub slot: u32,
    /// How many there were before it in its place.
    pub generation: i64,
    /// Center, m.
    pub center_m: DVec3,
    /// Radius, m.
    pub radius_m: f64,
    /// The number of its film.
    pub film: u32,
    /// How far its film is turned about the vertical, radians.
    pub turn_rad: f64,
    /// How much thicker its film is than the one that it shows.
    pub thickness: f64,
    /// For how long it has been there, s.
    pub age_s: f64,
}

/// What all bubbles of a moment have in common.
struct Common {
    /// Places along each edge of a lattice.
    lattice: [u32; 3],
    /// Mean distance between bubbles in a cube of edge 1.
    gap: f64,
    /// Where the first one begins in such a cube.
    first: [f64; 3],
    gusts: [Gust; GUSTS],
}

impl Common {
    /// A place in the unit cube that keeps off those of other slots, where three random numbers alone would put some close together: of Roberts'
    /// additive recurrence by powers of the root of x⁴ = x + 1 (2018, "The Unreasonable Effectiveness of Quasirandom Sequences"), moved by half of
    /// the mean gap at most.
    fn spread_out(&self, slot: u32, random: [f64; 3]) -> [f64; 3] {
        const STEPS: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3];
        [0, 1, 2].map(|axis| {
            let place = self.first[axis] + f64::from(slot) * STEPS[axis] + self.gap * (random[axis] - 0.5);
            place - place.floor()
        })
    }
}

/// What each of a bubble's random numbers is for.
#[derive(Clone, Copy)]
enum Purpose {
    Phase,
    Place,
    Way,
    Look,
}

impl Swarm {
    /// All bubbles at a time in seconds.
    pub fn at(&self, time_s: f64) -> impl Iterator<Item = Member> {
        let common = Common {
            lattice: self.lattice(),
            gap: f64::from(self.count).cbrt().recip(),
            first: unit(pcg3d([self.seed, 0, 0xe000_0000])),
            gusts: std::array::from_fn(|number| Gust::new(self.seed, number as u32, self.wander_m)),
        };
        (0..self.count).filter_map(move |slot| self.member(slot, time_s, &common))
    }

    fn member(&self, slot: u32, time_s: f64, common: &Common) -> Option<Member> {
        let (generation, age_s) = match self.lending.life_s {
            None => (0, time_s),
            Some(life_s) => {
                let longest_s = LIVES[1] * life_s;
                let phase = match self.origin {
                    Origin::Wand { .. } => f64::from(slot) / f64::from(self.count),
                    Origin::Cloud | Origin::Grid => self.random(slot, 0, Purpose::Phase)[0],
                };
                let lives = time_s / longest_s + phase;
                let [lasts, ..] = self.random(slot, lives as i64 + 1, Purpose::Phase);
                let age_s = lives.fract() * longest_s;
                if age_s > life_s * between(LIVES, lasts) {
                    return None;
                }
                (lives as i64, age_s)
            }
        };
        let born_s = time_s - age_s;
        let [turn, thicker, film] = self.random(slot, generation, Purpose::Look);
        let place = self.random(slot, generation, Purpose::Place);
        let [size, a, b] = self.random(slot, generation, Purpose::Way);
        let full_m = self.radius_m * (1.0 + self.radius_spread * (2.0 * size - 1.0));
        let (start_m, velocity_m_s) = self.start(slot, place, [a, b], common);
        let carried_m = start_m + self.carried(velocity_m_s, full_m, age_s);
        let taken = if self.lending.life_s.is_some() { 1.0 - (-age_s / GUSTS_TAKE_S).exp() } else { 1.0 };
        let gusts_m: DVec3 = common.gusts.iter().map(|gust| gust.at(carried_m, time_s)).sum();
        let size_now = if self.lending.life_s.is_some() { blown(age_s) } else { 1.0 };
        Some(Member {
            slot,
            generation,
            center_m: carried_m + taken * gusts_m,
            radius_m: full_m * size_now,
            film: self.lending.film(born_s, film),
            turn_rad: TAU * turn,
            thickness: 1.0 + self.thickness_spread * (2.0 * thicker - 1.0),
            age_s,
        })
    }

    /// Where a bubble begins, and how fast.
    fn start(&self, slot: u32, place: [f64; 3], way: [f64; 2], common: &Common) -> (DVec3, DVec3) {
        let in_box = |place: [f64; 3]| self.center_m + self.size_m * (DVec3::from(place) - 0.5);
        match self.origin {
            Origin::Cloud => (in_box(common.spread_out(slot, place)), self.wind_m_s),
            Origin::Grid => {
                let lattice = common.lattice;
                let [x, y, _] = lattice;
                let cell = [slot % x, slot / x % y, slot / (x * y)];
                let place = [0, 1, 2].map(|axis| (f64::from(cell[axis]) + 0.5) / f64::from(lattice[axis]));
                (in_box(place), self.wind_m_s)
            }
            Origin::Wand { direction, speed_m_s, spread_rad } => {
                let right = direction.any_orthonormal_vector();
                let up = direction.cross(right);
                // Evenly over the cone.
                let cos = 1.0 - way[0] * (1.0 - spread_rad.cos());
                let (sin, (y, x)) = ((1.0 - cos * cos).max(0.0).sqrt(), (TAU * way[1]).sin_cos());
                let toward = cos * direction + sin * (x * right + y * up);
                (self.center_m, speed_m_s * between(SPEEDS, place[0]) * toward)
            }
        }
    }

    /// How far the air has carried a bubble of a radius that began with a velocity.
    fn carried(&self, velocity_m_s: DVec3, radius_m: f64, age_s: f64) -> DVec3 {
        let wind_m = self.wind_m_s * age_s;
        if velocity_m_s == self.wind_m_s {
            return wind_m;
        }
        let inertia_m = 2.0 * radius_m + 4.0 * self.thickness_m * DENSITY / AIR_DENSITY;
        let stopping_s = inertia_m / (0.5 * DRAG * DRAG_SPEED_M_S);
        wind_m + (velocity_m_s - self.wind_m_s) * (stopping_s * -(-age_s / stopping_s).exp_m1())
    }

    /// How far from round a bubble of a wand is.
    #[must_use]
    pub fn shape(&self, member: &Member) -> Shape {
        let Origin::Wand { direction, .. } = self.origin else { return Shape::ROUND };
        let oscillator = Oscillator::new(member.radius_m.max(1e-4), self.thickness_m);
        oscillator.freely(Shape { shape: traceless(direction) * self.wobble, rate: DMat3::ZERO }, member.age_s)
    }

    /// Places along each edge of a lattice that has room for all bubbles, about as far apart along each; one along edges without length.
    fn lattice(&self) -> [u32; 3] {
        let mut lattice = [1; 3];
        let room = |lattice: [u32; 3]| lattice.iter().map(|n| u64::from(*n)).product::<u64>();
        while room(lattice) < u64::from(self.count) {
            let gap = |axis: &usize| self.size_m[*axis] / f64::from(lattice[*axis]);
            let widest = [0, 1, 2].into_iter().max_by(|a, b| gap(a).total_cmp(&gap(b)).then(b.cmp(a))).unwrap_or(0);
            lattice[widest] += 1;
        }
        lattice
    }

    /// Three random numbers in [0, 1) of a bubble.
    fn random(&self, slot: u32, generation: i64, purpose: Purpose) -> [f64; 3] {
        // Golden ratio: bubbles of one slot have nothing to do with those of another.
        let life = (generation as u32).wrapping_mul(0x9e37_79b9) ^ ((purpose as u32) << 28);
        unit(pcg3d([self.seed, slot, life]))
    }
}

fn between([low, high]: [f64; 2], part: f64) -> f64 {
    low + (high - low) * part
}

fn unit(words: [u32; 3]) -> [f64; 3] {
    words.map(|word| f64::from(word) / (f64::from(u32::MAX) + 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swarm(origin: Origin, life_s: Option<f64>) -> Swarm {
        Swarm {
            origin,
            count: 500,
            seed: 3,
            center_m: DVec3::new(1.0, 2.0, 3.0),
            size_m: DVec3::new(2.0, 1.0, 0.5),
            radius_m: 0.02,
            radius_spread: 0.5,
            thickness_m: 700e-9,
            thickness_spread: 0.3,
            lending: Lending { films: 4, life_s, tick_s: 1.0 / 60.0 },
            wind_m_s: DVec3::new(0.1, 0.0, 0.05),
            wander_m: 0.03,
            wobble: 0.1,
        }
    }

    fn wand() -> Swarm {
        let origin = Origin::Wand { direction: DVec3::X, speed_m_s: 0.8, spread_rad: 0.2 };
        swarm(origin, Some(6.0))
    }

    #[test]
    fn a_cloud_fills_its_box_with_all_sizes() {
        let swarm = Swarm { wander_m: 0.0, ..swarm(Origin::Cloud, None) };
        let members: Vec<Member> = swarm.at(0.0).collect();
        assert_eq!(members.len(), 500);
        let offset = |member: &Member| (member.center_m - swarm.center_m) / swarm.size_m;
        assert!(members.iter().all(|member| offset(member).abs().max_element() <= 0.5));
        // Standard error of the mean: 1/sqrt(12 * 500) = 0.013.
        let mean = members.iter().map(offset).sum::<DVec3>() / 500.0;
        assert!(mean.abs().max_element() < 0.05, "{mean}");
        let radii = members.iter().map(|member| member.radius_m);
        let (low, high) = radii.fold((f64::INFINITY, 0.0_f64), |(low, high), r| (low.min(r), high.max(r)));
        assert!((0.01..0.0105).contains(&low) && (0.0295..0.03).contains(&high), "{low} {high}");
        assert!((0..4).all(|film| members.iter().filter(|member| member.film == film).count() > 90));
    }

    #[test]
    fn a_grid_has_a_place_for_each() {
        let swarm = Swarm { wander_m: 0.0, ..swarm(Origin::Grid, None) };
        assert!((500..600).contains(&swarm.lattice().iter().product::<u32>()), "{:?}", swarm.lattice());
        let members: Vec<Member> = swarm.at(0.0).collect();
        let nearest = |a: &Member| {
            let others = members.iter().filter(|b| b.slot != a.slot);
            others.map(|b| b.center_m.distance(a.center_m)).fold(f64::INFINITY, f64::min)
        };
        assert!(members.iter().all(|member| nearest(member) > 0.09));
        let flat = Swarm { size_m: DVec3::new(1.0, 0.0, 0.0), ..swarm };
        assert_eq!(flat.lattice(), [500, 1, 1]);
    }

    #[test]
    fn the_way_obeys_its_law_and_begins_at_the_wand() {
        let swarm = Swarm { wander_m: 0.0, ..wand() };
        let velocity = DVec3::new(0.8, 0.1, 0.0);
        let d = 1e-4;
        let at = |age_s: f64| swarm.carried(velocity, 0.02, age_s);
        assert!(at(0.0) == DVec3::ZERO && ((at(d) - at(0.0)) / d).distance(velocity) < 1e-3);
        let stopping_s = (0.04 + 4.0 * 700e-9 * DENSITY / AIR_DENSITY) / (0.5 * 0.5 * 0.3);
        let v = (at(0.5 + d) - at(0.5 - d)) / (2.0 * d);
        let acceleration = (at(0.5 + d) - 2.0 * at(0.5) + at(0.5 - d)) / (d * d);
        assert!(acceleration.distance((swarm.wind_m_s - v) / stopping_s) < 1e-5);
        let young = swarm.at(20.0).filter(|member| member.age_s < 0.05);
        assert!(young.map(|member| member.center_m.distance(swarm.center_m)).all(|way_m| way_m < 0.05));
    }

    #[test]
    fn nothing_jumps_but_by_its_end() {
        for swarm in [wand(), swarm(Origin::Cloud, Some(3.0)), swarm(Origin::Grid, None)] {
            let (a, b): (Vec<Member>, Vec<Member>) = (swarm.at(7.3).collect(), swarm.at(7.301).collect());
            let mut seen = 0;
            for now in &b {
                let Some(before) = a.iter().find(|a| (a.slot, a.generation) == (now.slot, now.generation)) else {
                    assert!(now.age_s < 0.0011 && now.radius_m < 0.2 * 0.03, "appears at {}", now.radius_m);
                    continue;
                };
                seen += 1;
                assert!(before.center_m.distance(now.center_m) < 0.0015, "1.2 m/s at most");
                assert_eq!((before.film, before.turn_rad, before.thickness), (now.film, now.turn_rad, now.thickness));
            }
            assert!(seen > 200);
        }
    }

    #[test]
    fn no_film_is_blown_anew_while_a_bubble_shows_it() {
        for films in [1, 2, 5] {
            let mut swarm = wand();
            swarm.lending.films = films;
            let interval = swarm.lending.interval_ticks();
            assert_eq!(interval.is_none(), films == 1);
            let Some(interval) = interval else { continue };
            for time_s in [0.0, 0.9, 5.0, 33.3, 100.0] {
                for member in swarm.at(time_s) {
                    let born = (time_s - member.age_s) / swarm.lending.tick_s;
                    let end = born + LIVES[1] * 6.0 / swarm.lending.tick_s;
                    let period = interval * u64::from(films);
                    let first = interval * u64::from(member.film);
                    let blown = (0..40).map(|k| (first + k * period) as f64).filter(|tick| *tick > 0.0);
                    // A bubble and its film may begin at the same tick.
                    assert!(blown.into_iter().all(|tick| tick <= born.floor() || tick + 1.0 >= end), "{born} {end}");
                }
            }
        }
    }

    #[test]
    fn equal_seeds_give_equal_bubbles_and_others_do_not() {
        let [a, b] = [3, 4].map(|seed| Swarm { seed, ..wand() }.at(12.0).collect::<Vec<_>>());
        assert_eq!(a, wand().at(12.0).collect::<Vec<_>>());
        assert!(a != b);
    }

    #[test]
    fn bubbles_of_a_wand_swing_and_calm_down() {
        let swarm = wand();
        let member = |age_s: f64| Member { age_s, ..swarm.at(12.0).next().unwrap() };
        let size = |age_s: f64| swarm.shape(&member(age_s)).shape.x_axis.length();
        assert!(size(0.0) > 0.06 && size(5.0) < 0.2 * size(0.0), "{} {}", size(0.0), size(5.0));
    }
}
