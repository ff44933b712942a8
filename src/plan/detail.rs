//! How fine a film is, and its flow: by how large the bubble is in the picture.
//!
//! A film's history must not depend on where it is looked at from, or on the size of the picture: its grids follow from the scene alone, from the
//! camera that it begins with, or all keyframes of that camera, and for a picture of a certain height. Where it is moved in a window, they are settled
//! before.

use glam::DVec3;

use crate::scene::{Boundary, Bubble, Camera, Change, Detail, Film, Scene};

/// Rows of the picture that bubbles are measured in.
const ROWS: f64 = 1080.0;
/// Diameter in pixels up to which half of the cells along an edge look the same: as blown, colours differ by 0.12 (CIEDE2000) on average and by 3
/// at most, as much as far bubbles may from pictures of many samples; a tenth of a second later by less than a tenth of what the film
/// changes by in a step.
const HALF_DIAMETER: f64 = 40.0;
/// Minimum cells along an edge.
const MIN_CELLS: u32 = 16;
/// Minimum cells along an edge of the grid of a whole flow: 1.4° each. It is four times coarser than finer films: its cells are still a fraction
/// of the smallest eddy, and cubic interpolation of one step's displacement errs by less than can be seen.
const MIN_FLOW_CELLS: u32 = 64;

/// Cells along a panel's edge of a bubble's film, and of its flow where that is coarser.
#[must_use]
pub fn film_grids(scene: &Scene, index: usize) -> [u32; 2] {
    let bubble = &scene.bubbles[index];
    grids(&bubble.film, settled(scene, index, bubble))
}

/// Cells along a panel's edge of a film that bubbles share, and of its flow. It is seen on small bubbles most of the time.
pub(super) fn shared_grids(film: &Film) -> [u32; 2] {
    grids(film, if film.detail == Detail::Auto { Detail::Half } else { film.detail })
}

fn grids(film: &Film, detail: Detail) -> [u32; 2] {
    let cells = film.cells;
    let all = [cells, cells.div_ceil(4).max(MIN_FLOW_CELLS)];
    match detail {
        Detail::Half => all.map(|cells| cells.div_ceil(2).max(MIN_CELLS)),
        Detail::Auto | Detail::Full => all,
    }
}

/// Settles how fine films are by the camera of now, whatever it does from then on.
pub fn settle_detail(scene: &mut Scene) {
    for index in 0..scene.bubbles.len() {
        scene.bubbles[index].film.detail = settled(scene, index, &scene.bubbles[index]);
    }
}

/// The detail that `auto` chooses for a bubble. A film with a boundary takes all of its cells, for patches that rise from its rim are a few cells
/// wide.
fn settled(scene: &Scene, index: usize, bubble: &Bubble) -> Detail {
    match bubble.film.detail {
        Detail::Auto if bubble.boundary != Boundary::Free => Detail::Full,
        Detail::Auto if largest_diameter(scene, index, bubble) > HALF_DIAMETER => Detail::Full,
        Detail::Auto => Detail::Half,
        detail => detail,
    }
}

/// The most rows that a bubble is ever across, there and everywhere that it is dragged to; more than all where the eye is inside.
fn largest_diameter(scene: &Scene, index: usize, bubble: &Bubble) -> f64 {
    let radius_m = 1e-3 * bubble.radius_mm;
    let dragged = scene.events.iter().filter_map(|event| match &event.change {
        Change::Drag(drag) if drag.bubble == index => Some(DVec3::from(drag.to_m)),
        _ => None,
    });
    let places: Vec<DVec3> = std::iter::once(DVec3::from(bubble.center_m)).chain(dragged).collect();
    let rows = |camera: &Camera| {
        let eye_m = camera.eye();
        let nearest_m = places.iter().map(|place_m| place_m.distance(eye_m)).fold(f64::INFINITY, f64::min);
        ROWS * radius_m / nearest_m / (0.5 * camera.fov_y_rad()).tan()
    };
    let camera = &scene.camera;
    let moved = camera.keyframes.iter().map(|keyframe| rows(&camera.at(keyframe.time_s)));
    moved.reduce(f64::max).unwrap_or_else(|| rows(camera))
}
