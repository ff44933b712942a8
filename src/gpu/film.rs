//! A film's field on the device: the flow map, the tracer of the last remap, and the thickness that is shown.
//!
//! The film is moved as a flow map: `map(x)` says where the liquid at x was at the last remap, and the thickness is the tracer of that remap
//! looked up there. Each step composes the map with one backtrace; a remap looks the tracer up once for good and makes the map the identity.
//! Remapping at every step is the classic semi-Lagrangian scheme with bicubic interpolation; remapping rarely keeps filaments sharp, for the
//! error then grows with the number of remaps and not of steps (Taylor & Nave, arXiv 2106.13170).

use bytemuck::{Pod, Zeroable};

use super::{
    Gpu, GpuError,
    advance_map::{MapBuffers, Step, advance_map},
    compose_map::compose_map,
    pipelines::ComputeKey,
    timing::Recorder,
};
use crate::physics::sphere::{CubedSphere, HALO, HaloEntry, HaloTable};

/// The grid, as `sample_tracer` reads it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct GridUniform {
    /// Cells along a panel's edge.
    pub cells: u32,
    pad: [u32; 3],
}

/// Name of the passes that make a film ready to be drawn.
const SHOW: &str = "show_field";

/// A film's field.
pub struct Field {
    sphere: CubedSphere,
    grid: wgpu::Buffer,
    tangents: wgpu::Buffer,
    halo: Halo,
    /// Where smooth flows are traced.
    flow: FlowGrid,
    /// The map, and where its next step goes.
    map: [wgpu::Buffer; 2],
    map_is_identity: bool,
    /// The tracer of the last remap, and where the next remap goes.
    tracer: [wgpu::Buffer; 2],
    /// What pictures read: a layer a panel, halo included.
    film: wgpu::Texture,
}

/// Halo cells beyond an edge, then those beyond a corner, which read the edges.
struct Halo([HaloList; 2]);

struct HaloList {
    entries: wgpu::Buffer,
    count: u32,
}

impl Halo {
    fn new(gpu: &Gpu, sphere: CubedSphere) -> Self {
        let table = HaloTable::new(sphere);
        let list =
            |entries: &[HaloEntry]| HaloList { entries: gpu.storage("halo", entries), count: entries.len() as u32 };
        Self([list(&table.edges), list(&table.corners)])
    }
}

/// A grid four times coarser than the film, on which a step's backtrace is made: its cells are still a fraction of the smallest eddy,
/// and cubic interpolation of one step's displacement errs by less than f32 rounds.
struct FlowGrid {
    cells: u32,
    tangents: wgpu::Buffer,
    halo: Halo,
    step_map: wgpu::Buffer,
}

impl FlowGrid {
    /// Cells along a panel's edge at least: 1.4° each.
    const MIN_CELLS: u32 = 64;

    fn new(gpu: &Gpu, film: CubedSphere) -> Self {
        let film_cells = film.n() as u32;
        let cells = film_cells.div_ceil(4).max(Self::MIN_CELLS).min(film_cells);
        // No finer than the film's own grid, which is one.
        let sphere = CubedSphere::new(cells as usize).unwrap_or(film);
        let usage = wgpu::BufferUsages::STORAGE;
        Self {
            cells,
            tangents: gpu.storage("flow tangents", &tangents(cells)),
            halo: Halo::new(gpu, sphere),
            step_map: gpu.buffer("step map", sphere.padded_len() as u64 * 16, usage),
        }
    }

    /// Traces one step back from every cell.
    fn trace(&self, recorder: &mut Recorder<'_>, name: &'static str, step: &Step) -> Result<(), GpuError> {
        let map = MapBuffers { cells: self.cells, tangents: &self.tangents, before: None, after: &self.step_map };
        advance_map(recorder, name, step, &map)?;
        fill_halo(recorder, &self.halo, name, HaloOf::Map(&self.step_map))
    }
}

