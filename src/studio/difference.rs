//! How far two pictures are apart, as people see them.

use glam::DVec3;

use crate::{
    parallel,
    physics::colour::{BT709, Lab, ciede2000, srgb_decode, xyz_to_lab},
};

/// The difference of two pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// CIEDE2000 of each pixel, row by row.
    pub delta_e: Vec<f64>,
    /// Their mean.
    pub mean: f64,
    /// The value that 99.9 % of them do not exceed.
    pub p999: f64,
}

/// CIEDE2000 between two pictures of equal size: rows of RGBA, 8 bits of sRGB. Pixels that only one of them has are left out.
#[must_use]
pub fn difference(a: &[u8], b: &[u8]) -> Difference {
    let [(a, _), (b, _)] = [a, b].map(<[u8]>::as_chunks::<4>);
    let delta_e = parallel::map(a.len().min(b.len()), |k| apart(&a[k], &b[k]));
    let mut sorted = delta_e.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let p999 = sorted.get((0.999 * sorted.len() as f64) as usize).copied().unwrap_or_default();
    let mean = delta_e.iter().sum::<f64>() / delta_e.len().max(1) as f64;
    Difference { delta_e, mean, p999 }
}

fn apart(a: &[u8], b: &[u8]) -> f64 {
    // Most pixels of two versions of a picture are the same.
    if a[..3] == b[..3] { 0.0 } else { ciede2000(lab(a), lab(b)) }
}

fn lab(pixel: &[u8]) -> Lab {
    let linear = DVec3::from_array([0, 1, 2].map(|k| srgb_decode(f64::from(pixel[k]) / 255.0)));
    xyz_to_lab(BT709.to_xyz() * linear, BT709.to_xyz() * DVec3::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_pictures_differ_by_nothing_and_greys_by_their_lightness() {
        let picture = [[200u8, 200, 200, 255]; 2000].concat();
        let none = difference(&picture, &picture);
        assert_eq!((none.delta_e.len(), none.mean, none.p999), (2000, 0.0, 0.0));
        let mut other = picture.clone();
        other[..40].iter_mut().for_each(|value| *value = 255);
        let ten = difference(&picture, &other);
        // L* of 200 is 80.6; between it and white CIEDE2000 counts 1 / (1 + 0.015 · 40.3² / √(20 + 40.3²)) of 19.4.
        assert!((ten.delta_e[0] - 12.1).abs() < 0.2 && ten.delta_e[10] == 0.0, "{}", ten.delta_e[0]);
        assert!((ten.mean - ten.delta_e[0] / 200.0).abs() < 1e-12 && ten.p999 > 12.0);
    }
}
