//! What is known of a point that was pinned with the probe: its spectra, the colours of all thicknesses there, and how it thinned.

use std::fmt::Write;

use glam::{DMat3, DVec3};

use crate::{
    physics::colour::{BT2020, Display, Gamut, Walls, chromaticity_uv, chromaticity_xy, daylight_scale},
    words::words,
};

use super::{Reading, SpectrumRow};

words! {
    /// Plots of a pinned point.
    pub enum Plot: "plot" {
        Spectra = "spectra", "Reflectance R and transmittance T against wavelength, for s and p light, over the spectrum of the light";
        Time = "time", "Thickness of the pinned place against time, while time passes";
        Strip = "Newton's strip", "Colours of films against their thickness, at this angle and in this light";
        Chromaticity = "chromaticity", "Where the film's colours lie among all colours: spectral locus, sRGB, Display P3";
    }
}

impl Plot {
    /// The plot as a word of a file's name.
    #[must_use]
    pub fn file_word(self) -> &'static str {
        if self == Self::Strip { "strip" } else { self.name() }
    }
}

/// A film of a thickness, at the angle and in the light of the pinned point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StripPoint {
    /// Thickness along the normal, nm.
    pub thickness_nm: f64,
    /// XYZ of white light after reflection by one wall; a perfect mirror has Y = 1.
    pub xyz: DVec3,
    /// The colour as sRGB, exposed so that the brightest film at this angle is white.
    pub swatch: [u8; 3],
}

/// The thickness of a pinned place at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Time of the film, s.
    pub time_s: f64,
    /// Thickness in nm of the front wall and, if there is one, of the back wall.
    pub thickness_nm: [Option<f64>; 2],
}

/// A pinned point.
#[derive(Clone, Debug, PartialEq)]
pub struct Pin {
    /// What was read there.
    pub reading: Reading,
    /// What the walls do with light.
    pub spectrum: Vec<SpectrumRow>,
    /// Newton's strip: films from no thickness on.
    pub strip: Vec<StripPoint>,
    /// The film and the places of the walls on it: unit vectors from the center of the bubble, in the world's axes.
    pub places: (usize, Vec<DVec3>),
    /// Thickness as time has passed, in the order of time.
    pub history: Vec<Sample>,
}

/// Thickness at the end of a strip, nm, unless the pinned film is thicker.
const STRIP_NM: f64 = 1500.0;
/// Films of a strip.
const STRIP_POINTS: u32 = 301;
/// Samples of a history that are kept: ten minutes at six a second.
const LONGEST_HISTORY: usize = 3600;

impl Pin {
    /// Works out all that follows from a reading.
    #[must_use]
    pub fn new(reading: Reading, places: (usize, Vec<DVec3>)) -> Self {
        let (spectrum, strip) = (reading.spectrum(), strip(&reading));
        let mut pin = Self { reading, spectrum, strip, places, history: Vec::new() };
        let thickness = |wall: usize| pin.reading.walls.get(wall).map(|wall| wall.thickness_nm);
        pin.record(Sample { time_s: pin.reading.time_s, thickness_nm: [thickness(0), thickness(1)] });
        pin
    }

    /// Notes the thickness at a time; what was noted of later times is of another history. Returns whether it is news.
    pub fn record(&mut self, sample: Sample) -> bool {
        self.history.retain(|known| known.time_s < sample.time_s || *known == sample);
        if self.history.last() == Some(&sample) {
            return false;
        }
        if self.history.len() == LONGEST_HISTORY {
            self.history.remove(0);
        }
        self.history.push(sample);
        true
    }

    /// What a plot shows, as comma-separated values with the numbers of the reading above it.
    #[must_use]
    pub fn csv(&self, plot: Plot) -> String {
        match plot {
            Plot::Spectra => self.reading.csv(),
            Plot::Time => self.table("time_s,front_nm,back_nm", |csv| {
                for Sample { time_s, thickness_nm } in &self.history {
                    let [front, back] = thickness_nm.map(|nm| nm.map_or(String::new(), |nm| nm.to_string()));
                    // Writing to a string cannot fail.
                    let _ = writeln!(csv, "{time_s},{front},{back}");
                }
            }),
            Plot::Strip => self.table("thickness_nm,X,Y,Z,s_r,s_g,s_b", |csv| {
                for StripPoint { thickness_nm, xyz, swatch: [r, g, b] } in &self.strip {
                    let _ = writeln!(csv, "{thickness_nm},{},{},{},{r},{g},{b}", xyz.x, xyz.y, xyz.z);
                }
            }),
            Plot::Chromaticity => self.table("thickness_nm,x,y,u_prime,v_prime", |csv| {
                for StripPoint { thickness_nm, xyz, .. } in &self.strip {
                    let (xy, uv) = (chromaticity_xy(*xyz), chromaticity_uv(*xyz));
                    let _ = writeln!(csv, "{thickness_nm},{},{},{},{}", xy.x, xy.y, uv.x, uv.y);
                }
            }),
        }
    }

