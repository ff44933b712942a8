//! Fills the halo of a field from its cells.

use crate::{
    gpu::{
        device::GpuError,
        grid::Grid,
        kernel::{Read, ReadWrite, kernels, shader_view},
        timing::{Groups, Recorder},
    },
    physics::sphere::HaloEntry,
};

shader_view! { HaloEntry { cell, sources, weights } }

kernels! {
    pass flow_halo;

    /// Of numbers.
    struct HaloOfScalar {
        @0 entries: Read<[HaloEntry]>;
        @1 scalar: ReadWrite<[f32]>;
    }
    compute halo_of_scalar, halo_of_thickness;

    /// Of pairs of numbers.
    struct HaloOfPair {
        @0 entries: Read<[HaloEntry]>;
        @1 pair: ReadWrite<[[f32; 2]]>;
    }
    compute halo_of_pair;

    /// Of two fields of vectors.
    struct HaloOfVelocities {
        @0 entries: Read<[HaloEntry]>;
        @1 velocity: ReadWrite<[[f32; 4]]>;
        @2 velocity_ahead: ReadWrite<[[f32; 4]]>;
    }
    compute halo_of_velocities;
}

/// Records the one workgroup that fills the halo of a film's thickness. No value leaves the range of those that it is interpolated from.
pub fn halo_of_thickness(
    recorder: &mut Recorder<'_>,
    grid: &Grid,
    thickness: &wgpu::Buffer,
    one_group: Groups<'_>,
) -> Result<(), GpuError> {
    HaloOfScalar { entries: grid.halo(recorder.gpu), scalar: thickness }.halo_of_thickness(
        recorder,
        "step_field",
        one_group,
    )
}
