//! Bakes the lookup table (√cosθ × path in the film → what is seen of light that one wall reflects) from the light's spectrum.

use std::f64::consts::TAU;

use bytemuck::Zeroable;

use crate::{
    gpu::{
        device::{Gpu, GpuError},
        kernel::{Rgba32Float, Rgba32Uint, Uniform, Written2dArray, WrittenFormat, kernels, overrides, shader_struct},
        passes::pair_rows::{PairRows, PairUniform},
        quadrature::{MAX_SPECTRUM, QuadratureSample, Spectrum},
        timing::Recorder,
        uniform_buffer::UniformBuffer,
    },
    plan::{OpticsKey, TableKey},
};

/// Rows of one dispatch, so that none runs long.
const ROWS_PER_DISPATCH: usize = 512;
/// Rows that an invocation bakes.
const ROWS_PER_INVOCATION: u32 = 4;
/// Phase, in radians, by which fringes may move from one sample of the spectrum to the next without losing contrast: those of water to 1.5 µm.
const RESOLVED_STEP: f64 = 0.2;

shader_struct! {
    /// What a table spans: see `shaders/optics/table.wgsl`.
    #[derive(PartialEq)]
    pub struct TableAxes {
        /// Columns and rows.
        pub size: [f32; 2],
        /// Thickness at the last row for normal incidence, in nm.
        pub max_thickness_nm: f32,
        /// Index of the film at the sodium line.
        pub index: f32,
    }
}

impl TableAxes {
    /// The axes of a table.
    #[must_use]
    pub fn of(key: &TableKey) -> Self {
        Self {
            size: [key.columns as f32, key.rows as f32],
            max_thickness_nm: key.max_thickness_nm as f32,
            index: key.optics.film.reference_index() as f32,
        }
    }
}

shader_struct! {
    /// What one dispatch reads besides the spectra.
    pub struct BakeUniform {
        /// The table's axes.
        pub axes: TableAxes,
        /// First row to bake.
        pub first_row: u32,
        /// Phase by which fringes may move from sample to sample, in radians.
        pub resolved_step: f32,
        /// Number of samples in use.
        pub wavelengths: u32,
        pad: u32,
    }
}

overrides! {
    /// Constants of all kernels that write or read a table, or would if the quality had one.
    pub struct TableOverrides {
        /// Whether the table keeps primaries apart.
        override COLOURED: bool;
        /// Whether it keeps polarisations apart.
        override POLARISED: bool;
    }
}

kernels! {
    pass bake_table;

    /// Some rows of a table.
    struct BakeTable {
        const ROWS: u32 = ROWS_PER_INVOCATION;
        override FADES: bool;
        overrides table_kind: TableOverrides;
        @0 bake: Uniform<BakeUniform>;
        @1 samples: Uniform<[QuadratureSample; MAX_SPECTRUM]>;
        @2 table: Written2dArray<Rgba32Float>;
    }
    compute bake_table;
}

/// A table on the device: a layer for each primary and polarisation that it keeps apart.
pub struct Table {
    /// What it spans, as a uniform.
    pub axes: UniformBuffer<TableAxes>,
    /// View of all layers: two rows to a texel, see `shaders/optics/table.wgsl`.
    pub view: wgpu::TextureView,
    /// What is baked: a row to a texel, before rows are paired.
    baked: wgpu::TextureView,
    /// Samples of the light's spectrum, then zeros. A uniform, because all lanes read the same sample at once: llvmpipe reads a storage
    /// buffer separately for each lane, which made the bake eight times as slow.
    spectra: UniformBuffer<[QuadratureSample; MAX_SPECTRUM]>,
    wavelengths: u32,
    /// Whether the samples are too few for the fringes of some film.
    fades: bool,
}