impl Field {
    /// An empty field.
    #[must_use]
    pub fn new(gpu: &Gpu, sphere: CubedSphere) -> Self {
        let cells = sphere.n() as u32;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let padded = sphere.padded_len() as u64;
        Self {
            sphere,
            grid: gpu.uniform("grid", &GridUniform { cells, pad: [0; 3] }),
            tangents: gpu.storage("tangents", &tangents(cells)),
            halo: Halo::new(gpu, sphere),
            flow: FlowGrid::new(gpu, sphere),
            map: ["map", "next map"].map(|label| gpu.buffer(label, padded * 16, usage)),
            map_is_identity: true,
            tracer: ["tracer", "next tracer"].map(|label| gpu.buffer(label, padded * 4, usage)),
            film: film_texture(gpu, sphere.padded_width() as u32),
        }
    }

    /// Cells along a panel's edge.
    #[must_use]
    pub fn cells(&self) -> u32 {
        self.sphere.n() as u32
    }

    /// Thickness in nm as it was last shown, a layer a panel, halo included.
    #[must_use]
    pub fn film(&self) -> wgpu::TextureView {
        film_view(&self.film)
    }

    /// Sets the tracer, in the grid's order of cells, and forgets all motion.
    pub fn seed(&mut self, recorder: &mut Recorder<'_>, values: &[f32]) -> Result<(), GpuError> {
        recorder.gpu.upload(&self.tracer[0], &self.padded(values));
        self.map_is_identity = true;
        fill_halo(recorder, &self.halo, "seed_field", HaloOf::Tracer(&self.tracer[0]))
    }

    /// Moves the liquid by one step. If a remap follows at once, the map's halo is not needed.
    pub fn advance(&mut self, recorder: &mut Recorder<'_>, step: &Step, remap: bool) -> Result<(), GpuError> {
        self.advance_into_spare(recorder, "step_field", step)?;
        self.map.swap(0, 1);
        if remap {
            return self.remap(recorder);
        }
        self.map_is_identity = false;
        fill_halo(recorder, &self.halo, "step_field", HaloOf::Map(&self.map[0]))
    }

    fn advance_into_spare(&self, recorder: &mut Recorder<'_>, name: &'static str, step: &Step) -> Result<(), GpuError> {
        let before = (!self.map_is_identity).then_some(&self.map[0]);
        let map = MapBuffers { cells: self.cells(), tangents: &self.tangents, before, after: &self.map[1] };
        recorder.counts.cells_stepped += self.sphere.cells() as u64;
        if step.may_be_coarse() && self.flow.cells < self.cells() {
            self.flow.trace(recorder, name, step)?;
            return compose_map(recorder, name, (self.flow.cells, &self.flow.step_map), &map);
        }
        advance_map(recorder, name, step, &map)
    }

    /// Looks the tracer up through the map, for good.
    fn remap(&mut self, recorder: &mut Recorder<'_>) -> Result<(), GpuError> {
        self.sample(recorder, "step_field", &self.map[0], &self.tracer[1])?;
        fill_halo(recorder, &self.halo, "step_field", HaloOf::Tracer(&self.tracer[1]))?;
        self.tracer.swap(0, 1);
        self.map_is_identity = true;
        Ok(())
    }

    /// Makes the thickness ready to be drawn, a part of a step ahead of the state if one is given. The state stays.
    pub fn show(&self, recorder: &mut Recorder<'_>, ahead: Option<&Step>) -> Result<(), GpuError> {
        let thickness = self.thickness(recorder, ahead)?;
        let gpu = recorder.gpu;
        let pipeline =
            gpu.pipelines.compute(gpu, &ComputeKey { pass: "pack_film", entry: "pack_film", constants: vec![] })?;
        let bindings = gpu.bind(
            &pipeline.get_bind_group_layout(0),
            &[thickness.as_entire_binding(), wgpu::BindingResource::TextureView(&self.film())],
        );
        let side = self.film.width();
        recorder.dispatch(SHOW, &pipeline, &bindings, [side.div_ceil(64), side, 6]);
        Ok(())
    }

