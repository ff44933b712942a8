//! The multigrid solver of `(Δ − k) ψ = f` on the device: see its f64 twin in `physics::flow`.
//!
//! The finest grid is swept by one dispatch a sweep, for all films; all coarser ones of a film together are a single workgroup's work.

use bytemuck::Zeroable;

use super::{FlowGrid, buffer};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        grid::halo_entries,
        passes::{
            flow_coarse::{CoarseLevel, CoarseSystem, FlowCoarse, MAX_LEVELS},
            flow_correct::FlowCorrect,
            flow_residual::{FilmSystem, FlowResidual, MAX_FILMS, SolveUniform},
            flow_sweep::FlowSweep,
        },
        timing::{Recorder, STEP_FLOW},
        uniform_buffer::UniformBuffer,
    },
    physics::{
        flow::{Order, SWEEPS, Shift, coarser, coarsest_weights, is_coarsest, sweep_weights},
        sphere::CubedSphere,
    },
};

/// A linear system: `(Δ − k) ψ = gain · source`.
#[derive(Clone, Copy)]
pub struct System {
    /// k.
    pub shift: Shift,
    /// f over the source.
    pub gain: f64,
}

impl System {
    /// Poisson's equation.
    pub const POISSON: Self = Self { shift: 0.0, gain: 1.0 };
}

/// The grids, and room to work.
pub struct Multigrid {
    /// The grids, the finest first, still without weights.
    levels: Vec<CoarseLevel>,
    /// Values of all films on all grids.
    values: u32,
    tangents: wgpu::Buffer,
    halo: wgpu::Buffer,
    f: wgpu::Buffer,
    e: wgpu::Buffer,
    /// ψ on the finest grid, every other sweep.
    scratch: wgpu::Buffer,
}

impl Multigrid {
    /// The grids with and below that of some films, which has one below it.
    pub fn new(gpu: &Gpu, grid: &FlowGrid) -> Self {
        let FlowGrid { sphere, films, .. } = *grid;
        let all = std::iter::successors(Some(sphere.n()), |&n| coarser(n)).take(MAX_LEVELS);
        let (mut levels, mut all_tangents, mut entries, mut values) = (Vec::new(), Vec::new(), Vec::new(), 0);
        for sphere in all.filter_map(|n| CubedSphere::new(n).ok()) {
            levels.push(CoarseLevel {
                weights: [0.0; SWEEPS],
                per_angle2: sphere.cell_angle().powi(-2) as f32,
                cells: sphere.n() as u32,
                field: values,
                tangent: all_tangents.len() as u32,
                halo: entries.len() as u32,
            });
            all_tangents.extend(sphere.edge_tangents());
            entries.extend(halo_entries(sphere));
            values += films * sphere.padded_len() as u32;
        }
        Self {
            levels,
            values,
            tangents: gpu.storage("coarse tangents", &all_tangents),
            halo: gpu.storage("coarse halo", &entries),
            f: buffer(gpu, "coarse right sides", u64::from(values) * 4),
            e: buffer(gpu, "coarse corrections", u64::from(values) * 8),
            scratch: buffer(gpu, "swept", grid.padded_len() * 4),
        }
    }

    /// Records cycles that improve ψ, which has its halo before and after, for the system of each film; of the source, in padded storage, only
    /// cells are read.
    pub fn cycles(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &FlowGrid,
        (systems, source): (&[System], &wgpu::Buffer),
        psi: &wgpu::Buffer,
        count: usize,
    ) -> Result<(), GpuError> {
        let solve = &recorder.gpu.uniform("solve", &self.solve_uniform(grid.sphere, systems));
        let coarse: Vec<_> = systems.iter().map(|system| self.coarse_system(system.shift)).collect();
        let coarse = &recorder.gpu.storage("coarse grids", &coarse);
        for _ in 0..count {
            self.correct(recorder, grid, source, psi, (solve, coarse))?;
            // An odd number of sweeps, so that the last is into ψ.
            for sweep in 0..SWEEPS {
                let [from, to] = if sweep % 2 == 0 { [&self.scratch, psi] } else { [psi, &self.scratch] };
                let kernel = FlowSweep {
                    SWEEP: sweep as u32,
                    solve,
                    tangents: &grid.tangents,
                    source,
                    psi: from,
                    psi_after: to,
                };
                kernel.flow_sweep(recorder, STEP_FLOW, grid.eights_groups())?;
                grid.fill_halo(recorder, to)?;
            }
        }
        Ok(())
    }

    /// Corrects ψ by what the coarse grids find, into `scratch`.
    fn correct(
        &self,
        recorder: &mut Recorder<'_>,
        grid: &FlowGrid,
        source: &wgpu::Buffer,
        psi: &wgpu::Buffer,
        (solve, coarse): (&UniformBuffer<SolveUniform>, &wgpu::Buffer),
    ) -> Result<(), GpuError> {
        let Self { tangents, halo, f, e, scratch, .. } = self;
        let residual = FlowResidual { solve, tangents: &grid.tangents, source, psi, left: f };
        residual.flow_residual(recorder, STEP_FLOW, grid.eights_groups())?;
        FlowCoarse { coarse, tangents, entries: halo, f, e }.flow_coarse(recorder, STEP_FLOW, grid.film_groups())?;
        let correct = FlowCorrect { solve, correction: e, psi, psi_after: scratch };
        correct.flow_correct(recorder, STEP_FLOW, grid.groups())?;
        grid.fill_halo(recorder, scratch)
    }

    fn solve_uniform(&self, sphere: CubedSphere, systems: &[System]) -> SolveUniform {
        let mut uniform = SolveUniform {
            per_angle2: sphere.cell_angle().powi(-2) as f32,
            cells: sphere.n() as u32,
            coarse_cells: self.levels[1].cells,
            coarse_field: self.levels[1].field,
            systems: [FilmSystem::zeroed(); MAX_FILMS],
        };
        for (slot, system) in uniform.systems.iter_mut().zip(systems) {
            *slot = FilmSystem {
                weights: sweep_weights(sphere.n(), Order::Fourth, system.shift).map(|weight| weight as f32),
                shift: system.shift as f32,
                gain: system.gain as f32,
                padding: [0; 3],
            };
        }
        uniform
    }

    fn coarse_system(&self, shift: Shift) -> CoarseSystem {
        let mut found = CoarseSystem::zeroed();
        // The finest grid, those below it, and the first of them that needs none below itself.
        let needed =
            2 + self.levels.iter().skip(1).take_while(|level| !is_coarsest(level.cells as usize, shift)).count();
        let levels = &self.levels[..needed.min(self.levels.len())];
        (found.levels, found.values, found.shift) = (levels.len() as u32, self.values, shift as f32);
        for (slot, level) in found.level.iter_mut().zip(levels) {
            let weights = sweep_weights(level.cells as usize, Order::Second, shift).map(|weight| weight as f32);
            *slot = CoarseLevel { weights, ..*level };
        }
        if let Some(coarsest) = levels.last() {
            let weights = coarsest_weights(coarsest.cells as usize, shift);
            found.sweeps = weights.len() as u32;
            for (slot, weight) in found.coarsest.iter_mut().zip(weights) {
                *slot = weight as f32;
            }
        }
        found
    }
}
