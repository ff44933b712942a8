//! Random valid scenes over every range that the format's page documents: nothing may fail, and what is drawn must be light.
//!
//! `SOAPFILM_FUZZ_CASES=10000 cargo test --test gpu fuzz` draws any number of them; `SOAPFILM_FUZZ_SEED=7` draws others. A failure prints the
//! scene, without what does not matter to it.

mod scenes;
mod values;

use std::{fmt, sync::Arc};

use cpu_time::ProcessTime;
use glam::DVec3;
use proptest::{
    prelude::*,
    strategy::ValueTree,
    test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner},
};
use soapfilm::{
    gpu::Renderer,
    input::{LoadedScene, load_scene},
    output::Picture,
    physics::{
        colour::{BT2020, Gamut},
        environment::CubeMap,
    },
    plan::{FilmKey, FrameRequest, Moment, Pace, Shot, request},
    scene::{Backdrop, Fault, Quality, Scene},
};

use crate::support::{mean_and_max, radiance, renderer, short_or_long};

/// Scenes of the gate, and frames that they share: a driver compiles the pipelines of each frame for seconds.
const CASES: u32 = 100;
const FRAMES: u32 = 5;
const SIZE: [u32; 2] = [12, 8];
/// What the films of a picture may take: steps, and cells that these move in all.
type Effort = (usize, u64);
/// In the gate.
const SHORT: Effort = (4, 40_000);
/// Where tests run in full, or somebody asks for a number of scenes.
const FULL: Effort = (8, 100_000);
/// Part of a picture's brightest X, Y or Z by which others may be negative: fitted wavelengths and half floats in tables err by as much.
const MAX_NEGATIVE: f64 = 2e-3;
/// Mean difference between `fast` and `spectral`, as a part of the mean of the picture.
const MAX_FAST: f64 = 0.1;

/// A scene and when it is seen.
#[derive(Clone)]
struct Case {
    scene: Scene,
    moment: Moment,
    /// Whether it is drawn twice.
    again: bool,
}

impl fmt::Debug for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} of\n{}", self.moment, self.scene.to_toml())
    }
}

fn number(variable: &str) -> Option<u64> {
    let text = std::env::var(variable).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{variable}={text} is not a whole number")))
}

fn runner(seed: u64, cases: u32) -> TestRunner {
    let rng_seed = RngSeed::Fixed(seed);
    TestRunner::new(Config { cases, rng_seed, failure_persistence: None, max_shrink_iters: 100, ..Config::default() })
}

fn cases(frame: scenes::Frame) -> impl Strategy<Value = Case> {
    let ticks = prop_oneof![Just(0), 1..60_u64, Just(10_000_000)];
    let fraction = prop::sample::select(vec![0.0, 0.5]);
    // Another renderer bakes its own table, which takes a software driver seconds.
    (scenes::scenes(frame), ticks, fraction, prop::bool::weighted(0.05))
        .prop_map(|(scene, tick, fraction, again)| Case { scene, moment: Moment { tick, fraction }, again })
}

#[test]
fn any_valid_scene_is_drawn() {
    let Some(mut renderer) = renderer() else { return };
    let (asked, seed) = (number("SOAPFILM_FUZZ_CASES"), number("SOAPFILM_FUZZ_SEED").unwrap_or(1));
    let count = asked.map_or(CASES, |count| count as u32);
    let frames = if asked.is_some() { count } else { FRAMES };
    let (mut drawn, cpu) = (0, ProcessTime::now());
    for frame in 0..frames {
        let mut runner = runner(seed.wrapping_mul(1_000_003) + u64::from(frame), count.div_ceil(frames));
        let frame = scenes::frames().new_tree(&mut runner).unwrap().current();
        let renderer = std::cell::RefCell::new(&mut renderer);
        let found = runner.run(&cases(frame.clone()), |case| check(&mut renderer.borrow_mut(), case));
        match found {
            Ok(()) => {
                drawn += 1;
                eprintln!("frame {drawn} of {frames}, {:.1} s of CPU, {frame:?}", cpu.elapsed().as_secs_f64());
            }
            Err(TestError::Fail(reason, case)) => panic!("seed {seed}: {reason}\n{case:?}"),
            Err(TestError::Abort(reason)) => panic!("seed {seed}: {reason}"),
        }
    }
    assert_eq!(drawn, frames);
}

fn check(renderer: &mut Renderer, case: Case) -> Result<(), TestCaseError> {
    prop_assert_eq!(case.scene.validate(), Ok(()));
    let loaded = load(&case.scene);
    let request = match frame_request(&loaded, case.moment) {
        Ok(request) => request,
        // Nothing can be seen from below a bath.
        Err(fault) if fault.to_string().contains("from below the bath") => return Ok(()),
        Err(error) => return Err(TestCaseError::fail(error.to_string())),
    };
    let pixels = radiance(renderer, &request);
    all_light(&pixels)?;
    if case.again {
        repeats(renderer, &request, &pixels)?;
    }
    if loaded.scene.view.quality == Quality::Fast {
        agrees_with_spectral(renderer, &loaded, case.moment, &pixels)?;
    }
    vanishes(renderer, loaded, case.moment)
}

