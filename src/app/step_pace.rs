//! How many cells of films a frame steps while they catch up: what the device has lately stepped in the time that a frame has for it.

use std::collections::VecDeque;

use crate::{
    gpu::timing::{PassTime, STEP_FIELD, STEP_FLOW, StepTime, TONEMAP},
    plan::Pace,
};

/// Time that the steps of a frame may always take, ms: with a picture that is drawn quickly, the window still answers 15 times a second.
const SHORT_MS: f64 = 1000.0 / 15.0;
/// The part of the time of all other passes that steps may take where that is longer: a film hardly moved if each of its steps waited for a picture
/// that takes a second.
const PART_OF_REST: f64 = 0.5;
/// Measurements of which the shortest counts: the others may be of shaders that were compiled first, or of a busy moment.
const REMEMBERED: usize = 4;

/// The latest measurements of a time.
#[derive(Clone, Debug, Default)]
struct Latest(VecDeque<f64>);

impl Latest {
    fn add(&mut self, ms: f64) {
        if self.0.len() == REMEMBERED {
            self.0.pop_front();
        }
        self.0.push_back(ms);
    }

    fn shortest(&self) -> Option<f64> {
        self.0.iter().copied().reduce(f64::min)
    }
}

/// What the device takes.
#[derive(Clone, Debug, Default)]
pub struct StepPace {
    /// For a step of a cell.
    cell: Latest,
    /// For all passes of a frame that are no steps.
    rest: Latest,
    /// What has arrived of them for a frame whose last pass has not, ms.
    rest_so_far_ms: f64,
}

impl StepPace {
    /// Enters times that have arrived: of passes, in the order in which they ran, and of steps alone.
    pub fn add(&mut self, passes: &[PassTime], steps: StepTime) {
        if steps.cells > 0 && steps.gpu_ms > 0.0 {
            self.cell.add(steps.gpu_ms / steps.cells as f64);
        }
        let rest = passes.iter().filter(|pass| ![STEP_FIELD, STEP_FLOW].contains(&pass.name));
        self.rest_so_far_ms += rest.filter_map(|pass| pass.gpu_ms).sum::<f64>();
        if passes.iter().any(|pass| pass.name == TONEMAP) {
            self.rest.add(std::mem::take(&mut self.rest_so_far_ms));
        }
    }

    /// That of the next frame. Where the adapter tells no times it stays what it is at first.
    #[must_use]
    pub fn of_frame(&self) -> Pace {
        let rest_ms = self.rest.shortest().unwrap_or(0.0);
        let steps_ms = SHORT_MS.max(PART_OF_REST * rest_ms);
        self.cell.shortest().map_or(Pace::UNMEASURED, |cell_ms| Pace::Frame { cells: (steps_ms / cell_ms) as u64 })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(pace: &StepPace) -> u64 {
        match pace.of_frame() {
            Pace::Frame { cells } => cells,
            Pace::Whole => unreachable!("a window waits"),
        }
    }

    fn measured(ms: impl IntoIterator<Item = f64>, draw_ms: Option<f64>) -> StepPace {
        let mut pace = StepPace::default();
        let passes = [("draw", draw_ms), (STEP_FLOW, Some(1e6)), (TONEMAP, None)];
        let passes = passes.map(|(name, gpu_ms)| PassTime { name, gpu_ms });
        ms.into_iter().for_each(|gpu_ms| pace.add(&passes, StepTime { cells: 1_000_000, gpu_ms }));
        pace
    }

    #[test]
    fn a_frame_steps_what_the_device_steps_in_the_time_that_it_has() {
        assert_eq!(StepPace::default().of_frame(), Pace::UNMEASURED);
        let million_in = |ms, draw_ms| cells(&measured([ms], Some(draw_ms))) as f64 / 1e6;
        assert!((million_in(100.0, 5.0) * 15.0 - 10.0).abs() < 1e-4, "a fifteenth of a second");
        assert!((million_in(1.0, 5.0) * 15.0 - 1000.0).abs() < 1e-4, "on a fast device");
        assert!((million_in(100.0, 800.0) - 4.0).abs() < 1e-4, "half of what the picture takes");
    }

    #[test]
    fn what_was_met_once_is_forgotten() {
        let after = |ms: &[f64]| cells(&measured(ms.iter().copied(), Some(5.0)));
        assert_eq!(after(&[2000.0, 10.0]), after(&[10.0]), "shaders were compiled");
        assert_eq!(after(&[10.0, 40.0, 40.0, 40.0]), after(&[10.0]), "a busy moment");
        assert_eq!(after(&[10.0, 40.0, 40.0, 40.0, 40.0]), after(&[40.0]), "a slower film");
    }

    #[test]
    fn a_frame_whose_times_arrive_one_by_one_is_one_frame() {
        let mut pace = measured([100.0], Some(800.0));
        let parts = [("finish", 50.0), ("draw", 750.0), (TONEMAP, 0.0)];
        for (name, ms) in parts {
            pace.add(&[PassTime { name, gpu_ms: Some(ms) }], StepTime::default());
            assert_eq!(cells(&pace), cells(&measured([100.0], Some(800.0))), "{name}");
        }
    }

    #[test]
    fn times_that_are_not_known_count_for_nothing() {
        let mut pace = measured([100.0], None);
        assert_eq!(cells(&pace), cells(&measured([100.0], Some(1.0))));
        pace.add(&[], StepTime::default());
        assert_eq!(cells(&pace), cells(&measured([100.0], Some(1.0))));
    }
}
