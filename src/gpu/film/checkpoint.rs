//! A saved state of a film, from which the film can go on again with the same bits.

use super::{Field, rest::KeptRestWatch};
use crate::gpu::{copies::Copies, flow::FlowCheckpoint, panel_texture::PanelTexture, timing::Recorder};

/// A film's state between two steps.
pub(super) struct Checkpoint {
    pub(super) field: FieldCheckpoint,
    pub(super) motion: Option<FlowCheckpoint>,
    pub(super) watch: KeptRestWatch,
}

/// The state of a field. Its diffusion, black film and drainage are set again by each step.
pub(super) struct FieldCheckpoint {
    control: Copies,
    textures: Vec<PanelTexture>,
    map_is_identity: bool,
    has_drained: bool,
    ticks_since_decision: u32,
}

impl Field {
    /// All on the device that steps change and later ones read, beside its control block.
    fn state(&self) -> impl Iterator<Item = &PanelTexture> {
        self.kept_map().into_iter().chain([&self.tracer])
    }

    pub(super) fn save(&self, recorder: &mut Recorder<'_>) -> FieldCheckpoint {
        FieldCheckpoint {
            control: Copies::of(recorder, &[&self.control.block]),
            textures: self.state().map(|field| field.copy(recorder)).collect(),
            map_is_identity: self.map_is_identity,
            ticks_since_decision: self.ticks_since_decision,
            has_drained: self.has_drained,
        }
    }

    pub(super) fn restore(&mut self, recorder: &mut Recorder<'_>, checkpoint: &FieldCheckpoint) {
        let FieldCheckpoint { control, textures, map_is_identity, has_drained, ticks_since_decision } = checkpoint;
        control.restore(recorder, &[&self.control.block]);
        for (from, to) in textures.iter().zip(self.state()) {
            from.copy_to(recorder, to);
        }
        (self.map_is_identity, self.has_drained) = (*map_is_identity, *has_drained);
        self.ticks_since_decision = *ticks_since_decision;
    }
}
