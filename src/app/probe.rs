//! The probe: what is known of the film under the pointer, as numbers that a person can note down.

pub mod pin;

use std::fmt::Write;

use glam::{DVec2, DVec3};
pub use pin::{Pin, Plot};

use crate::{
    physics::{
        colour::{BT709, FilmOptics, Walls, chromaticity_xy, m2_exposure, srgb_encode},
        optics::{Polarised, newton_order},
        spectra::{SAMPLES, wavelength_nm},
    },
    plan::OpticsKey,
    studio::WallInSight,
};

/// One wall under the pointer.
#[derive(Clone, Debug, PartialEq)]
pub struct WallReading {
    /// Whether it is the front wall of its bubble.
    pub is_front: bool,
    /// Thickness along the normal, nm.
    pub thickness_nm: f64,
    /// Cosine of the angle of incidence in air.
    pub cos_theta: f64,
    /// Speed of the liquid along the film, m/s, if it is known.
    pub speed_m_s: Option<f64>,
    /// Where it flows to in the picture, degrees counterclockwise from the right; none at rest.
    pub flow_deg: Option<f64>,
    /// XYZ of white light after reflection; a perfect mirror has Y = 1.
    pub xyz: DVec3,
    /// Path difference between the light of both faces, 2 n d cos of the angle inside, at 589 nm, in nm.
    pub path_nm: f64,
    /// The colour as sRGB, exposed so that the brightest film at this angle is white.
    pub swatch: [u8; 3],
}

impl WallReading {
    /// Angle of incidence in air, degrees.
    #[must_use]
    pub fn angle_deg(&self) -> f64 {
        self.cos_theta.acos().to_degrees()
    }

    /// Order of Newton's colours, from 1 on.
    #[must_use]
    pub fn order(&self) -> u32 {
        newton_order(self.path_nm)
    }

    /// What the wall is called.
    #[must_use]
    pub fn name(&self) -> &'static str {
        if self.is_front { "front wall" } else { "back wall" }
    }
}

/// The film under the pointer at a moment.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Which bubble.
    pub bubble: String,
    /// Time of the film, s.
    pub time_s: f64,
    /// What the film is made of, and the light.
    pub optics: OpticsKey,
    /// The walls on the line of sight, the nearer first, at least one.
    pub walls: Vec<WallReading>,
}

/// What the walls do with light of one wavelength.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumRow {
    /// Wavelength, nm.
    pub wavelength_nm: f64,
    /// Reflectance of the nearest wall.
    pub r: Polarised,
    /// Transmittance of the nearest wall.
    pub t: Polarised,
    /// Reflectance of both walls; that of the one where there is but one.
    pub r_both: Polarised,
    /// Transmittance of both walls.
    pub t_both: Polarised,
    /// The light's spectrum, over its largest value here.
    pub light: f64,
}

impl Reading {
    /// The reading of walls in sight, of a scene with that many bubbles of its own; `None` where there is no film, or it is not read yet.
    #[must_use]
    pub fn new(walls: &[WallInSight], time_s: f64, bubbles: usize) -> Option<Self> {
        let first = walls.first()?;
        let optics = first.optics.spectra_to(walls.iter().filter_map(|wall| wall.thickness_nm).fold(0.0, f64::max));
        let readings = walls.iter().enumerate().filter_map(|(place, wall)| {
            let is_front = place == 0 && walls.len() > 1;
            wall.thickness_nm.filter(|nm| *nm > 0.0).map(|nm| reading(&optics, wall, nm, is_front))
        });
        let readings: Vec<_> = readings.collect();
        let own = first.film < bubbles;
        let bubble = if own { format!("bubble {}", first.film + 1) } else { "bubble of a generator".to_owned() };
        (!readings.is_empty()).then(|| Self { bubble, time_s, optics: first.optics.clone(), walls: readings })
    }

    /// What the walls do with light, every 5 nm from 360 to 780 nm.
    #[must_use]
    pub fn spectrum(&self) -> Vec<SpectrumRow> {
        let (film, first) = (&self.optics.film, &self.walls[0]);
        let (one, both) = (Walls::One { thickness_nm: first.thickness_nm }, self.all());
        let wavelengths = || (0..SAMPLES).step_by(5).map(wavelength_nm);
        let light = |nm: f64| self.optics.illuminant.spectrum().at_nm(nm);
        let brightest = wavelengths().map(light).fold(f64::MIN_POSITIVE, f64::max);
        let row = |nm: f64| {
            let wall = film.wall(film.index.n(nm), first.cos_theta, nm);
            SpectrumRow {
                wavelength_nm: nm,
                r: one.polarised_reflectance(&wall),
                t: one.polarised_transmittance(&wall),
                r_both: both.polarised_reflectance(&wall),
                t_both: both.polarised_transmittance(&wall),
                light: light(nm) / brightest,
            }
        };
        wavelengths().map(row).collect()
    }

