//! Correlated colour temperature: that of the black body whose colour is nearest to a light's.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::{ColourWeights, Illuminant, chromaticity_uv};

/// Reciprocal temperatures of the black bodies that lights are compared with, in mired (10⁶/K): 25 000 K to 1000 K.
const MIREDS: std::ops::RangeInclusive<u32> = 40..=1000;
/// Steps between them, mired: chords of this length lie within 1e-5 of the locus, and a temperature of 6500 K is right to 1 K.
const STEP_MIRED: usize = 4;
/// The largest distance from the Planckian locus in the (u, v) diagram at which a light has a correlated temperature (CIE 015:2018, 9.5).
const FARTHEST_UV: f64 = 0.05;

/// The Planckian locus: reciprocal temperatures, and (u, v) of CIE 1960.
static LOCUS: LazyLock<Vec<(f64, DVec2)>> = LazyLock::new(|| {
    let mireds = MIREDS.step_by(STEP_MIRED).map(f64::from);
    // All of them are black bodies that have light.
    let body = |mired: f64| Some((mired, uv(ColourWeights::new(&Illuminant::black_body(1e6 / mired).ok()?).white())));
    mireds.filter_map(body).collect()
});

/// Chromaticity (u, v) of CIE 1960: v is two thirds of v′ of 1976.
fn uv(xyz: DVec3) -> DVec2 {
    DVec2::new(1.0, 2.0 / 3.0) * chromaticity_uv(xyz)
}

/// The correlated colour temperature of a light by its XYZ, K: that of the black body at the smallest distance in the (u, v) diagram of CIE 1960
/// (CIE 015:2018, 9.5). `None` for light farther than 0.05 from all black bodies of 1000 to 25 000 K: it has a hue, or no such temperature.
#[must_use]
pub fn correlated_temperature_k(xyz: DVec3) -> Option<f64> {
    let light = uv(xyz);
    let on_chord = |pair: &[(f64, DVec2)]| {
        let [(mired, start), (next_mired, end)] = [pair[0], pair[1]];
        let chord = end - start;
        let along = (light - start).dot(chord) / chord.length_squared();
        let mired = mired + (next_mired - mired) * along.clamp(0.0, 1.0);
        ((start + along.clamp(0.0, 1.0) * chord).distance(light), mired)
    };
    let (distance, mired) = LOCUS.windows(2).map(on_chord).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let is_within = mired > f64::from(*MIREDS.start()) && mired < f64::from(*MIREDS.end());
    (distance <= FARTHEST_UV && is_within).then(|| 1e6 / mired)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::spectra::Spectrum;

    fn temperature_k(light: &Illuminant) -> Option<f64> {
        correlated_temperature_k(ColourWeights::new(light).white())
    }

    #[test]
    fn black_bodies_have_their_own_temperature() {
        for kelvin in [1200.0, 2856.0, 5003.0, 6500.0, 12_345.0, 20_000.0] {
            let found = temperature_k(&Illuminant::black_body(kelvin).expect("in range")).expect("a black body");
            assert!((found / kelvin - 1.0).abs() < 2e-4, "{kelvin} K: {found}");
        }
    }

    #[test]
    fn lamps_have_the_published_temperatures() {
        // CIE 015:2018; sums at 1 nm over 360..780 nm move a chromaticity in its fourth digit, and with it a temperature by some 0.2 %.
        for (name, kelvin) in [("D65", 6504.0), ("D50", 5003.0), ("A", 2856.0), ("FL2", 4230.0), ("FL11", 4000.0)] {
            let found = temperature_k(&name.parse().expect("built in")).expect("white enough");
            assert!((found / kelvin - 1.0).abs() < 4e-3, "{name}: {found}");
        }
    }

    #[test]
    fn light_of_a_hue_has_none() {
        let green = Spectrum::within_points(&[(510.0, 0.0), (530.0, 1.0), (550.0, 0.0)]);
        assert_eq!(temperature_k(&Illuminant::new("green", green).expect("seen")), None);
        assert_eq!(temperature_k(&Illuminant::black_body(900.0).expect("in range")), None);
    }
}
