//! A film's state kept aside, so that the film can go on from there again with the same bits.

use super::{
    super::{GpuError, copies::Copies, flow::FlowCheckpoint, timing::Recorder},
    Field, FreeMotion, MovingFilm,
    rest::KeptRestWatch,
};

/// A film's state between two steps.
pub struct Checkpoint {
    field: FieldCheckpoint,
    motion: Option<FlowCheckpoint>,
    watch: KeptRestWatch,
}

/// The state of a field. What spreads, blackens or drains it is set anew by each step.
struct FieldCheckpoint {
    buffers: Copies,
    map_is_identity: bool,
    has_drained: bool,
    ticks_since_decision: u32,
}

impl MovingFilm {
    /// Keeps the state in a slot, the next new one at most.
    pub fn save(&mut self, recorder: &mut Recorder<'_>, slot: usize) -> Result<(), GpuError> {
        let checkpoint = Checkpoint {
            field: self.field.save(recorder),
            motion: self.motion.as_ref().map(|motion| motion.solver.save(recorder)),
            watch: self.watch.kept(recorder.gpu)?,
        };
        match self.checkpoints.get_mut(slot) {
            Some(old) => *old = checkpoint,
            None => self.checkpoints.push(checkpoint),
        }
        Ok(())
    }

    /// Makes the state of a slot the film's again; nothing for an empty slot.
    pub fn restore(&mut self, recorder: &mut Recorder<'_>, slot: usize) {
        let Self { field, motion, watch, checkpoints } = self;
        let Some(checkpoint) = checkpoints.get(slot) else { return };
        *watch = checkpoint.watch.into();
        field.restore(recorder, &checkpoint.field);
        // A film that had not moved by itself then starts to with no motion.
        let Some(flow) = &checkpoint.motion else {
            *motion = None;
            return;
        };
        motion.get_or_insert_with(|| FreeMotion::empty(recorder.gpu, field)).solver.restore(recorder, flow);
    }
}

impl Field {
    /// All on the device that steps change and later ones read.
    fn state(&self) -> Vec<&wgpu::Buffer> {
        self.kept_map().into_iter().chain([&self.tracer, &self.control.block]).collect()
    }

    fn save(&self, recorder: &mut Recorder<'_>) -> FieldCheckpoint {
        FieldCheckpoint {
            buffers: Copies::of(recorder, &self.state()),
            map_is_identity: self.map_is_identity,
            ticks_since_decision: self.ticks_since_decision,
            has_drained: self.has_drained,
        }
    }

    fn restore(&mut self, recorder: &mut Recorder<'_>, checkpoint: &FieldCheckpoint) {
        let FieldCheckpoint { buffers, map_is_identity, has_drained, ticks_since_decision } = checkpoint;
        buffers.restore(recorder, &self.state());
        (self.map_is_identity, self.has_drained) = (*map_is_identity, *has_drained);
        self.ticks_since_decision = *ticks_since_decision;
    }
}