    /// All walls, as the light meets them.
    #[must_use]
    pub fn all(&self) -> Walls {
        match &self.walls[..] {
            [front, back, ..] => {
                let (front_nm, back_nm) = (front.thickness_nm, back.thickness_nm);
                Walls::Two { front_nm, back_nm, exit_nm: front_nm }
            }
            walls => Walls::One { thickness_nm: walls[0].thickness_nm },
        }
    }

    /// The numbers as lines of text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!("{} at {:.3} s\n", self.bubble, self.time_s);
        for wall in &self.walls {
            let ([x, y, z], xy) = (wall.xyz.to_array(), chromaticity_xy(wall.xyz));
            let toward = wall.flow_deg.map_or(String::new(), |deg| format!(" toward {deg:.0}° from the right"));
            let speed = wall.speed_m_s.map_or("unknown".to_owned(), |speed| format!("{:.1} mm/s{toward}", 1e3 * speed));
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{}: thickness {:.2} nm, angle {:.3}°, path difference {:.1} nm, order {}, XYZ {x:.6} {y:.6} {z:.6}, chromaticity {:.4} {:.4}, flow {speed}",
                wall.name(),
                wall.thickness_nm,
                wall.angle_deg(),
                wall.path_nm,
                wall.order(),
                xy.x,
                xy.y,
            );
        }
        text
    }

    /// The spectra as a table of comma-separated values, the numbers above it as comments.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut csv = self.commented();
        csv.push_str("wavelength_nm,R_s,R_p,R,T,R_both,T_both,light,T_s,T_p,R_both_s,R_both_p,T_both_s,T_both_p\n");
        for SpectrumRow { wavelength_nm, r, t, r_both, t_both, light } in self.spectrum() {
            let [mean_r, mean_t, both_r, both_t] = [r, t, r_both, t_both].map(Polarised::mean);
            let _ = write!(csv, "{wavelength_nm},{},{},{mean_r},{mean_t},{both_r},{both_t},{light}", r.s, r.p);
            let _ = writeln!(csv, ",{},{},{},{},{},{}", t.s, t.p, r_both.s, r_both.p, t_both.s, t_both.p);
        }
        csv
    }

    /// The numbers as the comment above a table.
    #[must_use]
    pub fn commented(&self) -> String {
        self.text().lines().map(|line| format!("# {line}\n")).collect()
    }
}

fn reading(optics: &FilmOptics, wall: &WallInSight, thickness_nm: f64, is_front: bool) -> WallReading {
    let cos_theta = wall.cos_theta;
    let xyz = optics.xyz(cos_theta, Walls::One { thickness_nm });
    let exposed = m2_exposure(optics.film(), cos_theta, 1) * (BT709.from_xyz() * xyz);
    WallReading {
        is_front,
        thickness_nm,
        cos_theta,
        speed_m_s: wall.speed_m_s,
        flow_deg: wall.flow_deg,
        xyz,
        path_nm: optics.film().path_nm(thickness_nm, cos_theta),
        swatch: exposed.to_array().map(|part| (255.0 * srgb_encode(part.clamp(0.0, 1.0))).round() as u8),
    }
}

/// What the probe was asked, and what it has found.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Where the pointer is: right and up from the picture's middle, in heights of the picture.
    place: Option<DVec2>,
    /// Where it was clicked, until that is answered.
    clicked: Option<DVec2>,
    /// What is under the pointer.
    pub hover: Option<Reading>,
    /// What was clicked.
    pub pinned: Option<Pin>,
    /// The plot of it that is shown.
    pub plot: Plot,
    /// Whether the diagram of chromaticity is that of 1976 (u', v'), not that of 1931 (x, y).
    pub is_uniform: bool,
}

impl Default for Probe {
    fn default() -> Self {
        Self { place: None, clicked: None, hover: None, pinned: None, plot: Plot::Spectra, is_uniform: false }
    }
}

