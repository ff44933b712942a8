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
/// Steps per period, and cells along a cube's edge, of which each scheme takes as many as it needs to pass the target: numbers that leave few
/// invocations of a workgroup idle, and that maps as coarse as below divide.
const STEPS: [u32; 4] = [4, 15, 30, 60];
const CELLS: [usize; 11] = [32, 36, 40, 48, 60, 72, 88, 120, 152, 184, 240];
/// Schemes whose error on this many cells exceeds this multiple of the target do not reach it.
const HOPELESS: (f64, usize) = (4.0, 120);
/// Runs shorter than this are repeated, milliseconds.
const SHORT_MS: f64 = 1000.0;

/// Makes every pipeline once, so that no row of the report pays for it.
pub fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    for runner in runners() {
        for map_coarsening in runner.map_coarsenings.iter().copied() {
            let case = case(runner, map_coarsening, CELLS[0], 10, 1)?;
            let mut field = case.seed(gpu)?;
            case.advance(gpu, &mut field)?;
            values(gpu, &mut field)?;
        }
    }
    Ok(())
}

/// A scheme as it is run.
#[derive(Clone, Copy)]
struct Runner {
    name: &'static str,
    scheme: Scheme,
    /// The scheme whose traces its steps are made of.
    traced_as: Scheme,
    /// Cells that a cell of its map spans along each side, in turn.
    map_coarsenings: &'static [u32],
}

/// All schemes as the program runs them, and `bicubic` with long steps, traced like the steps of maps.
fn runners() -> impl Iterator<Item = Runner> {
    let own = Scheme::ALL.map(|scheme| Runner {
        name: scheme.name(),
        scheme,
        traced_as: scheme,
        map_coarsenings: match scheme {
            Scheme::Map => &[1, 2, 4],
            Scheme::MapAccurate => &[1, 2],
            _ => &[1],
        },
    });
    let traced =
        Runner { name: "bicubic, traced", scheme: Scheme::Bicubic, traced_as: Scheme::Map, map_coarsenings: &[1] };
    own.into_iter().chain([traced])
}

/// One row: what a run cost and how far it was from the truth.
#[derive(Clone, Copy)]
struct Row {
    map_coarsening: u32,
    cells: usize,
    steps: u32,
    cpu_s: f64,
    l2: f64,
}

/// CPU time to the target, the Courant number, and cells that a cell of the map spans.
#[derive(Clone, Copy)]
struct Price {
    seconds: f64,
    courant: f64,
    map_coarsening: u32,
}

