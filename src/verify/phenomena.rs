//! What real films do, each measured against its theory: bands, a swing after a stir, plumes, energy that moves to larger scales, and the
//! thinning of the top down to black film.

use glam::DVec3;

use super::{
    Run,
    free_film::{FreeFilm, RULES, field},
    interaction,
    played::Played,
    random::Random,
};
use crate::{
    gpu::GpuError,
    parallel,
    physics::{
        film::PrescribedFlow,
        flow::{FlowForces, Mode},
        optics::reflectance,
        sphere::CubedSphere,
    },
    plan::{BLACK_FILM_NM, remaining_nm},
    scene::{Change, Event, Scene, Stir},
};

/// Cells along a panel's edge.
const CELLS: u32 = 64;

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    cascade(run)?;
    bands(run)?;
    plume(run)?;
    drained(run)
}

/// A blown film in air at rest.
fn blown(thickness_nm: f64) -> Scene {
    let mut scene = Scene::default();
    (scene.bubbles[0].film.cells, scene.bubbles[0].film.thickness_nm) = (CELLS, thickness_nm);
    scene.motion.strength = 0.0;
    scene
}

/// The bright bands of a sorted film in light of one wavelength, seen from all sides at once: of its reflectance averaged around each height,
/// counted from the top to the bottom, against 2nΔh/λ between the two.
fn bands(run: &mut Run<'_>) -> Result<(), GpuError> {
    const INDEX: f64 = 1.333;
    const WAVELENGTH_NM: f64 = 550.0;
    const MERIDIANS: usize = 16;
    let scene = blown(700.0);
    let mut played = Played::new(run.gpu, &scene)?;
    played.play_to((5.0 / scene.motion.tick_s) as u64)?;
    let (sphere, thickness_nm) = (played.sphere(), played.thickness()?);
    let turn = std::f64::consts::TAU / MERIDIANS as f64;
    let meridians: Vec<Vec<f64>> =
        (0..MERIDIANS).map(|k| along_meridian(sphere, &thickness_nm, turn * k as f64)).collect();
    let around = |of: &dyn Fn(f64) -> f64, row: usize| {
        meridians.iter().map(|meridian| of(meridian[row])).sum::<f64>() / MERIDIANS as f64
    };
    let rows = meridians[0].len();
    let bright = |nm| reflectance(INDEX, 1.0, nm, WAVELENGTH_NM).mean();
    let bands = alternations(&(0..rows).map(|row| around(&bright, row)).collect::<Vec<_>>());
    let expected = 2.0 * INDEX * (around(&|nm| nm, rows - 1) - around(&|nm| nm, 0)) / WAVELENGTH_NM;
    // Reflectance goes as sin² of the phase, so a band is above three fifths for 0.44 of a fringe: a stretch of F fringes touches fewer than
    // F + 1.44 of them.
    run.at_most("bands of a sorted film: more or fewer than 2n Δh / λ", (bands - expected).abs(), 1.44);
    Ok(())
}

/// How often a sequence becomes bright after it was dark, or begins bright: above three fifths of its largest value and below two, so that
/// what is left of the marbling does not count.
fn alternations(bright: &[f64]) -> f64 {
    let largest = bright.iter().copied().fold(0.0, f64::max);
    let (mut count, mut is_bright) = (0, false);
    for value in bright {
        if !is_bright && *value > 0.6 * largest {
            (count, is_bright) = (count + 1, true);
        } else if *value < 0.4 * largest {
            is_bright = false;
        }
    }
    f64::from(count)
}

/// The thickness from the top to the bottom, a value for each two cells: the value of the nearest one.
fn along_meridian(sphere: CubedSphere, thickness_nm: &[f64], longitude: f64) -> Vec<f64> {
    let (sin, cos) = longitude.sin_cos();
    (1..CELLS)
        .map(|k| {
            let (across, up) = (std::f64::consts::PI * f64::from(k) / f64::from(CELLS)).sin_cos();
            let place = DVec3::new(across * cos, across * sin, up);
            let nearest = (0..sphere.cells()).min_by(|a, b| {
                let distance = |cell: usize| sphere.cell_direction(cell).distance_squared(place);
                distance(*a).total_cmp(&distance(*b))
            });
            thickness_nm[nearest.unwrap_or(0)]
        })
        .collect()
}

