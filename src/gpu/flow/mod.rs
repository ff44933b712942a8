//! The film's own motion on the device: vorticity and stream function under buoyancy, drag and viscosity. See its f64 twin,
//! [`physics::flow`](crate::physics::flow), for the equations and the order of a step.
//!
//! A solver may hold many films on equal grids, one after the other in each of its buffers: a step of all of them takes as many dispatches as
//! a step of one, and gives each the bits that it would get alone.

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
    passes::{flow_halo::HaloOfScalar, flow_measure::FlowMeasures, flow_residual::MAX_FILMS},
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
    films: u32,
    tangents: wgpu::Buffer,
    halo: wgpu::Buffer,
}

impl FlowGrid {
    /// Workgroups of a pass with one invocation per cell, in tiles of 8 x 8: rows of 64 would leave many idle.
    fn groups(&self) -> [u32; 3] {
        let tiles = (self.sphere.n() as u32).div_ceil(8);
        [tiles, tiles, 6 * self.films]
    }

    /// Workgroups of a pass with one invocation for four cells of each of two rows, in tiles of 32 x 8 cells.
    fn eights_groups(&self) -> [u32; 3] {
        let cells = self.sphere.n() as u32;
        [cells.div_ceil(32), cells.div_ceil(8), 6 * self.films]
    }

    /// A workgroup for each film.
    fn film_groups(&self) -> [u32; 3] {
        [self.films, 1, 1]
    }

    /// Cells of all films, halos included.
    fn padded_len(&self) -> u64 {
        u64::from(self.films) * self.sphere.padded_len() as u64
    }

    fn fill_halo(&self, recorder: &mut Recorder<'_>, field: &wgpu::Buffer) -> Result<(), GpuError> {
        HaloOfScalar { entries: &self.halo, scalar: field }.halo_of_scalar(recorder, STEP_FLOW, self.film_groups())
    }
}

