//! When a film counts as being at rest, so that it need not be moved.

/// Seconds of film time from one question for a film's speed to the next.
pub const ASKING_S: f64 = 2.0;
/// Acceleration of a bubble in radii a second squared below which it counts as none: less than what rounding does to gravity.
pub const STEADY: f64 = 1e-6;
/// Answers for as long as which a speed may go on to grow as it did, and still not reach the limit: a minute. Rounding lets the speed of a film
/// at rest grow a little for a while; a film that is about to turn over grows much faster.
const AHEAD: i32 = 30;

/// Speed in rad/s at which a film on cells of an angle in radians moves by less than a hundredth of a cell from one answer to the next: less than
/// a thousandth in any step, and about three times what rounding leaves of the flow in a sorted film.
#[must_use]
pub fn resting_speed(cell_angle: f64) -> f64 {
    1e-2 * cell_angle / ASKING_S
}

/// Whether a film rests, by its fastest flow in rad/s in one answer and in that before, if there was one: it is slower than a limit, and will not
/// soon be faster.
#[must_use]
pub fn rests(speed: f64, before: Option<f64>, limit: f64) -> bool {
    let stays_below = |before: f64| speed * (speed / before).max(1.0).powi(AHEAD) < limit;
    speed == 0.0 || before.is_some_and(stays_below)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_rests_where_it_is_slow_and_does_not_speed_up() {
        let limit = resting_speed(0.02);
        assert_eq!(limit, 1e-4);
        assert!(rests(0.0, None, limit) && rests(5e-5, Some(6e-5), limit) && rests(5e-5, Some(4.95e-5), limit));
        assert!(!rests(5e-5, None, limit), "nobody knows where it goes");
        assert!(!rests(5e-5, Some(4e-5), limit), "in a minute it will be faster");
        assert!(!rests(2e-4, Some(3e-4), limit));
    }
}
