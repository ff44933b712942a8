//! A number that moves from one given value to the next: piecewise interpolation in time.

use crate::words::words;

words! {
    /// How a number goes on from one given value to the next.
    #[derive(Default)]
    pub enum Ease: "ease" {
        #[default]
        Smooth = "smooth", "Its speed changes without a jump, and it never passes the values on both sides";
        Linear = "linear", "At constant speed";
        Hold = "hold", "It stays until the next keyframe, and jumps there";
    }
}

/// A given value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// When it is reached, s.
    pub time_s: f64,
    /// The value.
    pub value: f64,
    /// How it goes on from there.
    pub ease: Ease,
}

/// Times that are no further apart count as one, s: that of a tick is rounded.
const SAME_S: f64 = 1e-9;

/// The value at a time in s of a curve through knots, which stand in the order of their times; `None` without any. Before the first and after the
/// last it stands. At the time of a knot it is the knot's own, to the bit.
#[must_use]
pub fn value_at(knots: &[Knot], time_s: f64) -> Option<f64> {
    value_by(knots, time_s, |value| value, |value| value)
}

/// As [`value_at`], where a growing function of the number is interpolated, `of`, whose inverse is `back`.
#[must_use]
pub fn value_by(knots: &[Knot], time_s: f64, of: fn(f64) -> f64, back: fn(f64) -> f64) -> Option<f64> {
    let next = knots.partition_point(|knot| knot.time_s <= time_s + SAME_S);
    let Some(last) = next.checked_sub(1).filter(|last| last + 1 < knots.len()) else {
        // The first, or the last.
        return knots.get(next.saturating_sub(1)).map(|knot| knot.value);
    };
    let (from, to) = (knots[last], knots[next]);
    if from.ease == Ease::Hold || time_s - from.time_s <= SAME_S {
        return Some(from.value);
    }
    let knots: Vec<Knot> = knots.iter().map(|knot| Knot { value: of(knot.value), ..*knot }).collect();
    let part = (time_s - from.time_s) / (to.time_s - from.time_s);
    let value = match from.ease {
        Ease::Smooth => cubic(&knots, last, part),
        _ => knots[last].value + part * (knots[next].value - knots[last].value),
    };
    // Roundings alone could pass the ends.
    Some(back(value).clamp(from.value.min(to.value), from.value.max(to.value)))
}

/// The cubic from a knot to the next one (Hermite's form), a part of the way between them.
fn cubic(knots: &[Knot], last: usize, part: f64) -> f64 {
    let (from, to) = (knots[last], knots[last + 1]);
    let duration_s = to.time_s - from.time_s;
    let own = mean_slope(knots, last);
    let before = last.checked_sub(1).map(|before| (knots[before].ease, mean_slope(knots, before)));
    let after = (last + 2 < knots.len()).then(|| (to.ease, mean_slope(knots, last + 1)));
    let [start, end] = [before, after].map(|beside| duration_s * slope(own, beside));
    let (rise, rest) = (to.value - from.value, 1.0 - part);
    from.value + part * part * (3.0 - 2.0 * part) * rise + part * rest * (rest * start - part * end)
}

/// Slope of the line from a knot to the next one.
fn mean_slope(knots: &[Knot], last: usize) -> f64 {
    let (from, to) = (knots[last], knots[last + 1]);
    (to.value - from.value) / (to.time_s - from.time_s)
}