/// A thin patch at the equator of a film with strong drag: with b the buoyancy of its middle, a Gaussian one rises with b/(4α), as in a
/// Hele-Shaw cell: from α Δψ = n·(∇ ln h × G), whose flow, averaged over wave vectors and with the patch as weight, is half of ½b/α.
fn plume(run: &mut Run<'_>) -> Result<(), GpuError> {
    const MEAN_NM: f64 = 700.0;
    const THINNER: f64 = 0.02;
    const WIDTH_RAD: f64 = 0.12;
    const DRAG_1_S: f64 = 20.0;
    const GRAVITY_1_S2: f64 = 9.81 / 0.05;
    const STEP_S: f64 = 1.0 / 60.0;
    let patch = |x: DVec3| (-0.5 * (x.angle_between(DVec3::X) / WIDTH_RAD).powi(2)).exp();
    let thickness_nm = |x: DVec3| MEAN_NM * (1.0 - THINNER * patch(x));
    let forces = FlowForces { gravity: GRAVITY_1_S2 * DVec3::NEG_Z, drag: DRAG_1_S, ..FlowForces::default() };
    let field = field(run.gpu, CELLS as usize, RULES, thickness_nm)?;
    let mut film = FreeFilm::new(run.gpu, field, forces, PrescribedFlow::default())?;
    let mut heights = Vec::new();
    for _ in 0..2 {
        film.run(30, STEP_S)?;
        heights.push(height_of_patch(film.sphere(), &film.thickness()?));
    }
    // After half a second, ten times as long as drag takes, the speed is steady.
    let found = (heights[1] - heights[0]) / (30.0 * STEP_S);
    let expected = GRAVITY_1_S2 * THINNER / (4.0 * DRAG_1_S);
    // The sphere is flat over the patch to within its width squared, and the film thinner by THINNER there.
    run.at_most("a thin patch rises: error of its speed", (found / expected - 1.0).abs(), 0.05);
    Ok(())
}

/// Height of the middle of what is missing to the thickest film.
fn height_of_patch(sphere: CubedSphere, thickness_nm: &[f64]) -> f64 {
    let thickest = thickness_nm.iter().copied().fold(0.0, f64::max);
    let (sum, weighted) =
        thickness_nm.iter().zip(sphere.areas()).enumerate().fold((0.0, 0.0), |(sum, weighted), (cell, (nm, area))| {
            let missing = area * (thickest - nm);
            (sum + missing, weighted + missing * sphere.cell_direction(cell).z)
        });
    weighted / sum
}

/// Eddies stirred at random into a film without weight: their energy moves to larger scales, and vorticity to smaller ones.
fn cascade(run: &mut Run<'_>) -> Result<(), GpuError> {
    const STIRS: u64 = 60;
    let mut random = Random::new(3);
    let mut scene = interaction::weightless(CELLS);
    scene.motion.viscosity_mm2_s = 1.0;
    let mut vector = |size: f64| [0; 3].map(|_| size * (2.0 * random.next() - 1.0));
    let stir = |_| Stir { at: vector(1.0), velocity_m_s: vector(0.1), radius_deg: 6.0, ticks: 6, ..Stir::default() };
    scene.events = (0..STIRS).map(stir).map(|stir| Event { tick: 0, change: Change::Stir(stir) }).collect();
    let mut played = Played::new(run.gpu, &scene)?;
    let mut spectra = Vec::new();
    for tick in [8, 240] {
        played.play_to(tick)?;
        spectra.push(spectrum(played.flow()?.sphere(), &played.zeta()?));
    }
    let sums = |spectrum: &[f64]| {
        let all: f64 = spectrum.iter().sum();
        (all, spectrum.iter().enumerate().map(|(k, energy)| (k + 1) as f64 * energy).sum::<f64>() / all)
    };
    let [(before, from), (after, to)] = [sums(&spectra[0]), sums(&spectra[1])];
    run.at_most("stirred without weight: mean degree of the energy after 4 s over that at first", to / from, 0.8);
    run.at_most("stirred without weight: energy lost, part of it", 1.0 - after / before, 0.5);
    // The eddies turn by up to half a radian a step, whose square over 6 is the steps' error.
    run.at_most("stirred without weight: energy gained, part of it", after / before - 1.0, 0.05);
    // Kraichnan's −3 of vorticity on its way to small scales; coherent vortices make it steeper.
    run.at_most(
        "stirred without weight: slope of the energy's spectrum, degrees 10 to 30",
        slope(&spectra[1], 10..30),
        -3.0,
    );
    Ok(())
}

