//! The rings that a bubble's disc is drawn in. Towards its outline light grazes the film, stays inside for more reflections, and changes
//! faster than pixels do: rings there follow more reflections and take more samples, and the middle does not pay for it.

mod care;

use glam::DMat3;

use crate::{
    physics::{bubble::reach, optics::FilmMaterial},
    plan::{BubbleKey, CameraKey},
    scene::Quality,
};
use care::{Care, LimbSamples};

/// How far the corners of the polygons that rings are made of lie beyond the circles that they touch, in pixels. Each side costs as many pixels as its
/// triangles are long, since pixels beside a triangle are shaded along with it.
const CORNER_PIXELS: f64 = 0.5;
/// Sides of these polygons, at least and at most.
const SIDES: [f64; 2] = [12.0, 512.0];

/// A part of a bubble's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Inner and outer edge: angle from the direction of the bubble's center, in radians, where the bubble is round. None: the whole picture.
    pub edges_rad: Option<[f64; 2]>,
    /// Sides of the polygons around the edges. All rings of a bubble have as many, so that they join without gaps.
    pub sides: u32,
    /// Inner reflections whose films are looked up: 1, 3, 7 or 11. After eleven, light is followed on: see `shaders/optics/walls.wgsl`.
    pub inner_reflections: u32,
    /// Samples along each side of a pixel, or in all where they stand in a line.
    pub samples: u32,
    /// Whether the samples stand in a line through the pixel's middle, towards the bubble's center.
    pub in_line: bool,
    /// Radius of the circle of confusion that the samples fill, in pixels; 0 where the bubble is in focus.
    pub confusion_pixels: f64,
    /// Samples along each side of a pixel that is unlike its neighbours, in place of the one; 0 if all have one.
    pub refined_samples: u32,
    /// Lookups of the surroundings in a reflection, at most.
    pub environment_taps: u32,
    /// Whether the outline crosses it.
    pub outline: bool,
}

/// Lookups of the surroundings in a reflection, at most. Pixels span more of them in the plane of incidence than across it: twice as much at a
/// cosine of incidence of 0.7, and eight times at 0.35.
const ENVIRONMENT_TAPS: u32 = 4;
/// Radius of the circles of confusion in pixels from which they take sixteen samples, not four.
const FEW_SAMPLES_PIXELS: f64 = 3.0;
/// How far outside the outline a pixel may have its center and still be crossed by it, in pixels.
const MARGIN_PIXELS: f64 = 1.0;

impl Ring {
    /// The whole picture: what a bubble covers from inside.
    fn everywhere(inner_reflections: u32, samples: u32) -> Self {
        Self {
            edges_rad: None,
            sides: 3,
            inner_reflections,
            samples,
            in_line: false,
            confusion_pixels: 0.0,
            refined_samples: 0,
            environment_taps: 1,
            outline: false,
        }
    }

    /// The one ring of a bubble that is out of focus.
    fn out_of_focus(edges_rad: [f64; 2], sides: u32, inner_reflections: u32, confusion_pixels: f64) -> Self {
        Self {
            edges_rad: Some(edges_rad),
            sides,
            confusion_pixels,
            outline: true,
            ..Self::everywhere(inner_reflections, samples_of_circle(confusion_pixels))
        }
    }

    /// How many vertices its triangles have: see `ring` in `shaders/pass/bubble.wgsl`.
    #[must_use]
    pub fn vertices(&self) -> u32 {
        match self.edges_rad {
            None | Some([0.0, _]) => self.sides,
            Some(_) => 2 * (self.sides + 1),
        }
    }

    /// For the inner and the outer edge, a corner of the polygon around it: parts along the direction of the center and across.
    #[must_use]
    pub fn corners(&self) -> [[f32; 2]; 2] {
        let half_side = std::f64::consts::PI / f64::from(self.sides);
        self.edges_rad.unwrap_or_default().map(|angle| [angle.cos() * half_side.cos(), angle.sin()].map(|x| x as f32))
    }
}

