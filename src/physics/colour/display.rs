//! From scene radiance to what an 8-bit display shows: exposure, tone curve, gamut, sRGB encoding and dither, as the tonemap's shader does
//! it.

use glam::{DMat3, DVec3};

use super::{BT709, BT2020, DISPLAY_P3, RgbSpace, srgb_encode};

/// Radiance, relative to the brightest channel, at which the tone curve leaves the straight line.
const SHOULDER: f64 = 0.6;
/// Radiance that the curve maps to display white.
const WHITE: f64 = 6.0;
/// How much of its saturation a colour of [`WHITE`] and beyond loses.
const BLEACH: f64 = 0.8;

/// The colours that a display, or a picture's file, has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gamut {
    /// sRGB, with the primaries of BT.709.
    #[default]
    Srgb,
    /// Display P3, with sRGB's curve.
    DisplayP3,
}

impl Gamut {
    /// The linear space.
    #[must_use]
    pub fn space(self) -> &'static RgbSpace {
        match self {
            Self::Srgb => &BT709,
            Self::DisplayP3 => &DISPLAY_P3,
        }
    }

    /// The matrix from linear BT.2020.
    #[must_use]
    pub fn from_bt2020(self) -> DMat3 {
        BT2020.matrix_to(self.space())
    }

    /// The matrix to XYZ relative to the white, as CIELAB takes it.
    #[must_use]
    pub fn to_relative_xyz(self) -> DMat3 {
        let to_xyz = self.space().to_xyz();
        DMat3::from_diagonal(1.0 / (to_xyz * DVec3::ONE)) * to_xyz
    }
}

/// How radiance becomes a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Display {
    /// Exposure in stops: radiance is multiplied by 2 to this power.
    pub exposure_ev: f64,
    /// White balance, linear BT.2020.
    pub balance: DMat3,
    /// Colours of the display.
    pub gamut: Gamut,
    /// Seed of the dither, if there is any.
    pub dither: Option<u32>,
}

impl Display {
    /// The encoded bytes of a pixel of that column and row (from the top left), from linear BT.2020 radiance.
    #[must_use]
    pub fn encode(&self, radiance: DVec3, pixel: [u32; 2]) -> [u8; 3] {
        self.bytes(encoded(self.linear(radiance)), pixel)
    }

    /// The encoded bytes and the straight alpha of a pixel that adds light to a page and leaves the part `left` of the page's own light in each
    /// channel of the display. They are meant for programs that mix encoded values, as nearly all do that show PNG files.
    ///
    /// Alpha is how much less white a white page is, beside what is added: with P the encoded picture before black and W that before white it
    /// is 1 − (W − P), the mean of the channels. It is no less than P, so that a colour times alpha is P, and the picture before black is exact.
    #[must_use]
    pub fn encode_alone(&self, added: DVec3, left: DVec3, pixel: [u32; 2]) -> [u8; 4] {
        let added = self.linear(added);
        let [black, white] = [added, (added + left).clamp(DVec3::ZERO, DVec3::ONE)].map(encoded);
        let hidden = 1.0 - (white - black).element_sum() / 3.0;
        let alpha = (255.0 * hidden.max(black.max_element())).round().clamp(0.0, 255.0);
        if alpha == 0.0 {
            return [0; 4];
        }
        let [r, g, b] = self.bytes((255.0 / alpha * black).min(DVec3::ONE), pixel);
        [r, g, b, alpha as u8]
    }

    /// The display's linear RGB of radiance, 0 to 1.
    fn linear(&self, radiance: DVec3) -> DVec3 {
        let exposed = self.exposure_ev.exp2() * (self.balance * radiance);
        let (toned, bleach) = tone_curve(exposed.max(DVec3::ZERO));
        into_gamut(self.gamut, self.gamut.from_bt2020() * toned, bleach)
    }

    fn bytes(&self, encoded: DVec3, pixel: [u32; 2]) -> [u8; 3] {
        let noise = self.dither.map_or(0.0, |seed| dither(pixel, seed));
        encoded.to_array().map(|value| (255.0 * value + noise).round().clamp(0.0, 255.0) as u8)
    }
}

