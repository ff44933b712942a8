//! Decides on the device whether a film's map is remapped.

use bytemuck::{Pod, Zeroable};

use super::{
    GpuError,
    conserve::parts,
    film::{Control, Grid},
    pipelines::ComputeKey,
    timing::{Groups, Recorder},
};

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
}

/// See `shaders/pass/decide_remap.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DecideUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Angle between neighbouring cells.
    pub cell_angle: f32,
    /// Error of interpolating the map at which it is remapped.
    pub error_limit: f32,
    /// Ticks since the last decision.
    pub ticks: u32,
    /// The most ticks between two remaps.
    pub latest_ticks: u32,
    pad: [u32; 3],
    /// Workgroups of a pass over the tracer's texels.
    pub tracer_groups: [u32; 3],
    /// Workgroups of its sum.
    pub sum_groups: u32,
    /// Workgroups of a pass over the map's texels.
    pub map_groups: [u32; 3],
    pad_middle: u32,
    /// Workgroups of a pass over the tracer's texels, two by two.
    pub quad_groups: [u32; 3],
    pad_end: u32,
}

/// Records the decision about a map, some ticks after the one before.
pub fn decide_remap(
    recorder: &mut Recorder<'_>,
    name: &'static str,
    (film, tracer): (&Grid, &Grid),
    map: &wgpu::Buffer,
    control: &Control,
    (ticks, rule): (u32, RemapRule),
) -> Result<(), GpuError> {
    let uniform = DecideUniform {
        cells: film.cells,
        cell_angle: film.sphere.cell_angle() as f32,
        error_limit: rule.error_limit_cells,
        ticks,
        latest_ticks: rule.latest_ticks,
        pad: [0; 3],
        tracer_groups: tracer.padded_groups(),
        sum_groups: parts(tracer),
        map_groups: film.padded_groups(),
        pad_middle: 0,
        quad_groups: tracer.quad_groups(film.cells),
        pad_end: 0,
    };
    let uniform = recorder.gpu.uniform("decide", &uniform);
    let key = |entry| ComputeKey { pass: "decide_remap", entry, constants: vec![] };
    let [uniform, block, arguments] =
        [&uniform, &control.block, &control.arguments].map(wgpu::Buffer::as_entire_binding);
    if !rule.is_due_after(ticks) {
        let measured = [(0, uniform.clone()), (1, block.clone()), (2, map.as_entire_binding())];
        // One invocation for four cells.
        let half = film.cells.div_ceil(2);
        recorder.compute_at(name, &key("measure_distortion"), &measured, [half.div_ceil(64), half, 6].into())?;
    }
    let decided = [(0, uniform), (1, block), (3, arguments)];
    recorder.compute_at(name, &key("decide_remap"), &decided, Groups::Count([1; 3]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remap_is_due_if_the_next_decision_comes_too_late_however_soon_the_last_remap_was() {
        for latest_ticks in 1..40 {
            let rule = RemapRule { error_limit_cells: 1.0, latest_ticks };
            for ticks in 1..40 {
                // What `decide_remap.wgsl` finds just after a remap, when least is due.
                assert_eq!(rule.is_due_after(ticks), ticks + ticks > latest_ticks, "{ticks} of {latest_ticks}");
            }
        }
    }
}
