//! CIELAB and CIEDE2000.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// A colour in CIELAB (CIE 015:2018).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lab {
    /// Lightness L*, 100 for the white.
    pub l: f64,
    /// a*, green to red.
    pub a: f64,
    /// b*, blue to yellow.
    pub b: f64,
}

/// CIELAB of `xyz`, relative to `white`. Nothing is clamped: the linear piece near black continues below 0.
pub fn xyz_to_lab(xyz: DVec3, white: DVec3) -> Lab {
    let [fx, fy, fz] = (xyz / white).to_array().map(lab_curve);
    Lab { l: 116.0 * fy - 16.0, a: 500.0 * (fx - fy), b: 200.0 * (fy - fz) }
}

fn lab_curve(t: f64) -> f64 {
    const KNEE: f64 = 6.0 / 29.0;
    if t > KNEE.powi(3) { t.cbrt() } else { t / (3.0 * KNEE * KNEE) + 4.0 / 29.0 }
}

/// Colour difference CIEDE2000 with k_L = k_C = k_H = 1; about 1 is just visible side by side.
///
/// G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000 color-difference formula: implementation notes, supplementary test data, and
/// mathematical observations", Color Research & Application 30, 21 (2005).
pub fn ciede2000(first: Lab, second: Lab) -> f64 {
    let stretch = 1.0 + 0.5 * (1.0 - saturation(0.5 * (chroma(first) + chroma(second))));
    let (first, second) = (LCh::new(first, stretch), LCh::new(second, stretch));
    let grey = first.chroma * second.chroma == 0.0;
    let turn = if grey { 0.0 } else { hue_difference(first.hue, second.hue) };
    let lightness = 0.5 * (first.lightness + second.lightness);
    let chroma = 0.5 * (first.chroma + second.chroma);
    let hue = if grey { first.hue + second.hue } else { mean_hue(first.hue, second.hue) };

    let delta_l = (second.lightness - first.lightness) / lightness_scale(lightness);
    let delta_c = (second.chroma - first.chroma) / (1.0 + 0.045 * chroma);
    let delta_h = 2.0 * (first.chroma * second.chroma).sqrt() * (0.5 * turn).sin() / hue_scale(chroma, hue);
    let rotated = blue_rotation(chroma, hue) * delta_c * delta_h;
    (delta_l * delta_l + delta_c * delta_c + delta_h * delta_h + rotated).max(0.0).sqrt()
}

/// Lightness, and chroma and hue angle (0 to 2π) with a* stretched as CIEDE2000 does near grey.
struct LCh {
    lightness: f64,
    chroma: f64,
    hue: f64,
}

impl LCh {
    fn new(lab: Lab, stretch: f64) -> Self {
        let a = lab.a * stretch;
        let hue = if a == 0.0 && lab.b == 0.0 { 0.0 } else { lab.b.atan2(a).rem_euclid(TAU) };
        Self { lightness: lab.l, chroma: a.hypot(lab.b), hue }
    }
}

fn chroma(lab: Lab) -> f64 {
    lab.a.hypot(lab.b)
}

/// √(C⁷ / (C⁷ + 25⁷)): 0 for grey, 1 for strong colours.
fn saturation(chroma: f64) -> f64 {
    let c7 = chroma.powi(7);
    (c7 / (c7 + 25.0_f64.powi(7))).sqrt()
}

/// Whether the two hues are joined through 0°. Opposite hues are not; the allowance keeps rounding from deciding for them.
fn wraps(first: f64, second: f64) -> bool {
    (first - second).abs() > PI + 1e-12
}

fn hue_difference(first: f64, second: f64) -> f64 {
    let turn = second - first;
    if wraps(first, second) { turn - TAU.copysign(turn) } else { turn }
}

fn mean_hue(first: f64, second: f64) -> f64 {
    let mean = 0.5 * (first + second);
    if !wraps(first, second) {
        mean
    } else if mean < PI {
        mean + PI
    } else {
        mean - PI
    }
}

/// S_L.
fn lightness_scale(lightness: f64) -> f64 {
    let off2 = (lightness - 50.0).powi(2);
    1.0 + 0.015 * off2 / (20.0 + off2).sqrt()
}

/// S_H.
fn hue_scale(chroma: f64, hue: f64) -> f64 {
    let wave = |harmonic: f64, phase_deg: f64| (harmonic * hue + phase_deg.to_radians()).cos();
    let t = 1.0 - 0.17 * wave(1.0, -30.0) + 0.24 * wave(2.0, 0.0) + 0.32 * wave(3.0, 6.0) - 0.20 * wave(4.0, -63.0);
    1.0 + 0.015 * chroma * t
}

