//! What is laid over the picture: a number of the film in front as false colour, and a profile of the film along a line.

use std::sync::Arc;

use glam::DVec2;

use super::{
    colour_map::{diverging, viridis},
    compare::Pixels,
};
use crate::{
    parallel,
    physics::film::properties::{Drainage, VISCOSITY},
    studio::{FilmInFront, FilmView},
    words::words,
};

words! {
    /// What false colour shows of the film in front.
    pub enum FalseColour: "overlay" {
        None = "none", "The picture as a camera sees it";
        Thickness = "thickness", "Thickness of the front wall, nm";
        Speed = "flow speed", "Speed of the liquid along the front wall, mm/s";
        Vorticity = "vorticity", "Vorticity of the front wall, 1/s: positive where it turns counterclockwise as seen from outside";
    }
}

impl FalseColour {
    /// The unit of its numbers.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::None => "",
            Self::Thickness => "nm",
            Self::Speed => "mm/s",
            Self::Vorticity => "1/s",
        }
    }

    /// The colour of a part of its scale, 0 to 1, 8 bits of sRGB: that of 0 is neutral where numbers have a sign.
    #[must_use]
    pub fn colour(self, part: f64) -> [u8; 3] {
        if self == Self::Vorticity { diverging(part) } else { viridis(part) }
    }

    fn value(self, front: &FilmInFront) -> Option<f64> {
        match self {
            Self::None => None,
            Self::Thickness => Some(front.thickness_nm),
            Self::Speed => front.speed_m_s.map(|speed| 1e3 * speed),
            Self::Vorticity => front.vorticity_1_s,
        }
    }
}

/// A map of the film in front.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The map as a picture, clear where nothing is known.
    pub pixels: Pixels,
    /// The numbers that the first and the last colour stand for.
    pub scale: [f64; 2],
    /// What it shows.
    pub of: FalseColour,
}

/// Pixels of a picture for one of a map, along each side.
const COARSER: u32 = 3;

impl Map {
    /// The map of what a picture of a size in pixels shows; `None` if nothing of it is known.
    #[must_use]
    pub fn new(of: FalseColour, view: &FilmView<'_>, size: [u32; 2]) -> Option<Self> {
        let [width, height] = size.map(|side| side.div_ceil(COARSER));
        let values = parallel::map((width * height) as usize, |k| {
            let k = k as u32;
            let at = f64::from(COARSER) * (DVec2::new((k % width).into(), (k / width).into()) + 0.5);
            view.front(at).and_then(|front| of.value(&front))
        });
        let scale = scale(of, values.iter().flatten().copied())?;
        let part = |value: f64| (value - scale[0]) / (scale[1] - scale[0]);
        let rgba = values.iter().flat_map(|value| match value {
            None => [0; 4],
            Some(value) => {
                let [r, g, b] = of.colour(part(*value));
                [r, g, b, 255]
            }
        });
        Some(Self { pixels: Pixels { size: [width, height], rgba: Arc::new(rgba.collect()) }, scale, of })
    }
}

/// The ends of a scale for some numbers: round ones, 0 where speeds begin, and equally far from 0 for what has a sign.
fn scale(of: FalseColour, values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    if low > high {
        return None;
    }
    let ends = match of {
        FalseColour::Vorticity => [-low.abs().max(high.abs()), low.abs().max(high.abs())],
        FalseColour::Speed => [0.0, high],
        FalseColour::Thickness | FalseColour::None => [low, high],
    };
    let step = 10f64.powf(((ends[1] - ends[0]).max(1e-9).log10() - 0.5).floor());
    let ends = [(ends[0] / step).floor() * step, (ends[1] / step).ceil() * step];
    Some(if ends[1] > ends[0] { ends } else { [ends[0], ends[0] + step] })
}

/// Distance of streamlines, pixels of the picture.
const STREAMLINE_SPACING: f64 = 24.0;

/// Lines along which the front walls flow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Streamlines(pub Vec<Vec<DVec2>>);

impl Streamlines {
    /// Those of what a picture of a size in pixels shows. Places are right and up from its middle, in heights of it; each line goes with the flow.
    #[must_use]
    pub fn new(view: &FilmView<'_>, size: [u32; 2]) -> Self {
        let [width, height] = size.map(f64::from);
        let place = |at: DVec2| (at - 0.5 * DVec2::new(width, height)) * DVec2::new(1.0, -1.0) / height;
        let lines = view.streamlines(STREAMLINE_SPACING).into_iter();
        Self(lines.map(|line| line.into_iter().map(place).collect()).collect())
    }
}

/// Points of a profile.
const POINTS: u32 = 201;

/// The film in front along a line in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The ends of the line: right and up from the middle of the picture, in heights of it.
    pub ends: [DVec2; 2],
    /// The points that have film, in the order of the line: how far along it, 0 to 1, and the film.
    pub points: Vec<(f64, FilmInFront)>,
    /// Time of the film, s.
    pub time_s: f64,
    /// Mean thickness of the film when it was blown, nm.
    pub blown_nm: f64,
}

impl Profile {
    /// A line along which nothing is read yet.
    #[must_use]
    pub fn new(ends: [DVec2; 2]) -> Self {
        Self { ends, points: Vec::new(), time_s: 0.0, blown_nm: 0.0 }
    }