/// As the program loads it, from a file.
fn load(scene: &Scene) -> LoadedScene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene.to_toml()).unwrap();
    let loaded = load_scene(path.to_str().unwrap()).unwrap_or_else(|error| panic!("{error}\n{}", scene.to_toml()));
    assert_eq!(loaded.scene, *scene);
    loaded
}

/// The picture at a moment, or at an earlier one where films would take too long to get there.
fn frame_request(loaded: &LoadedScene, mut moment: Moment) -> Result<FrameRequest, Fault> {
    loop {
        let shot = Shot { size: SIZE, moment, full_precision: true, gamut: Gamut::Srgb, pace: Pace::Whole };
        let request = request(&loaded.scene, &loaded.resources, &shot)?;
        if moment.tick == 0 || is_cheap(&request) {
            return Ok(request);
        }
        moment.tick /= 2;
    }
}

fn is_cheap(request: &FrameRequest) -> bool {
    let (max_steps, max_cells) = number("SOAPFILM_FUZZ_CASES").map_or_else(|| short_or_long(SHORT, FULL), |_| FULL);
    let (mut steps, mut cells) = (0, 0);
    for (_, film) in request.picture.draw.films() {
        if let FilmKey::Field(film) = film {
            let own = film.steps_from(0).take(max_steps + 1).count();
            (steps, cells) = (steps + own, cells + own as u64 * film.cell_count());
        }
    }
    steps <= max_steps && cells <= max_cells
}

/// Every pixel is a number, and none is less than dark: X, Y and Z of light are never negative, whatever red, green and blue are.
fn all_light(pixels: &[DVec3]) -> Result<(), TestCaseError> {
    let rgba: Vec<[f32; 4]> = pixels.iter().map(|rgb| rgb.extend(1.0).as_vec4().to_array()).collect();
    let Picture::Radiance { rgb, .. } = Picture::radiance_from_bt2020(SIZE, &rgba) else { unreachable!("radiance") };
    let lost = rgb.iter().flatten().filter(|value| !value.is_finite()).count();
    prop_assert_eq!(lost, 0, "values that are not finite");
    let xyz = pixels.iter().map(|rgb| BT2020.to_xyz() * *rgb);
    let (low, high) =
        xyz.fold((0.0_f64, 0.0_f64), |(low, high), xyz| (low.min(xyz.min_element()), high.max(xyz.max_element())));
    prop_assert!(-low <= MAX_NEGATIVE * high, "negative light: {} beside {}", low, high);
    Ok(())
}

/// Another renderer draws the same bits.
fn repeats(renderer: &Renderer, request: &FrameRequest, pixels: &[DVec3]) -> Result<(), TestCaseError> {
    let again = radiance(&mut Renderer::new(renderer.gpu.clone()), request);
    let bits = |pixels: &[DVec3]| pixels.iter().map(|rgb| rgb.to_array().map(f64::to_bits)).collect::<Vec<_>>();
    prop_assert!(bits(&again) == bits(pixels), "another picture each time");
    Ok(())
}

fn agrees_with_spectral(
    renderer: &mut Renderer,
    loaded: &LoadedScene,
    moment: Moment,
    fast: &[DVec3],
) -> Result<(), TestCaseError> {
    let mut loaded = loaded.clone();
    loaded.scene.view.quality = Quality::Spectral;
    let spectral = radiance(renderer, &frame_request(&loaded, moment).unwrap());
    let (mean, _) = mean_and_max(spectral.iter().map(|rgb| (BT2020.to_xyz() * *rgb).max_element()));
    let (apart, _) =
        mean_and_max(fast.iter().zip(&spectral).map(|(a, b)| (BT2020.to_xyz() * (*a - *b)).abs().max_element()));
    prop_assert!(apart <= MAX_FAST * mean, "`fast` is {} off `spectral`, of {}", apart, mean);
    Ok(())
}

/// The white furnace: in the same light from everywhere nothing is seen of a bubble, nor of drops. A bath is dark below. The light is of the scene's own
/// illuminant, and coloured where the scene's is, so that it is drawn by the scene's own pipelines.
fn vanishes(renderer: &mut Renderer, mut loaded: LoadedScene, moment: Moment) -> Result<(), TestCaseError> {
    let (light, is_neutral) = (&mut loaded.scene.light, loaded.resources.environment.is_neutral());
    light.constant.get_or_insert(if is_neutral { [1.0; 3] } else { [1.0, 0.5, 0.25] });
    (light.patches, loaded.scene.view.backdrop) = (Vec::new(), Backdrop::Environment);
    // Wires are darker than light.
    loaded.scene.bubbles.iter_mut().for_each(|bubble| bubble.wire_mm = 0.0);
    (loaded.resources.environment, loaded.resources.spectral_lights) =
        (Arc::new(CubeMap::constant(DVec3::ONE)), Vec::new());
    let request = frame_request(&loaded, moment).unwrap();
    if request.picture.draw.on_bath {
        return Ok(());
    }
    let light = &request.picture.draw.lighting.light;
    let even = light.seen * light.gain;
    let pixels = radiance(renderer, &request);
    let (_, error) = mean_and_max(pixels.into_iter().map(|rgb| (rgb - even).abs().max_element()));
    prop_assert!(error <= 1e-3 * even.abs().max_element(), "seen in even light: {} beside {}", error, even);
    Ok(())
}
