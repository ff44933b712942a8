//! Film that ends at a circle of latitude, and the image that stands for what is beyond.
//!
//! On a sphere as on a plane, a circle is a wall to a flow whose vortices all have an image behind it: turned the other way round, where the
//! inversion in the circle takes them, for the inversion is conformal. With that image the stream function is constant on the circle, and a
//! solver of the whole sphere solves for the cap above it (Newton 2001, "The N-Vortex Problem", on the method of images on the sphere).

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::CubedSphere;

/// The part of the unit sphere above a circle of latitude.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cap {
    /// Height of the rim: the cosine of its colatitude.
    pub rim_z: f64,
    /// Squared tangent of half the rim's colatitude.
    pub inversion: f64,
}

impl Cap {
    /// The hemisphere that stands on a bath.
    pub const HEMISPHERE: Self = Self { rim_z: 0.0, inversion: 1.0 };

    /// The cap above a colatitude in radians.
    #[must_use]
    pub fn above(rim: f64) -> Self {
        Self { rim_z: rim.cos(), inversion: (0.5 * rim).tan().powi(2) }
    }

    /// Whether there is film in a direction, a unit vector.
    #[must_use]
    pub fn contains(&self, x: DVec3) -> bool {
        x.z >= self.rim_z
    }

    /// The other of the two directions that are each other's images.
    #[must_use]
    pub fn image(&self, x: DVec3) -> DVec3 {
        let (t, below, above) = (self.inversion, 1.0 - x.z, 1.0 + x.z);
        DVec3::new(2.0 * t * x.x, 2.0 * t * x.y, below - t * t * above) / (below + t * t * above)
    }

    /// How much longer a short line at a direction is in the image: of areas it is the square.
    #[must_use]
    pub fn stretch(&self, x: DVec3) -> f64 {
        let t = self.inversion;
        2.0 * t / ((1.0 - x.z) + t * t * (1.0 + x.z))
    }

    /// A direction with film: the same, or its image.
    #[must_use]
    pub fn folded(&self, x: DVec3) -> DVec3 {
        if self.contains(x) { x } else { self.image(x) }
    }

    /// The part of a cell that is film, by its direction and its angle.
    #[must_use]
    pub fn part_of_cell(&self, x: DVec3, cell_angle: f64) -> f64 {
        let across = (1.0 - x.z * x.z).sqrt().max(1e-9) * cell_angle;
        (0.5 + (x.z - self.rim_z) / across).clamp(0.0, 1.0)
    }

    /// Solid angles of film in all cells of a grid, in its order, sr.
    #[must_use]
    pub fn areas(&self, grid: CubedSphere) -> Vec<f64> {
        let part = |cell| self.part_of_cell(grid.cell_direction(cell), grid.cell_angle());
        grid.areas().iter().enumerate().map(|(cell, area)| area * part(cell)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_image_of_an_image_is_the_point_and_the_rim_stays() {
        for rim in [0.6_f64, 1.2, std::f64::consts::FRAC_PI_2, 2.5] {
            let cap = Cap::above(rim);
            for x in [DVec3::new(0.3, -0.5, 0.4), DVec3::new(-0.1, 0.2, -0.9), DVec3::Z].map(DVec3::normalize) {
                let image = cap.image(x);
                assert!((image.length() - 1.0).abs() < 1e-12 && cap.image(image).distance(x) < 1e-12);
                assert!(cap.contains(x) != cap.contains(image) && cap.contains(cap.folded(x)));
                assert!((cap.stretch(x) * cap.stretch(image) - 1.0).abs() < 1e-12);
            }
            let on_rim = DVec3::new(rim.sin(), 0.0, rim.cos());
            assert!(cap.image(on_rim).distance(on_rim) < 1e-14);
        }
        assert_eq!(Cap::HEMISPHERE.image(DVec3::new(0.6, 0.0, 0.8)), DVec3::new(0.6, 0.0, -0.8));
    }

    #[test]
    fn the_inversion_is_conformal() {
        let (cap, d) = (Cap::above(2.1), 1e-6);
        let x = DVec3::new(0.2, 0.7, -0.3).normalize();
        let (e1, e2) = x.any_orthonormal_pair();
        let [a, b] = [e1, e2].map(|e| (cap.image((x + d * e).normalize()) - cap.image(x)) / d);
        assert!((a.length() / cap.stretch(x) - 1.0).abs() < 1e-5 && (b.length() / cap.stretch(x) - 1.0).abs() < 1e-5);
        assert!(a.dot(b).abs() < 1e-5 * a.length_squared());
    }

    #[test]
    fn parts_of_cells_make_the_cap() {
        let grid = CubedSphere::new(48).unwrap();
        for rim in [1.0, std::f64::consts::FRAC_PI_2, 2.2] {
            let cap = Cap::above(rim);
            let area: f64 = cap.areas(grid).iter().sum();
            let exact = std::f64::consts::TAU * (1.0 - rim.cos());
            assert!((area / exact - 1.0).abs() < 1e-3, "{area} {exact}");
        }
    }
}
