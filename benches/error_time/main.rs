//! Run time against error: lookup tables of several sizes, and the schemes of transport, as tables, and as CSV files and plots in
//! `target/`.
//!
//! `cargo bench --bench error_time -- --smoke` runs the smallest case of each, to see that it works.

mod plot;
mod report;
mod transport;

use std::time::Instant;

use cpu_time::ProcessTime;
use glam::Vec3;
use report::Report;
use soapfilm::{
    gpu::{
        AdapterChoice, Gpu, GpuError,
        bake_table::Table,
        probe_colour::{ProbePoint, probe_colours},
        timing::Recorder,
    },
    physics::{
        colour::{BT2020, FilmOptics, Illuminant, Walls, m2_delta_e},
        optics::FilmIndex,
    },
    plan::TableKey,
};

fn main() -> anyhow::Result<()> {
    let smoke = std::env::args().any(|argument| argument == "--smoke");
    let gpu = pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env()))?;
    println!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
    warm_up(&gpu)?;
    tables(&gpu, smoke)?;
    transport::run(&gpu, smoke)
}

/// Makes every pipeline once, so that no row of the reports pays for it.
fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    let key = TableKey::full(FilmIndex::Water, Illuminant::default().into(), 0.0).coarser(1024);
    bake(gpu, &key)?;
    transport::warm_up(gpu)
}

/// Columns, rows and longest film of each table.
const TABLES: [(u32, u32, f64); 7] = [
    (32, 256, 1500.0),
    (32, 1024, 1500.0),
    (64, 512, 1500.0),
    (64, 1024, 1500.0),
    (64, 2048, 1500.0),
    (128, 2048, 1500.0),
    (64, 4096, 3000.0),
];

fn tables(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["columns", "rows", "max_nm", "bake_cpu_ms", "bake_wall_ms", "max_dE", "mean_dE"];
    let mut report = Report::new("tables", &columns);
    let optics = FilmOptics::new(FilmIndex::Water, &Illuminant::default());
    for (columns, rows, max_thickness_nm) in TABLES.into_iter().take(if smoke { 1 } else { TABLES.len() }) {
        let full = TableKey::full(FilmIndex::Water, Illuminant::default().into(), max_thickness_nm);
        let key = TableKey { columns, rows, ..full };
        let (table, cpu_ms, wall_ms) = timed(|| bake(gpu, &key))?;
        let [worst, mean] = colour_error(gpu, &table, &optics, max_thickness_nm, if smoke { 500 } else { 20_000 })?;
        report.row(&[f64::from(columns), f64::from(rows), max_thickness_nm, cpu_ms, wall_ms, worst, mean]);
    }
    report.save()
}

fn bake(gpu: &Gpu, key: &TableKey) -> Result<Table, GpuError> {
    let table = Table::new(gpu, key);
    let mut recorder = Recorder::new(gpu);
    table.bake(&mut recorder, key, 0..key.rows)?;
    recorder.submit(&Default::default());
    gpu.wait()?;
    Ok(table)
}

/// Largest and mean colour difference (CIEDE2000, exposed for each angle) from f64 over films that fill a rectangle evenly.
fn colour_error(gpu: &Gpu, table: &Table, optics: &FilmOptics, max_nm: f64, count: u32) -> anyhow::Result<[f64; 2]> {
    // The additive recurrence of the plastic number fills the rectangle evenly without a generator.
    let point = |k: u32| {
        let [u, v] =
            [0.754_877_666_246_692_7, 0.569_840_290_998_053_2].map(|step: f64| (0.5 + step * f64::from(k)).fract());
        let cos_theta = (0.0025 + 0.9975 * u).sqrt() as f32;
        ProbePoint { cos_theta, front_nm: (max_nm * v) as f32, back_nm: 0.0, exit_nm: 0.0, walls: 1 }
    };
    let points: Vec<ProbePoint> = (0..count).map(point).collect();
    let mut found: Vec<[f32; 4]> = Vec::new();
    for chunk in probe_colours(gpu, table, &points)? {
        found.extend(bytemuck::pod_collect_to_vec::<u8, [f32; 4]>(&chunk.wait(gpu)?));
    }
    let differences = points.iter().zip(&found).map(|(point, [r, g, b, _])| {
        let cos_theta = f64::from(point.cos_theta);
        let truth = optics.xyz(cos_theta, Walls::One { thickness_nm: f64::from(point.front_nm) });
        let xyz = BT2020.to_xyz() * Vec3::new(*r, *g, *b).as_dvec3();
        m2_delta_e(xyz, truth, optics.film(), cos_theta, 1, optics.weights().white())
    });
    let (worst, sum) = differences.fold((0.0, 0.0), |(worst, sum): (f64, f64), e| (worst.max(e), sum + e));
    Ok([worst, sum / f64::from(count)])
}

/// The result of some work, its process CPU time and its wall time in milliseconds.
fn timed<T>(work: impl FnOnce() -> Result<T, GpuError>) -> anyhow::Result<(T, f64, f64)> {
    let (cpu, wall) = (ProcessTime::try_now()?, Instant::now());
    let result = work()?;
    Ok((result, cpu.try_elapsed()?.as_secs_f64() * 1e3, wall.elapsed().as_secs_f64() * 1e3))
}
