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
    fn state(&self) -> [&wgpu::Buffer; 6] {
        [&self.zeta, &self.psi, &self.psi_before, &self.velocity, &self.velocity_ahead, &self.measures]
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