/// R_T, which joins chroma and hue differences in the blue.
fn blue_rotation(chroma: f64, hue: f64) -> f64 {
    let off = (hue.to_degrees() - 275.0) / 25.0;
    let angle_deg = 30.0 * (-off * off).exp();
    -2.0 * saturation(chroma) * (2.0 * angle_deg).to_radians().sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Table 1 of Sharma et al. (2005): L*, a*, b* of both colours, and their difference.
    #[rustfmt::skip]
    const SHARMA: [[f64; 7]; 34] = [
        [50.0000, 2.6772, -79.7751, 50.0000, 0.0000, -82.7485, 2.0425],
        [50.0000, 3.1571, -77.2803, 50.0000, 0.0000, -82.7485, 2.8615],
        [50.0000, 2.8361, -74.0200, 50.0000, 0.0000, -82.7485, 3.4412],
        [50.0000, -1.3802, -84.2814, 50.0000, 0.0000, -82.7485, 1.0000],
        [50.0000, -1.1848, -84.8006, 50.0000, 0.0000, -82.7485, 1.0000],
        [50.0000, -0.9009, -85.5211, 50.0000, 0.0000, -82.7485, 1.0000],
        [50.0000, 0.0000, 0.0000, 50.0000, -1.0000, 2.0000, 2.3669],
        [50.0000, -1.0000, 2.0000, 50.0000, 0.0000, 0.0000, 2.3669],
        [50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0009, 7.1792],
        [50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0010, 7.1792],
        [50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0011, 7.2195],
        [50.0000, 2.4900, -0.0010, 50.0000, -2.4900, 0.0012, 7.2195],
        [50.0000, -0.0010, 2.4900, 50.0000, 0.0009, -2.4900, 4.8045],
        [50.0000, -0.0010, 2.4900, 50.0000, 0.0010, -2.4900, 4.8045],
        [50.0000, -0.0010, 2.4900, 50.0000, 0.0011, -2.4900, 4.7461],
        [50.0000, 2.5000, 0.0000, 50.0000, 0.0000, -2.5000, 4.3065],
        [50.0000, 2.5000, 0.0000, 73.0000, 25.0000, -18.0000, 27.1492],
        [50.0000, 2.5000, 0.0000, 61.0000, -5.0000, 29.0000, 22.8977],
        [50.0000, 2.5000, 0.0000, 56.0000, -27.0000, -3.0000, 31.9030],
        [50.0000, 2.5000, 0.0000, 58.0000, 24.0000, 15.0000, 19.4535],
        [50.0000, 2.5000, 0.0000, 50.0000, 3.1736, 0.5854, 1.0000],
        [50.0000, 2.5000, 0.0000, 50.0000, 3.2972, 0.0000, 1.0000],
        [50.0000, 2.5000, 0.0000, 50.0000, 1.8634, 0.5757, 1.0000],
        [50.0000, 2.5000, 0.0000, 50.0000, 3.2592, 0.3350, 1.0000],
        [60.2574, -34.0099, 36.2677, 60.4626, -34.1751, 39.4387, 1.2644],
        [63.0109, -31.0961, -5.8663, 62.8187, -29.7946, -4.0864, 1.2630],
        [61.2901, 3.7196, -5.3901, 61.4292, 2.2480, -4.9620, 1.8731],
        [35.0831, -44.1164, 3.7933, 35.0232, -40.0716, 1.5901, 1.8645],
        [22.7233, 20.0904, -46.6940, 23.0331, 14.9730, -42.5619, 2.0373],
        [36.4612, 47.8580, 18.3852, 36.2715, 50.5065, 21.2231, 1.4146],
        [90.8027, -2.0831, 1.4410, 91.1528, -1.6435, 0.0447, 1.4441],
        [90.9257, -0.5406, -0.9208, 88.6381, -0.8985, -0.7239, 1.5381],
        [6.7747, -0.2908, -2.4247, 5.8714, -0.0985, -2.2286, 0.6377],
        [2.0776, 0.0795, -1.1350, 0.9033, -0.0636, -0.5514, 0.9082],
    ];

    #[test]
    fn equals_the_34_pairs_of_sharma_both_ways() {
        for (i, [l1, a1, b1, l2, a2, b2, expected]) in SHARMA.into_iter().enumerate() {
            let (first, second) = (Lab { l: l1, a: a1, b: b1 }, Lab { l: l2, a: a2, b: b2 });
            for found in [ciede2000(first, second), ciede2000(second, first)] {
                // The table has four digits after the point.
                assert!((found - expected).abs() < 5.1e-5, "pair {}: {found} instead of {expected}", i + 1);
            }
        }
    }

    #[test]
    fn white_has_lightness_100_and_black_0() {
        let white = DVec3::new(0.95047, 1.0, 1.08883);
        let lab = xyz_to_lab(white, white);
        assert!((lab.l - 100.0).abs() < 1e-12 && lab.a.abs() < 1e-12 && lab.b.abs() < 1e-12);
        let black = xyz_to_lab(DVec3::ZERO, white);
        assert!(black.l.abs() < 1e-13 && black.a == 0.0 && black.b == 0.0);
    }

    #[test]
    fn the_two_pieces_of_the_curve_meet() {
        let knee = (6.0_f64 / 29.0).powi(3);
        assert!((lab_curve(knee * (1.0 + 1e-12)) - lab_curve(knee * (1.0 - 1e-12))).abs() < 1e-11);
    }

    #[test]
    fn middle_grey_and_a_red_have_their_known_lab() {
        let d65 = DVec3::new(0.95047, 1.0, 1.08883);
        assert!((xyz_to_lab(0.18418651851244416 * d65, d65).l - 50.0).abs() < 1e-9);
        // The sRGB red primary, from its XYZ to four digits: Lab (53.24, 80.09, 67.20).
        let red = xyz_to_lab(DVec3::new(0.4124, 0.2126, 0.0193), d65);
        assert!((red.l - 53.24).abs() < 0.02 && (red.a - 80.09).abs() < 0.05 && (red.b - 67.20).abs() < 0.1, "{red:?}");
    }

    #[test]
    fn a_colour_is_no_distance_from_itself() {
        for [l, a, b, ..] in SHARMA {
            assert_eq!(ciede2000(Lab { l, a, b }, Lab { l, a, b }), 0.0);
        }
    }
}
