//! How far two pictures are apart.

use std::fmt;

use soapfilm::studio::difference;

/// What differs between two pictures of the same size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Largest difference of a byte.
    pub max_steps: u8,
    /// Pixels that differ at all.
    pub pixels: usize,
    /// Mean CIEDE2000 over all pixels.
    pub mean_delta_e: f64,
}

impl Comparison {
    /// Compares two RGBA pictures; those that cannot be compared are an error.
    pub fn of(golden_size: [u32; 2], golden: &[u8], size: [u32; 2], now: &[u8]) -> Result<Self, String> {
        let pixels = size.map(|side| side as usize).iter().product::<usize>();
        if pixels == 0 {
            return Err("there are no pixels to compare".to_owned());
        }
        if golden_size != size || golden.len() != now.len() || golden.len() != 4 * pixels {
            return Err(format!("{golden_size:?} against {size:?} pixels cannot be compared"));
        }
        Ok(Self {
            max_steps: golden.iter().zip(now).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0),
            pixels: golden.chunks_exact(4).zip(now.chunks_exact(4)).filter(|(a, b)| a != b).count(),
            mean_delta_e: difference(golden, now).mean,
        })
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} pixels differ, by {} steps at most, mean ΔE {:.4}",
            self.pixels, self.max_steps, self.mean_delta_e
        )
    }
}

mod tests {
    use super::Comparison;

    const GREY: [u8; 16] = [100; 16];

    #[test]
    fn equal_pictures_do_not_differ() {
        let expected = Comparison { max_steps: 0, pixels: 0, mean_delta_e: 0.0 };
        assert_eq!(Comparison::of([2, 2], &GREY, [2, 2], &GREY), Ok(expected));
    }

    #[test]
    fn planted_errors_are_found() {
        let mut wrong = GREY;
        wrong[5] = 103;
        let found = Comparison::of([2, 2], &GREY, [2, 2], &wrong).unwrap();
        assert_eq!((found.max_steps, found.pixels), (3, 1));
        // Three steps of green on mid grey in one of four pixels.
        assert!(found.mean_delta_e > 0.2 && found.mean_delta_e < 1.0, "{found}");
        let mut transparent = GREY;
        transparent[3] = 0;
        assert_eq!(Comparison::of([2, 2], &GREY, [2, 2], &transparent).unwrap().max_steps, 100);
    }

    #[test]
    fn pictures_without_pixels_or_of_other_sizes_cannot_be_compared() {
        assert!(Comparison::of([0, 0], &[], [0, 0], &[]).is_err());
        assert!(Comparison::of([4, 1], &GREY, [2, 2], &GREY).is_err());
        assert!(Comparison::of([2, 2], &GREY[..12], [2, 2], &GREY).is_err());
    }
}