fn encoded(linear: DVec3) -> DVec3 {
    DVec3::from(linear.to_array().map(srgb_encode))
}

/// How much of its chroma a colour loses for its brightness, from 0 to 1, and the grey that it would end at, linear.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Bleach {
    part: f64,
    grey: f64,
}

/// Maps the largest channel onto [0, 1]: straight up to [`SHOULDER`], then a rational shoulder of the same slope that reaches 1 at
/// [`WHITE`]; colours beyond the display's white bleach.
fn tone_curve(linear: DVec3) -> (DVec3, Bleach) {
    let peak = linear.max_element();
    if peak <= SHOULDER {
        return (linear, Bleach::default());
    }
    let room = 1.0 - SHOULDER;
    let over = (peak.min(WHITE) - SHOULDER) / room;
    let over_white = (WHITE - SHOULDER) / room;
    let mapped = SHOULDER + room * over * (1.0 + over / (over_white * over_white)) / (1.0 + over);
    let part = BLEACH * smoothstep((peak - 1.0) / (WHITE - 1.0));
    (linear * (mapped / peak), Bleach { part, grey: mapped })
}

fn smoothstep(t: f64) -> f64 {
    let t = t.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Halvings of the chroma's range: it is then right to 1 / 4096.
const HALVINGS: u32 = 12;

/// Bleaches a colour towards its grey, and brings it back into [0, 1] by lowering its chroma just as far as needed: both in CIELAB, whose
/// hue stays. Clipping turns the hue of film colours by up to 16°, and mixing with grey in linear light turns the hue of bright sodium light by 20°.
fn into_gamut(gamut: Gamut, linear: DVec3, bleach: Bleach) -> DVec3 {
    let inside = |linear: DVec3| linear.min_element() >= 0.0 && linear.max_element() <= 1.0;
    if bleach.part == 0.0 && inside(linear) {
        return linear;
    }
    let to_xyz = gamut.to_relative_xyz();
    let from_xyz = to_xyz.inverse();
    let response = DVec3::from((to_xyz * linear).to_array().map(lightness_curve));
    let bleached = response.y + bleach.part * (lightness_curve(bleach.grey) - response.y);
    let lightness = bleached.clamp(lightness_curve(0.0), lightness_curve(1.0));
    let chroma = (1.0 - bleach.part) * (response - response.y);
    let with_chroma = |t: f64| from_xyz * DVec3::from((lightness + t * chroma).to_array().map(inverse_curve));
    let whole = with_chroma(1.0);
    if inside(whole) {
        return whole;
    }
    let (mut kept, mut step) = (0.0, 0.5);
    for _ in 0..HALVINGS {
        if inside(with_chroma(kept + step)) {
            kept += step;
        }
        step *= 0.5;
    }
    with_chroma(kept).clamp(DVec3::ZERO, DVec3::ONE)
}

/// Where the curve of CIELAB leaves the cube root for a straight line (CIE 015:2018).
const CURVE_START: f64 = 6.0 / 29.0;

/// The compressive curve of CIELAB.
fn lightness_curve(t: f64) -> f64 {
    if t > CURVE_START.powi(3) { t.cbrt() } else { t / (3.0 * CURVE_START * CURVE_START) + 4.0 / 29.0 }
}

fn inverse_curve(f: f64) -> f64 {
    if f > CURVE_START { f.powi(3) } else { 3.0 * CURVE_START * CURVE_START * (f - 4.0 / 29.0) }
}

/// Triangular noise in (−1, 1) steps of the display, the same for all channels.
fn dither([column, row]: [u32; 2], seed: u32) -> f64 {
    let first = hash(column.wrapping_add(hash(row.wrapping_add(hash(seed)))));
    uniform(first) - uniform(hash(first))
}

/// The output permutation of PCG (M. O'Neill 2014), by M. Jarzynski and M. Olano, "Hash functions for GPU rendering", JCGT 9 (2020).
pub(in crate::physics) fn hash(value: u32) -> u32 {
    let state = value.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// Uniform in [0, 1).
pub(in crate::physics) fn uniform(bits: u32) -> f64 {
    f64::from(bits >> 8) / f64::from(1 << 24)
}

#[cfg(test)]
mod tests {
    use super::super::{FilmOptics, Walls, xyz_to_lab};
    use super::*;
    use crate::physics::optics::FilmIndex;

    const PLAIN: Display = Display { exposure_ev: 0.0, balance: DMat3::IDENTITY, gamut: Gamut::Srgb, dither: None };

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
        let curve = |value: f64| tone_curve(DVec3::splat(value)).0.x;
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
    fn colours_inside_the_gamut_stay_and_others_reach_its_surface() {
        let inside = DVec3::new(0.1, 0.9, 0.3);
        assert_eq!(into_gamut(Gamut::Srgb, inside, Bleach::default()), inside);
        for outside in [DVec3::new(-0.2, 0.6, 0.1), DVec3::new(1.1, 0.2, -0.05), DVec3::new(0.3, 0.9, 1.2)] {
            let mapped = into_gamut(Gamut::Srgb, outside, Bleach::default());
            let room = mapped.min_element().min(1.0 - mapped.max_element());
            assert!((0.0..2e-3).contains(&room), "{outside} to {mapped}");
            let weights = BT709.luminance_weights();
            assert!((weights.dot(mapped) - weights.dot(outside)).abs() < 1e-9);
        }
        assert_eq!(into_gamut(Gamut::Srgb, DVec3::splat(-1.0), Bleach::default()), DVec3::ZERO);
    }

    /// By how much the hue of a colour of BT.2020 turns on its way to the display, degrees; 0 for colours that are shown nearly grey, whose hue is
    /// irrelevant, and for colours that are shown unchanged.
    fn turn_of_hue(gamut: Gamut, radiance: DVec3) -> Option<f64> {
        let (toned, bleach) = tone_curve(radiance);
        let linear = gamut.from_bt2020() * toned;
        let mapped = into_gamut(gamut, linear, bleach);
        let white = gamut.space().to_xyz() * DVec3::ONE;
        let [before, after] = [linear, mapped].map(|rgb| xyz_to_lab(gamut.space().to_xyz() * rgb, white));
        let turn = (before.b.atan2(before.a) - after.b.atan2(after.a)).to_degrees();
        let turn = ((turn + 180.0).rem_euclid(360.0) - 180.0).abs();
        (linear != mapped).then_some(if after.a.hypot(after.b) > 2.0 { turn } else { 0.0 })
    }

    /// Along the fringes of a film, as bright as the eye would choose and brighter: many leave sRGB, some Display P3, and highlights bleach.
    #[test]
    fn saturated_fringes_keep_their_hue() {
        for name in ["D65", "sodium"] {
            let optics = FilmOptics::new(FilmIndex::Water, &name.parse().unwrap());
            for (gamut, brightness) in [(Gamut::Srgb, 1.0), (Gamut::DisplayP3, 1.0), (Gamut::Srgb, 4.0)] {
                let turns = (0..1500).filter_map(|k| {
                    let cos_theta = [1.0, 0.7, 0.4][k % 3];
                    let xyz = optics.xyz(cos_theta, Walls::One { thickness_nm: k as f64 });
                    let exposed = BT2020.from_xyz() * xyz / optics.film().max_reflectance(cos_theta);
                    turn_of_hue(gamut, brightness * exposed.max(DVec3::ZERO))
                });
                let (count, worst) = turns.fold((0, 0.0_f64), |(count, worst), turn| (count + 1, worst.max(turn)));
                eprintln!(
                    "measured: {name}, {gamut:?}, {brightness}: {count} of 1500 fringe colours mapped, hue turned by {worst:.3} degrees"
                );
                assert!(count > 20 && worst <= 3.0, "{name}, {gamut:?}, {brightness}: {count} {worst}");
            }
        }
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
