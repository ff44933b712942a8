//! The picture that the shaders approximate: the same light paths in f64, wavelength by wavelength, with no table and no field of f32.
//!
//! A ray is followed from the eye against the light. At each wall of film it splits: of the light that is seen along it, the part R arrives along
//! the reflected ray, and the part T = 1 − R along the ray straight on. Both go on to the next wall, of whatever bubble, so bubbles before one
//! another, through one another, inside one another and around the eye need no rule of their own. Thickness and angle are those of each hit. A
//! branch of which too little would be seen is not split any further; all of it is given to the surroundings in its direction, so that no
//! light is lost.
//!
//! A ray that meets one round bubble meets its film again and again at the same angle and in the same plane of incidence (a property of
//! spheres), so s and p light never mix and each hit multiplies them separately. With Rₖ and Tₖ = 1 − Rₖ of hit k the tree is a series,
//!
//! ```text
//! L = R₀ E(v₀) + T₀ T₁ B(v) + T₀ R₁ T₂ E(v₁) + T₀ R₁ R₂ T₃ E(v₂) + …
//! ```
//!
//! where v is the ray, v₀ its outer reflection and vₖ its direction after k inner reflections. From inside the bubble the sum starts at hit 1.
//!
//! From bubble to bubble, and on a stretched one from hit to hit, the plane of incidence turns. A turn mixes s and p with their coherence, which
//! has a complex weight of its own and which each wall multiplies by t_s t_p* or r_s r_p*, its phases included (see `weights.rs`). So a nearly
//! clear film before another leaves polarised light as it is, whatever its plane.
//!
//! What is and is not exact: along a path light may have any polarisation, elliptic too, and meet walls in any number of planes. The products of
//! walls are formed at each wavelength of the light, and only their sum becomes a colour. RGB surroundings stand for spectra (see
//! [`Uplift`](super::colour::Uplift)), so that coloured light too is the full spectral answer. Light of different paths does not interfere.
//! Surroundings are unpolarised, and a bath mirrors without polarising (see `bath.rs`). Rays are straight (refraction shifts them by less than the
//! film's thickness). What stands behind the bubbles is seen straight through them only, not in reflections.
//! Wires and drops, at which films end, are not in it.
//! What films end at, wires and drops, is not in it.

mod aperture;
mod bath;
mod finish;
mod front;
mod light_path;
mod plate;
mod view;
mod walls;
mod weights;

use glam::{DMat3, DVec2, DVec3};

use crate::parallel;

use super::colour::{ColourWeights, FilmOptics};
pub use aperture::{aperture_place, spread};
pub use finish::Finish;
pub use front::{FrontBubble, FrontPixel, FrontScene, FrontWall};
use light_path::LightPath;
pub use plate::Plate;
pub use view::PictureCamera;
pub use walls::{Line, Surface, Wall};

/// A bubble.
pub struct FilmSphere<'a> {
    /// Its film, under the picture's light.
    pub optics: &'a FilmOptics,
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
    /// The illuminant: the weights that the optics of every film have too, at the same wavelengths.
    pub light: &'a ColourWeights,
    /// The bubbles, in any order.
    pub spheres: Vec<FilmSphere<'a>>,
    /// Light that arrives from a direction.
    pub surroundings: &'a (dyn Fn(DVec3) -> DVec3 + Sync),
    /// Light that arrives from a direction behind the bubbles; `None` where the surroundings are seen.
    pub backdrop: Option<&'a (dyn Fn(DVec3) -> DVec3 + Sync)>,
    /// Direction along which the electric field passes a polariser before the camera. The light that it takes from unpolarised light is
    /// given back.
    pub polariser: Option<DVec3>,
    /// Whether the bubbles stand on a bath at the height of their centers, above which is the eye; see `bath.rs`.
    pub on_bath: bool,
    /// Part of light, at the wavelength that keeps most, below which a branch of a ray is not split any further.
    pub negligible: f64,
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
        let paths = LightPath::new(self);
        let row = |y: u32| {
            let row: Vec<DVec3> = (0..width).map(|x| self.pixel(&paths, [x, y])).collect();
            progress();
            row
        };
        parallel::map(height as usize, |y| row(y as u32)).concat()
    }

    /// Radiance of some pixels, each a column and a row, as of [`Self::radiance`].
    #[must_use]
    pub fn radiance_of(&self, pixels: &[[u32; 2]]) -> Vec<DVec3> {
        let paths = LightPath::new(self);
        parallel::map(pixels.len(), |k| self.pixel(&paths, pixels[k]))
    }

    fn pixel(&self, paths: &LightPath, corner: [u32; 2]) -> DVec3 {
        let corner = DVec2::new(f64::from(corner[0]), f64::from(corner[1]));
        let side = self.samples_at(corner + 0.5);
        let offset = |k: u32| (f64::from(k) + 0.5) / f64::from(side);
        let samples = (0..side * side).map(|k| corner + DVec2::new(offset(k % side), offset(k / side)));
        let total: DVec3 = samples.map(|position| paths.colour(self.camera.ray(self.size, position))).sum();
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
}

#[cfg(test)]
mod tests;
