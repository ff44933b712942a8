//! A panorama of the whole sphere in one 2:1 picture.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use thiserror::Error;

use crate::parallel;

use super::Repairs;

/// The direction that a point of an equirectangular picture shows, a unit vector.
///
/// `uv` runs over [0, 1) from the picture's top left. The center looks along +x, up is +z, and moving right turns clockwise
/// seen from above: azimuth = (1/2 − u) 2π, elevation = (1/2 − v) π.
pub fn direction_of_uv(uv: DVec2) -> DVec3 {
    let (sin_azimuth, cos_azimuth) = ((0.5 - uv.x) * TAU).sin_cos();
    let (sin_elevation, cos_elevation) = ((0.5 - uv.y) * PI).sin_cos();
    DVec3::new(cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation)
}

/// The point of an equirectangular picture that shows `direction` (of any length but zero): the inverse of [`direction_of_uv`].
pub fn uv_of_direction(direction: DVec3) -> DVec2 {
    let azimuth = direction.y.atan2(direction.x);
    // atan2 keeps full precision at the poles, where asin would lose half of its digits.
    let elevation = direction.z.atan2(direction.truncate().length());
    DVec2::new(0.5 - azimuth / TAU, 0.5 - elevation / PI)
}

/// The pixels given do not fill the picture's width and height, or the width is odd.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "a panorama of {width}x{height} pixels cannot be made from {pixels} pixels: give width * height of them, width even"
)]
pub struct WrongPixelCount {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Pixels that were given.
    pub pixels: usize,
}

/// An equirectangular picture of radiance, linear BT.2020, in [0, [`super::MAX_RADIANCE`]].
#[derive(Debug, Clone, PartialEq)]
pub struct Equirect {
    width: usize,
    height: usize,
    pixels: Vec<[f32; 3]>,
    repairs: Repairs,
}

impl Equirect {
    /// A panorama from its pixels, linear BT.2020, row by row from the top left; what no light can have is repaired and
    /// counted.
    ///
    /// # Errors
    /// The count of pixels is not `width * height`, is zero, or `width` is odd (a row then has no pixel straight across the
    /// pole).
    pub fn new(width: usize, height: usize, mut pixels: Vec<[f32; 3]>) -> Result<Self, WrongPixelCount> {
        let expected = width.checked_mul(height);
        if pixels.is_empty() || expected != Some(pixels.len()) || !width.is_multiple_of(2) {
            return Err(WrongPixelCount { width, height, pixels: pixels.len() });
        }
        let repairs =
            parallel::change(&mut pixels, width, |_, row| row.iter_mut().map(Repairs::repair).sum::<Repairs>());
        let repairs = repairs.into_iter().sum();
        Ok(Self { width, height, pixels, repairs })
    }

    /// Pixels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows, the zenith's first.
    pub fn height(&self) -> usize {
        self.height
    }

    /// All pixels, linear BT.2020, row by row from the top left.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// What had to be repaired in the pixels given.
    pub fn repairs(&self) -> Repairs {
        self.repairs
    }

    /// Radiance from `direction` (of any length but zero), interpolated between the four nearest pixel centers.
    pub fn radiance(&self, direction: DVec3) -> DVec3 {
        let uv = uv_of_direction(direction);
        let position = DVec2::new(uv.x * self.width as f64, uv.y * self.height as f64) - 0.5;
        let corner = position.floor();
        let weight = position - corner;
        let (column, row) = (corner.x as i64, corner.y as i64);
        let across = |row| self.pixel(column, row).lerp(self.pixel(column + 1, row), weight.x);
        across(row).lerp(across(row + 1), weight.y)
    }

