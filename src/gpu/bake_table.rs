//! Bakes the lookup table (√cosθ × path in the film → colour) from 421 wavelengths.

use bytemuck::{Pod, Zeroable};

use super::{Gpu, GpuError, pipelines::ComputeKey, timing::Recorder};
use crate::{
    physics::{
        colour::{BT2020, FilmOptics},
        optics::REFERENCE_NM,
        spectra,
    },
    plan::TableKey,
};

/// Format of the table: filterable and storable on every adapter.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// What a table spans: see `shaders/optics/table.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TableAxes {
    /// Columns and rows.
    pub size: [f32; 2],
    /// Thickness at the last row for normal incidence, in nm.
    pub max_thickness_nm: f32,
    /// Index of the film at [`REFERENCE_NM`].
    pub index: f32,
}

impl TableAxes {
    /// The axes of a table.
    #[must_use]
    pub fn of(key: &TableKey) -> Self {
        Self {
            size: [key.columns as f32, key.rows as f32],
            max_thickness_nm: key.max_thickness_nm as f32,
            index: key.index.n(REFERENCE_NM) as f32,
        }
    }
}

/// One wavelength of the spectral sum.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SpectralSample {
    /// Linear BT.2020 colour that a perfect mirror reflects of it.
    pub colour: [f32; 3],
    /// Refractive index of the film.
    pub index: f32,
}

/// What one dispatch reads besides the spectra.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct BakeUniform {
    /// The table's axes.
    pub axes: TableAxes,
    /// First row to bake.
    pub first_row: u32,
    /// First wavelength, in nm.
    pub first_wavelength_nm: f32,
    /// Step between wavelengths, in nm.
    pub wavelength_step_nm: f32,
    pad: u32,
}

/// A table on the device: two layers, s and p light.
pub struct Table {
    /// What it spans, as a uniform.
    pub axes: wgpu::Buffer,
    /// View of both layers.
    pub view: wgpu::TextureView,
    samples: wgpu::Buffer,
}

impl Table {
    /// An empty table and the spectra that it will be baked from.
    #[must_use]
    pub fn new(gpu: &Gpu, key: &TableKey) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("film table"),
            size: wgpu::Extent3d { width: key.columns, height: key.rows, depth_or_array_layers: 2 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let axes = gpu.uniform("table axes", &TableAxes::of(key));
        Self { axes, view, samples: gpu.storage("spectra", &spectral_samples(key)) }
    }

    /// Records the bake of some rows.
    pub fn bake(
        &self,
        recorder: &mut Recorder<'_>,
        key: &TableKey,
        rows: std::ops::Range<u32>,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu;
        let pipeline_key = ComputeKey { pass: "bake_table", entry: "bake_table", constants: vec![] };
        let pipeline = gpu.pipelines.compute(gpu, &pipeline_key)?;
        let uniform = BakeUniform {
            axes: TableAxes::of(key),
            first_row: rows.start,
            first_wavelength_nm: spectra::FIRST_NM as f32,
            wavelength_step_nm: 1.0,
            pad: 0,
        };
        let uniform = gpu.uniform("bake", &uniform);
        let bindings = gpu.bind(
            &pipeline.get_bind_group_layout(0),
            &[
                uniform.as_entire_binding(),
                self.samples.as_entire_binding(),
                wgpu::BindingResource::TextureView(&self.view),
            ],
        );
        recorder.dispatch("bake_table", &pipeline, &bindings, [key.columns.div_ceil(64), rows.len() as u32, 1]);
        Ok(())
    }
}

fn spectral_samples(key: &TableKey) -> Vec<SpectralSample> {
    let optics = FilmOptics::new(key.index, &key.illuminant);
    let to_bt2020 = BT2020.from_xyz();
    let weights = optics.weights().as_slice().iter();
    weights
        .zip(optics.indices())
        .map(|(weight, index)| SpectralSample {
            colour: (to_bt2020 * *weight).as_vec3().to_array(),
            index: *index as f32,
        })
        .collect()
}

/// Filters a table: linear, and no wrapping at its ends.
#[must_use]
pub fn table_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("film table"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}
