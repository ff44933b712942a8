//! Soft-edged shapes, as coverages between 0 and 1.

use glam::DVec2;

/// Hermite step from 0 at `start` to 1 at `end`.
pub(super) fn smoothstep(start: f64, end: f64, value: f64) -> f64 {
    let t = ((value - start) / (end - start)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A bell of height 1 at 0 and width `sigma`; nothing beyond six widths, where a texel beside it does not see the 1.5e-8 that are left.
pub(super) fn bell(distance: f64, sigma: f64) -> f64 {
    let widths = distance / sigma;
    if widths.abs() > 6.0 { 0.0 } else { (-0.5 * widths * widths).exp() }
}

/// Signed distance from `point` to a rectangle about the origin with rounded corners; negative inside.
pub(super) fn rounded_box_distance(point: DVec2, half_size: DVec2, corner: f64) -> f64 {
    let outside = point.abs() - half_size + corner;
    outside.max(DVec2::ZERO).length() + outside.max_element().min(0.0) - corner
}

/// Coverage along one axis by `count` panes between −`half` and `half` with bars `bar` wide around and between them, edges
/// `edge` wide.
pub(super) fn panes(position: f64, half: f64, count: f64, bar: f64, edge: f64) -> f64 {
    if position.abs() >= half {
        return 0.0;
    }
    let pane = 2.0 * half / count;
    let along = (position + half) / pane;
    let from_bar = (along - along.round()).abs() * pane;
    smoothstep(0.5 * bar, 0.5 * bar + edge, from_bar)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_bells_have_their_ends() {
        assert_eq!([smoothstep(1.0, 3.0, 0.0), smoothstep(1.0, 3.0, 2.0), smoothstep(1.0, 3.0, 9.0)], [0.0, 0.5, 1.0]);
        assert_eq!(smoothstep(3.0, 1.0, 1.0), 1.0);
        assert_eq!(bell(0.0, 2.0), 1.0);
        assert!(bell(8.0, 2.0) < 4e-4);
    }

    #[test]
    fn boxes_measure_distance() {
        let distance = |x, y| rounded_box_distance(DVec2::new(x, y), DVec2::new(3.0, 2.0), 1.0);
        assert_eq!(distance(4.0, 0.0), 1.0);
        assert_eq!(distance(0.0, 0.0), -2.0);
        // The rounded corner's center is (2, 1).
        assert!((distance(2.0 + 3.0, 1.0 + 4.0) - 4.0).abs() < 1e-15);
    }

    #[test]
    fn panes_lie_between_bars() {
        let cover = |position| panes(position, 1.0, 2.0, 0.1, 0.02);
        assert_eq!([cover(0.5), cover(-0.5)], [1.0, 1.0]);
        assert_eq!([cover(0.0), cover(0.04), cover(0.99), cover(-1.5)], [0.0; 4]);
    }
}
