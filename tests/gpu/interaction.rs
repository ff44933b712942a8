//! What people do to a bubble, on the device against the f64 twin.

use soapfilm::{
    physics::{
        film::{Push, properties::air_drag},
        flow::{FlowForces, FlowSolver, relative_l2},
        sphere::{CubedSphere, PaddedField},
    },
    scene::{Blow, Change, Event, Stir},
    verify::interaction::{Played, weightless},
};

use crate::support::gpu;
use glam::DVec3;

const CELLS: u32 = 64;
/// A step is two ticks of 1/60 s.
const STEP_S: f64 = 2.0 / 60.0;

/// A stir, and a jet that begins in the middle of the third step.
fn events() -> (Stir, Blow) {
    let stir =
        Stir { at: [0.5, 0.4, 0.3], velocity_m_s: [-0.1, 0.1, 0.0], radius_deg: 12.0, ticks: 20, ..Stir::default() };
    (stir, Blow { at: [-0.3, 0.1, 0.9], toward: [1.0, 0.0, -0.5], radius_deg: 25.0, ticks: 4, ..Blow::default() })
}

/// Vorticity after so many steps of the twin, from the events' own numbers.
fn twin(steps: u32) -> Vec<f64> {
    let (stir, blow) = events();
    let (radius_m, stir_s) = (0.05, 20.0 / 60.0);
    let push = |at: [f64; 3], radius_deg: f64, velocity: DVec3, rate: f64| Push {
        centre: DVec3::from(at).normalize(),
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
        solver.step(STEP_S, &FlowForces::default(), &still);
    }
    solver.zeta().cells()
}

#[test]
fn pushes_do_on_the_device_what_they_do_in_f64() {
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
        let scene =
            soapfilm::scene::Scene { events: vec![Event { tick: 0, change: Change::Blow(blow) }], ..weightless(CELLS) };
        let mut played = Played::new(&gpu, &scene).unwrap();
        played.play_to(6).unwrap();
        played.velocity().unwrap().iter().fold(0.0, |most: f64, u| most.max(u.length()))
    };
    let (straight, oblique) = (largest([-0.3, -0.5, -0.8]), largest([-0.3, 0.5, -0.8]));
    assert!(straight < 1e-5 * oblique && oblique > 1.0, "{straight} {oblique}");
}
