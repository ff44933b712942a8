//! From scene radiance to what an 8-bit display shows: exposure, tone curve, gamut, sRGB encoding and dither, as the tonemap's shader does
//! it.

use glam::DVec3;

use super::{BT709, bt2020_to_bt709, srgb_encode};

/// Radiance, relative to the brightest channel, at which the tone curve leaves the straight line.
const SHOULDER: f64 = 0.6;
/// Radiance that the curve maps to display white.
const WHITE: f64 = 6.0;
/// How much of its saturation a colour of [`WHITE`] and beyond loses.
const BLEACH: f64 = 0.8;

/// How radiance becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// Exposure in stops: radiance is multiplied by 2 to this power.
    pub exposure_ev: f64,
    /// Seed of the dither, if there is any.
    pub dither: Option<u32>,
}

impl Display {
    /// The sRGB bytes of a pixel of that column and row (from the top left), from linear BT.2020 radiance.
    #[must_use]
    pub fn encode(&self, radiance: DVec3, pixel: [u32; 2]) -> [u8; 3] {
        let linear = into_gamut(bt2020_to_bt709() * tone_curve(self.exposure_ev.exp2() * radiance));
        let noise = self.dither.map_or(0.0, |seed| dither(pixel, seed));
        linear.to_array().map(|value| (255.0 * srgb_encode(value) + noise).round().clamp(0.0, 255.0) as u8)
    }
}

/// Maps the largest channel onto [0, 1]: straight up to [`SHOULDER`], then a rational shoulder of the same slope that reaches 1 at
/// [`WHITE`]; colours beyond the display's white lose saturation.
fn tone_curve(linear: DVec3) -> DVec3 {
    let peak = linear.max_element();
    if peak <= SHOULDER {
        return linear;
    }
    let room = 1.0 - SHOULDER;
    let over = (peak.min(WHITE) - SHOULDER) / room;
    let over_white = (WHITE - SHOULDER) / room;
    let mapped = SHOULDER + room * over * (1.0 + over / (over_white * over_white)) / (1.0 + over);
    let bleach = smoothstep((peak - 1.0) / (WHITE - 1.0)) * BLEACH;
    (linear * (mapped / peak)).lerp(DVec3::splat(mapped), bleach)
}

fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Brings a colour outside [0, 1] back by moving it towards the grey of its own luminance, just as far as needed.
fn into_gamut(linear: DVec3) -> DVec3 {
    let grey = BT709.luminance_weights().dot(linear).clamp(0.0, 1.0);
    let offset = linear - grey;
    let room = |offset: f64| if offset > 0.0 { 1.0 - grey } else { grey };
    let leaves = |offset: f64| room(offset) / offset.abs().max(1e-9);
    let t = offset.to_array().map(leaves).into_iter().fold(1.0, f64::min);
    (grey + t * offset).clamp(DVec3::ZERO, DVec3::ONE)
}

/// Triangular noise in (−1, 1) steps of the display, the same for all channels.
fn dither([column, row]: [u32; 2], seed: u32) -> f64 {
    let first = hash(column.wrapping_add(hash(row.wrapping_add(hash(seed)))));
    uniform(first) - uniform(hash(first))
}

/// The output permutation of PCG (M. O'Neill 2014), by M. Jarzynski and M. Olano, "Hash functions for GPU rendering", JCGT 9 (2020).
fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Uniform in [0, 1).
fn uniform(bits: u32) -> f64 {
    f64::from(bits >> 8) / f64::from(1 << 24)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Display = Display { exposure_ev: 0.0, dither: None };

    #[test]
    fn dark_radiance_is_shown_as_it_is() {
        for value in [0.0, 0.01, 0.18, 0.6] {
            let expected = (255.0 * srgb_encode(value)).round() as u8;
            assert_eq!(PLAIN.encode(DVec3::splat(value), [0, 0]), [expected; 3], "{value}");
        }
        let brighter = Display { exposure_ev: 1.0, ..PLAIN };
        assert_eq!(brighter.encode(DVec3::splat(0.2), [0, 0]), PLAIN.encode(DVec3::splat(0.4), [0, 0]));
    }

    #[test]
    fn the_curve_rises_smoothly_to_white() {
        let curve = |value: f64| tone_curve(DVec3::splat(value)).x;
        let mut last = 0.0;
        for k in 1..=600 {
            let value = curve(f64::from(k) * 0.01);
            // Slope 1 at most, and no jump where the shoulder begins.
            assert!(value > last && value - last < 0.01 + 1e-12, "{k}");
            last = value;
        }
        assert!((last - 1.0).abs() < 1e-12);
        assert_eq!(curve(1e9), curve(WHITE));
    }

    #[test]
    fn colours_outside_the_gamut_keep_their_luminance() {
        let green = DVec3::new(-0.2, 0.6, 0.1);
        let mapped = into_gamut(green);
        assert!(mapped.min_element() >= 0.0 && mapped.min_element() < 1e-15);
        let weights = BT709.luminance_weights();
        assert!((weights.dot(mapped) - weights.dot(green)).abs() < 1e-12);
        let inside = DVec3::new(0.1, 0.9, 0.3);
        assert!((into_gamut(inside) - inside).abs().max_element() < 1e-15);
    }

    #[test]
    fn dither_is_triangular_and_without_bias() {
        let count = 40_000;
        let noise: Vec<f64> = (0..count).map(|k| dither([k % 200, k / 200], 7)).collect();
        let mean = noise.iter().sum::<f64>() / f64::from(count);
        let variance = noise.iter().map(|value| value * value).sum::<f64>() / f64::from(count);
        // A triangle on (-1, 1) has the variance 1/6; five standard errors of 40 000 samples.
        assert!(mean.abs() < 0.011 && (variance - 1.0 / 6.0).abs() < 0.006, "{mean} {variance}");
        assert!(noise.iter().all(|value| value.abs() < 1.0));
    }
}
