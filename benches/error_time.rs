//! Run time against error: lookup tables of several sizes, and the schemes of transport, as a table and as CSV files in `target/`.
//!
//! `cargo bench --bench error_time -- --smoke` runs the smallest case of each, to see that it works.

use std::time::Instant;

use cpu_time::ProcessTime;
use glam::Vec3;
use soapfilm::{
    gpu::{
        AdapterChoice, Gpu, GpuError,
        bake_table::Table,
        probe_colour::{ProbePoint, probe_colours},
        timing::Recorder,
        transport_case::{Case, values},
    },
    physics::{
        colour::{BT2020, FilmOptics, Illuminant, Walls, m2_delta_e},
        optics::FilmIndex,
        sphere::CubedSphere,
        transport::{Quantity, Scheme, Tracer, TracerKind, Wind, WindKind},
    },
    plan::TableKey,
};

fn main() -> anyhow::Result<()> {
    let smoke = std::env::args().any(|argument| argument == "--smoke");
    let gpu = pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env()))?;
    println!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
    warm_up(&gpu)?;
    tables(&gpu, smoke)?;
    transport(&gpu, smoke)
}

/// Makes every pipeline once, so that no row of the reports pays for it.
fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    let key = TableKey::full(FilmIndex::Water, Illuminant::default().into(), 0.0).coarser(1024);
    bake(gpu, &key)?;
    for scheme in [Scheme::Bicubic, Scheme::Map] {
        let case = transport_case(scheme, 8, 10)?;
        case.advance(gpu, &mut case.seed(gpu)?)?;
    }
    Ok(())
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

/// Cells along a cube's edge and steps a period.
const GRIDS: [(usize, u32); 6] = [(30, 30), (30, 60), (60, 60), (60, 120), (120, 120), (120, 240)];

fn transport(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["remap_every", "cells", "steps", "cpu_ms_per_step", "wall_ms_per_step", "l2"];
    let mut report = Report::new("transport", &columns);
    for scheme in [Scheme::Bicubic, Scheme::Map] {
        for (cells, steps) in GRIDS.into_iter().take(if smoke { 1 } else { GRIDS.len() }) {
            let case = transport_case(scheme, cells, steps)?;
            let mut field = case.seed(gpu)?;
            let ((), cpu_ms, wall_ms) = timed(|| case.advance(gpu, &mut field))?;
            let l2 = case.measure(&values(gpu, &mut field)?).l2;
            let steps = f64::from(steps);
            let interval = f64::from(u8::from(scheme.keeps_map()));
            report.row(&[interval, cells as f64, steps, cpu_ms / steps, wall_ms / steps, l2]);
        }
    }
    report.save()
}

/// Cosine bells in the non-divergent wind for one period.
fn transport_case(scheme: Scheme, cells: usize, steps: u32) -> anyhow::Result<Case> {
    let wind = Wind::new(WindKind::NonDivergent, None)?;
    let tracer = Tracer::new(TracerKind::CosineBells, wind.tracer_rotation());
    Ok(Case {
        grid: CubedSphere::new(cells)?,
        wind,
        tracer,
        quantity: Quantity::Density,
        scheme,
        limiter: false,
        steps_a_period: steps,
        steps: u64::from(steps),
    })
}

/// The result of some work, its process CPU time and its wall time in milliseconds.
fn timed<T>(work: impl FnOnce() -> Result<T, GpuError>) -> anyhow::Result<(T, f64, f64)> {
    let (cpu, wall) = (ProcessTime::try_now()?, Instant::now());
    let result = work()?;
    Ok((result, cpu.try_elapsed()?.as_secs_f64() * 1e3, wall.elapsed().as_secs_f64() * 1e3))
}

/// A table on the terminal and in a CSV file.
struct Report {
    name: &'static str,
    csv: String,
}

impl Report {
    fn new(name: &'static str, columns: &[&str]) -> Self {
        println!("\n{name}\n{}", columns.iter().map(|column| format!("{column:>16}")).collect::<String>());
        Self { name, csv: columns.join(",") + "\n" }
    }

    fn row(&mut self, numbers: &[f64]) {
        let shown =
            |number: &f64| if number.fract() == 0.0 { format!("{number:>16}") } else { format!("{number:>16.5}") };
        println!("{}", numbers.iter().map(shown).collect::<String>());
        self.csv += &(numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n");
    }

    fn save(&self) -> anyhow::Result<()> {
        let path = format!("{}/error_time_{}.csv", env!("CARGO_TARGET_TMPDIR"), self.name);
        std::fs::write(&path, &self.csv)?;
        println!("written to {path}");
        Ok(())
    }
}