impl Probe {
    /// Points at a place, or at none; a click stays until it is answered.
    pub fn point(&mut self, place: Option<DVec2>, is_clicked: bool) {
        self.place = place;
        self.hover = self.hover.take().filter(|_| place.is_some());
        if is_clicked && self.clicked.is_none() {
            self.clicked = place;
        }
    }

    /// The place that is to be read.
    #[must_use]
    pub fn asked(&self) -> Option<DVec2> {
        self.clicked.or(self.place)
    }

    /// Whether a click waits for its answer.
    #[must_use]
    pub fn is_clicked(&self) -> bool {
        self.clicked.is_some()
    }

    /// Takes an answer, which is final once the film is read, and the walls that it is of; returns whether it is another one than before, or pins a
    /// point.
    pub fn answer(&mut self, reading: Option<Reading>, walls: &[WallInSight], is_read: bool) -> bool {
        let is_pinned = is_read && self.clicked.take().is_some();
        let is_new = self.hover != reading || is_pinned;
        if is_pinned {
            let places = walls.iter().map(|wall| wall.place).collect();
            let film = walls.first().map_or(0, |wall| wall.film);
            self.pinned = reading.clone().map(|reading| Pin::new(reading, (film, places)));
        }
        self.hover = reading;
        is_new
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::physics::{colour::Illuminant, optics::FilmMaterial};

    /// Two walls of soapy water, met at 45 degrees.
    pub fn reading() -> Reading {
        let optics = OpticsKey { film: FilmMaterial::default(), illuminant: Illuminant::default().into() };
        let wall = |thickness_nm, place| WallInSight {
            film: 0,
            place,
            cos_theta: 0.5f64.sqrt(),
            thickness_nm: Some(thickness_nm),
            speed_m_s: Some(0.01),
            flow_deg: Some(-35.0),
            optics: optics.clone(),
        };
        Reading::new(&[wall(320.0, DVec3::X), wall(500.0, DVec3::NEG_X)], 1.5, 1).unwrap()
    }

    #[test]
    fn numbers_are_those_of_the_optics() {
        let reading = reading();
        let optics = FilmOptics::resolving(FilmMaterial::default(), &Illuminant::default(), 500.0);
        let [front, back] = &reading.walls[..] else { panic!("two walls") };
        assert_eq!(front.xyz, optics.xyz(0.5f64.sqrt(), Walls::One { thickness_nm: 320.0 }));
        assert!((front.angle_deg() - 45.0).abs() < 1e-12 && front.is_front && !back.is_front);
        // 2 · 1.333 · 320 nm · cos 32.0°, which is of the second order.
        assert!((front.path_nm - 723.2).abs() < 1.0 && front.order() == 2, "{front:?}");
        assert_eq!(back.order(), 3);
    }

    #[test]
    fn spectra_keep_the_light() {
        let rows = reading().spectrum();
        assert_eq!((rows.len(), rows[0].wavelength_nm, rows[84].wavelength_nm), (85, 360.0, 780.0));
        for row in &rows {
            assert!((row.r.s + row.t.s - 1.0).abs().max((row.r.p + row.t.p - 1.0).abs()) < 1e-12, "one wall: {row:?}");
            let [both_r, both_t] = [row.r_both, row.t_both].map(Polarised::mean);
            assert!(both_r + both_t < 1.0 && both_r > row.r.mean(), "two walls: {row:?}");
            assert!((0.0..=1.0).contains(&row.light));
        }
        let csv = reading().csv();
        let table: Vec<_> = csv.lines().filter(|line| !line.starts_with('#')).collect();
        assert_eq!(
            (table.len(), table[0]),
            (86, "wavelength_nm,R_s,R_p,R,T,R_both,T_both,light,T_s,T_p,R_both_s,R_both_p,T_both_s,T_both_p")
        );
    }

    #[test]
    fn a_click_is_answered_once_the_film_is_read() {
        let mut probe = Probe::default();
        probe.point(Some(DVec2::ZERO), true);
        probe.point(Some(DVec2::ONE), false);
        assert_eq!(probe.asked(), Some(DVec2::ZERO), "the pointer has gone on, the click stays");
        assert!(probe.answer(Some(reading()), &[], false) && probe.pinned.is_none());
        assert!(probe.answer(Some(reading()), &[], true) && probe.pinned.is_some(), "a pin is news");
        assert_eq!(probe.asked(), Some(DVec2::ONE));
        probe.point(None, false);
        assert_eq!((probe.asked(), probe.hover), (None, None));
    }
}
