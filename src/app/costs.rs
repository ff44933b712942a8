//! What pictures cost: times of the last ones, for the costs panel.

use std::collections::VecDeque;

use crate::gpu::timing::{Counts, PassTime};

/// Pictures that are remembered.
const REMEMBERED: usize = 120;

/// Costs of the last pictures.
#[derive(Clone, Debug, Default)]
pub struct Costs {
    /// The adapter and its driver.
    pub adapter: String,
    /// Wall time that the window's thread spent on each of the last pictures, ms, oldest first.
    pub cpu_ms: VecDeque<f64>,
    /// GPU times of the latest passes.
    pub passes: Vec<PassTime>,
    /// Work since the start.
    pub counts: Counts,
}

impl Costs {
    /// Enters a picture.
    pub fn add(&mut self, cpu_ms: f64, counts: Counts) {
        if self.cpu_ms.len() == REMEMBERED {
            self.cpu_ms.pop_front();
        }
        self.cpu_ms.push_back(cpu_ms);
        self.counts = counts;
    }

    /// Enters pass times that have arrived; times of passes that did not run stay.
    pub fn add_passes(&mut self, arrived: Vec<PassTime>) {
        for time in arrived {
            match self.passes.iter_mut().find(|known| known.name == time.name) {
                Some(known) => *known = time,
                None => self.passes.push(time),
            }
        }
    }

    /// The median of the remembered times, ms.
    #[must_use]
    pub fn median_cpu_ms(&self) -> Option<f64> {
        let mut sorted: Vec<f64> = self.cpu_ms.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        sorted.get(sorted.len() / 2).copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_pictures_are_remembered() {
        let mut costs = Costs::default();
        assert_eq!(costs.median_cpu_ms(), None);
        (0..=REMEMBERED).for_each(|ms| costs.add(ms as f64, Counts::default()));
        assert_eq!((costs.cpu_ms.len(), costs.cpu_ms[0]), (REMEMBERED, 1.0));
        assert_eq!(costs.median_cpu_ms(), Some(61.0));
    }

    #[test]
    fn a_pass_has_its_latest_time() {
        let mut costs = Costs::default();
        let time = |name, gpu_ms| PassTime { name, gpu_ms: Some(gpu_ms) };
        costs.add_passes(vec![time("draw", 1.0), time("tonemap", 2.0)]);
        costs.add_passes(vec![time("draw", 3.0)]);
        assert_eq!(costs.passes, [time("draw", 3.0), time("tonemap", 2.0)]);
    }
}
