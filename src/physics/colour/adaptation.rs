//! From the light of a scene to its colour, and to the colour in a camera that is balanced to it.

use std::sync::LazyLock;

use glam::{DMat3, DVec3};

use super::{BT2020, ColourWeights, Illuminant, RgbSpace, quadrature::responses};

/// Cone responses of the Bradford adaptation (ICC.1:2022, annex E.2).
const BRADFORD: DMat3 = DMat3::from_cols(
    DVec3::new(0.8951, -0.7502, 0.0389),
    DVec3::new(0.2664, 1.7135, -0.0685),
    DVec3::new(-0.1614, 0.0367, 1.0296),
);

static DAYLIGHT: LazyLock<DVec3> =
    LazyLock::new(|| BT2020.from_xyz() * ColourWeights::new(&Illuminant::default()).white());

/// Factor on integrated linear BT.2020 colours that makes the white of D65 exactly (1, 1, 1): its chromaticity is rounded in the
/// definition of the space, by 2e-4.
pub fn daylight_scale() -> DVec3 {
    1.0 / *DAYLIGHT
}

/// The matrix from RGB light (linear BT.2020, see [`super::Uplift`]) to its colour under an illuminant, linear BT.2020 where
/// D65's white is (1, 1, 1). For D65 it is the identity within the uplift's residual, 1e-4.
pub fn seen_light(illuminant: &Illuminant) -> DMat3 {
    let responses = responses(&ColourWeights::new(illuminant));
    DMat3::from_diagonal(daylight_scale()) * responses.into_iter().fold(DMat3::ZERO, |sum, response| sum + response)
}

/// Steps of the iteration in [`unseen`], which finds the inverse of what is within a factor of `2^(-ROUNDS / 2)` of the strongest.
const ROUNDS: usize = 24;

/// The matrix from colours to light that has them, given the matrix from light to its colour, as of [`seen_light`]. Under lamps of few lines
/// lights differ that look the same: it gives the weakest of them, by the pseudo-inverse (iteration of A. Ben-Israel and D. Cohen, SIAM J. Numer.
/// Anal. 3, 1966, 410).
#[must_use]
pub fn unseen(seen: &DMat3) -> DMat3 {
    let squares: f64 = seen.to_cols_array().iter().map(|element| element * element).sum();
    let start = seen.transpose() * (1.0 / squares.max(f64::MIN_POSITIVE));
    (0..ROUNDS).fold(start, |inverse, _| inverse * (2.0 * DMat3::IDENTITY - *seen * inverse))
}

/// The matrix that shows an illuminant's white as D65's, in linear BT.2020 (Bradford).
pub fn white_balance(illuminant: &Illuminant) -> DMat3 {
    let to_cones = BRADFORD * BT2020.to_xyz();
    let white = daylight_scale() * (BT2020.from_xyz() * ColourWeights::new(illuminant).white());
    let gains = (to_cones * DVec3::ONE) / (to_cones * white);
    to_cones.inverse() * DMat3::from_diagonal(gains) * to_cones
}

/// The matrix from an RGB space to XYZ adapted to D50, as ICC profiles need it, and the adaptation itself (Bradford).
pub fn adapted_to_d50(space: &RgbSpace) -> (DMat3, DMat3) {
    let d50 = DVec3::new(0.9642, 1.0, 0.8249);
    let gains = (BRADFORD * d50) / (BRADFORD * (space.to_xyz() * DVec3::ONE));
    let adaptation = BRADFORD.inverse() * DMat3::from_diagonal(gains) * BRADFORD;
    (adaptation * space.to_xyz(), adaptation)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::colour::BUILT_IN;

    #[test]
    fn daylight_is_seen_as_it_is() {
        let seen = seen_light(&Illuminant::default());
        assert!((seen * DVec3::ONE - 1.0).abs().max_element() < 1e-12);
        assert!(seen.abs_diff_eq(DMat3::IDENTITY, 3e-4), "{seen}");
        assert!(white_balance(&Illuminant::default()).abs_diff_eq(DMat3::IDENTITY, 1e-12));
    }

    #[test]
    fn unseen_light_has_the_colour_that_was_seen() {
        for name in BUILT_IN.iter().map(|light| light.name) {
            let seen = seen_light(&name.parse().expect("built in"));
            let back = seen * unseen(&seen) * seen;
            // What is fainter than that is not told from none.
            let faintest = 0.5_f64.powi(ROUNDS as i32 / 2) * seen.col(0).length();
            assert!(back.abs_diff_eq(seen, faintest), "{name}: {back} {seen}");
        }
    }

    #[test]
    fn balance_makes_white_of_every_lamps_white() {
        let built_in = BUILT_IN.iter().map(|light| light.name);
        for name in built_in.chain(["2000 K"]) {
            let light: Illuminant = name.parse().expect("known");
            if light.is_monochromatic() {
                continue;
            }
            let shown = white_balance(&light) * seen_light(&light) * DVec3::ONE;
            assert!((shown - 1.0).abs().max_element() < 1e-9, "{name}: {shown}");
        }
    }

    #[test]
    fn everything_is_yellow_under_sodium() {
        let seen = seen_light(&"sodium".parse().expect("built in"));
        let [red, blue] = [DVec3::X, DVec3::Z].map(|light| (seen * light).normalize());
        // The two lines are 0.6 nm apart, and so nearly one colour.
        assert!(red.distance(blue) < 2e-3, "{red} {blue}");
    }
}
