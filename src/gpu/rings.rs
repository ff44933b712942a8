//! The rings that a bubble's disc is drawn in. Towards its outline light grazes the film, stays inside for more reflections, and changes
//! faster than pixels do: rings there follow more reflections and take more samples, and the middle does not pay for it.

use crate::{
    physics::{
        bubble::reach,
        optics::{FilmMaterial, WATER_INDEX, max_reflectance},
    },
    plan::{BubbleKey, CameraKey, QuadratureKey},
    scene::Quality,
};

/// Sides of the polygons that rings are made of.
pub const SIDES: u32 = 96;

/// A part of a bubble's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner and outer edge: angle from the direction of the bubble's center, in radians, where the bubble is round. None: the whole picture.
    pub edges_rad: Option<[f64; 2]>,
    /// Inner reflections whose films are looked up: 1, 3, 7 or 11. After eleven, light is followed on: see `shaders/optics/walls.wgsl`.
    pub inner_reflections: u32,
    /// Samples along each side of a pixel.
    pub samples: u32,
    /// Whether the outline crosses it.
    pub outline: bool,
}

/// A film that reflects as much at every angle as water does at this cosine of incidence is a mirror that keeps light for long: from index 2.
const MIRROR_COS: f64 = 0.35;

/// How accurately a quality treats what is near the limb.
struct Care {
    /// Inner reflections that are followed in the middle.
    middle_reflections: u32,
    /// Cosine of incidence below which more inner reflections are followed.
    deep_cos: f64,
    /// How many there.
    deep_reflections: u32,
    /// How many within [`LIMB_PIXELS`] of the limb.
    limb_reflections: u32,
    /// Samples along each side of a pixel there.
    limb_samples: u32,
}

/// Width of the outermost ring, in pixels: beyond it the cosine of incidence changes by less than a fifth from pixel to pixel.
const LIMB_PIXELS: f64 = 3.0;
/// How far outside the outline a pixel may have its center and still be crossed by it, in pixels.
const MARGIN_PIXELS: f64 = 1.0;

impl Care {
    /// Denser films mirror more at every angle: what water leaves near the outline, they leave further inside.
    fn of(quality: Quality, film: &FilmMaterial) -> Self {
        let mut care = Self::of_water(quality);
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
    fn following([middle, deep, limb]: [u32; 3], deep_cos: f64, limb_samples: u32) -> Self {
        Self { middle_reflections: middle, deep_cos, deep_reflections: deep, limb_reflections: limb, limb_samples }
    }

    fn of_water(quality: Quality) -> Self {
        match quality {
            Quality::Fast => Self::following([1, 3, 3], 0.5, 2),
            Quality::Standard => Self::following([3, 7, 7], 0.35, 2),
            Quality::Spectral => Self::following([3, 7, 11], 0.7, 4),
        }
    }
}

impl Ring {
    /// The whole picture: what a bubble covers from inside.
    fn everywhere(inner_reflections: u32, samples: u32) -> Self {
        Self { edges_rad: None, inner_reflections, samples, outline: false }
    }

    /// For the inner and the outer edge, a corner of the polygon around it: parts along the direction of the center and across.
    #[must_use]
    pub fn corners(&self) -> [[f32; 2]; 2] {
        let half_side = std::f64::consts::PI / f64::from(SIDES);
        self.edges_rad.unwrap_or_default().map(|angle| [angle.cos() * half_side.cos(), angle.sin()].map(|x| x as f32))
    }
}

/// Distance of the eye from a bubble's center in radii, in the space in which the bubble is round.
fn eye_radii(camera: &CameraKey, bubble: &BubbleKey) -> f64 {
    (bubble.stretch.inverse() * (camera.eye_m - bubble.center_m)).length() / bubble.radius_m
}

/// Angle from a bubble's center to its outline, in radians and in the space in which it is round; none from inside.
fn limb_rad(camera: &CameraKey, bubble: &BubbleKey) -> Option<f64> {
    let sine = eye_radii(camera, bubble).recip();
    (sine < 1.0).then(|| sine.asin())
}

/// The most that a pixel spans there, in radians: in the middle of the picture, less elsewhere.
fn pixel_rad(camera: &CameraKey, bubble: &BubbleKey) -> f64 {
    camera.pixel_height_m * reach(bubble.stretch) * reach(bubble.stretch.inverse())
}

/// The rings of a bubble, from the middle outwards.
#[must_use]
pub fn rings(camera: &CameraKey, bubble: &BubbleKey, quality: Quality, film: &FilmMaterial) -> Vec<Ring> {
    let care = Care::of(quality, film);
    let deep_sin = (1.0 - care.deep_cos * care.deep_cos).sqrt();
    let Some(limb_rad) = limb_rad(camera, bubble) else {
        let is_deep = eye_radii(camera, bubble) > deep_sin;
        return vec![Ring::everywhere(
            if is_deep { care.deep_reflections } else { care.middle_reflections },
            bubble.samples,
        )];
    };
    let pixel_rad = pixel_rad(camera, bubble);
    let ring_rad = (limb_rad - LIMB_PIXELS * pixel_rad).max(0.0);
    let deep_rad = (deep_sin * limb_rad.sin()).asin().min(ring_rad);
    let ring = |edges_rad: [f64; 2], inner_reflections: u32| Ring {
        edges_rad: Some(edges_rad),
        inner_reflections,
        samples: bubble.samples,
        outline: false,
    };
    let limb = ring([ring_rad, limb_rad + MARGIN_PIXELS * pixel_rad], care.limb_reflections);
    let limb = Ring { samples: bubble.samples.max(care.limb_samples), outline: true, ..limb };
    let rings =
        [ring([0.0, deep_rad], care.middle_reflections), ring([deep_rad, ring_rad], care.deep_reflections), limb];
    rings.into_iter().filter(|ring| ring.edges_rad.is_some_and(|[inner, outer]| outer > inner)).collect()
}

/// The one ring that covers all of a bubble: for the yardstick.
#[must_use]
pub fn disc(camera: &CameraKey, bubble: &BubbleKey) -> Ring {
    let Some(limb_rad) = limb_rad(camera, bubble) else { return Ring::everywhere(3, 1) };
    let edges_rad = Some([0.0, limb_rad + MARGIN_PIXELS * pixel_rad(camera, bubble)]);
    Ring { edges_rad, outline: true, ..Ring::everywhere(3, 1) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::optics::FilmIndex;

    #[test]
    fn denser_films_are_followed_for_longer_at_more_angles() {
        let care = |quality, index| Care::of(quality, &FilmMaterial::from(FilmIndex::Constant(index)));
        for quality in [Quality::Fast, Quality::Standard, Quality::Spectral] {
            let water = Care::of(quality, &FilmMaterial::default());
            assert_eq!(water.deep_cos, Care::of_water(quality).deep_cos);
            let deep_cos = [1.0, 1.333, 1.6, 1.9, 2.4, 4.0].map(|index| care(quality, index).deep_cos);
            assert!(deep_cos.is_sorted(), "{deep_cos:?}");
            assert!(care(quality, 4.0).deep_reflections > water.deep_reflections);
        }
    }
}
