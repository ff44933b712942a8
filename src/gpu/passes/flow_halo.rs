//! Fills the halo of a field from its cells.

use crate::{
    gpu::{
        device::GpuError,
        grid::Grid,
        kernel::{Read, ReadWrite, kernels, shader_view},
        timing::{Groups, Recorder, STEP_FIELD},
    },
    physics::sphere::HaloEntry,
};

shader_view! { HaloEntry { weights, cell, first, step, padding } }

kernels! {
    pass flow_halo;

    /// Of a field of numbers: any, or a thickness, none of which leaves the range of those that it is interpolated from.
    struct HaloOfScalar {
        @0 entries: Read<[HaloEntry]>;
        @1 scalar: ReadWrite<[f32]>;
    }
    compute halo_of_scalar, halo_of_thickness;

    /// Of two fields of numbers.
    struct HaloOfTwo {
        @0 entries: Read<[HaloEntry]>;
        @1 scalar: ReadWrite<[f32]>;
        @2 other: ReadWrite<[f32]>;
    }
    compute halo_of_two;

    /// Of a field of pairs of numbers.
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

/// Records the one workgroup that fills the halo of a film's thickness.
pub fn halo_of_thickness(
    recorder: &mut Recorder<'_>,
    grid: &Grid,
    thickness: &wgpu::Buffer,
    one_group: Groups<'_>,
) -> Result<(), GpuError> {
    HaloOfScalar { entries: grid.halo(recorder.gpu), scalar: thickness }
        .halo_of_thickness(recorder, STEP_FIELD, one_group)
}
