//! The film's own motion on the device: vorticity and stream function under buoyancy, drag and viscosity. See its f64 twin,
//! [`physics::flow`](crate::physics::flow), for the equations and the order of a step.

mod checkpoint;
mod mirror;
mod multigrid;
mod pin;
mod step;

pub use checkpoint::FlowCheckpoint;
use mirror::RimMirror;
use multigrid::{Multigrid, System};
use pin::PinnedDrop;

use super::{
    device::{Gpu, GpuError},
    grid::halo_entries,
    passes::{flow_halo::HaloOfScalar, flow_measure::FlowMeasures},
    timing::{Recorder, STEP_FLOW},
};
use crate::physics::{
    film::Cap,
    flow::{FlowForces, POISSON_CYCLES, VISCOUS_CYCLES},
    sphere::CubedSphere,
};

/// Multigrid cycles of a step: only as many as its error needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cycles {
    /// Those that find the stream function.
    pub poisson: usize,
    /// Those of each of the two viscous solves.
    pub viscous: usize,
}

impl Default for Cycles {
    fn default() -> Self {
        Self { poisson: POISSON_CYCLES, viscous: VISCOUS_CYCLES }
    }
}

/// What the passes over the finest grid share.
struct FlowGrid {
    sphere: CubedSphere,
    tangents: wgpu::Buffer,
    halo: wgpu::Buffer,
}

impl FlowGrid {
    /// A workgroup for each 64 cells of a row.
    fn groups(&self) -> [u32; 3] {
        let cells = self.sphere.n() as u32;
        [cells.div_ceil(64), cells, 6]
    }

    fn fill_halo(&self, recorder: &mut Recorder<'_>, field: &wgpu::Buffer) -> Result<(), GpuError> {
        HaloOfScalar { entries: &self.halo, scalar: field }.halo_of_scalar(recorder, STEP_FLOW, [1; 3])
    }
}

/// Vorticity, stream function and velocity of a film, in padded storage. What its steps change is listed once, for checkpoints: in
/// `checkpoint.rs`. All of its methods but [`Self::new`] only record.
pub struct FlowSolver {
    grid: FlowGrid,
    multigrid: Multigrid,
    /// What stands for the film beyond a rim, if it has one.
    mirror: Option<RimMirror>,
    /// What holds the film at its bottom, if anything does.
    drop: Option<PinnedDrop>,
    zeta: wgpu::Buffer,
    log_thickness: wgpu::Buffer,
    forcing: wgpu::Buffer,
    psi: wgpu::Buffer,
    psi_before: wgpu::Buffer,
    /// Where the next step's ψ goes.
    psi_next: wgpu::Buffer,
    /// What half a step of drag leaves of vorticity with what half a step of the forces adds, and the part that is left.
    pushed: wgpu::Buffer,
    decay: wgpu::Buffer,
    /// What the two viscous stages take, vorticity after the first, and the sum of what the second takes.
    stages: [wgpu::Buffer; 2],
    once: wgpu::Buffer,
    twice: wgpu::Buffer,
    /// Where what the next step finds goes.
    moved: wgpu::Buffer,
    velocity: wgpu::Buffer,
    velocity_ahead: wgpu::Buffer,
    measures: wgpu::Buffer,
    /// Whether ψ one step ago is known.
    has_history: bool,
    /// Cycles of the steps to come.
    pub cycles: Cycles,
}

impl FlowSolver {
    /// Minimum cells along a panel's edge.
    pub const MIN_CELLS: u32 = 16;
    /// Cells along a panel's edge at most: beyond, the coarse grids are too much for one workgroup.
    pub const MAX_CELLS: u32 = 512;
    /// Cycles that find the first stream function, from nothing.
    const FIRST_CYCLES: usize = 12;

    /// A film at rest, on a grid with a number of cells along a panel's edge within [`Self::MIN_CELLS`] and [`Self::MAX_CELLS`].
    #[must_use]
    pub fn new(gpu: &Gpu, cells: u32) -> Self {
        let cells = cells.clamp(Self::MIN_CELLS, Self::MAX_CELLS);
        // The range lies within the range of grids, for which the constructor cannot fail.
        let sphere = CubedSphere::new(cells as usize).expect("a size in range");
        let field = |label| buffer(gpu, label, sphere.padded_len() as u64 * 4);
        let velocity = |label| buffer(gpu, label, sphere.padded_len() as u64 * 16);
        Self {
            grid: FlowGrid {
                sphere,
                tangents: gpu.storage("flow tangents", &sphere.edge_tangents()),
                halo: gpu.storage("flow halo", &halo_entries(sphere)),
            },
            multigrid: Multigrid::new(gpu, sphere),
            mirror: None,
            drop: None,
            zeta: field("vorticity"),
            log_thickness: field("ln h"),
            forcing: field("forcing"),
            psi: field("stream function"),
            psi_before: field("stream function before"),
            psi_next: field("next stream function"),
            pushed: buffer(gpu, "pushed vorticity", sphere.padded_len() as u64 * 8),
            decay: field("decay"),
            stages: ["first viscous stage", "second viscous stage"].map(field),
            once: field("vorticity after the first"),
            twice: field("source of the second"),
            moved: field("moved"),
            velocity: velocity("velocity"),
            velocity_ahead: velocity("velocity ahead"),
            measures: buffer(gpu, "flow measures", size_of::<FlowMeasures>() as u64),
            has_history: false,
            cycles: Cycles::default(),
        }
    }

