//! A texel of a cube map in four bytes.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use crate::parallel;

/// Linear BT.2020 radiance from 0 to [`super::MAX_RADIANCE`]: three mantissas of 9 bits with one exponent, the format that GPUs name `rgb9e5ufloat`.
/// It rounds by at most 1/512 of the brightest component, half as much as `.hdr` files do. GPUs, and programs that draw in place of one, filter it
/// faster than half floats, which take twice the memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(transparent)]
pub struct Texel(pub(super) u32);

const MANTISSA_BITS: u32 = 9;
const EXPONENT_BIAS: i32 = 15;
/// Bits below the exponent in an f32, and its bias.
const F32_MANTISSA_BITS: u32 = 23;
const F32_BIAS: i32 = 127;

impl Texel {
    /// The texel that is closest to a radiance without NaN, by the rule of Vulkan's specification (section "Shared exponent").
    #[must_use]
    pub fn of(radiance: [f32; 3]) -> Self {
        let max = radiance[0].max(radiance[1]).max(radiance[2]);
        // One more than the exponent of the brightest component, so that its mantissa is below 1; no less than the smallest that can be stored.
        let exponent = |max: f32| (((max.to_bits() >> F32_MANTISSA_BITS) as i32) - F32_BIAS + 1).max(-EXPONENT_BIAS);
        // A mantissa that rounds up to 1 takes the next exponent.
        let rounded = max + 0.5 * unit(exponent(max));
        let exponent = exponent(rounded);
        let per_unit = unit(exponent).recip();
        let [r, g, b] = radiance.map(|component| (component * per_unit + 0.5) as u32);
        Self(
            r | g << MANTISSA_BITS
                | b << (2 * MANTISSA_BITS)
                | ((exponent + EXPONENT_BIAS) as u32) << (3 * MANTISSA_BITS),
        )
    }

    /// The radiance that it stands for.
    #[must_use]
    pub fn radiance(self) -> DVec3 {
        let mantissa = |k: u32| f64::from(self.0 >> (k * MANTISSA_BITS) & ((1 << MANTISSA_BITS) - 1));
        let exponent = (self.0 >> (3 * MANTISSA_BITS)) as i32 - EXPONENT_BIAS;
        f64::from(unit(exponent)) * DVec3::new(mantissa(0), mantissa(1), mantissa(2))
    }
}

/// What the last bit of a mantissa stands for: a power of two.
fn unit(exponent: i32) -> f32 {
    f32::from_bits(((exponent - MANTISSA_BITS as i32 + F32_BIAS) as u32) << F32_MANTISSA_BITS)
}

/// The texels that are closest to radiances.
pub(super) fn texels_of(radiances: &[[f32; 3]]) -> Vec<Texel> {
    const PIECE: usize = 4096;
    let mut texels = vec![Texel::default(); radiances.len()];
    parallel::change(&mut texels, PIECE, |piece, texels| {
        for (texel, radiance) in texels.iter_mut().zip(&radiances[piece * PIECE..]) {
            *texel = Texel::of(*radiance);
        }
    });
    texels
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::environment::MAX_RADIANCE;

    #[test]
    fn radiance_comes_back_to_half_a_bit_of_the_brightest_component() {
        let bright = [1e-9, 3.1e-5, 1e-3, 0.2, 0.4999, 0.99951, 1.0, 1.999, 2.0, 3.7, 511.6, 40_000.0, MAX_RADIANCE];
        for max in bright {
            for parts in [[1.0, 1.0, 1.0], [1.0, 0.5, 0.0], [0.001, 1.0, 0.9999], [0.3, 0.33, 1.0]] {
                let radiance = parts.map(|part| part * max);
                let stored = Texel::of(radiance).radiance();
                let error = (stored - DVec3::from_array(radiance.map(f64::from))).abs().max_element();
                assert!(error <= f64::from(max) / 512.0 + 0.5f64.powi(25), "{radiance:?}: {stored}");
            }
        }
        assert_eq!(Texel::of([0.0; 3]), Texel::default());
        assert_eq!(Texel::of([1.0, 2.0, 0.25]).radiance(), DVec3::new(1.0, 2.0, 0.25));
        // From the example of Vulkan's rule: 256 of 512 with the exponent of 2.
        assert_eq!(Texel::of([1.0; 3]).0, 0x8402_0100);
    }

    #[test]
    fn a_mantissa_that_rounds_up_takes_the_next_exponent() {
        for max in [0.999_1f32, 1.999, 3.9999, 1023.9] {
            let stored = Texel::of([max; 3]).radiance();
            assert_eq!(stored, DVec3::splat(f64::from(max.log2().ceil().exp2())), "{max}");
        }
    }
}
