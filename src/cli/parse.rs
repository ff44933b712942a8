//! Parsers of single arguments.

use std::ops::RangeInclusive;

use crate::{
    export::{Quality, parse_size},
    physics::colour::{BuiltIn, Gamut},
    scene,
};

/// `1280x720`.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    parse_size(text).map_err(|error| error.to_string())
}

/// A time in seconds, from 0.
pub fn time_s(text: &str) -> Result<f64, String> {
    let time = finite(text)?;
    if time < 0.0 { Err("the time is before the start: use 0 or later".to_owned()) } else { Ok(time) }
}

/// A number that is neither infinite nor NaN.
pub fn finite(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or_else(|| "not a finite number; write one as in 2.5".to_owned())
}

/// A number from one to another, both included.
pub fn within(range: RangeInclusive<f64>) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let value = finite(text)?;
        if range.contains(&value) { Ok(value) } else { Err(format!("use {} to {}", range.start(), range.end())) }
    }
}

/// `X,Y,Z`, not all zero.
pub fn direction(text: &str) -> Result<glam::DVec3, String> {
    let numbers = text.split(',').map(finite).collect::<Result<Vec<_>, _>>()?;
    let [x, y, z] = numbers[..] else { return Err("write a direction as X,Y,Z".to_owned()) };
    let vector = glam::DVec3::new(x, y, z);
    // The squares of very large and very small numbers have no place in an f64.
    let scaled = || (vector / vector.abs().max_element()).try_normalize();
    vector.try_normalize().or_else(scaled).ok_or_else(|| "a direction must not be 0,0,0".to_owned())
}

/// A cosine in [0, 1].
pub fn cosine(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a cosine lies between 0 and 1".to_owned()) }
}

/// An angle from the normal in degrees, from 0 to 90, as its cosine.
pub fn angle_cos(text: &str) -> Result<f64, String> {
    let degrees = finite(text)?;
    match degrees {
        // The cosine of the double nearest to a right angle is not 0.
        90.0 => Ok(0.0),
        _ if (0.0..90.0).contains(&degrees) => Ok(degrees.to_radians().cos()),
        _ => Err("an angle from the normal lies between 0 and 90 degrees".to_owned()),
    }
}

/// A thickness in nm.
pub fn thickness_nm(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    if (0.0..=30_000.0).contains(&value) {
        Ok(value)
    } else {
        Err("a thickness lies between 0 and 30000 nm".to_owned())
    }
}

/// The range of a table in nm.
pub fn range_nm(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    if (1.0..=10_000.0).contains(&value) { Ok(value) } else { Err("a table spans 1 to 10000 nm".to_owned()) }
}

/// Columns and rows of a table, `64x2048`.
pub fn table_size(text: &str) -> Result<[u32; 2], String> {
    let size = size(text)?;
    if size.iter().all(|side| (2..=8192).contains(side)) {
        Ok(size)
    } else {
        Err("a table has 2 to 8192 columns and rows".to_owned())
    }
}

/// A thickness of skins in nm.
pub fn skin_nm(text: &str) -> Result<f64, String> {
    let value = finite(text)?;
    if (0.0..=5.0).contains(&value) { Ok(value) } else { Err("a skin is from 0 to 5 nm thick".to_owned()) }
}

/// `fast`, `standard`, `spectral` or `reference`.
pub fn quality(text: &str) -> Result<Quality, String> {
    let named = scene::Quality::ALL.into_iter().find(|quality| quality.name() == text).map(Quality::Gpu);
    named
        .or((text == "reference").then_some(Quality::Reference))
        .ok_or_else(|| "use `fast`, `standard`, `spectral` or `reference`".to_owned())
}

/// What `--illuminant` takes.
pub fn illuminant_help() -> String {
    let names = BuiltIn::names();
    format!("The light: {names}, a black body like `3000 K`, or a CSV file of wavelengths and powers")
}

/// `srgb` or `p3`.
pub fn gamut(text: &str) -> Result<Gamut, String> {
    match text {
        "srgb" => Ok(Gamut::Srgb),
        "p3" => Ok(Gamut::DisplayP3),
        _ => Err("use `srgb` or `p3`".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_must_be_finite() {
        for wrong in ["nan", "inf", "-inf", "", "1,2"] {
            assert!(finite(wrong).is_err() && time_s(wrong).is_err(), "{wrong}");
        }
        assert!(time_s("-1").is_err());
        assert_eq!(time_s("2.5"), Ok(2.5));
    }

    #[test]
    fn directions_are_normalised_and_never_zero() {
        for text in ["0,0,2", "0,0,1e308", "0,0,1e-300"] {
            assert_eq!(direction(text), Ok(glam::DVec3::Z), "{text}");
        }
        for wrong in ["0,0,0", "1,2", "1,2,3,4", "a,b,c"] {
            assert!(direction(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn angles_are_cosines() {
        assert_eq!((angle_cos("0"), angle_cos("90")), (Ok(1.0), Ok(0.0)));
        assert!((angle_cos("60").unwrap() - 0.5).abs() < 1e-15);
        for wrong in ["-1", "90.1", "nan", "", "half"] {
            assert!(angle_cos(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn qualities_have_names() {
        assert_eq!(quality("spectral"), Ok(Quality::Gpu(scene::Quality::Spectral)));
        assert_eq!(quality("reference"), Ok(Quality::Reference));
        assert!(quality("best").is_err() && gamut("rec2020").is_err());
    }
}
