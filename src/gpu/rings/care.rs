//! How accurately a quality treats what is near the limb.

use crate::{
    physics::optics::{FilmMaterial, WATER_INDEX, max_reflectance},
    plan::QuadratureKey,
    scene::Quality,
};

/// A film that reflects as much at every angle as water does at this cosine of incidence is a mirror that keeps light for long: from index 2.
const MIRROR_COS: f64 = 0.35;
/// Samples along each side of a pixel that is unlike its neighbours. They bring 2 to 3 dB to pictures of trees and windows for a third of a frame's
/// cost more; four in a line across the edge bring less for as much.
const REFINED_SAMPLES: u32 = 2;
/// Width of the outermost ring, in pixels, at least: beyond it the cosine of incidence changes by a tenth at most from pixel to pixel. Where the ring's
/// pixels take many samples, on a grid, it is narrower, and beyond it the cosine changes by a sixth.
const LIMB_PIXELS: f64 = 5.0;
const LIMB_PIXELS_OF_GRID: f64 = 3.0;
/// Contrast of the surroundings from which light is hard: black before it shows what is wrong with the edges of lamps, and with what films reflect
/// several times. Cloth and sky have 3; windows of a dark room and trees before the sky have 200, and more samples there would not bring them nearer
/// to the truth; lamps before black velvet have a thousand.
const HARD_CONTRAST: f64 = 300.0;

/// Reflections that are followed, and samples that are taken.
pub(super) struct Care {
    /// Inner reflections that are followed in the middle.
    pub middle_reflections: u32,
    /// Samples along each side of a pixel that is unlike its neighbours, in place of the one; 0 if all have one.
    pub refined_samples: u32,
    /// Cosine of incidence below which more inner reflections are followed.
    pub deep_cos: f64,
    /// How many there.
    pub deep_reflections: u32,
    /// How many in the ring at the limb.
    pub limb_reflections: u32,
    /// Samples of a pixel there.
    pub limb_samples: LimbSamples,
    /// The ring begins where a reflection turns by this angle from pixel to pixel, in radians; if that is infinite, as far from the limb as [`Care::least_limb_pixels`].
    pub limb_turn_rad: f64,
}

/// Where samples are at the limb.
#[derive(Clone, Copy)]
pub(super) enum LimbSamples {
    /// On a grid, with this number of samples along each side of a pixel.
    Grid(u32),
    /// In a line towards the center, along which a bubble changes most: this number of samples, in place of its square on a grid.
    Line(u32),
}

impl Care {
    /// Denser films mirror more at every angle: what water leaves near the outline, they leave further inside.
    pub fn of(quality: Quality, film: &FilmMaterial, contrast: f64) -> Self {
        let mut care = if contrast < HARD_CONTRAST { Self::of_water(quality) } else { Self::in_hard_light(quality) };
        if film.reference_index() > QuadratureKey::MAX_FACTOR_INDEX {
            care.middle_reflections = 3;
        }
        if film.max_reflectance(1.0) >= max_reflectance(WATER_INDEX, MIRROR_COS) {
            let reflections = if quality == Quality::Fast { 7 } else { 11 };
            return Self { deep_cos: 1.0, deep_reflections: reflections, limb_reflections: reflections, ..care };
        }
        let enough = max_reflectance(WATER_INDEX, care.deep_cos);
        let cosines = (0..=100).map(|k| 0.01 * f64::from(k));
        let deep_cos = cosines.filter(|cos| film.max_reflectance(*cos) >= enough).fold(care.deep_cos, f64::max);
        Self { deep_cos, ..care }
    }

    /// So many inner reflections in the middle, beyond an angle of incidence, and at the limb.
    fn following([middle, deep, limb]: [u32; 3], deep_cos: f64, limb_samples: LimbSamples) -> Self {
        Self {
            middle_reflections: middle,
            deep_cos,
            deep_reflections: deep,
            limb_reflections: limb,
            limb_samples,
            limb_turn_rad: f64::INFINITY,
            refined_samples: REFINED_SAMPLES,
        }
    }

    pub fn of_water(quality: Quality) -> Self {
        match quality {
            Quality::Fast => Self { refined_samples: 0, ..Self::following([1, 3, 3], 0.5, LimbSamples::Line(4)) },
            Quality::Standard => Self::following([3, 7, 7], 0.35, LimbSamples::Line(4)),
            Quality::Spectral => Self::following([3, 7, 11], 0.7, LimbSamples::Grid(4)),
        }
    }

    /// For half of a frame's cost more, half of the error at the limb: see `verify picture`.
    pub fn in_hard_light(quality: Quality) -> Self {
        let care = Self::of_water(quality);
        match quality {
            Quality::Fast => Self { limb_turn_rad: 0.05, ..care },
            Quality::Standard => {
                Self { limb_reflections: 11, limb_samples: LimbSamples::Line(8), limb_turn_rad: 0.05, ..care }
            }
            Quality::Spectral => Self { limb_samples: LimbSamples::Grid(6), limb_turn_rad: 0.035, ..care },
        }
    }

    /// Width of the ring at the limb of a bubble, whose radius is given, in pixels. A reflection turns by twice as much as the wall: by 2 / (r cos θ)
    /// from pixel to pixel, where cos² θ is 2 / r for each pixel from the limb.
    pub fn limb_pixels(&self, radius_pixels: f64) -> f64 {
        self.least_limb_pixels().max(2.0 / (self.limb_turn_rad.powi(2) * radius_pixels))
    }

    pub fn least_limb_pixels(&self) -> f64 {
        match self.limb_samples {
            LimbSamples::Line(_) => LIMB_PIXELS,
            LimbSamples::Grid(_) => LIMB_PIXELS_OF_GRID,
        }
    }
}
