//! The schemes of transport, at several grids and steps: cosine bells in the non-divergent wind after eight periods.

use anyhow::Context;
use soapfilm::{
    gpu::{
        Gpu,
        timing::Recorder,
        transport_case::{Case, values},
    },
    physics::{
        sphere::CubedSphere,
        transport::{Quantity, Scheme, Tracer, TracerKind, Wind, WindKind},
    },
};

use crate::{
    plot::{Series, svg},
    report::Report,
    timed,
};

/// The error whose price is compared.
const TARGET_L2: f64 = 0.01;
/// Periods of the wind.
const PERIODS: u32 = 8;
/// Cells along a cube's edge, and steps a period for each such cell: Courant numbers near 40, 20, 10 and 5.
const CELLS: [usize; 3] = [30, 60, 120];
const STEPS_A_CELL: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

/// Makes every pipeline once, so that no row of the report pays for it.
pub fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    for scheme in Scheme::ALL {
        let case = case(scheme, 8, 10, 1)?;
        let mut field = case.seed(gpu)?;
        case.advance(gpu, &mut field)?;
        values(gpu, &mut field)?;
    }
    Ok(())
}

/// One row: what a run cost and how far it was from the truth.
struct Row {
    cells: usize,
    courant: f64,
    cpu_s: f64,
    l2: f64,
}

pub fn run(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["scheme", "cells", "steps", "courant", "cpu_s", "cpu_ms_step", "over_copy", "l2"];
    println!("\nschemes: {}", Scheme::ALL.map(|scheme| format!("{} = {}", scheme as u32, scheme.name())).join(", "));
    let mut report = Report::new("transport", &columns);
    let (mut series, mut prices) = (Vec::new(), Vec::new());
    for scheme in Scheme::ALL {
        let mut rows = Vec::new();
        for cells in CELLS.into_iter().take(if smoke { 1 } else { CELLS.len() }) {
            for steps_a_cell in STEPS_A_CELL.into_iter().take(if smoke { 1 } else { STEPS_A_CELL.len() }) {
                rows.push(measure(gpu, &mut report, scheme, cells, steps_a_cell)?);
            }
        }
        // Where the target is in reach of twice as many cells, its price is measured and not extrapolated.
        let finest = rows.iter().map(|row| row.l2).fold(f64::INFINITY, f64::min);
        if !smoke && finest > TARGET_L2 && finest < 4.0 * TARGET_L2 {
            rows.push(measure(gpu, &mut report, scheme, 2 * CELLS[CELLS.len() - 1], STEPS_A_CELL[0])?);
        }
        prices.push((scheme, price(&rows)));
        let points = rows.iter().map(|row| [row.cpu_s, row.l2]).collect();
        series.push(Series { name: scheme.name().to_owned(), points });
    }
    report.save()?;
    let path = format!("{}/error_time_transport.svg", env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(&path, svg(["CPU time of eight periods, s", "l2"], &series)).with_context(|| path.clone())?;
    println!("written to {path}\n\nCPU time to reach l2 = {TARGET_L2} after {PERIODS} periods:");
    for (scheme, price) in &prices {
        match price {
            Some((seconds, courant)) => {
                println!("{:>14}  {seconds:>10.1} s at Courant number {courant}", scheme.name())
            }
            None => println!("{:>14}  not measured: its order needs two grids", scheme.name()),
        }
    }
    Ok(())
}

fn measure(gpu: &Gpu, report: &mut Report, scheme: Scheme, cells: usize, steps_a_cell: f64) -> anyhow::Result<Row> {
    let steps = (steps_a_cell * cells as f64) as u32;
    let case = case(scheme, cells, steps, PERIODS)?;
    let mut field = case.seed(gpu)?;
    let ((), cpu_ms, _) = timed(|| case.advance(gpu, &mut field))?;
    let copies = u64::from(PERIODS * steps);
    let ((), copy_ms, _) = timed(|| {
        let mut recorder = Recorder::new(gpu);
        (0..copies).for_each(|_| field.copy_state(&mut recorder));
        recorder.submit(&Default::default());
        gpu.wait()
    })?;
    let l2 = case.measure(&values(gpu, &mut field)?).l2;
    let courant = 10.0 / steps_a_cell;
    let per_step = cpu_ms / copies as f64;
    report.row(&[
        f64::from(scheme as u32),
        cells as f64,
        f64::from(steps),
        courant,
        cpu_ms * 1e-3,
        per_step,
        cpu_ms / copy_ms,
        l2,
    ]);
    Ok(Row { cells, courant, cpu_s: cpu_ms * 1e-3, l2 })
}

/// CPU time to the target at the best Courant number: from the finest row of each, by the order that it shows against the row before, with
/// cells times steps as the price.
fn price(rows: &[Row]) -> Option<(f64, f64)> {
    let to_target = |fine: &Row| {
        let coarse = rows.iter().rfind(|row| row.courant == fine.courant && row.cells < fine.cells)?;
        let refinement = (fine.cells as f64 / coarse.cells as f64).ln();
        let order = (coarse.l2 / fine.l2).ln() / refinement;
        let growth = (fine.cpu_s / coarse.cpu_s).ln() / refinement;
        Some((fine.cpu_s * (fine.l2 / TARGET_L2).powf(growth / order), fine.courant))
    };
    let finest = rows.iter().map(|row| row.cells).max()?;
    rows.iter().filter(|row| row.cells == finest).filter_map(to_target).min_by(|a, b| a.0.total_cmp(&b.0))
}

fn case(scheme: Scheme, cells: usize, steps_a_period: u32, periods: u32) -> anyhow::Result<Case> {
    let wind = Wind::new(WindKind::NonDivergent, None)?;
    Ok(Case {
        grid: CubedSphere::new(cells)?,
        tracer: Tracer::new(TracerKind::CosineBells, wind.tracer_rotation()),
        wind,
        quantity: Quantity::Density,
        scheme,
        limiter: false,
        steps_a_period,
        steps: u64::from(steps_a_period * periods),
    })
}
