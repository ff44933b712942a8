//! What the integration tests share: a device, pictures of scenes, and how much is asked of them.
#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod page;

use std::{
    process::{Command, Stdio},
    sync::{Mutex, PoisonError},
};

use cpu_time::ProcessTime;
use glam::DVec3;
use soapfilm::{
    gpu::{AdapterChoice, Gpu, Renderer},
    input::{LoadedScene, load_scene},
    physics::colour::Gamut,
    plan::{FrameRequest, Moment, Pace, Shot, request},
    verify::{Check, Extent, Part, Run},
};

/// Part of the name of the adapter that must be there; without it a machine that has none skips the tests that need one.
pub const REQUIRE_ADAPTER: &str = "SOAPFILM_REQUIRE_ADAPTER";
/// Set to 1: every test runs in full, however long that takes. Otherwise those with many cases or steps take fewer, of each kind.
const LONG_TESTS: &str = "SOAPFILM_LONG_TESTS";
/// Set to 1: other people's tools must be there; without it a machine that has none skips what needs them.
pub const REQUIRE_TOOLS: &str = "SOAPFILM_REQUIRE_TOOLS";
/// Set to 1: what drives a real window must be there.
pub const REQUIRE_WINDOW: &str = "SOAPFILM_REQUIRE_WINDOW";

/// Whether an environment variable is 1.
pub fn is_set(variable: &str) -> bool {
    std::env::var(variable).is_ok_and(|value| value == "1")
}

/// The short form of something, or the whole of it where every test runs in full.
pub fn short_or_long<T>(short: T, long: T) -> T {
    if is_set(LONG_TESTS) { long } else { short }
}

/// Whether all of these programs can be started. Where they cannot, says so, and fails if a variable demands them.
pub fn has_tools(tools: &[&str], required_by: &str) -> bool {
    let quiet = |tool: &str| Command::new(tool).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let missing: Vec<_> = tools.iter().copied().filter(|tool| quiet(tool).is_err()).collect();
    if missing.is_empty() {
        return true;
    }
    let missing = missing.join(", ");
    assert!(!is_set(required_by), "{required_by}=1, but {missing} is not installed");
    eprintln!("skipped: {missing} is not installed");
    false
}

/// Devices that no test uses at the moment. There are as many as tests that run at once: two tests on one device would wait for each other's
/// work, and what one test has compiled the next one on its device need not.
static IDLE: Mutex<Vec<Gpu>> = Mutex::new(Vec::new());

/// A test's device, which goes to another test when the test's thread ends.
struct Lease(Option<Gpu>);

impl Drop for Lease {
    fn drop(&mut self) {
        IDLE.lock().unwrap_or_else(PoisonError::into_inner).extend(self.0.take());
    }
}

impl Lease {
    fn new() -> Self {
        let idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner).pop();
        Self(idle.or_else(open))
    }
}

/// The device to test on, the same one throughout a test. Nothing where no adapter is required and none is there. A test that loses a device, or
/// leaves errors on it, opens its own.
pub fn gpu() -> Option<Gpu> {
    thread_local!(static LEASE: Lease = Lease::new());
    LEASE.with(|lease| lease.0.clone())
}

fn open() -> Option<Gpu> {
    let required = std::env::var(REQUIRE_ADAPTER).ok().filter(|name| !name.is_empty());
    let choice = AdapterChoice { name: required.clone(), backend: None }.or_env();
    match (pollster::block_on(Gpu::headless(&choice)), required) {
        (Ok(gpu), Some(name)) => {
            let found = gpu.adapter_name();
            assert!(found.contains(&name), "{REQUIRE_ADAPTER}={name}, but the adapter is {found}");
            Some(gpu)
        }
        (Ok(gpu), None) => Some(gpu),
        (Err(error), Some(name)) => panic!("{REQUIRE_ADAPTER}={name}, but {error}"),
        (Err(error), None) => {
            eprintln!("skipped: {error}");
            None
        }
    }
}

/// Runs a part of `soapfilm verify`, tells what it measured, and fails if a check does or there are too few.
pub fn hold(part: Part, at_least: usize) {
    let Some(gpu) = gpu() else { return };
    let mut checks: Vec<Check> = Vec::new();
    let mut since = ProcessTime::now();
    let mut report = |check: Check| {
        let Check { name, measured, limit } = &check;
        eprintln!(
            "measured: {name}: {measured:.4e} (limit {limit:.4e}), after {:.1} s of CPU",
            since.elapsed().as_secs_f64()
        );
        checks.push(check);
        since = ProcessTime::now();
    };
    let extent = short_or_long(Extent::Short, Extent::Full);
    let preset = |name: &str| load_scene(name).ok().map(|loaded| (loaded.scene, loaded.resources));
    Run { gpu: &gpu, extent, preset: &preset, report: &mut report }.part(part).unwrap();
    assert!(checks.len() >= at_least, "only {} checks", checks.len());
    let (made, told) = (checks.len() as u64, part.checks());
    assert!(
        extent == Extent::Short || made.abs_diff(told) <= told / 3,
        "a display of progress counts on {told} checks, these are {made}"
    );
    let failed: Vec<_> = checks.iter().filter(|check| !check.passed()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

/// A renderer on the adapter to test on.
pub fn renderer() -> Option<Renderer> {
    gpu().map(Renderer::new)
}

/// A preset with all it names.
pub fn load(preset: &str) -> LoadedScene {
    load_scene(preset).unwrap()
}

/// What a still picture of a scene needs, all at once and in f32.
pub fn still(loaded: &LoadedScene, size: [u32; 2], time_s: f64) -> FrameRequest {
    let moment = Moment::of_time(time_s, loaded.scene.motion.tick_s);
    let shot = Shot { size, moment, full_precision: true, gamut: Gamut::Srgb, pace: Pace::Whole };
    request(&loaded.scene, &loaded.resources, &shot).unwrap()
}

/// Radiance of each pixel, linear BT.2020.
pub fn radiance(renderer: &mut Renderer, request: &FrameRequest) -> Vec<DVec3> {
    assert!(renderer.render(request).unwrap().complete);
    let bytes = renderer.read_radiance().unwrap().wait(&renderer.gpu).unwrap();
    let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
    pixels.into_iter().map(|[r, g, b, _]| DVec3::new(r.into(), g.into(), b.into())).collect()
}

/// Bytes of each pixel, sRGB and alpha.
pub fn display(renderer: &mut Renderer, request: &FrameRequest) -> Vec<u8> {
    assert!(renderer.render(request).unwrap().complete);
    renderer.read_picture().unwrap().wait(&renderer.gpu).unwrap()
}

/// Numbers in [0, 1) that look random and are the same on every machine (SplitMix64, Steele, Lea & Flood 2014).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Mean and maximum of some numbers; fails if there are none, or if one is NaN.
pub fn mean_and_max(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let values: Vec<f64> = values.into_iter().collect();
    assert!(!values.is_empty(), "nothing was compared");
    assert!(values.iter().all(|value| value.is_finite()), "not a number among {} values", values.len());
    (values.iter().sum::<f64>() / values.len() as f64, values.iter().copied().fold(f64::NEG_INFINITY, f64::max))
}
