//! A blown film that gravity sorts: thin film rises, thick film sinks, and bands are left.

use cpu_time::ProcessTime;
use glam::DVec3;

use super::{
    Run,
    free_film::{FreeFilm, RULES, field},
};
use crate::{
    gpu::{Gpu, GpuError, control::ControlBlock, film::Rules, flow::Cycles, passes::decide_remap::RemapRule},
    physics::{
        film::{InitialFilm, PrescribedFlow},
        flow::{FlowForces, POISSON_CYCLES, VISCOUS_CYCLES},
        sphere::CubedSphere,
    },
};

/// A blown film of 700 nm on a bubble of 5 cm, in air at rest.
#[derive(Clone, Copy, Debug)]
pub struct Sorting {
    /// Cells along a panel's edge.
    pub cells: usize,
    /// How many of them a cell of the map spans.
    pub map_coarsening: u32,
    /// Cells along a panel's edge of the flow, where it is coarser.
    pub flow_cells: u32,
    /// Multigrid cycles of a step.
    pub cycles: Cycles,
    /// Seed: each gives another film.
    pub seed: u32,
    /// Kinematic viscosity, m²/s.
    pub viscosity_m2_s: f64,
    /// Diffusion of thickness, m²/s.
    pub diffusion_m2_s: f64,
    /// Drag, 1/s.
    pub drag: f64,
    /// Length of a step, s.
    pub dt_s: f64,
}

/// A film on the way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sorted {
    /// Part of the variance of thickness that height explains.
    pub explained: f64,
    /// Standard deviation over the standard deviation of the blown film.
    pub kept: f64,
    /// Fringes between bottom and top, 2nΔh / 550 nm.
    pub fringes: f64,
    /// Part of the variance in waves of two cells: what sand would be.
    pub sand: f64,
    /// Departure of the mean thickness, as a part of it.
    pub drift: f64,
    /// Remaps of the map since the start.
    pub remaps: u32,
    /// Process time of a step since the start, ms.
    pub cpu_ms_per_step: f64,
}

const RADIUS_M: f64 = 0.05;
/// The longest time between two remaps, s.
const LATEST_REMAP_S: f64 = 2.0;

impl Sorting {
    /// A viscous film as laboratories have them, drawn with the cells of scenes.
    pub const LABORATORY: Self = Self {
        cells: 256,
        map_coarsening: 2,
        flow_cells: 64,
        cycles: Cycles { poisson: POISSON_CYCLES, viscous: VISCOUS_CYCLES },
        seed: 1,
        viscosity_m2_s: 3e-4,
        diffusion_m2_s: 1e-6,
        drag: 2.0,
        dt_s: 1.0 / 60.0,
    };

    /// Thickness in nm, in the order of the grid, after some steps; and process time of a step, ms.
    pub fn thickness(&self, gpu: &Gpu, steps: u32) -> Result<(Vec<f64>, f64), GpuError> {
        let mut film = self.film(gpu)?;
        gpu.wait()?;
        let cpu = ProcessTime::now();
        film.run(steps, self.dt_s)?;
        let cpu_ms = cpu.elapsed().as_secs_f64() * 1e3;
        Ok((film.thickness()?, cpu_ms / f64::from(steps.max(1))))
    }

    /// Lets it sort itself, and looks at it at these times in seconds.
    pub fn measure(&self, gpu: &Gpu, times_s: &[f64]) -> Result<Vec<Sorted>, GpuError> {
        let mut film = self.film(gpu)?;
        let blown = film.thickness()?;
        let (cpu, mut steps, mut found) = (ProcessTime::now(), 0, Vec::new());
        for time_s in times_s {
            let end = (time_s / self.dt_s).round() as u32;
            film.run(end - steps, self.dt_s)?;
            steps = end;
            let cpu_ms_per_step = cpu.elapsed().as_secs_f64() * 1e3 / f64::from(steps.max(1));
            let control: ControlBlock = bytemuck::pod_read_unaligned(&film.field.read_control(gpu).wait(gpu)?);
            let now = film.thickness()?;
            found.push(Sorted { remaps: control.remaps, cpu_ms_per_step, ..compared(film.sphere(), &blown, &now) });
        }
        Ok(found)
    }

