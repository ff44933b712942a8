//! Colours of a list of films, through the table and the shader functions that pictures use.

use glam::{DVec3, Vec3};

use super::bake_table::{Table, TableAxes, TableOverrides};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        kernel::{Read, ReadWrite, Uint2dArray, Uniform, kernels, shader_struct},
        quadrature::{MAX_WAVELENGTHS, Quadrature, QuadratureOverrides, QuadratureSample},
        readback::Readback,
        timing::Recorder,
    },
    physics::colour::{Walls, seen_light},
    plan::{OpticsKey, QuadratureKey, TableKey, range_nm},
    scene::Quality,
};

shader_struct! {
    /// One ray's walls: see `shaders/pass/probe_colour.wgsl`.
    pub struct ProbePoint {
        /// Cosine of the angle outside.
        pub cos_theta: f32,
        /// Thickness of the front wall, in nm.
        pub front_nm: f32,
        /// Thickness of the back wall.
        pub back_nm: f32,
        /// Thickness where the light leaves.
        pub exit_nm: f32,
        /// 1 for the front wall alone, 2 for front and back.
        pub walls: u32,
    }
}

kernels! {
    pass probe_colour;

    /// The colour of each of a list of rays, unfiltered and with three inner reflections.
    struct ProbeColours {
        const INNER: u32 = 3;
        const MIRRORS_OTHERS: bool = false;
        const TRACKS_POLARISATION: bool = false;
        const THICKNESSES: u32 = 1;
        overrides table_kind: TableOverrides;
        overrides summed: QuadratureOverrides;
        @0 axes: Uniform<TableAxes>;
        @1 table: Uint2dArray;
        @2 quadrature: Uniform<[QuadratureSample; MAX_WAVELENGTHS]>;
        @3 points: Read<[ProbePoint]>;
        @4 colours: ReadWrite<[[f32; 4]]>;
    }
    compute probe_colour;
}

impl ProbePoint {
    /// A point from what physics calls it.
    #[must_use]
    pub fn new(cos_theta: f64, walls: Walls) -> Self {
        let (count, [front_nm, back_nm, exit_nm]) = match walls {
            Walls::One { thickness_nm } => (1, [thickness_nm, 0.0, 0.0]),
            Walls::Two { front_nm, back_nm, exit_nm } => (2, [front_nm, back_nm, exit_nm]),
        };
        let [front_nm, back_nm, exit_nm] = [front_nm, back_nm, exit_nm].map(|nm| nm as f32);
        Self { cos_theta: cos_theta as f32, front_nm, back_nm, exit_nm, walls: count }
    }

    /// The thickest of its walls, in nm.
    #[must_use]
    pub fn thickest_nm(&self) -> f64 {
        f64::from(self.front_nm.max(self.back_nm).max(self.exit_nm))
    }
}

/// Points of one dispatch.
const CHUNK: usize = 1 << 20;

/// All that gives the colour of films on the device, as pictures of one quality have it.
pub struct ColourProbe {
    table: Table,
    quadrature: Quadrature,
}

impl ColourProbe {
    /// Bakes and fits for films up to a thickness, in white light.
    pub fn new(gpu: &Gpu, optics: &OpticsKey, quality: Quality, thickest_nm: f64) -> Result<Self, GpuError> {
        let range_nm = range_nm(thickest_nm);
        let quadrature = QuadratureKey::new(optics.clone(), range_nm, quality, &seen_light(&optics.illuminant), true);
        let table = match quadrature.needs_table() {
            true => Table::baked(gpu, &TableKey::full(optics.clone(), range_nm))?,
            false => Table::unread(gpu, optics),
        };
        Ok(Self::with_table(table, Quadrature::fit(gpu, &quadrature)))
    }

    /// With another table or another quadrature than pictures use.
    #[must_use]
    pub fn with_table(table: Table, quadrature: Quadrature) -> Self {
        Self { table, quadrature }
    }

    /// Unpolarised colours of some points, linear BT.2020, where a perfect mirror has the illuminant's white.
    pub fn measure(&self, gpu: &Gpu, points: &[ProbePoint]) -> Result<Vec<DVec3>, GpuError> {
        let chunks = points.chunks(CHUNK).map(|chunk| self.start(gpu, chunk)).collect::<Result<Vec<_>, _>>()?;
        let mut colours = Vec::with_capacity(points.len());
        for chunk in chunks {
            let rgba: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&chunk.wait(gpu)?);
            colours.extend(rgba.into_iter().map(|[r, g, b, _]| Vec3::new(r, g, b).as_dvec3()));
        }
        Ok(colours)
    }

    fn start(&self, gpu: &Gpu, points: &[ProbePoint]) -> Result<Readback, GpuError> {
        let size = points.len() as u64 * 16;
        let colours = gpu.buffer("colours", size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let kernel = ProbeColours {
            table_kind: TableOverrides { COLOURED: false, POLARISED: false },
            summed: self.quadrature.overrides(),
            axes: &self.table.axes,
            table: &self.table.view,
            quadrature: &self.quadrature.buffer,
            points: &gpu.storage("points", points),
            colours: &colours,
        };
        let mut recorder = Recorder::new(gpu);
        kernel.probe_colour(&mut recorder, "probe_colour", [points.len().div_ceil(64) as u32, 1, 1])?;
        recorder.submit(&Default::default());
        Ok(Readback::of_buffer(gpu, &colours, size))
    }
}