pub fn run(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns =
        ["scheme", "map_coarsening", "cells", "steps", "traces", "courant", "cpu_s", "cpu_ms_step", "over_copy", "l2"];
    let names = runners().enumerate().map(|(index, runner)| format!("{index} = {}", runner.name));
    println!("\nschemes: {}", names.collect::<Vec<_>>().join("; "));
    let mut report = Report::new("transport", &columns);
    let (mut series, mut prices) = (Vec::new(), Vec::new());
    for (index, runner) in runners().enumerate() {
        let mut points = Vec::new();
        let mut best: Option<Price> = None;
        for map_coarsening in runner.map_coarsenings.iter().copied() {
            for steps in STEPS.into_iter().take(if smoke { 1 } else { STEPS.len() }) {
                let rows = sweep(gpu, &mut report, (index, runner), map_coarsening, steps, smoke)?;
                points.extend(rows.iter().map(|row| [row.cpu_s, row.l2]));
                best = best.into_iter().chain(price(&rows)).min_by(|a, b| a.seconds.total_cmp(&b.seconds));
            }
        }
        prices.push((runner.name, best));
        series.push(Series { name: runner.name.to_owned(), points });
    }
    report.save()?;
    let path = format!("{}/error_time_transport.svg", env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(&path, svg(["CPU time of eight periods, s", "l2"], &series)).with_context(|| path.clone())?;
    println!("written to {path}\n\nCPU time to reach l2 = {TARGET_L2} after {PERIODS} periods:");
    let bicubic = prices.iter().find(|(name, _)| *name == Scheme::Bicubic.name()).and_then(|(_, price)| *price);
    for (name, price) in &prices {
        match price {
            Some(Price { seconds, courant, map_coarsening }) => {
                let gain = bicubic.map_or(f64::NAN, |bicubic| bicubic.seconds / seconds);
                println!(
                    "{name:>16}  {seconds:>8.3} s, bicubic's divided by {gain:.1}, at Courant number {courant:.0} and a map \
                     {map_coarsening} times as coarse"
                );
            }
            None => println!("{name:>16}  not reached"),
        }
    }
    Ok(())
}

/// Ever more cells at a number of steps per period, until the target is passed or out of reach: because the error of the trace, that no grid makes
/// smaller, is what is left, or because the grid would be too fine.
fn sweep(
    gpu: &Gpu,
    report: &mut Report,
    (index, runner): (usize, Runner),
    map_coarsening: u32,
    steps: u32,
    smoke: bool,
) -> anyhow::Result<Vec<Row>> {
    let mut rows: Vec<Row> = Vec::new();
    for cells in CELLS.into_iter().take(if smoke { 1 } else { CELLS.len() }) {
        let row = measure(gpu, report, index, &case(runner, map_coarsening, cells, steps, PERIODS)?)?;
        let coarser = rows.iter().rev().find(|before| 4 * before.cells <= 3 * cells);
        let stalls = coarser.is_some_and(|before| row.l2 > 0.9 * before.l2);
        rows.push(row);
        let (factor, enough) = HOPELESS;
        if row.l2 <= TARGET_L2 || stalls || (cells >= enough && row.l2 > factor * TARGET_L2) {
            break;
        }
    }
    Ok(rows)
}

fn measure(gpu: &Gpu, report: &mut Report, index: usize, case: &Case) -> anyhow::Result<Row> {
    let mut field = case.seed(gpu)?;
    let (mut cpu_ms, mut runs) = (0.0, 0);
    while runs == 0 || (runs < 8 && cpu_ms < SHORT_MS) {
        field = case.seed(gpu)?;
        gpu.wait()?;
        cpu_ms += timed(|| case.advance(gpu, &mut field))?.1;
        runs += 1;
    }
    cpu_ms /= f64::from(runs);
    let Case { map_coarsening, steps_per_period: steps, .. } = *case;
    let cells = case.grid.n();
    let ((), copy_ms, _) = timed(|| {
        let mut recorder = Recorder::new(gpu);
        field.copy_state(&mut recorder, case.steps);
        recorder.submit(&Default::default());
        gpu.wait()
    })?;
    let l2 = case.measure(&values(gpu, &mut field)?).l2;
    let row = Row { map_coarsening, cells, steps, cpu_s: cpu_ms * 1e-3, l2 };
    report.row(&[
        index as f64,
        f64::from(map_coarsening),
        cells as f64,
        f64::from(steps),
        f64::from(case.traces_per_step),
        courant(cells as f64, steps),
        row.cpu_s,
        cpu_ms / case.steps as f64,
        cpu_ms / copy_ms,
        row.l2,
    ]);
    Ok(row)
}

/// Cells that the fastest wind crosses in a step, nearly.
fn courant(cells: f64, steps: u32) -> f64 {
    10.0 * cells / f64::from(steps)
}

/// The cost of the target at a number of steps per period: between the two grids around it, by the orders that they show.
fn price(rows: &[Row]) -> Option<Price> {
    let around = rows.windows(2).find(|pair| pair[0].l2 > TARGET_L2 && pair[1].l2 <= TARGET_L2)?;
    let part = (around[0].l2 / TARGET_L2).ln() / (around[0].l2 / around[1].l2).ln();
    let between = |a: f64, b: f64| a * (b / a).powf(part);
    let cells = between(around[0].cells as f64, around[1].cells as f64);
    Some(Price {
        seconds: between(around[0].cpu_s, around[1].cpu_s),
        courant: courant(cells, around[0].steps),
        map_coarsening: around[0].map_coarsening,
    })
}

fn case(
    runner: Runner,
    map_coarsening: u32,
    cells: usize,
    steps_per_period: u32,
    periods: u32,
) -> anyhow::Result<Case> {
    let wind = Wind::new(WindKind::NonDivergent, None)?;
    Ok(Case {
        grid: CubedSphere::new(cells)?,
        tracer: Tracer::new(TracerKind::CosineBells, wind.tracer_rotation()),
        wind,
        quantity: Quantity::Density,
        scheme: runner.scheme,
        map_coarsening,
        limiter: false,
        steps_per_period,
        steps: u64::from(steps_per_period * periods),
        traces_per_step: Case::traces_per_step(runner.traced_as, steps_per_period),
    })
}