    /// As blown.
    fn film<'a>(&self, gpu: &'a Gpu) -> Result<FreeFilm<'a>, GpuError> {
        let film = InitialFilm::Blown { thickness_nm: 700.0, stratification: 0.0, seed: self.seed };
        let remap = RemapRule { latest_ticks: (LATEST_REMAP_S / self.dt_s).round() as u32, ..RULES.remap };
        let rules = Rules { remap, map_coarsening: self.map_coarsening, flow_cells: self.flow_cells, ..RULES };
        let mut field = field(gpu, self.cells, rules, film.profile())?;
        field.diffuse(gpu, self.diffusion_m2_s / RADIUS_M.powi(2), self.dt_s);
        let forces = FlowForces {
            gravity: DVec3::NEG_Z * 9.81 / RADIUS_M,
            drag: self.drag,
            air_drag: 0.0,
            viscosity: self.viscosity_m2_s / RADIUS_M.powi(2),
        };
        let mut film = FreeFilm::new(gpu, field, forces, PrescribedFlow::default())?;
        film.motion.solve_in(self.cycles);
        Ok(film)
    }
}

fn compared(sphere: CubedSphere, blown: &[f64], now: &[f64]) -> Sorted {
    const BANDS: usize = 64;
    let mut bands = [(0.0, 0.0); BANDS];
    for (cell, (value, area)) in now.iter().zip(sphere.areas()).enumerate() {
        let height = 0.5 * (1.0 + sphere.cell_direction(cell).z);
        let band = &mut bands[((height * BANDS as f64) as usize).min(BANDS - 1)];
        *band = (band.0 + area, band.1 + area * value);
    }
    let (mean, spread) = moments(sphere, now);
    let (blown_mean, blown_spread) = moments(sphere, blown);
    let level = |(area, sum): &(f64, f64)| sum / area;
    let between: f64 = bands.iter().map(|band| band.0 * (level(band) - mean).powi(2)).sum::<f64>();
    Sorted {
        explained: between / (4.0 * std::f64::consts::PI) / spread.powi(2),
        kept: spread / blown_spread,
        fringes: 2.0 * 1.333 * (level(&bands[0]) - level(&bands[BANDS - 1])) / 550.0,
        sand: sand(sphere, now) / spread.powi(2),
        drift: (mean / blown_mean - 1.0).abs(),
        ..Sorted::default()
    }
}

/// Mean and standard deviation over the sphere.
fn moments(sphere: CubedSphere, values: &[f64]) -> (f64, f64) {
    let mean_of = |of: &dyn Fn(f64) -> f64| {
        values.iter().zip(sphere.areas()).map(|(value, area)| area * of(*value)).sum::<f64>()
            / (4.0 * std::f64::consts::PI)
    };
    let mean = mean_of(&|value| value);
    (mean, mean_of(&|value| (value - mean).powi(2)).sqrt())
}

/// Mean square of the waves of two cells along rows: a quarter of the second difference.
fn sand(sphere: CubedSphere, values: &[f64]) -> f64 {
    let rows = values.chunks(sphere.n());
    let squares: Vec<f64> =
        rows.flat_map(|row| row.windows(3).map(|w| (0.25 * (w[0] - 2.0 * w[1] + w[2])).powi(2))).collect();
    squares.iter().sum::<f64>() / squares.len() as f64
}

/// With the parameters of laboratory films.
pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    for (name, viscosity_m2_s) in [("5e-5", 5e-5), ("3e-4", 3e-4)] {
        let name = format!("a blown film of viscosity {name} m²/s after 2 s");
        let found = Sorting { viscosity_m2_s, ..Sorting::LABORATORY }.measure(run.gpu, &[2.0])?[0];
        run.at_most(format!("{name}: variance that height does not explain"), 1.0 - found.explained, 0.1);
        run.at_most(format!("{name}: 2.5 fringes over those between top and bottom"), 2.5 / found.fringes, 1.0);
        run.at_most(format!("{name}: standard deviation that is lost"), 1.0 - found.kept, 0.4);
        run.at_most(format!("{name}: variance in waves of two cells"), found.sand, 1e-4);
        run.at_most(format!("{name}: drift of the mean"), found.drift, 1e-7);
    }
    Ok(())
}
