//! Keys of bubbles in sight: what the picture knows of each.

use glam::{DMat3, DVec2, DVec3};

use super::{CameraKey, FilmKey, OpenHoleKey, Opening};
use crate::physics::film::Cap;

/// One bubble as the picture sees it.
#[derive(Clone, Debug, PartialEq)]
pub struct BubbleKey {
    /// Its number in layers of pictures, from 1: bubbles of the scene in their order, then the places of each generator.
    pub id: u32,
    /// Index of its film, which for a bubble of the scene is the bubble's own.
    pub index: usize,
    /// Index of the material of its film in each of the [`Lighting`](super::Lighting)s.
    pub material: usize,
    /// Center in metres.
    pub center_m: DVec3,
    /// Radius in metres.
    pub radius_m: f64,
    /// Takes directions from the center to places on the wall, over the radius: symmetric, of determinant 1, and the identity for a bubble that
    /// is round.
    pub stretch: DMat3,
    /// Bounding rectangle in clip coordinates, lower left and upper right.
    pub bounds: [DVec2; 2],
    /// Takes directions of the world to the film, which may turn as a whole.
    pub to_film: DMat3,
    /// What has evaporated from the whole film, in nm.
    pub evaporated_nm: f64,
    /// Samples along each side of a pixel.
    pub samples: u32,
    /// Whether the film is looked up through its flow map at each pixel: where cells are larger than pixels.
    pub magnified: bool,
    /// Whether pixels that are unlike their neighbours take more samples, where the quality has that.
    pub refined: bool,
    /// Thicknesses that each sample is the mean of: 1, or more where a pixel spans half a cell of the film or more.
    pub thicknesses: u32,
    /// The film.
    pub film: FilmKey,
    /// How much thicker the bubble is than the film shows.
    pub thickness_factor: f64,
    /// The hole in it, while it bursts.
    pub hole: Option<Opening>,
    /// The part of the sphere that has film, above a bath or within a ring; none for a whole sphere. On a bath its image is seen too.
    pub cap: Option<Cap>,
    /// What its film ends at, and what flies off it, if that is drawn.
    pub bodies: Vec<Body>,
}

/// What is drawn at a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// What it is.
    pub kind: BodyKind,
    /// Bounding rectangle in clip coordinates.
    pub bounds: [DVec2; 2],
}

/// What can be drawn at a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyKind {
    /// The wire of a ring that the film hangs on.
    Wire {
        /// Colatitude of the rim, radians.
        rim_rad: f64,
        /// Radius of the wire, m.
        wire_m: f64,
    },
    /// The foot of a bubble on a bath: the water that climbs at it.
    Foot {
        /// Colatitude of the rim, radians.
        rim_rad: f64,
        /// Radius of the thread of water that shines there, m.
        foot_m: f64,
    },
    /// A drop of water that hangs from the film.
    Drop {
        /// Colatitude of the rim, radians.
        rim_rad: f64,
    },
    /// The rim of a hole, a thread of water.
    HoleRim,
    /// Droplets that fly off it.
    Spray,
}

impl BubbleKey {
    /// The hole and what it opens in, while the bubble bursts.
    #[must_use]
    pub fn open_hole(&self) -> Option<OpenHoleKey> {
        let Self { evaporated_nm, radius_m, .. } = *self;
        self.hole.map(|hole| OpenHoleKey { film: self.film.clone(), evaporated_nm, radius_m, hole })
    }
}

/// A film that bubbles of a generator share.
#[derive(Clone, Debug, PartialEq)]
pub struct LentFilm {
    /// Index of the film.
    pub index: usize,
    /// Index of its material in each of the [`Lighting`](super::Lighting)s.
    pub material: usize,
    /// The film.
    pub film: FilmKey,
    /// Takes directions of the world to it, as it is on a bubble that is not turned.
    pub to_film: DMat3,
    /// What has evaporated from it, in nm.
    pub evaporated_nm: f64,
    /// How much thicker a bubble that shows it can be.
    pub max_thickness_factor: f64,
}

/// A bubble of a generator that is drawn with all others like it at once: round, whole, and with the reflections on three walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmallBubble {
    /// Its number in layers of pictures, as of [`BubbleKey::id`].
    pub id: u32,
    /// Center in metres.
    pub center_m: DVec3,
    /// Radius in metres.
    pub radius_m: f64,
    /// Bounding rectangle in clip coordinates, lower left and upper right.
    pub bounds: [DVec2; 2],
    /// Its film's place in [`DrawKey::lent`](super::DrawKey::lent).
    pub lent: usize,
    /// How far its film is turned about the vertical, radians.
    pub turn_rad: f64,
    /// How much thicker the bubble is than the film shows.
    pub thickness_factor: f64,
}

impl SmallBubble {
    /// Takes directions of the world to its film.
    #[must_use]
    pub fn to_film(&self, lent: &LentFilm) -> DMat3 {
        lent.to_film * DMat3::from_rotation_z(self.turn_rad)
    }

    /// Radius in pixels.
    #[must_use]
    pub fn radius_pixels(&self, camera: &CameraKey) -> f64 {
        self.radius_m / self.center_m.distance(camera.eye_m).max(self.radius_m) / camera.pixel_height_m
    }

    /// The bubble as it would be drawn alone, with the film that it shows.
    #[must_use]
    pub fn whole(&self, lent: &LentFilm, camera: &CameraKey) -> BubbleKey {
        BubbleKey {
            id: self.id,
            index: lent.index,
            material: lent.material,
            center_m: self.center_m,
            radius_m: self.radius_m,
            stretch: DMat3::IDENTITY,
            bounds: self.bounds,
            // A film of one thickness looks the same however it is turned.
            to_film: if matches!(lent.film, FilmKey::Uniform(_)) { DMat3::IDENTITY } else { self.to_film(lent) },
            evaporated_nm: lent.evaporated_nm,
            samples: samples(self.radius_pixels(camera)),
            magnified: false,
            // Of a crowd each bubble shows little, and most pixels have an edge in them.
            refined: false,
            thicknesses: 1,
            film: lent.film.clone(),
            thickness_factor: self.thickness_factor,
            hole: None,
            cap: None,
            bodies: Vec::new(),
        }
    }
}

/// Samples along a pixel's side: bubbles of few pixels need more, for their film and their reflections are finer than a pixel. About as many
/// rays meet every such bubble, 50 000 to 80 000, a quarter of what a bubble takes that fills a picture of 1280 x 720.
pub(in crate::plan) fn samples(radius_pixels: f64) -> u32 {
    match radius_pixels {
        r if r < 9.0 => 16,
        r if r < 13.0 => 12,
        r if r < 18.0 => 8,
        r if r < 26.0 => 6,
        r if r < 36.0 => 4,
        r if r < 50.0 => 3,
        r if r < 64.0 => 2,
        _ => 1,
    }
}
