//! A saved state of a flow, from which it can go on again with the same bits.

use super::FlowSolver;
use crate::gpu::{copies::Copies, timing::Recorder};

/// A flow's state between two steps.
pub struct FlowCheckpoint {
    buffers: Copies,
    has_history: bool,
}

impl FlowSolver {
    /// All on the device that steps change and later ones read.
    pub(super) fn state(&self) -> [&wgpu::Buffer; 6] {
        [&self.zeta, &self.psi, &self.psi_before, &self.velocity, &self.velocity_ahead, &self.measures]
    }

    /// Copies the state of another solver's only film to a place here. All that come here must be as far: before their first step, or after it.
    pub(in crate::gpu) fn take_in(&mut self, recorder: &mut Recorder<'_>, place: usize, film: &Self) {
        self.has_history = film.has_history;
        for (from, to) in film.state().into_iter().zip(self.state()) {
            recorder.encoder().copy_buffer_to_buffer(from, 0, to, place as u64 * from.size(), from.size());
        }
    }

    /// Copies the state of the film at a place to another solver, whose only film it is.
    pub(in crate::gpu) fn hand_back(&self, recorder: &mut Recorder<'_>, place: usize, film: &mut Self) {
        film.has_history = self.has_history;
        for (from, to) in self.state().into_iter().zip(film.state()) {
            recorder.encoder().copy_buffer_to_buffer(from, place as u64 * to.size(), to, 0, to.size());
        }
    }

    /// Keeps the state aside.
    #[must_use]
    pub fn save(&self, recorder: &mut Recorder<'_>) -> FlowCheckpoint {
        FlowCheckpoint { buffers: Copies::of(recorder, &self.state()), has_history: self.has_history }
    }

    /// Restores this flow from a saved state of a flow on the same grid.
    pub fn restore(&mut self, recorder: &mut Recorder<'_>, checkpoint: &FlowCheckpoint) {
        checkpoint.buffers.restore(recorder, &self.state());
        self.has_history = checkpoint.has_history;
    }
}
