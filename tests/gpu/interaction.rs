//! What people do to a bubble, on the device against the f64 twin.

use soapfilm::{
    gpu::Renderer,
    input::LoadedScene,
    physics::{
        film::{Push, properties::air_drag},
        flow::{FOLLOWED_TURN, FlowForces, FlowSolver, relative_l2},
        sphere::{CubedSphere, PaddedField},
    },
    scene::{Backdrop, Blow, Change, Drag, Event, FilmStateName, Quality, Scene, Stir},
    verify::{interaction::weightless, played::Played, reference},
};

use crate::support::{gpu, load, mean_and_max, radiance, renderer, short_or_long, still};
use glam::{DMat3, DVec3};

const CELLS: u32 = 64;
/// A step is two ticks of 1/60 s.
const STEP_S: f64 = 2.0 / 60.0;

/// A stir, and a jet that begins in the middle of the third step.
fn events() -> (Stir, Blow) {
    let stir =
        Stir { at: [0.5, 0.4, 0.3], velocity_m_s: [-0.1, 0.1, 0.0], radius_deg: 12.0, ticks: 20, ..Stir::default() };
    (stir, Blow { at: [-0.3, 0.1, 0.9], toward: [1.0, 0.0, -0.5], radius_deg: 25.0, ticks: 4, ..Blow::default() })
}

/// Vorticity after a number of steps of the twin, from the numbers of the events.
fn twin(steps: u32) -> Vec<f64> {
    let (stir, blow) = events();
    let (radius_m, stir_s) = (0.05, 20.0 / 60.0);
    let push = |at: [f64; 3], radius_deg: f64, velocity: DVec3, rate: f64| Push {
        center: DVec3::from(at).normalize(),
        sharpness: Push::sharpness_of(radius_deg.to_radians()),
        velocity: velocity / radius_m,
        rate,
    };
    let stirred = push(stir.at, stir.radius_deg, stir.velocity_m_s.into(), 6.0 / stir_s);
    let jet = DVec3::from(blow.toward).normalize() * blow.speed_m_s;
    let layer = 0.5 * air_drag(700e-9, blow.speed_m_s, radius_m * blow.radius_deg.to_radians());
    let blown = push(blow.at, blow.radius_deg, jet, layer);
    let grid = CubedSphere::new(CELLS as usize).unwrap();
    let mut solver = FlowSolver::new(grid, |_| 0.0);
    let still = PaddedField::from_cells(grid, solver.halo(), |_| 0.0);
    for step in 0..steps {
        // From tick 5 until 9: half of step 2, all of step 3, half of step 4.
        let blown_s = [0.0, 0.0, 0.5, 1.0, 0.5].get(step as usize).unwrap_or(&0.0) * STEP_S;
        let pushes = [stirred.in_step(STEP_S, STEP_S), blown.in_step(blown_s, STEP_S)];
        let (u, zeta) = (solver.velocity().cells(), solver.zeta().cells());
        let source = |cell: usize| {
            pushes.iter().map(|push| push.source(grid.cell_direction(cell), u[cell], zeta[cell])).sum::<f64>()
        };
        let forcing = PaddedField::from_cells(grid, solver.halo(), source);
        solver.stir(forcing);
        // The jet acts from tick 5 for 4 ticks, the stir from the start of all steps; what turns fast is tried first.
        let end_s = f64::from(step + 1) * STEP_S;
        let strain = stirred.strain(end_s).max(blown.strain((end_s - 5.0 / 60.0).clamp(0.0, 4.0 / 60.0)));
        let step = if strain * STEP_S > FOLLOWED_TURN { FlowSolver::step_corrected } else { FlowSolver::step };
        step(&mut solver, STEP_S, &FlowForces::default(), &still);
    }
    solver.zeta().cells()
}

#[test]
fn pushes_on_the_device_match_their_f64_twin() {
    let Some(gpu) = gpu() else { return };
    let (stir, blow) = events();
    let mut scene = weightless(CELLS);
    scene.events = vec![Event { tick: 0, change: Change::Stir(stir) }, Event { tick: 5, change: Change::Blow(blow) }];
    let mut played = Played::new(&gpu, &scene).unwrap();
    for steps in [1, 6] {
        played.play_to(2 * u64::from(steps)).unwrap();
        let (found, expected) = (played.zeta().unwrap(), twin(steps));
        let error = relative_l2(CubedSphere::new(CELLS as usize).unwrap(), &found, &expected);
        // f32, whose rounding the Laplacian magnifies; the jet alone is a tenth of the whole.
        assert!(error < 1e-3, "after {steps} steps: {error}");
    }
}

