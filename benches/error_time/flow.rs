//! The flow solver: a flow with a known answer, and a blown film that gravity sorts, at several grids, steps and numbers of cycles.

use anyhow::Context;
use glam::DVec3;
use soapfilm::{
    gpu::{Gpu, flow::Cycles, flow_case::FlowRun},
    physics::{
        flow::{FlowCase, FlowCaseKind, Mode},
        sphere::CubedSphere,
    },
    verify::sorting::Sorting,
};

use crate::{
    plot::{Series, svg},
    report::Report,
};

/// Cycles of the stream function and of each viscous solve: fewer and more than the program's own.
const CYCLES: [Cycles; 5] = [cycles(1, 1), cycles(2, 1), cycles(3, 1), cycles(2, 2), cycles(4, 2)];
/// Cells along a panel's edge of the flow.
const CELLS: [u32; 4] = [16, 32, 64, 128];
/// Steps of the exact flow for each of these cells.
const STEPS_PER_CELL: [f64; 2] = [0.625, 1.25];
/// When a blown film is compared with a finer one: later on, small differences have grown.
const FRESH_S: f64 = 0.1;
/// When it has sorted itself.
const SORTED_S: f64 = 2.0;
/// Steps of the film a second.
const STEPS_PER_SECOND: [u32; 3] = [30, 60, 120];

const fn cycles(poisson: usize, viscous: usize) -> Cycles {
    Cycles { poisson, viscous }
}

pub fn run(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    exact(gpu, smoke)?;
    sorting(gpu, smoke)
}

/// A Rossby-Haurwitz wave over one wavelength.
fn exact(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let case = FlowCase::new(FlowCaseKind::RossbyHaurwitz, DVec3::ONE.normalize(), Mode::new(1, 1, 0)?, 1.0, 1.0)?;
    let mut report = Report::new("flow_exact", &["cells", "steps", "cycles", "cpu_ms_step", "cpu_s", "l2"]);
    let measure = |cells: u32, steps_per_cell: f64, poisson: usize, report: &mut Report| {
        let steps = (steps_per_cell * f64::from(cells)).round() as u32;
        let cycles = Cycles { poisson, ..Cycles::default() };
        let found = FlowRun { case, cells, steps_per_span: steps, spans: 1, cycles }.measure(gpu)?;
        let cpu_s = found.cpu.as_secs_f64();
        report.row(&[cells.into(), steps.into(), poisson as f64, cpu_s * 1e3, cpu_s * f64::from(steps), found.l2]);
        anyhow::Ok([cpu_s * f64::from(steps), found.l2])
    };
    // Makes every pipeline, so that no row pays for it.
    FlowRun { case, cells: 16, steps_per_span: 8, spans: 1, cycles: Cycles::default() }.measure(gpu)?;
    let mut all = Vec::new();
    for poisson in if smoke { 2..3 } else { 1..5 } {
        let mut points = Vec::new();
        for cells in CELLS.into_iter().take(if smoke { 1 } else { CELLS.len() }) {
            for steps_per_cell in STEPS_PER_CELL.into_iter().take(if smoke { 1 } else { STEPS_PER_CELL.len() }) {
                points.push(measure(cells, steps_per_cell, poisson, &mut report)?);
            }
        }
        all.push(Series { name: format!("{poisson} cycles"), points });
    }
    report.save()?;
    draw("flow_exact", ["CPU time of a wavelength, s", "l2 of vorticity"], &all)
}

/// The film of the preset `tent`: soon after it was blown, where it still is what the same film with a finer flow is, and sorted.
fn sorting(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let cells = if smoke { 32 } else { 256 };
    let film = Sorting { viscosity_m2_s: 1e-4, diffusion_m2_s: 5e-7, cells, ..Sorting::LABORATORY };
    let columns = [
        "flow_cells",
        "steps_a_second",
        "poisson",
        "viscous",
        "cpu_ms_step",
        "cpu_s",
        "rms_nm",
        "explained",
        "kept",
        "fringes",
    ];
    let mut report = Report::new("flow_sorting", &columns);
    let grids = CELLS.map(|flow_cells| Sorting { flow_cells, ..film });
    let steps = STEPS_PER_SECOND.map(|steps| Sorting { dt_s: 1.0 / f64::from(steps), ..film });
    let counts = CYCLES.map(|cycles| Sorting { cycles, ..film });
    let mut all = Vec::new();
    for (name, films, finest) in [
        ("flow cells", &grids[..], Sorting { flow_cells: 256, ..film }),
        ("steps", &steps[..], Sorting { dt_s: 1.0 / 480.0, ..film }),
        ("cycles", &counts[..], Sorting { cycles: cycles(6, 3), ..film }),
    ] {
        let truth = fresh(gpu, &finest)?;
        let measured =
            films.iter().take(if smoke { 1 } else { films.len() }).map(|film| measure(gpu, &mut report, film, &truth));
        all.push(Series { name: name.to_owned(), points: measured.collect::<Result<_, _>>()? });
    }
    report.save()?;
    draw("flow_sorting", ["CPU time of a second of film, s", "rms error of thickness, nm"], &all)
}

/// Thickness after [`FRESH_S`].
fn fresh(gpu: &Gpu, film: &Sorting) -> anyhow::Result<Vec<f64>> {
    Ok(film.thickness(gpu, (FRESH_S / film.dt_s).round() as u32)?.0)
}

fn measure(gpu: &Gpu, report: &mut Report, film: &Sorting, truth: &[f64]) -> anyhow::Result<[f64; 2]> {
    let areas = CubedSphere::new(film.cells)?.areas();
    let found = fresh(gpu, film)?;
    let squares = found.iter().zip(truth).zip(areas).map(|((a, b), area)| area * (a - b).powi(2));
    let rms_nm = (squares.sum::<f64>() / (4.0 * std::f64::consts::PI)).sqrt();
    let sorted = film.measure(gpu, &[SORTED_S])?[0];
    let (Cycles { poisson, viscous }, steps) = (film.cycles, (1.0 / film.dt_s).round());
    let cpu_s = sorted.cpu_ms_per_step * steps * 1e-3;
    report.row(&[
        film.flow_cells.into(),
        steps,
        poisson as f64,
        viscous as f64,
        sorted.cpu_ms_per_step,
        cpu_s,
        rms_nm,
        sorted.explained,
        sorted.kept,
        sorted.fringes,
    ]);
    Ok([cpu_s, rms_nm])
}

fn draw(name: &str, labels: [&str; 2], series: &[Series]) -> anyhow::Result<()> {
    let path = format!("{}/error_time_{name}.svg", env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(&path, svg(labels, series)).with_context(|| path.clone())?;
    println!("written to {path}");
    Ok(())
}