    /// Reads the film along the line, in a picture of a size in pixels; returns whether it has changed. `blown_nm` is the mean thickness with which a film
    /// of an index began.
    pub fn read(&mut self, view: &FilmView<'_>, size: [u32; 2], time_s: f64, blown_nm: impl Fn(usize) -> f64) -> bool {
        let [width, height] = size.map(f64::from);
        let point = |k: u32| {
            let along = f64::from(k) / f64::from(POINTS - 1);
            let place = self.ends[0].lerp(self.ends[1], along);
            let at = 0.5 * DVec2::new(width, height) + height * DVec2::new(place.x, -place.y);
            Some((along, view.front(at)?))
        };
        let points: Vec<_> = (0..POINTS).filter_map(point).collect();
        let film = points.first().map_or(0, |(_, front)| front.film);
        let read = Self { ends: self.ends, points, time_s, blown_nm: blown_nm(film) };
        let is_new = read != *self;
        *self = read;
        is_new
    }

    /// What a bubble of one thickness has become that drains between immobile surfaces alone: thickness in nm and height in mm, in its upper half. See
    /// [`Drainage`].
    #[must_use]
    pub fn drained(&self) -> Vec<[f64; 2]> {
        let Some((_, front)) = self.points.first() else { return Vec::new() };
        let law = Drainage { thickness_m: 1e-9 * self.blown_nm, radius_m: front.radius_m, viscosity: VISCOSITY };
        let point = |k: u32| {
            let colatitude = f64::from(k).to_radians();
            [1e9 * law.thickness_m(colatitude, self.time_s), 1e3 * front.radius_m * colatitude.cos()]
        };
        (0..=90).step_by(3).map(point).collect()
    }

    /// The profile as comma-separated values.
    #[must_use]
    pub fn csv(&self) -> String {
        let head = format!(
            "# front wall along a line, at {} s\nalong,height_mm,thickness_nm,speed_mm_s,vorticity_1_s\n",
            self.time_s
        );
        let row = |(along, front): &(f64, FilmInFront)| {
            let known = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
            let speed = known(front.speed_m_s.map(|speed| 1e3 * speed));
            format!("{along},{},{},{speed},{}\n", 1e3 * front.height_m, front.thickness_nm, known(front.vorticity_1_s))
        };
        head + &self.points.iter().map(row).collect::<String>()
    }
}

/// What is laid over the picture.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// What false colour shows.
    pub of: FalseColour,
    /// The latest map of that.
    pub map: Option<Map>,
    /// Whether streamlines are shown.
    pub shows_streamlines: bool,
    /// The latest ones.
    pub streamlines: Streamlines,
    /// The line that was drawn, with the film along it.
    pub profile: Option<Profile>,
}

impl Default for Overlay {
    fn default() -> Self {
        Self {
            of: FalseColour::None,
            map: None,
            shows_streamlines: false,
            streamlines: Streamlines::default(),
            profile: None,
        }
    }
}

impl Overlay {
    /// Whether films must be read for it.
    #[must_use]
    pub fn reads(&self) -> bool {
        self.of != FalseColour::None || self.shows_streamlines || self.profile.is_some()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn front(height_m: f64, thickness_nm: f64) -> FilmInFront {
        FilmInFront { height_m, radius_m: 0.05, film: 0, thickness_nm, speed_m_s: Some(0.01), vorticity_1_s: None }
    }

    #[test]
    fn scales_have_round_ends_that_hold_all_values() {
        let ends = |of, values: &[f64]| scale(of, values.iter().copied());
        assert_eq!(ends(FalseColour::Thickness, &[321.0, 1301.0]), Some([300.0, 1400.0]));
        assert_eq!(ends(FalseColour::Speed, &[3.0, 17.2]), Some([0.0, 18.0]));
        assert_eq!(ends(FalseColour::Vorticity, &[-2.0, 5.3]), Some([-6.0, 6.0]));
        let [low, high] = ends(FalseColour::Thickness, &[400.0]).unwrap();
        assert!(low <= 400.0 && high > low, "one thickness everywhere: {low} {high}");
        assert_eq!(ends(FalseColour::Speed, &[]), None);
    }

    #[test]
    fn the_law_beside_a_profile_is_that_of_drainage() {
        let points = vec![(0.0, front(0.05, 300.0)), (1.0, front(0.0, 500.0))];
        let profile = Profile { points, time_s: 3600.0, blown_nm: 1000.0, ..Profile::new([DVec2::ZERO, DVec2::Y]) };
        let law = profile.drained();
        // At the top 1/h² − 1/h₀² = ρ g t / (3 μ R).
        let apex_nm = 1e9 / (1e12_f64 + 1000.0 * 9.80665 * 3600.0 / (3.0 * 1.1e-3 * 0.05)).sqrt();
        assert!((law[0][0] - apex_nm).abs() < 1e-6 * apex_nm && (law[0][1] - 50.0).abs() < 1e-9, "{:?}", law[0]);
        assert!(law.windows(2).all(|pair| pair[1][0] > pair[0][0]), "thicker below");
        assert_eq!(profile.csv().lines().count(), 4);
        assert!(profile.csv().ends_with("1,0,500,10,\n"));
    }
}