#[test]
fn a_jet_straight_at_the_film_moves_nothing() {
    let Some(gpu) = gpu() else { return };
    let largest = |toward: [f64; 3]| {
        let blow = Blow { at: [0.3, 0.5, 0.8], toward, ..Blow::default() };
        let scene = Scene { events: vec![Event { tick: 0, change: Change::Blow(blow) }], ..weightless(CELLS) };
        let mut played = Played::new(&gpu, &scene).unwrap();
        played.play_to(6).unwrap();
        played.velocity().unwrap().iter().fold(0.0, |max: f64, u| max.max(u.length()))
    };
    let (straight, oblique) = (largest([-0.3, -0.5, -0.8]), largest([-0.3, 0.5, -0.8]));
    assert!(straight < 1e-5 * oblique && oblique > 1.0, "{straight} {oblique}");
}

/// A picture of a bubble that flies through the air, and the matrix that stretches it.
fn pushed_picture(renderer: &mut Renderer, loaded: &LoadedScene, size: [u32; 2]) -> (Vec<DVec3>, Vec<DVec3>, DMat3) {
    let mut request = still(loaded, size, 25.0 / 60.0);
    // Fewer samples than pictures of this size have, the same for both.
    request.picture.draw.bubbles[0].samples = short_or_long(2, 8);
    let draw = &request.picture.draw;
    let stretch = draw.bubbles[0].stretch;
    let truth = reference::radiance(draw, &Default::default(), &|| ()).unwrap();
    (radiance(renderer, &request), truth, stretch)
}

/// A bubble of one thickness that a drag has pushed out of shape, in a preset's light.
fn dragged(preset: &str, to_m: [f64; 3]) -> LoadedScene {
    let mut loaded = load(preset);
    (loaded.scene.bubbles[0].film.state, loaded.scene.bubbles[0].film.thickness_nm) = (FilmStateName::Uniform, 420.0);
    loaded.scene.view.quality = Quality::Spectral;
    loaded.scene.events = vec![Event { tick: 2, change: Change::Drag(Drag { bubble: 0, to_m }) }];
    loaded
}

#[test]
fn a_pushed_bubble_matches_the_f64_picture() {
    let Some(mut renderer) = renderer() else { return };
    for (to_m, largest_stretch, limit) in [([0.0, 0.05, 0.02], 0.02, 5e-4), ([0.0, 0.3, 0.1], 0.2, 3e-3)] {
        let mut loaded = dragged("tent", to_m);
        loaded.scene.camera.target_m = [0.0, to_m[1], to_m[2]];
        let (seen, truth, stretch) = pushed_picture(&mut renderer, &loaded, [64, 40]);
        let size = (0..3).map(|k| (stretch.col(k) - DMat3::IDENTITY.col(k)).abs().max_element()).fold(0.0, f64::max);
        assert!(size > 1e-3 && size < largest_stretch, "{size}");
        let brightest = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        let apart = seen.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element() / brightest);
        let (mean, max) = mean_and_max(apart);
        eprintln!("measured: stretch {size:.4}, mean {mean:.5}, max {max:.4} of the brightest");
        // The film has the mean of the angles at its first two walls, which differ in proportion to the stretch.
        assert!(mean < limit, "stretch {size}: {mean} {max}");
    }
}

/// Whatever its shape, no light is lost.
#[test]
fn an_ellipsoid_vanishes_in_even_light() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = dragged("furnace", [0.0, 0.3, 0.1]);
    loaded.scene.camera.target_m = [0.0, 0.3, 0.1];
    loaded.scene.view.backdrop = Backdrop::Environment;
    let (seen, truth, stretch) = pushed_picture(&mut renderer, &loaded, [32, 20]);
    assert_ne!(stretch, DMat3::IDENTITY);
    let even = truth[0];
    let (_, max) = mean_and_max(seen.iter().chain(&truth).map(|pixel| (*pixel - even).abs().max_element() / even.x));
    assert!(max < 2e-3, "{max}");
}

#[test]
fn a_still_bubble_is_round_to_the_bit() {
    let Some(mut renderer) = renderer() else { return };
    let mut never = dragged("tent", [0.0; 3]);
    never.scene.events.clear();
    let mut back = dragged("tent", [1e-3, 0.0, 0.0]);
    back.scene.events.push(Event { tick: 8, change: Change::Drag(Drag::default()) });
    let at = |loaded: &LoadedScene| still(loaded, [64, 40], 60.0);
    assert_eq!(at(&back).picture.draw.bubbles[0].stretch, DMat3::IDENTITY, "it has come to rest");
    assert_eq!(radiance(&mut renderer, &at(&back)), radiance(&mut renderer, &at(&never)));
}
