//! From spectra to colours, and how far two colours are apart.
//!
//! XYZ = Σ S R cmf / Σ S ȳ over 360 to 780 nm in steps of 1 nm, CIE 1931 2° observer, so that a perfect mirror has Y = 1. Film colours
//! leave sRGB (12.7 % of all samples) and Display P3 (5.9 %), but not BT.2020, which is why everything here stays XYZ or linear BT.2020
//! until a picture is written.

mod adaptation;
mod built_in;
mod chromaticity;
mod cie;
mod delta_e;
mod display;
mod film;
mod illuminant;
mod quadrature;
mod spaces;
mod table;
mod temperature;
mod transmittance;
mod uplift;
mod walls;
mod weights;

#[cfg(test)]
mod reference_tests;

pub use adaptation::{adapted_to_d50, daylight_scale, seen_light, unseen, white_balance};
pub use built_in::{BUILT_IN, BuiltIn, Line};
pub use chromaticity::{chromaticity_uv, chromaticity_xy, spectral_locus};
pub use cie::Observer;
pub use delta_e::{Lab, ciede2000, xyz_to_lab};
pub use display::{Display, Gamut};
pub(in crate::physics) use display::{hash, uniform};
pub use film::{FilmOptics, SpectrumPoint, m2_delta_e, m2_exposure};
pub use illuminant::{Illuminant, UnknownIlluminant};
pub use quadrature::{QuadratureTask, QuadratureWavelength, fit_quadrature, responses};
pub use spaces::{BT709, BT2020, DISPLAY_P3, RgbSpace, bt709_to_bt2020, bt2020_to_bt709, srgb_decode, srgb_encode};
pub use table::{FilmTable, FilmTexel};
pub use temperature::correlated_temperature_k;
pub use transmittance::transmittance;
pub use uplift::Uplift;
pub use walls::Walls;
pub use weights::ColourWeights;
