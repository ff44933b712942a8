//! Planning a frame: what it costs at the beginning of a film, after an hour of it with thousands of events, and with ten thousand bubbles.

use soapfilm::{
    Scene,
    gpu::GpuError,
    input::load_scene,
    physics::colour::Gamut,
    plan::{GpuState, Moment, Pace, Resources, Shot, Story, plan},
    scene::{Change, Event, Stir},
};

use crate::{report::Report, timed};

/// Ticks of an hour.
const HOUR_TICKS: u64 = 216_000;
/// Events within it.
const EVENTS: u64 = 20_000;
/// Frames planned for one number, each a tick after the one before.
const FRAMES: u64 = 500;
/// Number of runs where it only shows whether the benchmark works.
const SMOKE_FRAMES: u64 = 20;
/// Number of runs; the fastest counts, as the least disturbed.
const RUNS: usize = 5;

/// CPU time of a frame that is planned, µs: at tick 1, after an hour, and the one over the other; and what the first frame of an hour takes, ms,
/// which finds out what has happened until then.
pub fn run(smoke: bool) -> anyhow::Result<()> {
    println!(
        "\nscenes: 0 = quiet, 1 = {EVENTS} stirs in an hour, 2 = the same, in dry air, where bubbles live for seconds, 3 = the preset swarm, 10000 bubbles"
    );
    let mut report = Report::new("planning", &["scene", "first_us", "hour_us", "ratio", "arrive_cpu_ms"]);
    let [loaded, swarm] = [load_scene("tent")?, load_scene("swarm")?];
    for (row, scene) in scenes(&loaded.scene).into_iter().chain([swarm.scene]).enumerate() {
        let frames = if smoke { SMOKE_FRAMES } else { FRAMES };
        let planned = |tick| planned(&Story::new(scene.clone()), &loaded.resources, tick, frames);
        let ([first_us, _], [hour_us, arrive_ms]) = (planned(1)?, planned(HOUR_TICKS)?);
        report.row(&[row as f64, first_us, hour_us, hour_us / first_us, arrive_ms]);
    }
    report.save()
}

/// A scene without events, with many, and with many in dry air.
fn scenes(quiet: &Scene) -> [Scene; 3] {
    let stir = |k| Event { tick: k * HOUR_TICKS / EVENTS, change: Change::Stir(Stir::default()) };
    let stirred = Scene { events: (0..EVENTS).map(stir).collect(), ..quiet.clone() };
    let mut dry = stirred.clone();
    dry.motion.evaporation_nm_s = 50.0;
    [quiet.clone(), stirred, dry]
}

/// CPU time of a frame from a tick on, µs, and CPU time to reach that tick, ms.
fn planned(story: &Story, resources: &Resources, from: u64, frames: u64) -> anyhow::Result<[f64; 2]> {
    let frame = |tick, pace, state: &GpuState| {
        let shot =
            Shot { size: [1280, 720], moment: Moment::tick(tick), full_precision: false, gamut: Gamut::Srgb, pace };
        let request = story.request(resources, &shot).map_err(|fault| GpuError::Refused(fault.to_string()))?;
        Ok(plan(&request, state).after)
    };
    let (there, arrive_ms, _) = timed(|| frame(from, Pace::Whole, &GpuState::default()))?;
    let mut min_ms = f64::INFINITY;
    for _ in 0..RUNS {
        let ticks = from + 1..=from + frames;
        let (_, cpu_ms, _) =
            timed(|| ticks.into_iter().try_fold(there.clone(), |state, tick| frame(tick, Pace::UNMEASURED, &state)))?;
        min_ms = min_ms.min(cpu_ms);
    }
    Ok([1e3 * min_ms / frames as f64, arrive_ms])
}
