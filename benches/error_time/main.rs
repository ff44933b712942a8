//! Run time against error: lookup tables of several sizes, the qualities, and the schemes of transport, as tables, and as CSV files and
//! plots in `target/`.
//!
//! `cargo bench --bench error_time -- --smoke` runs the smallest case of each, to see that it works.

mod plot;
mod report;
mod transport;

use std::time::Instant;

use cpu_time::ProcessTime;
use glam::DVec3;
use report::Report;
use soapfilm::{
    gpu::{
        AdapterChoice, Gpu, GpuError, Renderer,
        bake_table::Table,
        probe_colour::{ColourProbe, ProbePoint},
    },
    input::load_scene,
    physics::{
        colour::{BT2020, Gamut, Illuminant, Walls, m2_delta_e},
        optics::FilmMaterial,
    },
    plan::{BandsKey, Moment, OpticsKey, Pace, Shot, TableKey, want},
    scene::Quality,
};

fn main() -> anyhow::Result<()> {
    let smoke = std::env::args().any(|argument| argument == "--smoke");
    let gpu = pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env()))?;
    println!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
    warm_up(&gpu)?;
    tables(&gpu, smoke)?;
    transport::run(&gpu, smoke)?;
    qualities(gpu, smoke)
}

/// Makes every pipeline once, so that no row of the reports pays for it.
fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    bake(gpu, &TableKey::full(water(), TableKey::MIN_RANGE_NM).coarser(1024))?;
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

fn water() -> OpticsKey {
    OpticsKey { film: FilmMaterial::default(), illuminant: Illuminant::default().into() }
}

/// One wall through tables of several sizes.
fn tables(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["columns", "rows", "max_nm", "bake_cpu_ms", "bake_wall_ms", "max_dE", "mean_dE"];
    let mut report = Report::new("tables", &columns);
    for (columns, rows, max_nm) in TABLES.into_iter().take(if smoke { 1 } else { TABLES.len() }) {
        let key = TableKey { columns, rows, ..TableKey::full(water(), max_nm) };
        let (table, cpu_ms, wall_ms) = timed(|| bake(gpu, &key))?;
        let bands = BandsKey { optics: water(), range_nm: max_nm, quality: Quality::Standard };
        let points = points(if smoke { 500 } else { 20_000 }, max_nm, false);
        let probe = ColourProbe::with_table(gpu, table, bands);
        let [worst, mean] = colour_error(&points, &probe.measure(gpu, &probes(&points))?);
        report.row(&[f64::from(columns), f64::from(rows), max_nm, cpu_ms, wall_ms, worst, mean]);
    }
    report.save()
}

/// Two walls at each quality: bands, milliseconds to fit them, and nanoseconds a point; and what a frame of the default scene costs beside
/// a plain mirror sphere.
fn qualities(gpu: Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["bands", "max_nm", "fit_cpu_ms", "ns_per_point", "max_dE", "mean_dE", "frame_over_mirror"];
    let mut report = Report::new("qualities", &columns);
    let mut renderer = Renderer::new(gpu);
    for quality in Quality::ALL {
        for max_nm in [1500.0, 3000.0].into_iter().take(if smoke { 1 } else { 2 }) {
            let count = if smoke { 500 } else { 20_000 };
            let points = points(count, max_nm, true);
            let (probe, cpu_ms, _) = timed(|| ColourProbe::new(&renderer.gpu, &water(), quality, max_nm))?;
            probe.measure(&renderer.gpu, &probes(&points))?;
            let (seen, measure_ms, _) = timed(|| probe.measure(&renderer.gpu, &probes(&points)))?;
            let [worst, mean] = colour_error(&points, &seen);
            let bands = BandsKey { optics: water(), range_nm: max_nm, quality }.count() as f64;
            let ratio = frame_over_mirror(&mut renderer, quality, if smoke { 1 } else { 9 })?;
            report.row(&[bands, max_nm, cpu_ms, 1e6 * measure_ms / f64::from(count), worst, mean, ratio]);
        }
    }
    report.save()
}