/// Whether fringes of films up to a thickness move by more than is resolved from one sample to the next.
fn fades(samples: &[QuadratureSample], max_thickness_nm: f64) -> bool {
    let step = |sample: &QuadratureSample| {
        let [index, wavelength_nm, width_nm] = [sample.index, sample.wavelength_nm, sample.width_nm].map(f64::from);
        TAU * 2.0 * index * max_thickness_nm / wavelength_nm * width_nm / wavelength_nm
    };
    samples.iter().any(|sample| step(sample) > RESOLVED_STEP)
}

impl Table {
    /// An empty table and the spectra that it will be baked from.
    #[must_use]
    pub fn new(gpu: &Gpu, key: &TableKey) -> Self {
        let axes = gpu.uniform("table axes", &TableAxes::of(key));
        let spectrum = Spectrum::of(&key.optics);
        let fine = spectrum.samples();
        let fades = fades(&fine, key.max_thickness_nm);
        let samples = if fades { fine } else { spectrum.coarse_samples() };
        let mut spectra = [QuadratureSample::zeroed(); MAX_SPECTRUM];
        // No light has more: see `MAX_SPECTRUM`.
        spectra[..samples.len()].copy_from_slice(&samples);
        Self {
            axes,
            view: layers(gpu, "film table", key, Rgba32Uint::FORMAT),
            baked: layers(gpu, "baked film table", key, Rgba32Float::FORMAT),
            spectra: gpu.uniform("spectra", &spectra),
            wavelengths: samples.len() as u32,
            fades,
        }
    }

    /// A whole table.
    pub fn baked(gpu: &Gpu, key: &TableKey) -> Result<Self, GpuError> {
        let table = Self::new(gpu, key);
        let mut recorder = Recorder::new(gpu);
        for first in (0..key.rows).step_by(ROWS_PER_DISPATCH) {
            table.bake(&mut recorder, key, first..(first + ROWS_PER_DISPATCH as u32).min(key.rows))?;
        }
        recorder.submit(&Default::default());
        Ok(table)
    }

    /// The smallest table, for the binding of a shader that reads none.
    #[must_use]
    pub fn unread(gpu: &Gpu, optics: &OpticsKey) -> Self {
        Self::new(gpu, &TableKey { columns: 1, rows: 1, ..TableKey::full(optics.clone(), TableKey::MIN_RANGE_NM) })
    }

    /// Records the bake of some rows.
    pub fn bake(
        &self,
        recorder: &mut Recorder<'_>,
        key: &TableKey,
        rows: std::ops::Range<u32>,
    ) -> Result<(), GpuError> {
        let uniform = BakeUniform {
            axes: TableAxes::of(key),
            first_row: rows.start,
            resolved_step: RESOLVED_STEP as f32,
            wavelengths: self.wavelengths,
            pad: 0,
        };
        let kernel = BakeTable {
            FADES: self.fades,
            table_kind: TableOverrides { COLOURED: key.coloured, POLARISED: key.polarised },
            bake: &recorder.gpu.uniform("bake", &uniform),
            samples: &self.spectra,
            table: &self.baked,
        };
        kernel.bake_table(
            recorder,
            "bake_table",
            [key.columns.div_ceil(64), (rows.len() as u32).div_ceil(ROWS_PER_INVOCATION), 1],
        )?;
        // The row before these still lacks its next.
        let pair = PairUniform {
            columns: key.columns,
            first_row: rows.start.saturating_sub(1),
            end_row: rows.end,
            last_row: key.rows - 1,
        };
        let pairs = pair.end_row - pair.first_row;
        let kernel = PairRows { pair: &recorder.gpu.uniform("pair", &pair), baked: &self.baked, paired: &self.view };
        kernel.pair_rows(recorder, "bake_table", [key.columns.div_ceil(64), pairs, key.layers()])
    }
}

/// All layers of a table in a format.
fn layers(gpu: &Gpu, label: &str, key: &TableKey, format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: key.columns,
            height: key.rows,
            depth_or_array_layers: gpu.array_layers(key.layers()),
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}
