//! When the tracer is looked up and stored, and a new map begins: the twin of `shaders/pass/decide_remap.wgsl`.
//!
//! A map is interpolated by cubics, which err halfway between cells by 3/128 of its fourth difference. With D the angle between cells and ε the
//! limit, it is remapped where along either axis
//!
//! ```text
//! 3/128 |Δ⁴ M| > ε D                                                                                 (M5)
//! ```
//!
//! or where a cell is turned inside out, and at the latest after a maximum number of ticks.

use glam::DVec3;

use crate::physics::sphere::PaddedField;

/// When a map is remapped.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemapRule {
    /// Error of interpolating the map, in cells, beyond which it is.
    pub error_limit_cells: f32,
    /// The most ticks between two remaps.
    pub latest_ticks: u32,
}

impl RemapRule {
    /// Error at which going on costs as much as the lookups of a remap.
    pub const ERROR_LIMIT_CELLS: f32 = 0.05;

    /// Ticks from one decision to the next.
    #[must_use]
    pub fn decision_ticks(self) -> u32 {
        (self.latest_ticks / 8).max(1)
    }

    /// Whether a remap is due `ticks` ticks after the last decision, whatever the map has become. The next decision comes as long after this
    /// one, which would be too late.
    #[must_use]
    pub fn is_due_after(self, ticks: u32) -> bool {
        ticks > self.latest_ticks / 2
    }

    /// This rule where remaps must be at most a number of ticks apart, for each of several reasons, which may be absent.
    #[must_use]
    pub fn no_later_than(self, limits: impl IntoIterator<Item = Option<u32>>) -> Self {
        let latest_ticks = limits.into_iter().flatten().fold(self.latest_ticks, u32::min);
        Self { latest_ticks, ..self }
    }
}

/// Ticks of a film's remaps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RemapClock {
    /// Ticks since the last decision.
    pub since_decision: u32,
    /// Ticks since the last remap, as of the last decision.
    pub since_remap: u32,
    /// Ticks that the last remap came after the one before it: what it does lasts for so long.
    pub remapped: u32,
    /// Remaps so far.
    pub remaps: u32,
}

impl RemapClock {
    /// Whether a map is remapped at this decision by a rule.
    pub fn decide(&mut self, rule: RemapRule, map: &PaddedField<DVec3>) -> bool {
        let ticks = std::mem::take(&mut self.since_decision);
        self.since_remap += ticks;
        // What is due anyway is not measured.
        let is_distorted = !rule.is_due_after(ticks) && distortion(map, rule) > 1.0;
        let is_due = is_distorted || self.since_remap + ticks > rule.latest_ticks;
        if is_due {
            (self.remaps, self.remapped, self.since_remap) = (self.remaps + 1, self.since_remap, 0);
        }
        is_due
    }
}

/// The largest error of a map over the limit (M5), at every other cell both ways, because neighbours are distorted alike; 2 where it is folded.
#[must_use]
pub fn distortion(map: &PaddedField<DVec3>, rule: RemapRule) -> f64 {
    let grid = map.grid();
    let limit = f64::from(rule.error_limit_cells) * grid.cell_angle();
    let cells = (0..grid.cells()).map(|cell| grid.cell(cell)).filter(|(_, i, j)| i % 2 == 0 && j % 2 == 0);
    let worst = cells.map(|(panel, i, j)| {
        let place = grid.padded_index(panel, i as isize, j as isize);
        let strides = [1, grid.padded_width()];
        let error =
            strides.map(|stride| interpolation_error(map.padded(), place, stride)).into_iter().fold(0.0, f64::max);
        if is_folded(map.padded(), place, strides) { 2.0 } else { error / limit }
    });
    worst.fold(0.0, f64::max)
}

/// Largest error of cubic interpolation along an axis, halfway between cells: 3/128 of the fourth difference.
fn interpolation_error(map: &[DVec3], place: usize, stride: usize) -> f64 {
    let fourth = map[place - 2 * stride] + map[place + 2 * stride] - 4.0 * (map[place - stride] + map[place + stride])
        + 6.0 * map[place];
    3.0 / 128.0 * fourth.length()
}

/// Whether the map turns a cell inside out.
fn is_folded(map: &[DVec3], place: usize, [along, across]: [usize; 2]) -> bool {
    let here = map[place];
    (map[place + along] - here).cross(map[place + across] - here).dot(here) <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;

    const RULE: RemapRule = RemapRule { error_limit_cells: 0.05, latest_ticks: 20 };

    fn map(to: impl Fn(DVec3) -> DVec3 + Sync) -> PaddedField<DVec3> {
        PaddedField::sample(CubedSphere::new(16).unwrap(), |x| to(x).normalize())
    }

    #[test]
    fn a_remap_is_due_if_the_next_decision_comes_too_late_however_soon_the_last_remap_was() {
        for latest_ticks in 1..40 {
            let rule = RemapRule { latest_ticks, ..RULE };
            for ticks in 1..40 {
                let mut clock = RemapClock { since_decision: ticks, ..RemapClock::default() };
                assert_eq!(clock.decide(rule, &map(|x| x)), rule.is_due_after(ticks), "{ticks} of {latest_ticks}");
            }
        }
    }

    #[test]
    fn shear_is_distortion_and_turning_is_not() {
        let turned = map(|x| DVec3::new(x.y, x.z, x.x));
        assert!(distortion(&turned, RULE) < 0.01, "{}", distortion(&turned, RULE));
        let sheared = |rate: f64| map(move |x| glam::DMat3::from_rotation_z(rate * x.z.powi(3)) * x);
        let [little, much] = [0.5, 8.0].map(|rate| distortion(&sheared(rate), RULE));
        assert!(little < 1.0 && much > 1.0, "{little} {much}");
        assert_eq!(distortion(&map(|x| -x), RemapRule { error_limit_cells: f32::MAX, ..RULE }), 2.0, "inside out");
    }

    #[test]
    fn the_clock_counts_from_remap_to_remap() {
        let (mut clock, still) = (RemapClock::default(), map(|x| x));
        let mut due = Vec::new();
        for tick in 1..=45 {
            clock.since_decision += 1;
            if clock.since_decision >= RULE.decision_ticks() && clock.decide(RULE, &still) {
                due.push((tick, clock.remapped));
            }
        }
        assert_eq!(due, [(20, 20), (40, 20)]);
        assert_eq!(RULE.no_later_than([None, Some(7), Some(9)]).latest_ticks, 7);
    }
}