/// Process CPU time of a frame over that of one with a plain mirror sphere: medians over frames that alternate.
fn frame_over_mirror(renderer: &mut Renderer, quality: Quality, frames: usize) -> anyhow::Result<f64> {
    let mut loaded = load_scene("default")?;
    loaded.scene.view.quality = quality;
    let shot = Shot {
        size: if frames > 1 { [1280, 720] } else { [64, 36] },
        moment: Moment::default(),
        full_precision: false,
        gamut: Gamut::Srgb,
        yardstick: false,
        pace: Pace::Whole,
    };
    let bubble = want(&loaded.scene, &loaded.resources, &shot)?;
    let mirror = want(&loaded.scene, &loaded.resources, &Shot { yardstick: true, ..shot })?;
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..frames + 2 {
        for (want, times) in [&bubble, &mirror].into_iter().zip(&mut times) {
            renderer.forget_picture();
            let ((), cpu_ms, _) = timed(|| renderer.bring(want).and_then(|_| renderer.gpu.wait()))?;
            // The first rounds bake and compile.
            if round >= 2 {
                times.push(cpu_ms);
            }
        }
    }
    let [bubble, mirror] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    Ok(bubble / mirror)
}

fn bake(gpu: &Gpu, key: &TableKey) -> Result<Table, GpuError> {
    let table = Table::baked(gpu, key)?;
    gpu.wait()?;
    Ok(table)
}

/// Films that fill a box evenly, without a generator: the additive recurrence of the generalised golden ratio.
fn points(count: u32, max_nm: f64, two_walls: bool) -> Vec<(f64, Walls)> {
    let part = |k: u32, step: f64| (0.5 + step * f64::from(k)).fract();
    let point = |k: u32| {
        let cos_theta = (0.0025 + 0.9975 * part(k, 0.856_674_883_854_502_9)).sqrt();
        let [front_nm, back_nm, exit_nm] = [0.733_891_856_627_126, 0.628_706_721_037_808_7, 0.538_597_257_223_610_1]
            .map(|step| max_nm * part(k, step));
        let one = Walls::One { thickness_nm: front_nm };
        (cos_theta, if two_walls { Walls::Two { front_nm, back_nm, exit_nm } } else { one })
    };
    (0..count).map(point).collect()
}

fn probes(points: &[(f64, Walls)]) -> Vec<ProbePoint> {
    points.iter().map(|(cos_theta, walls)| ProbePoint::new(*cos_theta, *walls)).collect()
}

/// Largest and mean colour difference (CIEDE2000, exposed for each angle) from f64, cos θ ≥ 0.26 for the largest of two walls.
fn colour_error(points: &[(f64, Walls)], seen: &[DVec3]) -> [f64; 2] {
    let optics = water().spectra();
    let (mut worst, mut sum) = (0.0_f64, 0.0);
    for ((cos_theta, walls), rgb) in points.iter().zip(seen) {
        let (truth, xyz) = (optics.xyz(*cos_theta, *walls), BT2020.to_xyz() * *rgb);
        let white = optics.weights().white();
        let error = m2_delta_e(xyz, truth, optics.film(), *cos_theta, walls.count(), white);
        sum += error;
        if walls.count() == 1 || *cos_theta >= 0.26 {
            worst = worst.max(error);
        }
    }
    [worst, sum / points.len() as f64]
}

/// The result of some work, its process CPU time and its wall time in milliseconds.
fn timed<T>(work: impl FnOnce() -> Result<T, GpuError>) -> anyhow::Result<(T, f64, f64)> {
    let (cpu, wall) = (ProcessTime::try_now()?, Instant::now());
    let result = work()?;
    Ok((result, cpu.try_elapsed()?.as_secs_f64() * 1e3, wall.elapsed().as_secs_f64() * 1e3))
}
