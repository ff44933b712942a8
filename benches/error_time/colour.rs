//! Colours: lookup tables of several sizes, numbers of wavelengths, and the qualities of pictures.

use anyhow::Context;
use glam::DVec3;
use soapfilm::{
    gpu::{
        Gpu, GpuError, Renderer,
        passes::bake_table::Table,
        passes::probe_colour::{ColourProbe, ProbePoint},
        quadrature::Quadrature,
    },
    input::load_scene,
    physics::{
        colour::{BT2020, Gamut, Illuminant, QuadratureTask, Walls, m2_delta_e, seen_light},
        optics::FilmMaterial,
    },
    plan::{Moment, OpticsKey, Pace, QuadratureKey, Rendering, Shot, TableKey, request},
    scene::Quality,
};

use crate::{
    plot::{Series, svg},
    report::Report,
    timed,
};

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
/// Numbers of wavelengths: beside a table, and alone.
const FRONT: [(QuadratureTask, &str, &[usize]); 2] = [
    (QuadratureTask::CrossTerms, "table and wavelengths", &[3, 4, 6, 9, 13, 18, 24, 36]),
    (QuadratureTask::Everything, "wavelengths alone", &[9, 13, 18, 24, 36, 48]),
];
/// Thickest film of the front, in nm.
const FRONT_NM: f64 = 1500.0;
/// Films whose colour errors are measured, and whose time is.
const FILMS: u32 = 20_000;
const TIMED_FILMS: u32 = 400_000;
/// Measurements of a time, of which the median counts.
const ROUNDS: usize = 5;

/// Makes the bake's pipeline once, so that no row of the reports pays for it.
pub fn warm_up(gpu: &Gpu) -> anyhow::Result<()> {
    bake(gpu, &TableKey::full(water(), TableKey::MIN_RANGE_NM).coarser(1024))?;
    Ok(())
}

fn water() -> OpticsKey {
    OpticsKey { film: FilmMaterial::default(), illuminant: Illuminant::default().into() }
}

/// One wall through tables of several sizes.
pub fn tables(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["columns", "rows", "max_nm", "bake_cpu_ms", "bake_wall_ms", "max_dE", "mean_dE"];
    let mut report = Report::new("tables", &columns);
    let mut series = Vec::new();
    for (columns, rows, max_nm) in TABLES.into_iter().take(if smoke { 1 } else { TABLES.len() }) {
        let key = TableKey { columns, rows, ..TableKey::full(water(), max_nm) };
        let (table, cpu_ms, wall_ms) = timed(|| bake(gpu, &key))?;
        let quadrature =
            QuadratureKey::new(water(), max_nm, Quality::Standard, &seen_light(&Illuminant::default()), true);
        let points = points(if smoke { 500 } else { FILMS }, max_nm, false);
        let probe = ColourProbe::with_table(table, Quadrature::fit(gpu, &quadrature));
        let [worst, mean] = colour_error(&points, &probe.measure(gpu, &probes(&points))?);
        report.row(&[f64::from(columns), f64::from(rows), max_nm, cpu_ms, wall_ms, worst, mean]);
        series.push(Series { name: format!("{columns}x{rows}, {max_nm} nm"), points: vec![[cpu_ms, worst]] });
    }
    report.save()?;
    save_plot("tables", ["CPU time of the bake, ms", "one wall, largest dE2000"], &series)
}

/// Two walls by several numbers of wavelengths: which of them a quality should have.
pub fn front(gpu: &Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["everything", "bands", "ns_per_point", "max_dE", "mean_dE"];
    let mut report = Report::new("front", &columns);
    let mut series = Vec::new();
    for (task, name, counts) in FRONT {
        let mut places = Vec::new();
        for count in counts.iter().copied().take(if smoke { 1 } else { counts.len() }) {
            let table = match task {
                QuadratureTask::CrossTerms => Table::baked(gpu, &TableKey::full(water(), FRONT_NM))?,
                QuadratureTask::Everything => Table::unread(gpu, &water()),
            };
            let quadrature = Quadrature::of_count(gpu, &water(), task, count, FRONT_NM);
            let probe = ColourProbe::with_table(table, quadrature);
            let points = points(if smoke { 500 } else { FILMS }, FRONT_NM, true);
            let [worst, mean] = colour_error(&points, &probe.measure(gpu, &probes(&points))?);
            let ns = nanoseconds_per_point(gpu, &probe, if smoke { 500 } else { TIMED_FILMS })?;
            report.row(&[f64::from(u8::from(task == QuadratureTask::Everything)), count as f64, ns, worst, mean]);
            places.push(Place { count, ns, errors: [worst, mean] });
        }
        for (k, error) in ["largest", "mean"].into_iter().enumerate() {
            if let Some(count) = knee(&places, |place| place.errors[k]) {
                println!("{name}: the knee of the {error} error is at {count} wavelengths");
            }
        }
        let points = places.iter().map(|place| [place.ns, place.errors[1]]).collect();
        series.push(Series { name: name.to_owned(), points });
    }
    report.save()?;
    save_plot("front", ["CPU time of a point, ns", "two walls, mean dE2000"], &series)
}

