//! Frames in a second, as an exact ratio.

use std::str::FromStr;

/// Largest numerator and denominator: what OpenEXR's `framesPerSecond` holds.
const MAX: u128 = i32::MAX as u128;

/// Frames in a second: a ratio of whole numbers in lowest terms, from 0.001 to 10000.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FrameRate {
    numerator: u32,
    denominator: u32,
}

impl FrameRate {
    /// Numerator and denominator.
    #[must_use]
    pub fn ratio(self) -> [u32; 2] {
        [self.numerator, self.denominator]
    }

    /// Time of a frame in seconds; frame 0 is at 0. The quotient of two whole numbers, rounded once.
    #[must_use]
    pub fn time_s(self, frame: u64) -> f64 {
        (u128::from(frame) * u128::from(self.denominator)) as f64 / f64::from(self.numerator)
    }

    /// Hours, minutes, seconds and frame of a frame's SMPTE time code, frame 0 at 00:00:00:00, without dropped numbers: rates like
    /// 24000/1001 count as many frames in a second as the whole rate next to them. `None` above 30 frames in a second, which time codes
    /// cannot count, below 1, and from 24 hours on.
    #[must_use]
    pub fn time_code(self, frame: u64) -> Option<[u8; 4]> {
        let whole = (f64::from(self.numerator) / f64::from(self.denominator)).round() as u64;
        let seconds = frame.checked_div(whole)?;
        if whole > 30 || seconds >= 24 * 3600 {
            return None;
        }
        Some([seconds / 3600, seconds / 60 % 60, seconds % 60, frame % whole].map(|part| part as u8))
    }

    /// Seconds that a frame lasts as a ratio, the nearest one whose numbers are at most `max`.
    #[must_use]
    pub fn delay(self, max: u16) -> [u16; 2] {
        let ratio = nearest_ratio([self.denominator.into(), self.numerator.into()], max.into());
        ratio.map(|number| u16::try_from(number).unwrap_or(max))
    }

    /// The ratio, or the nearest one that has no larger numbers than [`MAX`].
    fn nearest(numerator: u128, denominator: u128) -> Option<Self> {
        let [numerator, denominator] = nearest_ratio([numerator, denominator], MAX);
        let (low, high) = (denominator <= numerator.checked_mul(1000)?, numerator <= denominator.checked_mul(10_000)?);
        let rate = Self { numerator: u32::try_from(numerator).ok()?, denominator: u32::try_from(denominator).ok()? };
        (low && high && rate.numerator > 0 && rate.denominator > 0).then_some(rate)
    }
}

/// The last convergent of a ratio's continued fraction whose numbers are at most `max`: the ratio itself in lowest terms, if it fits.
fn nearest_ratio([mut a, mut b]: [u128; 2], max: u128) -> [u128; 2] {
    let (mut last, mut ratio) = ([0, 1], [1, 0]);
    while b > 0 {
        let whole = a / b;
        let next = [0, 1].map(|k: usize| whole.saturating_mul(ratio[k]).saturating_add(last[k]));
        if next.into_iter().any(|number| number > max) {
            break;
        }
        (last, ratio) = (ratio, next);
        (a, b) = (b, a % b);
    }
    ratio
}

/// A number of frames that cannot be one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("write frames per second as 30, 23.976 or 24000/1001, from 0.001 to 10000")]
pub struct FrameRateError;

impl FromStr for FrameRate {
    type Err = FrameRateError;

    /// `30`, `24000/1001`, or a decimal number like `23.976`, which is taken exactly: 2997/125.
    fn from_str(text: &str) -> Result<Self, FrameRateError> {
        let rate = match text.trim().split_once('/') {
            Some((numerator, denominator)) => whole(numerator.trim()).zip(whole(denominator.trim())),
            None => decimal(text.trim()),
        };
        rate.and_then(|(numerator, denominator)| Self::nearest(numerator, denominator)).ok_or(FrameRateError)
    }
}

fn decimal(text: &str) -> Option<(u128, u128)> {
    let (units, fraction) = text.split_once('.').unwrap_or((text, ""));
    let scale = 10_u128.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    let parts = [units, fraction].map(|digits| if digits.is_empty() { Some(0) } else { whole(digits) });
    let number = parts[0]?.checked_mul(scale)?.checked_add(parts[1]?)?;
    (text.len() > usize::from(text.contains('.'))).then_some((number, scale))
}

fn whole(digits: &str) -> Option<u128> {
    digits.bytes().all(|digit| digit.is_ascii_digit()).then(|| digits.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(text: &str) -> [u32; 2] {
        text.parse::<FrameRate>().unwrap_or_else(|error| panic!("{text}: {error}")).ratio()
    }

    #[test]
    fn rates_are_taken_exactly() {
        assert_eq!(rate("30"), [30, 1]);
        assert_eq!(rate("24000/1001"), [24000, 1001]);
        assert_eq!(rate("60/2"), [30, 1]);
        assert_eq!(rate("23.976"), [2997, 125]);
        assert_eq!(rate("0.5"), [1, 2]);
        assert_eq!(rate(".25"), [1, 4]);
        assert_eq!(rate("25."), [25, 1]);
        assert_eq!(rate("29.970029970029970029970"), [30000, 1001], "more digits than a ratio holds");
        assert_eq!([rate("10000"), rate("0.001")], [[10000, 1], [1, 1000]]);
    }

    #[test]
    fn an_invalid_frame_rate_is_refused() {
        for wrong in [
            "",
            ".",
            "0",
            "-1",
            "+30",
            "1e3",
            "nan",
            "inf",
            "30/0",
            "0/30",
            "a/b",
            "30/",
            "1/2/3",
            "10001",
            "0.0009",
            "1 000",
            "99999999999999999999999999999999999999999",
            "1/99999999999999999999999999999999999999",
        ] {
            assert_eq!(wrong.parse::<FrameRate>(), Err(FrameRateError), "{wrong}");
        }
    }

    #[test]
    fn times_are_rounded_once() {
        let film: FrameRate = "24000/1001".parse().unwrap();
        assert_eq!(film.time_s(24000), 1001.0);
        assert_eq!(film.time_s(1), 1001.0 / 24000.0);
        // A sum of steps, or a product with a rounded 1 / fps, is off here.
        assert_eq!("30".parse::<FrameRate>().unwrap().time_s(3_000_000_001), 3_000_000_001.0 / 30.0);
    }

    #[test]
    fn frames_last_as_long_as_small_numbers_can_say() {
        let delay = |rate: &str| rate.parse::<FrameRate>().unwrap().delay(u16::MAX);
        assert_eq!((delay("24000/1001"), delay("25"), delay("0.001")), ([1001, 24000], [1, 25], [1000, 1]));
        let [numerator, denominator] = delay("2147483647/71582788").map(f64::from);
        assert!((numerator / denominator - 1.0 / 30.0).abs() < 1e-6);
    }

    #[test]
    fn time_codes_count_frames_of_the_whole_rate() {
        let code = |rate: &str, frame| rate.parse::<FrameRate>().unwrap().time_code(frame);
        assert_eq!(code("24000/1001", 25), Some([0, 0, 1, 1]));
        assert_eq!(code("30", 30 * 3661 + 29), Some([1, 1, 1, 29]));
        assert_eq!(code("25", 24 * 3600 * 25), None);
        assert_eq!((code("60", 1), code("0.25", 1)), (None, None));
    }
}
