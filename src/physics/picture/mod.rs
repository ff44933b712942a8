//! The picture that the shaders approximate: the same light path in f64, wavelength by wavelength, with no table and no field of f32.
//!
//! A ray that meets a bubble meets its film again and again at the same angle and in the same plane of incidence (a property of spheres), so
//! s and p light never mix and each hit multiplies them separately. With Rₖ and Tₖ = 1 − Rₖ of hit k, each at its own thickness,
//!
//! ```text
//! L = R₀ E(v₀) + T₀ T₁ B(v) + T₀ R₁ T₂ E(v₁) + T₀ R₁ R₂ T₃ E(v₂) + …
//! ```
//!
//! where v is the ray, v₀ its outer reflection and vₖ its direction after k inner reflections; what is left after the last direction
//! followed is given to that direction, so that no energy is lost. From inside the bubble the sum starts at hit 1.
//!
//! A bubble that is stretched is met where it is round, and turns rays by its true normals. Each hit then has an angle of its own; that the
//! planes of incidence turn from hit to hit, which mixes s and p light by the square of the stretch, is left out.
//!
//! What is and is not exact: the products of walls are formed at each wavelength of the light, and only their sum becomes a colour. RGB
//! surroundings stand for spectra (see [`Uplift`](super::colour::Uplift)), so that coloured light too is the full spectral answer. Rays are straight (refraction shifts them by less than the film's thickness). A bubble behind another is not seen through it.

mod bath;
mod light_path;
mod view;

use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::colour::FilmOptics;
use light_path::LightPath;
pub use view::PictureCamera;

/// A bubble.
pub struct FilmSphere<'a> {
    /// Center in metres.
    pub center_m: DVec3,
    /// Radius in metres.
    pub radius_m: f64,
    /// Takes directions from the center to places on the wall, over the radius: symmetric; the identity for a sphere.
    pub stretch: DMat3,
    /// Film thickness in nm in the direction of a unit vector from the center.
    pub thickness_nm: Box<dyn Fn(DVec3) -> f64 + Send + Sync + 'a>,
}

/// All that a picture is computed from. Light is linear BT.2020 relative to the illuminant's white.
pub struct PictureScene<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Where the picture is taken from.
    pub camera: PictureCamera,
    /// The film and the illuminant.
    pub optics: &'a FilmOptics,
    /// The bubbles, farthest first: where two overlap the later one hides the earlier.
    pub spheres: Vec<FilmSphere<'a>>,
    /// Light that arrives from a direction.
    pub surroundings: &'a (dyn Fn(DVec3) -> DVec3 + Sync),
    /// Radiance behind the bubbles; `None` where the environment is seen.
    pub backdrop: Option<DVec3>,
    /// Direction along which the electric field passes a polariser before the camera. The light that it takes from unpolarised light is
    /// given back.
    pub polariser: Option<DVec3>,
    /// Whether the bubbles stand on a bath at the height of their centers, above which is the eye; see `bath.rs`.
    pub on_bath: bool,
    /// Samples along each side of a pixel, 1 or more. Pixels near an outline take more.
    pub samples: u32,
}

/// Samples along each side of a pixel that a bubble's outline crosses: coverage is then right to about 1 / 100.
const OUTLINE_SAMPLES: u32 = 12;
/// Samples along each side of a pixel near an outline, where the film turns into a mirror within a few pixels.
const RIM_SAMPLES: u32 = 6;
/// How near that is, in pixels.
const RIM_PIXELS: f64 = 2.5;

impl PictureScene<'_> {
    /// Radiance of each pixel, linear BT.2020 with daylight's white at (1, 1, 1), row by row from the top left: the mean over the pixel's
    /// samples. `progress` hears of each finished row, from any thread.
    #[must_use]
    pub fn radiance(&self, progress: &(dyn Fn() + Sync)) -> Vec<DVec3> {
        let [width, height] = self.size;
        let paths = LightPath::new(self.optics, self.polariser);
        let seen = paths.seen();
        let row = |y: u32| {
            let row: Vec<DVec3> = (0..width).map(|x| self.pixel(&paths, seen, [x, y])).collect();
            progress();
            row
        };
        let rows: Vec<Vec<DVec3>> = (0..height).into_par_iter().map(row).collect();
        rows.concat()
    }

    fn pixel(&self, paths: &LightPath, seen: DMat3, corner: [u32; 2]) -> DVec3 {
        let corner = DVec2::new(f64::from(corner[0]), f64::from(corner[1]));
        let side = self.samples_at(corner + 0.5);
        let offset = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
        let samples = (0..side * side).map(|k| corner + DVec2::new(offset(k % side), offset(k / side)));
        let total: DVec3 = samples.map(|position| self.sample(paths, seen, self.camera.ray(self.size, position))).sum();
        total / f64::from(side * side)
    }

    /// Samples along each side of the pixel around a position, by how near a bubble's outline is.
    fn samples_at(&self, position: DVec2) -> u32 {
        let ray = self.camera.ray(self.size, position);
        let pixels = |sphere: &FilmSphere| {
            // Where the bubble is round, and pixels are about as large.
            let to_round = sphere.stretch.inverse();
            let offset = to_round * (sphere.center_m - self.camera.eye_m);
            let limb = (sphere.radius_m / offset.length()).asin();
            ((to_round * ray).angle_between(offset) - limb).abs() / self.camera.pixel_height_m
        };
        // Not a number inside the bubble, which has no outline: the smaller of two numbers is then the other.
        match self.spheres.iter().map(pixels).fold(f64::INFINITY, f64::min) {
            near if near < 1.0 => OUTLINE_SAMPLES.max(self.samples),
            near if near < RIM_PIXELS => RIM_SAMPLES.max(self.samples),
            _ => self.samples.max(1),
        }
    }

    fn sample(&self, paths: &LightPath, seen: DMat3, ray: DVec3) -> DVec3 {
        let hit = self.spheres.iter().rev().find_map(|sphere| {
            let eye = (self.camera.eye_m - sphere.center_m) / sphere.radius_m;
            paths.trace(eye, ray, sphere.stretch, self.on_bath.then_some(sphere.radius_m), &*sphere.thickness_nm)
        });
        let surroundings =
            |direction| (self.surroundings)(if self.on_bath { bath::upward(direction) } else { direction });
        let behind = || self.backdrop.unwrap_or_else(|| surroundings(ray));
        match hit {
            None if self.on_bath => seen * (bath::crossing(1.0, ray.z, ray) * behind()),
            None => seen * behind(),
            Some(arrivals) => {
                let reflected = arrivals.reflected.iter().map(|(direction, colour)| *colour * surroundings(*direction));
                arrivals.straight * behind() + reflected.sum::<DVec3>()
            }
        }
    }
}

#[cfg(test)]
mod tests;
