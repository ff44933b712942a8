//! The lookup table, through the shader functions that pictures use, against the spectral sum in f64.

use glam::{DVec3, Vec3};
use rayon::prelude::*;
use soapfilm::{
    gpu::{
        Gpu,
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

use crate::support::{Random, gpu, mean_and_max};

/// One ray's cosine and its walls.
type Point = (f64, Walls);

/// Points as colour errors are measured: uniform on the projected disk with cos θ ≥ 0.05, thickness uniform.
fn points(count: usize, thickest_nm: f64, walls: u32) -> Vec<Point> {
    let mut random = Random(20_26);
    let mut point = || {
        let cos_theta = (0.0025 + 0.9975 * random.next()).sqrt();
        let [front_nm, back_nm, exit_nm] = [(); 3].map(|()| thickest_nm * random.next());
        let one = Walls::One { thickness_nm: front_nm };
        (cos_theta, if walls == 1 { one } else { Walls::Two { front_nm, back_nm, exit_nm } })
    };
    (0..count).map(|_| point()).collect()
}

/// XYZ of some points through the table.
fn through_table(gpu: &Gpu, index: FilmIndex, points: &[Point], thickest_nm: f64) -> Vec<DVec3> {
    let key = TableKey::full(index, Illuminant::default().into(), thickest_nm);
    let table = Table::new(gpu, &key);
    let mut recorder = Recorder::new(gpu);
    for first in (0..key.rows).step_by(512) {
        table.bake(&mut recorder, &key, first..(first + 512).min(key.rows)).unwrap();
    }
    recorder.submit(&Default::default());
    let probes: Vec<ProbePoint> = points.iter().map(probe).collect();
    let chunks = probe_colours(gpu, &table, &probes).unwrap();
    let colours =
        chunks.into_iter().flat_map(|chunk| bytemuck::pod_collect_to_vec::<_, [f32; 4]>(&chunk.wait(gpu).unwrap()));
    colours.map(|[r, g, b, _]| BT2020.to_xyz() * Vec3::new(r, g, b).as_dvec3()).collect()
}

fn probe((cos_theta, walls): &Point) -> ProbePoint {
    let (walls, [front_nm, back_nm, exit_nm]) = match *walls {
        Walls::One { thickness_nm } => (1, [thickness_nm, 0.0, 0.0]),
        Walls::Two { front_nm, back_nm, exit_nm } => (2, [front_nm, back_nm, exit_nm]),
    };
    let [front_nm, back_nm, exit_nm] = [front_nm, back_nm, exit_nm].map(|nm| nm as f32);
    ProbePoint { cos_theta: *cos_theta as f32, front_nm, back_nm, exit_nm, walls }
}

/// CIEDE2000 at exposure M2 of each point, and the point.
fn errors(gpu: &Gpu, points: &[Point], thickest_nm: f64) -> Vec<(f64, Point)> {
    let index = FilmIndex::Water;
    let optics = FilmOptics::new(index, &Illuminant::default());
    let white = optics.weights().white();
    let measured = through_table(gpu, index, points, thickest_nm);
    let error = |((cos_theta, walls), xyz): (&Point, &DVec3)| {
        let delta = m2_delta_e(optics.xyz(*cos_theta, *walls), *xyz, index, *cos_theta, walls.count(), white);
        (delta, (*cos_theta, *walls))
    };
    points.par_iter().zip(&measured).map(error).collect()
}

/// Compares with limits on the maximum and the mean, and says where the worst point lies.
fn hold(name: &str, errors: &[(f64, Point)], max_limit: f64, mean_limit: f64) {
    let (mean, max) = mean_and_max(errors.iter().map(|(delta, _)| *delta));
    let worst = errors.iter().max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, point)| point);
    eprintln!("measured: {name}: {} points, max {max:.4}, mean {mean:.5}, worst at {worst:?}", errors.len());
    assert!(
        max <= max_limit && mean <= mean_limit,
        "{name}: max {max} (limit {max_limit}), mean {mean} (limit {mean_limit}), worst at {worst:?}"
    );
}

/// 0.05 is the floor of half floats, and filtering as precise as hardware's adds about as much: below what any eye sees.
#[test]
fn one_wall_to_1500_nm() {
    let Some(gpu) = gpu() else { return };
    hold("one wall, d <= 1500 nm", &errors(&gpu, &points(40_000, 1500.0, 1), 1500.0), 0.10, 0.013);
}

/// The table grows with the range, so that thick films are no worse off but for f32's phases: a fifth of what is just visible.
#[test]
fn one_wall_to_3000_nm() {
    let Some(gpu) = gpu() else { return };
    hold("one wall, d <= 3000 nm", &errors(&gpu, &points(20_000, 3000.0, 1), 3000.0), 0.2, 0.03);
}

/// Products of colours are not colours of products: what the composition of two walls in RGB costs. The limits are what such
/// tables (s and p apart, BT.2020) are known to cost, 0.93 in the mean over pairs of random films, and a quarter more.
#[test]
fn two_walls_cost_what_rgb_products_cost() {
    let Some(gpu) = gpu() else { return };
    let errors = errors(&gpu, &points(20_000, 1500.0, 2), 1500.0);
    hold("two walls, d <= 1500 nm", &errors, 15.0, 1.2);
}

/// A film of no thickness reflects nothing, exactly: the table's first row is a row of zeros at its texels' centres.
#[test]
fn black_film_is_black() {
    let Some(gpu) = gpu() else { return };
    let points: Vec<Point> = (1..=100).map(|k| (f64::from(k) * 0.01, Walls::One { thickness_nm: 0.0 })).collect();
    let (_, max) = mean_and_max(through_table(&gpu, FilmIndex::Water, &points, 0.0).iter().map(|xyz| xyz.length()));
    assert_eq!(max, 0.0);
}