/// Cost of a number of wavelengths per point, in nanoseconds, and its largest and mean error.
struct Place {
    count: usize,
    ns: f64,
    errors: [f64; 2],
}

/// Where a front bends most: farthest below the straight line between its ends, both axes as logarithms. `None` for fewer than three.
fn knee(front: &[Place], error: impl Fn(&Place) -> f64) -> Option<usize> {
    let (first, last) = (front.first()?, front.last()?);
    let slope = (error(last) / error(first)).ln() / (last.ns / first.ns).ln();
    let below = |place: &Place| slope * (place.ns / first.ns).ln() - (error(place) / error(first)).ln();
    let inner = front.get(1..front.len() - 1)?;
    inner.iter().max_by(|a, b| below(a).total_cmp(&below(b))).map(|place| place.count)
}

/// Two walls at each quality: wavelengths, milliseconds to fit them, and nanoseconds per point; and the cost of a frame of the preset `tent` beside
/// a plain mirror sphere.
pub fn qualities(gpu: Gpu, smoke: bool) -> anyhow::Result<()> {
    let columns = ["bands", "max_nm", "fit_cpu_ms", "ns_per_point", "max_dE", "mean_dE", "over_mirror"];
    let mut report = Report::new("qualities", &columns);
    let mut renderer = Renderer::new(gpu);
    let mut series = Vec::new();
    for quality in Quality::ALL {
        let mut places = Vec::new();
        for max_nm in [1500.0, 3000.0].into_iter().take(if smoke { 1 } else { 2 }) {
            let points = points(if smoke { 500 } else { FILMS }, max_nm, true);
            let (probe, cpu_ms, _) = timed(|| ColourProbe::new(&renderer.gpu, &water(), quality, max_nm))?;
            let [worst, mean] = colour_error(&points, &probe.measure(&renderer.gpu, &probes(&points))?);
            let ns = nanoseconds_per_point(&renderer.gpu, &probe, if smoke { 500 } else { TIMED_FILMS })?;
            let quadrature =
                QuadratureKey::new(water(), max_nm, quality, &seen_light(&Illuminant::default()), true).count() as f64;
            let ratio = frame_over_mirror(&mut renderer, quality, if smoke { 1 } else { 9 })?;
            report.row(&[quadrature, max_nm, cpu_ms, ns, worst, mean, ratio]);
            places.push([ratio, mean]);
        }
        series.push(Series { name: quality.name().to_owned(), points: places });
    }
    report.save()?;
    save_plot("qualities", ["CPU time of a frame over a plain mirror's", "two walls, mean dE2000"], &series)
}

fn save_plot(name: &str, labels: [&str; 2], series: &[Series]) -> anyhow::Result<()> {
    let path = format!("{}/error_time_{name}.svg", env!("CARGO_TARGET_TMPDIR"));
    std::fs::write(&path, svg(labels, series)).with_context(|| path.clone())?;
    println!("written to {path}");
    Ok(())
}

/// Process CPU time of a point: the median over some rounds, sending and reading back included.
fn nanoseconds_per_point(gpu: &Gpu, probe: &ColourProbe, count: u32) -> anyhow::Result<f64> {
    let points = probes(&points(count, FRONT_NM, true));
    let round = |_| Ok(timed(|| probe.measure(gpu, &points))?.1);
    let times = (0..=ROUNDS).map(round).collect::<anyhow::Result<Vec<f64>>>()?;
    // The first round makes the pipeline.
    Ok(1e6 * median(times[1..].to_vec()) / f64::from(count))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Ratio of the process CPU time of a frame to the time of a frame with a plain mirror sphere: medians over frames that alternate.
fn frame_over_mirror(renderer: &mut Renderer, quality: Quality, frames: usize) -> anyhow::Result<f64> {
    let mut loaded = load_scene("tent")?;
    loaded.scene.view.quality = quality;
    let shot = Shot {
        size: if frames > 1 { [1280, 720] } else { [64, 36] },
        moment: Moment::default(),
        full_precision: false,
        gamut: Gamut::Srgb,
        pace: Pace::Whole,
    };
    let bubble = request(&loaded.scene, &loaded.resources, &shot)?;
    let mut mirror = bubble.clone();
    mirror.picture.draw.rendering = Rendering::Yardstick;
    let mut times = [Vec::new(), Vec::new()];
    for round in 0..frames + 2 {
        for (request, times) in [&bubble, &mirror].into_iter().zip(&mut times) {
            renderer.forget_picture();
            let ((), cpu_ms, _) = timed(|| renderer.render(request).and_then(|_| renderer.gpu.wait()))?;
            // The first rounds bake and compile.
            if round >= 2 {
                times.push(cpu_ms);
            }
        }
    }
    let [bubble, mirror] = times.map(median);
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
