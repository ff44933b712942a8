//! Finds the rim of the hole in a film that bursts.

use glam::DVec3;

use crate::{
    gpu::{
        device::{Gpu, GpuError},
        kernel::{PointSampler, ReadWrite, Texture2dArray, Uniform, kernels, shader_struct},
        shown_film::{NoFilm, Shown},
        timing::Recorder,
    },
    physics::film::{HOLE_MERIDIANS, HOLE_PARTS, rim_delay},
    plan::{BLACK_FILM_NM, FilmKey, OpenHoleKey},
};

shader_struct! {
    /// See `shaders/pass/open_hole.wgsl`.
    pub struct OpenHoleUniform {
        /// Direction of its middle in the film.
        pub middle: [f32; 3],
        /// For how long it has opened, s.
        pub seconds: f32,
        /// Seconds a radian, over the root of the thickness in nm.
        pub delay: f32,
        /// Radius of the sphere in nm.
        pub radius_nm: f32,
        /// Cells along a panel's edge of the film.
        pub cells: u32,
        /// Thickness of a uniform film, nm.
        pub thickness_nm: f32,
        /// What has evaporated, nm.
        pub evaporated_nm: f32,
        /// Thickness at which evaporation ends, nm.
        pub black_nm: f32,
        /// Whether the middle is where the film is thinnest.
        pub seeks: u32,
        pad: u32,
    }
}

shader_struct! {
    /// The rim on a meridian: see `shaders/film/hole.wgsl`.
    #[derive(Default, PartialEq)]
    pub struct RimValue {
        /// Angle from the middle to the film that is still at rest.
        pub outer_rad: f32,
        /// Angle to where the hole ends and the rim begins.
        pub inner_rad: f32,
        /// Mean thickness of the rim, nm.
        pub thickness_nm: f32,
        /// Fills 16 bytes.
        pub padding: f32,
    }
}

kernels! {
    pass open_hole;

    /// The middle of a hole, and its rim on each meridian.
    struct FollowRim {
        const HOLE_MERIDIANS: u32 = HOLE_MERIDIANS as u32;
        const HOLE_PARTS: u32 = HOLE_PARTS as u32;
        override UNIFORM_FILM: bool;
        @0 hole: Uniform<OpenHoleUniform>;
        @1 film: Texture2dArray;
        @2 middle: ReadWrite<[f32; 4]>;
        @3 rim: ReadWrite<[RimValue]>;
        @4 point_sampler: PointSampler;
    }
    compute open_hole;
}

/// A hole on the device.
pub struct OpenHole {
    /// Direction of its middle in the film, a `vec4f`.
    pub middle: wgpu::Buffer,
    /// A [`RimValue`] for each meridian.
    pub rim: wgpu::Buffer,
}

impl OpenHole {
    /// Room for a hole.
    #[must_use]
    pub fn new(gpu: &Gpu) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        Self {
            middle: gpu.buffer("middle of the hole", 16, usage),
            rim: gpu.buffer("rim of the hole", (HOLE_MERIDIANS * size_of::<RimValue>()) as u64, usage),
        }
    }

    /// Records the pass: the hole of a key, in a film that shows the key's moment; nothing of a uniform film need be shown.
    pub fn open(
        &self,
        recorder: &mut Recorder<'_>,
        key: &OpenHoleKey,
        shown: Option<Shown<'_>>,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu;
        let no_film = NoFilm::new(gpu);
        let film = &shown.unwrap_or_else(|| no_film.shown()).film.view;
        let kernel = FollowRim {
            UNIFORM_FILM: matches!(key.film, FilmKey::Uniform(_)),
            hole: &gpu.uniform("open hole", &uniform(key)),
            film,
            middle: &self.middle,
            rim: &self.rim,
            point_sampler: gpu.point_sampler(),
        };
        kernel.open_hole(recorder, "open_hole", [1; 3])
    }
}

fn uniform(key: &OpenHoleKey) -> OpenHoleUniform {
    let (cells, thickness_nm) = match &key.film {
        FilmKey::Uniform(thickness_nm) => (0, *thickness_nm as f32),
        FilmKey::Field(field) => (field.cells, 0.0),
    };
    // A film of one thickness is as thin everywhere, and its top is as good as any place.
    let top = DVec3::Z;
    OpenHoleUniform {
        middle: key.hole.at.unwrap_or(top).as_vec3().to_array(),
        seconds: key.hole.seconds as f32,
        delay: rim_delay(key.radius_m) as f32,
        radius_nm: (1e9 * key.radius_m) as f32,
        cells,
        thickness_nm,
        evaporated_nm: key.evaporated_nm as f32,
        black_nm: BLACK_FILM_NM as f32,
        seeks: u32::from(key.hole.at.is_none() && cells > 0),
        pad: 0,
    }
}
