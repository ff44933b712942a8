//! What is left of white light, channel by channel.

use glam::DVec3;

/// Channels of white light below this part of the strongest tell nothing: lamps of few lines leave RGB spaces.
const FAINT: f64 = 0.05;

/// The part of white light that is left in each channel of some RGB, from what is seen of the light and what would be seen of all of it. A channel
/// in which the light is faint has the part that is left of the sum.
#[must_use]
pub fn transmittance(left: DVec3, white: DVec3) -> DVec3 {
    let enough = FAINT * white.max_element();
    let of_sum = if white.max_element() > 0.0 { left.element_sum() / white.element_sum() } else { 1.0 };
    let part = |k: usize| if white[k] > enough { left[k] / white[k] } else { of_sum };
    DVec3::new(part(0), part(1), part(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faint_channels_follow_the_others() {
        let white = DVec3::new(2.0, 1.0, -0.01);
        assert_eq!(transmittance(0.25 * white, white), DVec3::splat(0.25));
        let bent = transmittance(DVec3::new(1.0, 0.25, 0.3), white);
        assert_eq!([bent.x, bent.y], [0.5, 0.25]);
        assert!((bent.z - 1.55 / 2.99).abs() < 1e-15);
        assert_eq!(transmittance(DVec3::ZERO, DVec3::ZERO), DVec3::ONE);
    }
}
