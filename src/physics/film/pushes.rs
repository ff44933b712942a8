//! All that pushes a film, and when.

use std::ops::Range;

use super::Push;
use crate::physics::{flow::FlowForces, timeline::Spans};

/// What pushes a film, with the ticks during which it does.
#[derive(Clone, Debug, Default)]
pub struct Pushes {
    spans: Spans<Push>,
    /// The most that any of the whole history makes the film shear and turn, however long it acts, 1/s.
    strongest_1_s: f64,
}

impl Pushes {
    /// What begins before a tick.
    #[must_use]
    pub fn until(&self, end: u64) -> Self {
        Self { spans: self.spans.until(end), ..*self }
    }

    /// What begins or goes on after a tick, with ticks that count from it.
    #[must_use]
    pub fn since(&self, born: u64) -> Self {
        Self { spans: self.spans.since(born), ..*self }
    }

    /// Whether both are parts of one history, which takes no look at it.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        self.spans.shares(&other.spans)
    }

    /// What pushes the film in a step between two times in ticks of a length in seconds.
    #[must_use]
    pub fn in_step(&self, from_ticks: f64, to_ticks: f64, tick_s: f64) -> Vec<Push> {
        let acting = self.spans.during(from_ticks, to_ticks).map(|(during, push)| {
            let ticks = to_ticks.min(during.end as f64) - from_ticks.max(during.start as f64);
            push.in_step(ticks * tick_s, (to_ticks - from_ticks) * tick_s)
        });
        acting.collect()
    }

    /// How fast what has pushed the film until a time in ticks may make it shear and turn then, 1/s: the maximum over all pushes, less what drag
    /// and viscosity have left of it.
    #[must_use]
    pub fn strain_1_s(&self, ticks: f64, tick_s: f64, forces: &FlowForces) -> f64 {
        let mut max: f64 = 0.0;
        for (during, push) in self.spans.until(ticks.ceil() as u64).iter().rev() {
            // Neither this one nor those before have pushed since, and drag alone has left no more of them.
            let since_s = (ticks - during.start.saturating_add(self.spans.longest()) as f64).max(0.0) * tick_s;
            if self.strongest_1_s * (-forces.drag * since_s).exp() <= 0.999 * max {
                break;
            }
            let acting_s = (ticks.min(during.end as f64) - during.start as f64).max(0.0) * tick_s;
            let since_s = (ticks - during.end as f64).max(0.0) * tick_s;
            max = max.max(push.strain(acting_s) * push.remaining_strain(since_s, forces));
        }
        max
    }
}

impl FromIterator<(Range<u64>, Push)> for Pushes {
    fn from_iter<I: IntoIterator<Item = (Range<u64>, Push)>>(pushes: I) -> Self {
        let spans: Spans<Push> = pushes.into_iter().collect();
        let strongest_1_s = spans.iter().map(|(_, push)| push.strain(f64::INFINITY)).fold(0.0, f64::max);
        Self { spans, strongest_1_s }
    }
}

impl PartialEq for Pushes {
    /// Equal pushes may be parts of histories in which others come later.
    fn eq(&self, other: &Self) -> bool {
        self.spans == other.spans
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::physics::film::Random;

    const TICK_S: f64 = 1.0 / 60.0;

    fn pushes(count: u64) -> Vec<(Range<u64>, Push)> {
        let mut random = Random::new(7, 0);
        let push = |k: u64| {
            let [sharpness, speed, rate] = [2.0, 0.01, 0.1].map(|low| random.between_log(low, 100.0 * low));
            let push = Push { center: DVec3::X, sharpness, velocity: speed * DVec3::Y, rate };
            (10 * k..10 * k + 1 + (k * k) % 40, push)
        };
        (0..count).map(push).collect()
    }

    #[test]
    fn the_strain_is_the_most_of_all_pushes() {
        let all = pushes(300);
        for (drag, viscosity) in [(2.0, 0.04), (0.1, 0.0), (0.0, 0.01)] {
            let forces = FlowForces { drag, viscosity, ..FlowForces::default() };
            for ticks in [0.0_f64, 5.5, 700.0, 2999.25, 3100.0, 9000.0, 1e6] {
                let of_push = |(during, push): &(Range<u64>, Push)| {
                    let acting_s = (ticks.min(during.end as f64) - during.start as f64).max(0.0) * TICK_S;
                    let since_s = (ticks - during.end as f64).max(0.0) * TICK_S;
                    push.strain(acting_s) * push.remaining_strain(since_s, &forces)
                };
                let expected = all.iter().map(of_push).fold(0.0, f64::max);
                let found = all.iter().cloned().collect::<Pushes>().strain_1_s(ticks, TICK_S, &forces);
                assert_eq!(found, expected, "drag {drag}, {ticks} ticks");
            }
        }
    }

    #[test]
    fn later_pushes_make_no_difference() {
        let [few, many] = [5, 9].map(|count| pushes(count).into_iter().collect::<Pushes>());
        assert!(few != many && few == many.until(41) && few.since(12) == many.until(41).since(12));
    }
}