/// Samples along each side of a square that is laid into a circle of confusion: each is filtered over its part of the circle.
fn samples_of_circle(confusion_pixels: f64) -> u32 {
    if confusion_pixels < FEW_SAMPLES_PIXELS { 2 } else { 4 }
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

/// Sides of the polygons around an outline: as few as come near enough to it.
fn sides(limb_rad: f64, pixel_rad: f64) -> u32 {
    let half_side = (1.0 + CORNER_PIXELS * pixel_rad / limb_rad).recip().acos();
    (std::f64::consts::PI / half_side).ceil().clamp(SIDES[0], SIDES[1]) as u32
}

/// The rings of a bubble, from the middle outwards, in surroundings of a contrast.
#[must_use]
pub fn rings(
    camera: &CameraKey,
    bubble: &BubbleKey,
    quality: Quality,
    film: &FilmMaterial,
    contrast: f64,
) -> Vec<Ring> {
    let care = Care::of(quality, film, contrast);
    let deep_sin = (1.0 - care.deep_cos * care.deep_cos).sqrt();
    let Some(limb_rad) = limb_rad(camera, bubble) else {
        let is_deep = eye_radii(camera, bubble) > deep_sin;
        return vec![Ring::everywhere(
            if is_deep { care.deep_reflections } else { care.middle_reflections },
            bubble.samples,
        )];
    };
    let pixel_rad = pixel_rad(camera, bubble);
    let ring_rad = (limb_rad - care.limb_pixels(limb_rad / pixel_rad) * pixel_rad).max(0.0);
    let deep_rad = (deep_sin * limb_rad.sin()).asin().min(ring_rad);
    let sides = sides(limb_rad, pixel_rad);
    let confusion_pixels = camera.confusion_pixels(bubble.center_m, bubble.radius_m);
    if confusion_pixels > 0.0 {
        let outer_rad = limb_rad + (MARGIN_PIXELS + confusion_pixels) * pixel_rad;
        return vec![Ring::out_of_focus([0.0, outer_rad], sides, care.middle_reflections, confusion_pixels)];
    }
    let inner = |edges_rad: [f64; 2], inner_reflections: u32| Ring {
        edges_rad: Some(edges_rad),
        sides,
        inner_reflections,
        samples: bubble.samples,
        in_line: false,
        confusion_pixels: 0.0,
        refined_samples: if bubble.refined { care.refined_samples } else { 0 },
        environment_taps: environment_taps(bubble),
        outline: false,
    };
    let rings = [
        inner([0.0, deep_rad], care.middle_reflections),
        inner([deep_rad, ring_rad], care.deep_reflections),
        limb_ring(bubble, &care, [ring_rad, limb_rad + MARGIN_PIXELS * pixel_rad], sides),
    ];
    rings.into_iter().filter(|ring| ring.edges_rad.is_some_and(|[inner, outer]| outer > inner)).collect()
}

/// The outermost ring, which the outline crosses.
fn limb_ring(bubble: &BubbleKey, care: &Care, edges_rad: [f64; 2], sides: u32) -> Ring {
    let (samples, in_line) = match care.limb_samples {
        LimbSamples::Line(samples) if is_sampled_in_line(bubble) => (samples, true),
        // As many samples as the line has.
        LimbSamples::Line(samples) => (bubble.samples.max(samples.isqrt()), false),
        LimbSamples::Grid(side) => (bubble.samples.max(side), false),
    };
    Ring {
        edges_rad: Some(edges_rad),
        sides,
        inner_reflections: care.limb_reflections,
        samples,
        in_line,
        confusion_pixels: 0.0,
        refined_samples: 0,
        environment_taps: environment_taps(bubble),
        outline: true,
    }
}

/// Whether samples of a bubble may stand in a line: pixels have one elsewhere, and all reflections lie in the plane through the center.
fn is_sampled_in_line(bubble: &BubbleKey) -> bool {
    bubble.samples == 1 && bubble.stretch == DMat3::IDENTITY
}

/// Lookups of the surroundings in a reflection. Where a pixel has several samples anyway they are lookups enough.
fn environment_taps(bubble: &BubbleKey) -> u32 {
    if is_sampled_in_line(bubble) { ENVIRONMENT_TAPS } else { 1 }
}

/// The ring of the middle, widened until it nearly meets the outline: for a preview.
#[must_use]
pub fn middle_everywhere(camera: &CameraKey, bubble: &BubbleKey, middle: Ring) -> Ring {
    // The polygon that the ring is drawn as reaches beyond its edge, and rays there must still meet the bubble.
    let edge_rad = |limb_rad: f64| limb_rad - pixel_rad(camera, bubble);
    let edges_rad = limb_rad(camera, bubble).map(edge_rad).filter(|edge| *edge > 0.0).map(|edge| [0.0, edge]);
    Ring { edges_rad: edges_rad.or(middle.edges_rad), ..middle }
}

/// The one ring that covers all of a bubble: for the yardstick.
#[must_use]
pub fn disc(camera: &CameraKey, bubble: &BubbleKey) -> Ring {
    let Some(limb_rad) = limb_rad(camera, bubble) else { return Ring::everywhere(3, 1) };
    let pixel_rad = pixel_rad(camera, bubble);
    let edges_rad = Some([0.0, limb_rad + MARGIN_PIXELS * pixel_rad]);
    Ring { edges_rad, sides: sides(limb_rad, pixel_rad), outline: true, ..Ring::everywhere(3, 1) }
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::{physics::optics::FilmIndex, plan::FilmKey};

    /// A bubble of 253 pixels before a camera.
    fn seen(stretch: DMat3) -> (CameraKey, BubbleKey) {
        let camera = CameraKey {
            eye_m: DVec3::ZERO,
            forward: DVec3::X,
            right: DVec3::NEG_Y,
            up: DVec3::Z,
            pixel_height_m: 1.0 / 2530.0,
            shift: DVec2::ZERO,
            lens_radius_m: 0.0,
            focus_m: 1.0,
        };
        let bubble = BubbleKey {
            id: 1,
            index: 0,
            material: 0,
            center_m: DVec3::X,
            radius_m: 0.1,
            stretch,
            bounds: [DVec2::NEG_ONE, DVec2::ONE],
            to_film: DMat3::IDENTITY,
            evaporated_nm: 0.0,
            samples: 1,
            magnified: false,
            refined: true,
            thicknesses: 1,
            film: FilmKey::Uniform(500.0),
            thickness_factor: 1.0,
            hole: None,
            cap: None,
            bodies: Vec::new(),
        };
        (camera, bubble)
    }

    #[test]
    fn polygons_come_half_a_pixel_near_to_outlines_with_few_sides() {
        let (mut camera, bubble) = seen(DMat3::IDENTITY);
        for pixels in [8.0, 40.0, 300.0, 2000.0] {
            camera.pixel_height_m = 0.1 / pixels;
            let rings = rings(&camera, &bubble, Quality::Standard, &FilmMaterial::default(), 3.0);
            let sides = f64::from(rings[0].sides);
            assert!(rings.iter().all(|ring| ring.sides == rings[0].sides));
            let beyond = |sides: f64| pixels * ((std::f64::consts::PI / sides).cos().recip() - 1.0);
            assert!(beyond(sides) <= 0.51 && (sides == 12.0 || beyond(sides - 2.0) > 0.5), "{pixels}: {sides}");
        }
    }

    #[test]
    fn rings_join_and_only_the_limb_of_a_round_bubble_takes_samples_in_a_line() {
        for quality in [Quality::Fast, Quality::Standard, Quality::Spectral] {
            let rings_of = |stretch| {
                let (camera, bubble) = seen(stretch);
                rings(&camera, &bubble, quality, &FilmMaterial::default(), 3.0)
            };
            let stretched = rings_of(DMat3::from_diagonal(DVec3::new(1.01, 1.0, 1.0)));
            assert!(stretched.iter().all(|ring| !ring.in_line && ring.environment_taps == 1));
            let rings = rings_of(DMat3::IDENTITY);
            assert!(
                rings.iter().all(|ring| ring.in_line == (ring.outline && quality != Quality::Spectral)),
                "{rings:?}"
            );
            assert!(rings.iter().all(|ring| ring.environment_taps == ENVIRONMENT_TAPS));
            assert!(rings.is_sorted_by_key(|ring| ring.inner_reflections));
            let edges: Vec<[f64; 2]> = rings.iter().filter_map(|ring| ring.edges_rad).collect();
            assert!(edges[0][0] == 0.0 && edges.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{edges:?}");
        }
    }

    #[test]
    fn a_bubble_out_of_focus_has_one_ring_as_wide_as_it_is_blurred() {
        let (camera, bubble) = seen(DMat3::IDENTITY);
        for (depth_m, samples) in [(1.03, 2), (2.0, 4)] {
            let camera = CameraKey { lens_radius_m: 0.1, focus_m: depth_m, ..camera };
            let confusion_pixels = camera.confusion_pixels(bubble.center_m, bubble.radius_m);
            assert!(confusion_pixels > 0.75, "{confusion_pixels}");
            let rings = rings(&camera, &bubble, Quality::Standard, &FilmMaterial::default(), 3.0);
            let [ring] = rings.as_slice() else { panic!("{rings:?}") };
            assert!(ring.outline && ring.samples == samples && ring.confusion_pixels == confusion_pixels, "{ring:?}");
            let pixels = (ring.edges_rad.unwrap()[1] - 0.1_f64.asin()) / camera.pixel_height_m;
            assert!((pixels - confusion_pixels - MARGIN_PIXELS).abs() < 1e-9, "{pixels}");
        }
    }

    #[test]
    fn denser_films_are_followed_for_longer_at_more_angles() {
        let care = |quality, index| Care::of(quality, &FilmMaterial::from(FilmIndex::Constant(index)), 3.0);
        for quality in [Quality::Fast, Quality::Standard, Quality::Spectral] {
            let water = Care::of(quality, &FilmMaterial::default(), 3.0);
            assert_eq!(water.deep_cos, Care::of_water(quality).deep_cos);
            let deep_cos = [1.0, 1.333, 1.6, 1.9, 2.4, 4.0].map(|index| care(quality, index).deep_cos);
            assert!(deep_cos.is_sorted(), "{deep_cos:?}");
            assert!(care(quality, 4.0).deep_reflections > water.deep_reflections);
        }
    }

    #[test]
    fn hard_light_takes_more_of_everything_at_the_limb_the_smaller_the_bubble_the_farther_inside() {
        let (mut camera, bubble) = seen(DMat3::IDENTITY);
        // From farther away: beyond 160 pixels the ring of soft light is as wide at `standard`.
        camera.pixel_height_m *= 3.0;
        let limb = |quality, contrast| {
            let rings = rings(&camera, &bubble, quality, &FilmMaterial::default(), contrast);
            rings.last().copied().expect("a limb")
        };
        for quality in [Quality::Fast, Quality::Standard, Quality::Spectral] {
            let [soft, hard] = [3.0, 3000.0].map(|contrast| limb(quality, contrast));
            let begin = |ring: Ring| ring.edges_rad.expect("a ring")[0];
            assert!(hard.samples >= soft.samples && hard.inner_reflections >= soft.inner_reflections);
            assert!(begin(hard) < begin(soft), "{quality:?}");
            let care = Care::in_hard_light(quality);
            assert!(
                care.limb_pixels(50.0) > care.limb_pixels(100.0)
                    && care.limb_pixels(2000.0) == care.least_limb_pixels()
            );
        }
    }
}