/// Kinetic energy by degree, from 1 on, of a vorticity: ½ ζ_lm² / (l (l + 1)) summed over orders.
fn spectrum(sphere: CubedSphere, zeta: &[f64]) -> Vec<f64> {
    let areas = sphere.areas();
    let energy = |degree: u32| {
        let modes = (0..=degree).filter_map(|order| Mode::new(degree, order, 0).ok());
        let energies = modes.map(|mode| {
            let add = |sum: [f64; 2], cell: usize| {
                let [cos, sin] = mode.values(sphere.cell_direction(cell));
                [sum[0] + areas[cell] * zeta[cell] * cos, sum[1] + areas[cell] * zeta[cell] * sin]
            };
            let [cos, sin] = (0..sphere.cells()).fold([0.0; 2], add);
            0.5 * (cos * cos + sin * sin) / mode.eigenvalue()
        });
        energies.sum::<f64>()
    };
    parallel::map(32, |k| energy(k as u32 + 1))
}

/// Slope of a spectrum over degrees, both in logarithms, by least squares.
fn slope(spectrum: &[f64], degrees: std::ops::Range<usize>) -> f64 {
    let points: Vec<(f64, f64)> = degrees.map(|degree| ((degree as f64).ln(), spectrum[degree - 1].ln())).collect();
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let [xy, xx] = points.iter().fold([0.0; 2], |[xy, xx], p| [xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x).powi(2)]);
    xy / xx
}

/// A film that evaporates as it sorts itself is thinnest at the top, black there first, and never less black than before.
fn drained(run: &mut Run<'_>) -> Result<(), GpuError> {
    const EVAPORATION_NM_S: f64 = 40.0;
    let mut scene = blown(250.0);
    (scene.motion.evaporation_nm_s, scene.motion.black_film_life_s) = (EVAPORATION_NM_S, 1e6);
    let mut played = Played::new(run.gpu, &scene)?;
    let (mut unsorted, mut first, mut shrunk, mut black): (f64, _, f64, _) = (0.0, None, 0.0, 0.0);
    for tick in (120..=300).step_by(12) {
        played.play_to(tick)?;
        let evaporated_nm = EVAPORATION_NM_S * tick as f64 * scene.motion.tick_s;
        let left: Vec<f64> = played.thickness()?.into_iter().map(|nm| remaining_nm(nm, evaporated_nm)).collect();
        let (sphere, areas) = (played.sphere(), played.sphere().areas());
        let caps = [0.8, 0.0, -0.8].map(|low| mean_between(sphere, &left, low, low + 0.2));
        unsorted = unsorted.max(caps[0] / caps[1]).max(caps[1] / caps[2]);
        let is_black = |cell: &usize| left[*cell] < 2.0 * BLACK_FILM_NM;
        let area = (0..sphere.cells()).filter(is_black).map(|cell| areas[cell]).sum::<f64>();
        if area > 0.0 && first.is_none() {
            let height =
                (0..sphere.cells()).filter(is_black).map(|cell| sphere.cell_direction(cell).z).fold(1.0, f64::min);
            first = Some(height);
        }
        shrunk = shrunk.max(black - area);
        black = area;
    }
    run.at_most("an evaporating film: a higher zone over a lower one, at worst", unsorted, 1.0);
    run.at_most(
        "an evaporating film: angle of its first black film from the top",
        first.map_or(f64::NAN, f64::acos),
        0.5,
    );
    run.at_most("an evaporating film: black area that was lost again, sr", shrunk, 0.0);
    Ok(())
}

/// Mean thickness between two heights.
fn mean_between(sphere: CubedSphere, thickness_nm: &[f64], low: f64, high: f64) -> f64 {
    let zone = |cell: &usize| (low..high).contains(&sphere.cell_direction(*cell).z);
    let (sum, area) = (0..sphere.cells()).filter(zone).fold((0.0, 0.0), |(sum, area), cell| {
        let own = sphere.cell_area(sphere.cell(cell).1, sphere.cell(cell).2);
        (sum + own * thickness_nm[cell], area + own)
    });
    sum / area
}