/// The slope at an end of a smooth piece, from its own mean slope and, where another piece meets it there, that piece's ease and mean slope.
///
/// Between two smooth pieces it is the harmonic mean (F. N. Fritsch and J. Butland, SIAM J. Sci. Stat. Comput. 5, 1984, for pieces of equal length),
/// which is 0 where the curve turns back. No slope exceeds three times the piece's own, so that the cubic is monotone (F. N. Fritsch and R. E.
/// Carlson, SIAM J. Numer. Anal. 17, 1980).
fn slope(own: f64, beside: Option<(Ease, f64)>) -> f64 {
    let Some((ease, beside)) = beside.filter(|(_, beside)| own * beside > 0.0) else { return 0.0 };
    match ease {
        Ease::Smooth => 2.0 / (1.0 / own + 1.0 / beside),
        // As fast as the other piece, if that is not too fast.
        Ease::Linear => beside.abs().min(3.0 * own.abs()).copysign(own),
        Ease::Hold => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knots(ease: Ease, points: &[(f64, f64)]) -> Vec<Knot> {
        points.iter().map(|(time_s, value)| Knot { time_s: *time_s, value: *value, ease }).collect()
    }

    /// Rises, stands, jumps up, turns back, and creeps.
    const POINTS: [(f64, f64); 8] =
        [(0.5, 1.0), (1.0, 1.5), (2.5, 1.5), (2.6, 40.0), (4.0, -3.0), (4.5, -3.1), (9.0, -3.2), (9.5, 0.1)];

    fn times() -> impl Iterator<Item = f64> {
        (0..20_000).map(|k| 5e-4 * f64::from(k))
    }

    #[test]
    fn a_curve_passes_through_its_knots_to_the_bit() {
        for ease in Ease::ALL {
            let knots = knots(ease, &POINTS);
            for (time_s, value) in POINTS {
                assert_eq!(value_at(&knots, time_s), Some(value), "{ease:?}");
            }
            assert_eq!([-3.0, 1e9].map(|time_s| value_at(&knots, time_s)), [Some(1.0), Some(0.1)]);
        }
        assert_eq!(value_at(&[], 3.0), None);
        assert_eq!(value_at(&knots(Ease::Linear, &[(2.0, 7.0)]), 1.0), Some(7.0));
    }

    #[test]
    fn between_two_knots_it_never_passes_their_values() {
        // Each knot with an ease of its own, in all orders.
        for shift in 0..3 {
            let mut knots = knots(Ease::Smooth, &POINTS);
            knots.iter_mut().enumerate().for_each(|(k, knot)| knot.ease = Ease::ALL[(k + shift) % 3]);
            for smooth in [true, false] {
                if smooth {
                    knots.iter_mut().for_each(|knot| knot.ease = Ease::Smooth);
                }
                let mut before = 1.0;
                for time_s in times() {
                    let value = value_at(&knots, time_s).unwrap();
                    let next = knots.partition_point(|knot| knot.time_s <= time_s).min(knots.len() - 1);
                    let ends = [knots[next.saturating_sub(1)].value, knots[next].value];
                    assert!(value >= ends[0].min(ends[1]) && value <= ends[0].max(ends[1]), "{value} at {time_s} s");
                    let is_new = knots.iter().any(|knot| (time_s - knot.time_s).abs() < 6e-4);
                    assert!(is_new || (value - before) * (ends[1] - ends[0]) >= 0.0, "it turns back at {time_s} s");
                    before = value;
                }
            }
        }
    }

    #[test]
    fn a_smooth_curve_has_a_continuous_first_derivative() {
        let knots = knots(Ease::Smooth, &POINTS);
        // On both sides of each knot, the ends included, where it stands before and after. Along the steepest piece, 0.1 s long and 38.5 high, the
        // second derivative is at most 6 × 38.5 / 0.1², so that a slope over 1e-6 s is off by 0.02 at most.
        for (time_s, _) in POINTS {
            let [left, right] = [-1.0, 1.0].map(|side| {
                let beside = value_at(&knots, time_s + 1e-6 * side).unwrap();
                side * (beside - value_at(&knots, time_s).unwrap()) / 1e-6
            });
            assert!((left - right).abs() < 0.05, "{left} and {right} at {time_s} s");
        }
    }

    #[test]
    fn a_smooth_piece_takes_over_the_speed_of_a_linear_one() {
        let mut knots = knots(Ease::Smooth, &[(0.0, 0.0), (1.0, 1.0), (2.0, 3.0)]);
        knots[0].ease = Ease::Linear;
        let slope = (value_at(&knots, 1.000001).unwrap() - 1.0) / 1e-6;
        assert!((slope - 1.0).abs() < 1e-4, "{slope}");
    }

    #[test]
    fn a_smooth_piece_after_a_steep_linear_one_arrives_at_its_end_alone() {
        let mut knots = knots(Ease::Smooth, &[(0.0, 0.0), (1.0, 10.0), (2.0, 10.5)]);
        knots[0].ease = Ease::Linear;
        let values: Vec<f64> = (0..=100).map(|k| value_at(&knots, 1.0 + 0.01 * f64::from(k)).unwrap()).collect();
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{values:?}");
    }

    #[test]
    fn a_logarithm_changes_by_equal_factors_in_equal_times() {
        let knots = knots(Ease::Linear, &[(0.0, 0.3), (3.0, 300.0)]);
        let values = [0.0, 1.0, 2.0, 3.0].map(|time_s| value_by(&knots, time_s, f64::ln, f64::exp).unwrap());
        assert_eq!([values[0], values[3]], [0.3, 300.0]);
        assert!((values[1] - 3.0).abs() < 1e-12 && (values[2] - 30.0).abs() < 1e-12, "{values:?}");
    }

    #[test]
    fn a_linear_curve_has_constant_speed_and_one_that_holds_jumps() {
        let turn = knots(Ease::Linear, &[(0.0, 20.0), (8.0, 380.0)]);
        for time_s in times().filter(|time_s| *time_s < 7.9) {
            let step = value_at(&turn, time_s + 0.1).unwrap() - value_at(&turn, time_s).unwrap();
            // Numbers below 400 in f64.
            assert!((step - 4.5).abs() < 1e-12, "{step} at {time_s} s");
        }
        let held = knots(Ease::Hold, &[(0.0, 1.0), (2.0, 5.0)]);
        assert_eq!([0.0, 1.999, 2.0].map(|time_s| value_at(&held, time_s)), [Some(1.0), Some(1.0), Some(5.0)]);
    }
}
