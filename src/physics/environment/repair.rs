//! Radiance that no light can have, put right and counted.

use std::fmt;
use std::iter::Sum;
use std::ops::Add;

use serde::{Deserialize, Serialize};

/// The brightest radiance an environment keeps: just below the largest half float (65504), so that pictures of it, and a filter's rounding, stay
/// finite.
pub const MAX_RADIANCE: f32 = 65000.0;

/// How many pixels (or texels) of an environment had to be repaired, each counted once, under the worst it had.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Repairs {
    /// Not a number in some component, replaced by 0.
    pub not_a_number: u64,
    /// Below zero in some component, replaced by 0.
    pub negative: u64,
    /// Brighter than [`MAX_RADIANCE`] in some component, clamped to it.
    pub too_bright: u64,
}

impl Repairs {
    /// Pixels repaired for any reason.
    pub fn total(&self) -> u64 {
        self.not_a_number + self.negative + self.too_bright
    }

    /// Repairs one radiance in place, and returns what was wrong with it.
    pub fn repair(radiance: &mut [f32; 3]) -> Self {
        let mut repairs = Self::default();
        if radiance.iter().any(|component| component.is_nan()) {
            repairs.not_a_number = 1;
        } else if radiance.iter().any(|&component| component < 0.0) {
            repairs.negative = 1;
        } else if radiance.iter().any(|&component| component > MAX_RADIANCE) {
            repairs.too_bright = 1;
        }
        *radiance = radiance.map(|component| if component.is_nan() { 0.0 } else { component.clamp(0.0, MAX_RADIANCE) });
        repairs
    }
}

impl Add for Repairs {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            not_a_number: self.not_a_number + other.not_a_number,
            negative: self.negative + other.negative,
            too_bright: self.too_bright + other.too_bright,
        }
    }
}

impl Sum for Repairs {
    fn sum<I: Iterator<Item = Self>>(repairs: I) -> Self {
        repairs.fold(Self::default(), Add::add)
    }
}

/// Counts of pixels by what was wrong with them; empty without any.
impl fmt::Display for Repairs {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bright = format!("brighter than {MAX_RADIANCE} or infinite (clamped)");
        let kinds = [
            (self.not_a_number, "NaN (made black)"),
            (self.negative, "negative (raised to 0)"),
            (self.too_bright, bright.as_str()),
        ];
        let told: Vec<String> =
            kinds.iter().filter(|(count, _)| *count > 0).map(|(n, what)| format!("{n} {what}")).collect();
        formatter.write_str(&told.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_radiance_is_left_alone() {
        let mut radiance = [0.0, 0.5, MAX_RADIANCE];
        assert_eq!(Repairs::repair(&mut radiance), Repairs::default());
        assert_eq!(radiance, [0.0, 0.5, MAX_RADIANCE]);
    }

    #[test]
    fn every_fault_is_replaced_and_counted_once() {
        let mut pixels = [
            [f32::NAN, -1.0, f32::INFINITY],
            [-1.0, 2.0, 1e9],
            [f32::INFINITY, 1.0, 2.0],
            [f32::NEG_INFINITY, 3.0, 4.0],
        ];
        let repairs: Repairs = pixels.iter_mut().map(Repairs::repair).sum();
        assert_eq!(repairs, Repairs { not_a_number: 1, negative: 2, too_bright: 1 });
        assert_eq!(repairs.total(), 4);
        assert_eq!(
            repairs.to_string(),
            "1 NaN (made black), 2 negative (raised to 0), 1 brighter than 65000 or infinite (clamped)"
        );
        let expected = [[0.0, 0.0, MAX_RADIANCE], [0.0, 2.0, MAX_RADIANCE], [MAX_RADIANCE, 1.0, 2.0], [0.0, 3.0, 4.0]];
        assert_eq!(pixels, expected);
    }
}