    /// The pixel at a column and row that may lie outside: columns wrap, and past a pole the picture continues half a turn away.
    fn pixel(&self, column: i64, row: i64) -> DVec3 {
        let (width, last_row) = (self.width as i64, self.height as i64 - 1);
        let across_pole = row < 0 || row > last_row;
        let turned = if across_pole { column + width / 2 } else { column };
        let index = row.clamp(0, last_row) * width + turned.rem_euclid(width);
        glam::Vec3::from(self.pixels[index as usize]).as_dvec3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn black(width: usize, height: usize) -> Vec<[f32; 3]> {
        vec![[0.0; 3]; width * height]
    }

    /// Radiance that tells its column by red and its row by green.
    fn ruler(width: usize, height: usize) -> Equirect {
        let pixels = (0..width * height).map(|i| [(i % width) as f32, (i / width) as f32, 1.0]).collect();
        Equirect::new(width, height, pixels).unwrap()
    }

    #[test]
    fn the_picture_looks_where_the_convention_says() {
        let cases = [
            ((0.5, 0.5), DVec3::X),
            ((0.25, 0.5), DVec3::Y), // left of the center is anticlockwise from +x
            ((0.75, 0.5), DVec3::NEG_Y),
            ((0.0, 0.5), DVec3::NEG_X),
            ((0.3, 0.0), DVec3::Z),
            ((0.7, 1.0), DVec3::NEG_Z),
        ];
        for ((u, v), direction) in cases {
            let error = direction_of_uv(DVec2::new(u, v)).distance(direction);
            assert!(error < 1e-15, "({u}, {v}) looks {error} away from {direction}");
        }
    }

    #[test]
    fn uv_and_direction_are_inverse() {
        for i in 0..40 {
            for j in 0..20 {
                let uv = DVec2::new((f64::from(i) + 0.5) / 40.0, (f64::from(j) + 0.5) / 20.0);
                // Two rounding errors of an angle up to π.
                assert!(uv_of_direction(3.0 * direction_of_uv(uv)).distance(uv) < 1e-14, "{uv}");
            }
        }
    }

    #[test]
    fn one_bright_pixel_shines_from_its_own_direction_only() {
        let (width, height) = (16, 8);
        let mut pixels = black(width, height);
        pixels[2 * width + 5] = [4.0, 5.0, 6.0];
        let panorama = Equirect::new(width, height, pixels).unwrap();
        for row in 0..height {
            for column in 0..width {
                let uv = DVec2::new((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
                let expected = if (column, row) == (5, 2) { DVec3::new(4.0, 5.0, 6.0) } else { DVec3::ZERO };
                let error = panorama.radiance(direction_of_uv(uv)).distance(expected);
                assert!(error < 1e-12, "column {column}, row {row}");
            }
        }
    }

    #[test]
    fn interpolates_between_pixel_centers() {
        let panorama = ruler(16, 8);
        let radiance = panorama.radiance(direction_of_uv(DVec2::new(5.75 / 16.0, 3.25 / 8.0)));
        assert!(radiance.distance(DVec3::new(5.25, 2.75, 1.0)) < 1e-12, "{radiance}");
    }

    #[test]
    fn wraps_across_the_seam_without_a_jump() {
        let panorama = ruler(16, 8);
        // Half way between the last column (15) and the first (0).
        let on_seam = panorama.radiance(direction_of_uv(DVec2::new(0.0, 3.5 / 8.0)));
        assert!((on_seam.x - 7.5).abs() < 1e-12, "{on_seam}");
        let either_side = [1e-9, -1e-9].map(|y| panorama.radiance(DVec3::new(-1.0, y, 0.0)));
        assert!(either_side[0].distance(either_side[1]) < 1e-6);
    }

    #[test]
    fn the_pole_has_one_radiance_from_every_side() {
        let mut pixels = black(16, 8);
        pixels[3] = [16.0; 3];
        let panorama = Equirect::new(16, 8, pixels).unwrap();
        // Straight across the pole the bright pixel of the top row is half of what is seen.
        let toward = direction_of_uv(DVec2::new(3.5 / 16.0, 0.0));
        let away = direction_of_uv(DVec2::new(11.5 / 16.0, 0.0));
        assert!((panorama.radiance(toward + 1e-9 * direction_of_uv(DVec2::new(3.5 / 16.0, 0.5))).x - 8.0).abs() < 1e-6);
        assert!((panorama.radiance(away + 1e-9 * direction_of_uv(DVec2::new(11.5 / 16.0, 0.5))).x - 8.0).abs() < 1e-6);
    }

    #[test]
    fn no_direction_panics() {
        let panorama = ruler(2, 1);
        for x in [-1.0, -0.0, 0.0, 1.0] {
            for y in [-1.0, -0.0, 0.0, 1.0] {
                for z in [-1.0, -0.0, 0.0, 1.0] {
                    assert!(panorama.radiance(DVec3::new(x, y, z)).is_finite());
                }
            }
        }
    }

    #[test]
    fn refuses_a_wrong_count_of_pixels() {
        for (width, height, pixels) in [(4, 2, 7), (4, 2, 9), (0, 0, 0), (3, 1, 3), (usize::MAX, 2, 4)] {
            let error = Equirect::new(width, height, vec![[0.0; 3]; pixels]).unwrap_err();
            assert_eq!(error, WrongPixelCount { width, height, pixels });
        }
    }

    #[test]
    fn repairs_are_counted() {
        let panorama = Equirect::new(2, 1, vec![[f32::NAN, 1.0, 1.0], [1.0, 1.0, f32::INFINITY]]).unwrap();
        assert_eq!(panorama.repairs(), Repairs { not_a_number: 1, negative: 0, too_bright: 1 });
        assert_eq!(panorama.pixels(), [[0.0, 1.0, 1.0], [1.0, 1.0, super::super::MAX_RADIANCE]]);
    }
}