    fn table(&self, heading: &str, rows: impl FnOnce(&mut String)) -> String {
        let mut csv = self.reading.commented();
        csv.push_str(heading);
        csv.push('\n');
        rows(&mut csv);
        csv
    }
}

/// Films at the angle of the nearest wall of a reading and in its light.
fn strip(reading: &Reading) -> Vec<StripPoint> {
    let wall = &reading.walls[0];
    let last_nm = reading.walls.iter().map(|wall| 1.1 * wall.thickness_nm).fold(STRIP_NM, f64::max);
    let optics = reading.optics.spectra_to(last_nm);
    let exposure_ev = -optics.film().max_reflectance(wall.cos_theta).max(1e-3).log2();
    let display = Display { exposure_ev, balance: DMat3::IDENTITY, gamut: Gamut::Srgb, dither: None };
    let spectral_wall = optics.spectral_wall(wall.cos_theta);
    let film = |k: u32| {
        let thickness_nm = last_nm * f64::from(k) / f64::from(STRIP_POINTS - 1);
        let reflectances = Walls::One { thickness_nm }.reflectances(&spectral_wall);
        let xyz = optics.weights().integrate(|i| reflectances[i]);
        StripPoint { thickness_nm, xyz, swatch: display.encode(daylight_scale() * (BT2020.from_xyz() * xyz), [0, 0]) }
    };
    (0..STRIP_POINTS).map(film).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::probe::tests::reading;

    fn pin() -> Pin {
        Pin::new(reading(), (0, vec![DVec3::X, DVec3::NEG_X]))
    }

    #[test]
    fn a_strip_passes_through_the_film_itself() {
        let pin = pin();
        assert_eq!((pin.strip[0].thickness_nm, pin.strip[0].xyz), (0.0, DVec3::ZERO));
        // The film of 320 nm lies on a point of the strip, 5 nm apart.
        assert_eq!((pin.strip[64].thickness_nm, pin.strip[300].thickness_nm), (320.0, 1500.0));
        let own = pin.reading.walls[0].xyz;
        assert!((pin.strip[64].xyz - own).abs().max_element() < 1e-15, "{own} {}", pin.strip[64].xyz);
    }

    #[test]
    fn a_history_forgets_what_lies_ahead_when_time_goes_back() {
        let mut pin = pin();
        let sample = |time_s, nm| Sample { time_s, thickness_nm: [Some(nm), None] };
        assert!(pin.record(sample(2.0, 300.0)) && pin.record(sample(3.0, 290.0)));
        assert!(!pin.record(sample(3.0, 290.0)), "nothing has changed");
        assert!(pin.record(sample(2.5, 280.0)));
        assert_eq!(pin.history.iter().map(|sample| sample.time_s).collect::<Vec<_>>(), [1.5, 2.0, 2.5]);
        assert!((0..2 * LONGEST_HISTORY).all(|k| pin.record(sample(3.0 + k as f64, 1.0))));
        assert_eq!(pin.history.len(), LONGEST_HISTORY);
    }

    #[test]
    fn every_plot_is_a_table() {
        let pin = pin();
        for (plot, heading, rows) in [
            (Plot::Spectra, "wavelength_nm,R_s,R_p,R,T,R_both,T_both,light,", 85),
            (Plot::Time, "time_s,front_nm,back_nm", 1),
            (Plot::Strip, "thickness_nm,X,Y,Z,s_r,s_g,s_b", 301),
            (Plot::Chromaticity, "thickness_nm,x,y,u_prime,v_prime", 301),
        ] {
            let csv = pin.csv(plot);
            let lines: Vec<_> = csv.lines().filter(|line| !line.starts_with('#')).collect();
            assert!(lines[0].starts_with(heading), "{}", lines[0]);
            assert_eq!(lines.len(), rows + 1, "{plot:?}");
            let columns = |line: &str| line.split(',').count();
            assert!(lines.iter().all(|line| columns(line) == columns(lines[0])), "{plot:?}");
        }
    }
}
