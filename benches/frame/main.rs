//! Frame timing: the whole frame and each pass by itself, bubble 80 % of the height, on the adapter that the program would use.
//!
//! `cargo bench --bench frame -- parts` prints a table of what each part of a frame costs instead, `-- crowd` what many bubbles cost, and `-- film`
//! what a step of a film costs.

mod clock;
mod crowd;
mod film;
mod parts;

use criterion::{BenchmarkId, Criterion, criterion_group};
use soapfilm::{
    gpu::{AdapterChoice, Gpu, Renderer},
    input::load_scene,
    physics::colour::Gamut,
    plan::{FrameRequest, GpuState, Moment, Pace, Plan, Rendering, Shot, plan, request},
    scene::Scene,
};

const SIZES: [[u32; 2]; 2] = [[1280, 720], [1920, 1080]];
/// A picture that shows whether the benchmark works: `cargo bench --bench frame -- --test`.
const SMOKE: [[u32; 2]; 1] = [[320, 180]];
/// Frames of which the table of parts is the median.
const ROUNDS: usize = 15;
/// Frames of which each number in the table of crowds is the median: such a frame takes longer.
const CROWD_ROUNDS: usize = 5;
const PASSES: [&str; 7] = ["bake_table", "fit_quadrature", "seed_field", "step_field", "show_field", "draw", "tonemap"];

fn frame(criterion: &mut Criterion) {
    let gpu = pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env())).expect("an adapter to measure on");
    println!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
    let mut renderer = Renderer::new(gpu);
    let is_smoke = std::env::args().any(|argument| argument == "--test");
    for size in if is_smoke { SMOKE.to_vec() } else { SIZES.to_vec() } {
        let bubble = frame_request(size);
        let mut mirror = bubble.clone();
        mirror.picture.draw.rendering = Rendering::Yardstick;
        draw(&mut renderer, &bubble);
        draw(&mut renderer, &mirror);
        let mut group = criterion.benchmark_group(format!("{}x{}", size[0], size[1]));
        group.sample_size(20);
        for (name, request) in [("frame", &bubble), ("mirror_yardstick", &mirror)] {
            group.bench_function(name, |bencher| bencher.iter(|| draw(&mut renderer, request)));
        }
        draw(&mut renderer, &bubble);
        for pass in PASSES {
            let only = only(&bubble, pass, renderer.state());
            group.bench_function(BenchmarkId::new("pass", pass), |bencher| {
                bencher.iter(|| {
                    renderer.execute(&only).expect("a plan that ran before");
                    renderer.gpu.wait().expect("a device that worked before");
                });
            });
        }
        group.finish();
    }
}

/// The preset `tent` a few ticks in, so that every pass has something to do, a whole step and the part of one included.
fn frame_request(size: [u32; 2]) -> FrameRequest {
    frame_request_of(size, Moment { tick: 2, fraction: 0.5 }, |_| ())
}

/// The preset `tent` with a change, at a moment.
fn frame_request_of(size: [u32; 2], moment: Moment, change: impl FnOnce(&mut Scene)) -> FrameRequest {
    let mut loaded = load_scene("tent").expect("the preset");
    change(&mut loaded.scene);
    let shot = Shot { size, moment, full_precision: false, gamut: Gamut::Srgb, pace: Pace::Whole };
    request(&loaded.scene, &loaded.resources, &shot).expect("a scene that can be drawn")
}

/// One frame, drawn again except for baked tables.
fn draw(renderer: &mut Renderer, request: &FrameRequest) {
    renderer.forget_picture();
    renderer.render(request).expect("a frame");
    renderer.gpu.wait().expect("a device that works");
}

/// The part of a plan from nothing that has this name.
fn only(request: &FrameRequest, name: &str, state: &GpuState) -> Plan {
    let whole = plan(request, &GpuState::default());
    let steps: Vec<_> = whole.steps.into_iter().filter(|(pass, _)| pass.name() == name).collect();
    assert!(!steps.is_empty(), "no pass is named {name}");
    Plan { steps, after: state.clone(), complete: true }
}

criterion_group!(benches, frame);

fn main() {
    let asked = |word: &str| std::env::args().any(|argument| argument == word);
    if asked("parts") {
        parts::print(SIZES[0], ROUNDS);
        return;
    }
    if asked("crowd") {
        crowd::print(SIZES[0], CROWD_ROUNDS);
        return;
    }
    if asked("film") {
        film::print(ROUNDS);
        return;
    }
    if asked("--test") {
        parts::print(SMOKE[0], 1);
        crowd::print(SMOKE[0], 1);
        film::print(1);
    }
    benches();
    Criterion::default().configure_from_args().final_summary();
}
