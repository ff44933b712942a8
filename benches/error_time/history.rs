//! Going back in time: what a jump costs beside the steps that lead forward to the same moment.

use soapfilm::{
    gpu::{Gpu, Renderer},
    input::load_scene,
    physics::colour::Gamut,
    plan::{FrameRequest, Moment, Pace, Shot, request},
    scene::Flow,
};

use crate::{report::Report, timed};

/// Cells along an edge of the film that is scrubbed.
const CELLS: u32 = 256;
/// Cells of a film that only shows whether the benchmark works.
const SMOKE_CELLS: u32 = 64;
/// Where it is scrubbed from, in ticks.
const END_TICKS: u64 = 360;
/// How far back, in ticks.
const JUMPS_TICKS: [u64; 3] = [30, 60, 300];

/// A film that moves by itself, and one in a flow in closed form: steps, CPU seconds of the way there and of each jump back, from the same
/// moment each time.
pub fn run(gpu: Gpu, smoke: bool) -> anyhow::Result<()> {
    println!("\nscenes: 0 = free, 1 = stirred");
    let columns = ["scene", "back_ticks", "steps", "cpu_s", "cpu_ms_step", "frame_cpu_ms"];
    let mut report = Report::new("history", &columns);
    let (cells, end) = if smoke { (SMOKE_CELLS, END_TICKS / 20) } else { (CELLS, END_TICKS) };
    let frame_request = |flow, tick| frame_request(flow, cells, tick);
    let mut renderer = Renderer::new(gpu);
    for (scene, flow) in [Flow::Free, Flow::Stirred].into_iter().enumerate() {
        // Once as a whole, so that no row pays for pipelines.
        arrive(&mut renderer, &frame_request(flow, 4)?)?;
        let (steps, cpu_ms) = arrive(&mut renderer, &frame_request(flow, end)?)?;
        let frame_ms = frame(&mut renderer, &frame_request(flow, end)?)?;
        let mut row = |back: u64, steps: u64, cpu_ms: f64| {
            let a_step = (cpu_ms - frame_ms) / steps.max(1) as f64;
            report.row(&[scene as f64, back as f64, steps as f64, cpu_ms * 1e-3, a_step, frame_ms]);
        };
        row(0, steps, cpu_ms);
        for back in JUMPS_TICKS.into_iter().filter(|back| *back < end) {
            let (steps, cpu_ms) = arrive(&mut renderer, &frame_request(flow, end - back)?)?;
            row(back, steps, cpu_ms);
            arrive(&mut renderer, &frame_request(flow, end)?)?;
        }
    }
    report.save()
}

/// A frame of the film of the preset `tent` at a tick, moved by a flow.
fn frame_request(flow: Flow, cells: u32, tick: u64) -> anyhow::Result<FrameRequest> {
    let mut loaded = load_scene("tent")?;
    loaded.scene.bubbles[0].film.cells = cells;
    loaded.scene.motion.flow = flow;
    let moment = Moment { tick, fraction: 0.0 };
    let shot = Shot { size: [256, 144], moment, full_precision: false, gamut: Gamut::Srgb, pace: Pace::UNMEASURED };
    Ok(request(&loaded.scene, &loaded.resources, &shot)?)
}

/// Goes on frame by frame until a picture is complete: steps taken and CPU time in milliseconds.
fn arrive(renderer: &mut Renderer, request: &FrameRequest) -> anyhow::Result<(u64, f64)> {
    let before = renderer.counts.cells_stepped;
    let ((), cpu_ms, _) = timed(|| {
        while !renderer.render(request)?.complete {}
        renderer.gpu.wait()
    })?;
    Ok(((renderer.counts.cells_stepped - before) / (6 * u64::from(CELLS).pow(2)), cpu_ms))
}

/// CPU time in milliseconds of a frame that moves nothing.
fn frame(renderer: &mut Renderer, request: &FrameRequest) -> anyhow::Result<f64> {
    renderer.forget_picture();
    Ok(arrive(renderer, request)?.1)
}