    /// From the next seed on the film ends at the rim of a cap, across which nothing flows; or nowhere.
    pub fn end_at(&mut self, gpu: &Gpu, cap: Option<Cap>) {
        if self.mirror.as_ref().map(|mirror| mirror.cap) != cap {
            self.mirror = cap.map(|cap| RimMirror::new(gpu, &self.grid, cap));
        }
    }

    /// From the next step on a drop of an angular radius in radians hangs at the bottom, through which nothing flows; or none.
    pub fn pin(&mut self, gpu: &Gpu, radius: Option<f64>) {
        self.drop = radius.map(|radius| PinnedDrop::new(gpu, &self.grid, radius));
    }

    /// Makes vorticity beyond the rim, if there is one, the image of that within.
    fn reflect(&self, recorder: &mut Recorder<'_>, zeta: &wgpu::Buffer) -> Result<(), GpuError> {
        self.mirror.as_ref().map_or(Ok(()), |mirror| mirror.reflect(recorder, &self.grid, zeta))
    }

    /// The grid.
    #[must_use]
    pub fn sphere(&self) -> CubedSphere {
        self.grid.sphere
    }

    /// Vorticity in 1/s, f32 in padded storage, its halo undefined.
    #[must_use]
    pub fn zeta(&self) -> &wgpu::Buffer {
        &self.zeta
    }

    /// Stream function in rad²/s, f32 in padded storage with its halo.
    #[must_use]
    pub fn psi(&self) -> &wgpu::Buffer {
        &self.psi
    }

    /// Velocity of the stream function in rad/s, Cartesian, `vec4f` in padded storage with its halo: what
    /// `shaders/flow/backtrace.wgsl` reads.
    #[must_use]
    pub fn velocity(&self) -> &wgpu::Buffer {
        &self.velocity
    }

    /// Where the caller puts ln h before each step: f32 in padded storage, of the thickness in nm. Its halo is filled by the step. Without
    /// drag of air only differences matter.
    #[must_use]
    pub fn log_thickness(&self) -> &wgpu::Buffer {
        &self.log_thickness
    }

    /// Where the caller puts what stirs the film besides, if anything: a source of vorticity in 1/s², f32 in padded storage, without halo.
    #[must_use]
    pub fn forcing(&self) -> &wgpu::Buffer {
        &self.forcing
    }

    /// One [`FlowMeasures`].
    #[must_use]
    pub fn measures(&self) -> &wgpu::Buffer {
        &self.measures
    }

    /// Sets vorticity in 1/s in each cell, in the grid's order, finds its stream function, and forgets all motion. A mean is left out.
    pub fn seed(&mut self, recorder: &mut Recorder<'_>, zeta: &[f32]) -> Result<(), GpuError> {
        recorder.gpu.upload(&self.zeta, &self.padded(zeta));
        self.has_history = false;
        for cleared in [&self.psi, &self.psi_before, &self.measures] {
            recorder.encoder().clear_buffer(cleared, 0, None);
        }
        self.reflect(recorder, &self.zeta)?;
        let system = System { shift: 0.0, gain: 1.0, source: &self.zeta };
        self.multigrid.cycles(recorder, &self.grid, &system, &self.psi, Self::FIRST_CYCLES)?;
        let still = self.uniform(recorder.gpu, 0.0, &FlowForces::default());
        self.find_velocity(recorder, &still, &self.psi, &self.psi)
    }

    /// Moves vorticity by one step of `dt_s` seconds under forces, with ln h given half a step from now, which is what `velocity` then
    /// carries the thickness with from half a step before to half a step after. Steps that last no time change nothing.
    pub fn step(&mut self, recorder: &mut Recorder<'_>, dt_s: f64, forces: &FlowForces) -> Result<(), GpuError> {
        self.take(recorder, dt_s, forces, 0)
    }

    /// A step for flows whose eddies turn by more than [`FOLLOWED_TURN`](crate::physics::flow::FOLLOWED_TURN) in a step: it is tried
    /// first, which doubles its cost.
    pub fn step_corrected(
        &mut self,
        recorder: &mut Recorder<'_>,
        dt_s: f64,
        forces: &FlowForces,
    ) -> Result<(), GpuError> {
        self.take(recorder, dt_s, forces, 1)
    }

    /// Values of cells, in the grid's order, in padded storage with an empty halo.
    #[must_use]
    pub fn padded(&self, values: &[f32]) -> Vec<f32> {
        let mut padded = vec![0.0; self.grid.sphere.padded_len()];
        for (cell, value) in values.iter().enumerate() {
            padded[self.place(cell)] = *value;
        }
        padded
    }

    /// The cells of padded storage, in the grid's order.
    #[must_use]
    pub fn inner(&self, padded: &[f32]) -> Vec<f32> {
        (0..self.grid.sphere.cells()).map(|cell| padded[self.place(cell)]).collect()
    }

    /// Place of a cell in padded storage.
    fn place(&self, cell: usize) -> usize {
        let (panel, i, j) = self.grid.sphere.cell(cell);
        self.grid.sphere.padded_index(panel, i as isize, j as isize)
    }
}

/// A storage buffer that can be copied from and to.
fn buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    gpu.buffer(label, size, usage)
}