/// Vorticity, stream function and velocity of one or more films, in padded storage. What its steps change is listed once, for checkpoints: in
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
    /// Films that one solver can hold at most.
    pub const MAX_FILMS: usize = MAX_FILMS;
    /// Minimum cells along a panel's edge.
    pub const MIN_CELLS: u32 = 16;
    /// Cells along a panel's edge at most: beyond, the coarse grids are too much for one workgroup.
    pub const MAX_CELLS: u32 = 512;
    /// Cycles that find the first stream function, from nothing.
    const FIRST_CYCLES: usize = 12;

    /// A film at rest, on a grid with a number of cells along a panel's edge within [`Self::MIN_CELLS`] and [`Self::MAX_CELLS`].
    #[must_use]
    pub fn new(gpu: &Gpu, cells: u32) -> Self {
        Self::of_films(gpu, cells, 1)
    }

    /// Films at rest that take their steps together, [`Self::MAX_FILMS`] at most.
    #[must_use]
    pub fn of_films(gpu: &Gpu, cells: u32, films: usize) -> Self {
        let cells = cells.clamp(Self::MIN_CELLS, Self::MAX_CELLS);
        // The range lies within the range of grids, for which the constructor cannot fail.
        let sphere = CubedSphere::new(cells as usize).expect("a size in range");
        let grid = FlowGrid {
            sphere,
            films: films.clamp(1, MAX_FILMS) as u32,
            tangents: gpu.storage("flow tangents", &sphere.edge_tangents()),
            halo: gpu.storage("flow halo", &halo_entries(sphere)),
        };
        let numbers = |label, bytes: u64| buffer(gpu, label, grid.padded_len() * bytes);
        let field = |label| numbers(label, 4);
        Self {
            multigrid: Multigrid::new(gpu, &grid),
            mirror: None,
            drop: None,
            zeta: field("vorticity"),
            log_thickness: field("ln h"),
            forcing: field("forcing"),
            psi: field("stream function"),
            psi_before: field("stream function before"),
            psi_next: field("next stream function"),
            pushed: numbers("pushed vorticity", 8),
            decay: field("decay"),
            stages: ["first viscous stage", "second viscous stage"].map(field),
            once: field("vorticity after the first"),
            twice: field("source of the second"),
            moved: field("moved"),
            velocity: numbers("velocity", 16),
            velocity_ahead: numbers("velocity ahead", 16),
            measures: buffer(gpu, "flow measures", u64::from(grid.films) * size_of::<FlowMeasures>() as u64),
            has_history: false,
            cycles: Cycles::default(),
            grid,
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

    /// Whether it has taken a step since the seed.
    pub(in crate::gpu) fn has_history(&self) -> bool {
        self.has_history
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

    /// [`FlowMeasures`] of each film.
    #[must_use]
    pub fn measures(&self) -> &wgpu::Buffer {
        &self.measures
    }

    /// Sets vorticity in 1/s in each cell, film after film and in the grid's order, finds its stream function, and forgets all motion. A mean is left out.
    pub fn seed(&mut self, recorder: &mut Recorder<'_>, zeta: &[f32]) -> Result<(), GpuError> {
        recorder.gpu.upload(&self.zeta, &self.padded(zeta));
        self.has_history = false;
        for cleared in [&self.psi, &self.psi_before, &self.measures] {
            recorder.encoder().clear_buffer(cleared, 0, None);
        }
        self.reflect(recorder, &self.zeta)?;
        let systems = vec![System::POISSON; self.grid.films as usize];
        self.multigrid.cycles(recorder, &self.grid, (&systems, &self.zeta), &self.psi, Self::FIRST_CYCLES)?;
        let still = self.uniform(recorder.gpu, 0.0);
        self.find_velocity(recorder, &still, &self.psi, &self.psi)
    }

    /// Moves vorticity by one step of `dt_s` seconds under forces, with ln h given half a step from now, which is what `velocity` then
    /// carries the thickness with from half a step before to half a step after. Steps that last no time change nothing.
    pub fn step(&mut self, recorder: &mut Recorder<'_>, dt_s: f64, forces: &FlowForces) -> Result<(), GpuError> {
        self.step_films(recorder, dt_s, &[*forces], false)
    }

    /// A step of all films, each under its own forces: with viscosity all of them, or none. It may be tried first, as by
    /// [`Self::step_corrected`].
    pub fn step_films(
        &mut self,
        recorder: &mut Recorder<'_>,
        dt_s: f64,
        forces: &[FlowForces],
        corrected: bool,
    ) -> Result<(), GpuError> {
        self.take(recorder, dt_s, forces, usize::from(corrected))
    }

    /// A step for flows whose eddies turn by more than [`FOLLOWED_TURN`](crate::physics::flow::FOLLOWED_TURN) in a step: it is tried
    /// first, which doubles its cost.
    pub fn step_corrected(
        &mut self,
        recorder: &mut Recorder<'_>,
        dt_s: f64,
        forces: &FlowForces,
    ) -> Result<(), GpuError> {
        self.step_films(recorder, dt_s, &[*forces], true)
    }

    /// Values of cells, film after film and in the grid's order, in padded storage with empty halos.
    #[must_use]
    pub fn padded(&self, values: &[f32]) -> Vec<f32> {
        let mut padded = vec![0.0; self.grid.padded_len() as usize];
        for (cell, value) in values.iter().enumerate() {
            padded[self.place(cell)] = *value;
        }
        padded
    }

    /// The cells of padded storage, film after film and in the grid's order.
    #[must_use]
    pub fn inner(&self, padded: &[f32]) -> Vec<f32> {
        let films = padded.len() / self.grid.sphere.padded_len();
        (0..films * self.grid.sphere.cells()).map(|cell| padded[self.place(cell)]).collect()
    }

    /// Place in padded storage of a cell, counted on from film to film.
    fn place(&self, cell: usize) -> usize {
        let sphere = self.grid.sphere;
        let (panel, i, j) = sphere.cell(cell % sphere.cells());
        cell / sphere.cells() * sphere.padded_len() + sphere.padded_index(panel, i as isize, j as isize)
    }
}

/// A storage buffer that can be copied from and to.
fn buffer(gpu: &Gpu, label: &str, size: u64) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    gpu.buffer(label, size, usage)
}
