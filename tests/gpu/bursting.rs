//! Films that become black, and that burst.

use soapfilm::{
    gpu::{Renderer, passes::open_hole::RimValue},
    input::LoadedScene,
    physics::{
        film::Hole,
        sphere::{CubedSphere, HaloTable, PaddedField},
    },
    plan::{BLACK_FILM_NM, FrameRequest, OpenHoleKey, Pass, remaining_nm},
    scene::{Change, Event, FilmStateName, Prick},
};

use crate::support::{load, radiance, renderer, short_or_long, still};

const SIZE: [u32; 2] = [64, 36];
const CELLS: u32 = 64;

/// A film that is sorted and thin above.
fn thin(mean_nm: f64) -> LoadedScene {
    let mut loaded = load("tent");
    let film = &mut loaded.scene.bubbles[0].film;
    (film.state, film.thickness_nm, film.cells) = (FilmStateName::Rest, mean_nm, CELLS);
    loaded.scene.motion.black_film_life_s = 1e6;
    loaded
}

/// The thickness that a film shows, and its mean.
fn shown(renderer: &mut Renderer, request: &FrameRequest) -> (CubedSphere, Vec<f64>, f64) {
    renderer.render(request).unwrap();
    let evaporated_nm = request.picture.draw.bubbles[0].evaporated_nm;
    let (grid, thickness_nm) = renderer.read_film(0).unwrap().unwrap();
    let values: Vec<f32> = bytemuck::pod_collect_to_vec(&thickness_nm.wait(&renderer.gpu).unwrap());
    let values: Vec<f64> = values.into_iter().map(|nm| remaining_nm(nm.into(), evaporated_nm)).collect();
    let total: f64 = grid.areas().iter().zip(&values).map(|(area, nm)| area * nm).sum();
    (grid, values, total / (4.0 * std::f64::consts::PI))
}

/// Part of the sphere that is black.
fn black_part(grid: CubedSphere, values: &[f64]) -> f64 {
    let areas = grid.areas();
    let black = areas.iter().zip(values).filter(|(_, nm)| **nm < 20.0);
    black.map(|(area, _)| area).sum::<f64>() / areas.iter().sum::<f64>()
}

#[test]
fn a_collapse_to_black_film_loses_no_liquid() {
    let Some(mut renderer) = renderer() else { return };
    // 28 nm at the top, 114 nm at the bottom: the upper third is thin enough to collapse, and nothing evaporates.
    let mut loaded = thin(60.0);
    loaded.scene.bubbles[0].film.cells = short_or_long(32, CELLS);
    let (grid, before, mean_before) = shown(&mut renderer, &still(&loaded, SIZE, 0.0));
    assert_eq!(black_part(grid, &before), 0.0);
    let (_, after, mean_after) = shown(&mut renderer, &still(&loaded, SIZE, 3.0));
    let black = black_part(grid, &after);
    assert!((0.2..0.6).contains(&black), "{black}");
    assert!(after.iter().all(|nm| *nm > 0.9 * BLACK_FILM_NM && nm.is_finite()), "nothing falls below black film");
    // Corrections are f32: a few parts in ten million.
    assert!((mean_after / mean_before - 1.0).abs() < 1e-6, "{mean_before} {mean_after}");
}

/// Black film stands on top, the border to thicker film is level, and no more than 4 cells wide.
#[test]
fn black_film_ends_at_a_level_border_as_sharp_as_cells() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = thin(70.0);
    let cells = short_or_long(64, 256);
    (loaded.scene.bubbles[0].film.cells, loaded.scene.motion.strength) = (cells, 0.0);
    let (grid, values, _) = shown(&mut renderer, &still(&loaded, SIZE, 2.0));
    let heights = |is_part: &dyn Fn(f64) -> bool| {
        let cells = values.iter().enumerate().filter(|(_, nm)| is_part(**nm));
        cells
            .map(|(cell, _)| grid.cell_direction(cell).z)
            .fold((1.0_f64, -1.0_f64), |(low, high), z| (low.min(z), high.max(z)))
    };
    let ((lowest_black, _), (_, highest_thick)) = (heights(&|nm| nm < 30.0), heights(&|nm| nm >= 30.0));
    let border = 0.5 * (lowest_black + highest_thick);
    assert!((0.2..0.6).contains(&border), "a part of the film is black: {border}");
    let between = |nm: f64| (12.0..45.0).contains(&nm);
    let area: f64 = grid.areas().iter().zip(&values).filter(|(_, nm)| between(**nm)).map(|(area, _)| area).sum();
    let width_cells = area / (std::f64::consts::TAU * (1.0 - border * border).sqrt()) / grid.cell_angle();
    let uneven = highest_thick - lowest_black;
    eprintln!("measured: border at {border:.3}, uneven by {uneven:.3}, {width_cells:.2} cells wide");
    assert!(uneven < 0.03, "it is level: {lowest_black} {highest_thick}");
    assert!(width_cells < 4.0, "{width_cells}");
}

#[test]
fn black_film_grows_as_the_film_evaporates_and_then_evaporates_no_more() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = thin(150.0);
    loaded.scene.bubbles[0].film.cells = short_or_long(32, CELLS);
    let rate_nm_s = short_or_long(320.0, 40.0);
    loaded.scene.motion.evaporation_nm_s = rate_nm_s;
    let mut black = vec![0.0];
    for evaporated_nm in [40.0, 80.0, 120.0, 160.0, 360.0] {
        let (grid, values, mean) = shown(&mut renderer, &still(&loaded, SIZE, evaporated_nm / rate_nm_s));
        black.push(black_part(grid, &values));
        assert!(
            mean >= 150.0 - evaporated_nm - 1e-3,
            "no more than what evaporates is lost: {mean} at {evaporated_nm} nm"
        );
    }
    assert!(black.windows(2).all(|pair| pair[1] >= pair[0]), "{black:?}");
    let (_, values, _) = shown(&mut renderer, &still(&loaded, SIZE, 640.0 / rate_nm_s));
    let nm = values.iter().fold((f64::MAX, 0.0_f64), |(low, high), nm| (low.min(*nm), high.max(*nm)));
    assert!(nm.0 > 9.0 && nm.1 < 11.0, "black everywhere, and there it stays: {nm:?}");
}