    /// The thickness in padded storage, a part of a step ahead of the state if one is given. The buffer holds it until the next step.
    pub fn thickness(&self, recorder: &mut Recorder<'_>, ahead: Option<&Step>) -> Result<&wgpu::Buffer, GpuError> {
        let map = match ahead {
            Some(step) => {
                self.advance_into_spare(recorder, SHOW, step)?;
                &self.map[1]
            }
            None if self.map_is_identity => return Ok(&self.tracer[0]),
            None => &self.map[0],
        };
        self.sample(recorder, SHOW, map, &self.tracer[1])?;
        fill_halo(recorder, &self.halo, SHOW, HaloOf::Tracer(&self.tracer[1]))?;
        Ok(&self.tracer[1])
    }

    fn sample(
        &self,
        recorder: &mut Recorder<'_>,
        name: &'static str,
        map: &wgpu::Buffer,
        to: &wgpu::Buffer,
    ) -> Result<(), GpuError> {
        let gpu = recorder.gpu;
        let key = ComputeKey { pass: "sample_tracer", entry: "sample_tracer", constants: vec![] };
        let pipeline = gpu.pipelines.compute(gpu, &key)?;
        let bindings = gpu.bind(
            &pipeline.get_bind_group_layout(0),
            &[&self.grid, map, &self.tracer[0], to].map(wgpu::Buffer::as_entire_binding),
        );
        recorder.dispatch(name, &pipeline, &bindings, [self.cells().div_ceil(64), self.cells(), 6]);
        Ok(())
    }

    /// Copies as many bytes as a step moves, and leaves the state alone: what steps are measured against.
    pub fn copy_state(&self, recorder: &mut Recorder<'_>) {
        for [from, to] in [&self.map, &self.tracer] {
            recorder.encoder().copy_buffer_to_buffer(from, 0, to, 0, from.size());
        }
    }

    /// The cells of padded storage, in the grid's order.
    #[must_use]
    pub fn inner(&self, padded: &[f32]) -> Vec<f32> {
        (0..self.sphere.cells()).map(|cell| padded[self.place(cell)]).collect()
    }

    /// Values in the grid's order, in padded storage with an empty halo.
    fn padded(&self, values: &[f32]) -> Vec<f32> {
        let mut padded = vec![0.0; self.sphere.padded_len()];
        for (cell, value) in values.iter().enumerate() {
            padded[self.place(cell)] = *value;
        }
        padded
    }

    /// Place of a cell in padded storage.
    fn place(&self, cell: usize) -> usize {
        let (panel, i, j) = self.sphere.cell(cell);
        self.sphere.padded_index(panel, i as isize, j as isize)
    }
}

/// An empty film for pictures that read none.
#[must_use]
pub fn no_film(gpu: &Gpu) -> wgpu::TextureView {
    film_view(&film_texture(gpu, 1))
}

fn film_texture(gpu: &Gpu, side: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("film"),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 6 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::R32Float,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

fn film_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// tan(α) of each cell coordinate of an edge, halo included, rounded once from f64.
fn tangents(cells: u32) -> Vec<f32> {
    let halo = HALO as f64;
    let step = std::f64::consts::FRAC_PI_2 / f64::from(cells);
    let count = cells as usize + 2 * HALO;
    (0..count).map(|k| ((k as f64 - halo + 0.5) * step - std::f64::consts::FRAC_PI_4).tan() as f32).collect()
}

enum HaloOf<'a> {
    Map(&'a wgpu::Buffer),
    Tracer(&'a wgpu::Buffer),
}

fn fill_halo(recorder: &mut Recorder<'_>, halo: &Halo, name: &'static str, of: HaloOf<'_>) -> Result<(), GpuError> {
    let gpu = recorder.gpu;
    let (entry, buffer) = match of {
        HaloOf::Map(buffer) => ("fill_map", buffer),
        HaloOf::Tracer(buffer) => ("fill_tracer", buffer),
    };
    let pipeline = gpu.pipelines.compute(gpu, &ComputeKey { pass: "fill_halo", entry, constants: vec![] })?;
    for list in &halo.0 {
        let bindings =
            gpu.bind(&pipeline.get_bind_group_layout(0), &[&list.entries, buffer].map(wgpu::Buffer::as_entire_binding));
        recorder.dispatch(name, &pipeline, &bindings, [list.count.div_ceil(64), 1, 1]);
    }
    Ok(())
}