fn pricked(at: [f64; 3]) -> LoadedScene {
    let mut loaded = thin(600.0);
    loaded.scene.events = vec![Event { tick: 20, change: Change::Prick(Prick { bubble: 0, at }) }];
    loaded.scene.motion.burst_slowdown = 100.0;
    loaded
}

/// Rim of the hole of a requested picture, on the device and in f64.
fn rims(renderer: &mut Renderer, request: &FrameRequest) -> (Vec<RimValue>, Hole) {
    let (grid, values, _) = shown(renderer, request);
    let bubble = &request.picture.draw.bubbles[0];
    let OpenHoleKey { radius_m, hole, .. } = bubble.open_hole().unwrap();
    let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| values[cell]);
    let buffer = renderer.read_hole(0).unwrap();
    let found = bytemuck::pod_collect_to_vec(&buffer.wait(&renderer.gpu).unwrap());
    (found, Hole::open(|x| field.bilinear(x), hole.at.unwrap(), hole.seconds, radius_m))
}

#[test]
fn a_hole_matches_its_f64_twin() {
    let Some(mut renderer) = renderer() else { return };
    let loaded = pricked([0.5, -0.3, 0.6]);
    for time_s in [0.4, 0.9, 1.6] {
        let request = still(&loaded, SIZE, time_s);
        let (found, truth) = rims(&mut renderer, &request);
        for (found, truth) in found.iter().zip(&truth.rim) {
            // Sums of 512 parts in f32, and bilinear lookups that differ by rounding.
            assert!((f64::from(found.outer_rad) - truth.outer_rad).abs() < 1e-4, "{found:?} {truth:?}");
            assert!((f64::from(found.inner_rad) - truth.inner_rad).abs() < 1e-4, "{found:?} {truth:?}");
            assert!((f64::from(found.thickness_nm) / truth.thickness_nm.max(1.0) - 1.0).abs() < 1e-2);
        }
    }
}

#[test]
fn a_burst_film_moves_no_more_and_then_is_gone() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = pricked([1.0, 0.2, 0.0]);
    loaded.scene.bubbles[0].film.state = FilmStateName::Blown;
    let first = still(&loaded, SIZE, 0.5);
    renderer.render(&first).unwrap();
    let later = renderer.render(&still(&loaded, SIZE, 0.8)).unwrap();
    let names: Vec<&str> = later.steps.iter().map(|(pass, _)| pass.name()).collect();
    assert_eq!(names, ["open_hole", "draw", "tonemap"]);
    let request = still(&loaded, SIZE, 3.5);
    assert!(request.picture.draw.bubbles.is_empty());
    let gone = radiance(&mut renderer, &request);
    assert!(gone.iter().all(|pixel| pixel.distance(gone[0]) < 1e-6), "nothing but the backdrop");
    // The burst lasts some 2.4 s of slow motion, and the new bubble comes 2 s later.
    let next = renderer.render(&still(&loaded, SIZE, 4.9)).unwrap();
    assert!(next.steps.iter().any(|(pass, _)| matches!(pass, Pass::SeedField { .. })), "a new bubble");
}

#[test]
fn nothing_is_where_the_hole_is() {
    let Some(mut renderer) = renderer() else { return };
    // From the front, half open: the middle of the picture looks through the hole at the inside of the back wall alone.
    let mut loaded = pricked([0.94, 0.34, 0.1]);
    loaded.scene.bubbles[0].film.state = FilmStateName::Uniform;
    loaded.scene.light.constant = Some([1.0; 3]);
    let middle = SIZE[0] as usize * SIZE[1] as usize / 2 + SIZE[0] as usize / 2;
    let mut seen = |time_s| radiance(&mut renderer, &still(&loaded, SIZE, time_s))[middle].y;
    let (whole, open, all_open) = (seen(0.1), seen(1.0), seen(2.2));
    assert!(open < 0.8 * whole && open > 1.2 * all_open, "two walls, one, and none: {whole} {open} {all_open}");
}

#[test]
fn holes_need_no_film_on_the_device() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = pricked([1.0, 0.0, 0.0]);
    loaded.scene.bubbles[0].film.state = FilmStateName::Uniform;
    let plan = renderer.render(&still(&loaded, SIZE, 1.0)).unwrap();
    assert!(!plan.steps.iter().any(|(pass, _)| matches!(pass, Pass::StepField { .. } | Pass::SeedField { .. })));
    let rim: Vec<RimValue> = bytemuck::pod_collect_to_vec(&renderer.read_hole(0).unwrap().wait(&renderer.gpu).unwrap());
    // All around as far as the speed of Taylor and Culick takes it.
    let expected = soapfilm::physics::film::properties::taylor_culick_speed(0.025, 600e-9);
    let expected = expected * (1.0 - 20.0 / 60.0) / 100.0 / 0.05;
    assert!(rim.iter().all(|rim| (f64::from(rim.outer_rad) / expected - 1.0).abs() < 1e-4), "{:?} {expected}", rim[0]);
}
