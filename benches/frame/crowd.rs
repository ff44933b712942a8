//! What a frame of many bubbles costs, planning included where CPU time is measured.

use soapfilm::{
    gpu::Renderer,
    input::{LoadedScene, load_scene},
    physics::colour::Gamut,
    plan::{FrameRequest, Moment, Pace, Shot, Story},
    scene::{Film, FilmStateName, Generator, Layout, Quality, Scene},
};

use crate::{
    clock::Clock,
    draw,
    parts::{frame_ms, renderer},
};

/// The qualities that windows use.
const QUALITIES: [Quality; 2] = [Quality::Fast, Quality::Standard];
/// Radius in pixels of one bubble; of more, the same area is shared out.
const RADIUS_PIXELS: f64 = 300.0;
/// Distance of the eye from all bubbles, m: so far that all are seen alike.
const DISTANCE_M: f64 = 10.0;

/// Prints the tables for pictures of a size, and of one with nine times as many pixels.
pub fn print(size: [u32; 2], rounds: usize) {
    let mut renderer = renderer();
    println!("adapter: {}, {}", renderer.gpu.adapter_name(), renderer.gpu.driver());
    for clock in Clock::all(&renderer.gpu) {
        print_by(*clock, &mut renderer, size, rounds);
    }
}

fn print_by(clock: Clock, renderer: &mut Renderer, size: [u32; 2], rounds: usize) {
    println!(
        "\n{} of a frame of {}x{}, ms, median of {rounds}, without the same frame without bubbles",
        clock.name(),
        size[0],
        size[1]
    );
    println!(
        "\n{:<35}{:>10}{:>10}{:>10}{:>10}{:>10}",
        "bubbles of equal area in all", "pixels", "fast", "ns/pixel", "standard", "ns/pixel"
    );
    let base = planned_ms(renderer, clock, &with_bubbles(0, Quality::Fast), size, rounds);
    for count in [1, 100, 10_000] {
        let pixels = pixels_touched(count, size);
        let [fast, standard] =
            QUALITIES.map(|quality| planned_ms(renderer, clock, &with_bubbles(count, quality), size, rounds) - base);
        let [fast_ns, standard_ns] = [fast, standard].map(|ms| 1e6 * ms / pixels);
        println!("{count:<35}{pixels:>10.0}{fast:>10.2}{fast_ns:>10.0}{standard:>10.2}{standard_ns:>10.0}");
    }
    let few = few_in_sight(size);
    let planned = planned_ms(renderer, clock, &few, size, rounds);
    let request = request(&few, size);
    let seen = request.picture.draw.bubbles.len() + request.picture.draw.small.len();
    let alone = frame_ms(renderer, clock, &request, rounds);
    println!("\n{seen} of 10000 bubbles in sight: {planned:.2} ms; those alone, without planning: {alone:.2} ms");
    let large = size.map(|pixels| 3 * pixels);
    for name in ["tent", "cloud"] {
        let scene = load(name);
        let [cost, of_large] = [size, large].map(|size| planned_ms(renderer, clock, &scene, size, rounds));
        let times = of_large / cost;
        println!("the preset {name}: {cost:.2} ms; nine times the pixels: {of_large:.2} ms, {times:.1} times");
    }
}

/// Pixels that bubbles on a lattice touch, each counted for each bubble: a disc of radius r touches π r² + 4 r of them.
fn pixels_touched(count: u32, size: [u32; 2]) -> f64 {
    let radius = RADIUS_PIXELS * f64::from(size[1]) / 720.0 / f64::from(count).sqrt();
    f64::from(count) * (std::f64::consts::PI * radius.powi(2) + 4.0 * radius)
}

fn load(name: &str) -> LoadedScene {
    load_scene(name).expect("the preset")
}

/// Bubbles on a lattice that faces the eye.
fn with_bubbles(count: u32, quality: Quality) -> LoadedScene {
    let mut loaded = load("tent");
    let scene: &mut Scene = &mut loaded.scene;
    scene.bubbles.clear();
    (scene.view.quality, scene.camera.distance_m) = (quality, DISTANCE_M);
    (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (0.0, 0.0);
    let pixel_m = 2.0 * (0.5 * scene.camera.fov_y_deg.to_radians()).tan() * DISTANCE_M / 720.0;
    let rows_m = 700.0 * pixel_m;
    scene.generators = (count > 0)
        .then(|| Generator {
            layout: Layout::Grid,
            count,
            size_m: [0.0, 1.7 * rows_m, rows_m],
            radius_mm: 1e3 * RADIUS_PIXELS * pixel_m / f64::from(count).sqrt(),
            radius_spread: 0.0,
            film: Film { state: FilmStateName::Rest, cells: 64, ..Film::default() },
            ..Generator::default()
        })
        .into_iter()
        .collect();
    loaded
}

/// The preset `swarm`, seen through a lens so long that some fifty of its bubbles are in sight.
fn few_in_sight(size: [u32; 2]) -> LoadedScene {
    let mut loaded = load("swarm");
    let seen = |loaded: &LoadedScene| {
        let draw = request(loaded, size).picture.draw;
        draw.bubbles.len() + draw.small.len()
    };
    while seen(&loaded) > 50 {
        loaded.scene.camera.fov_y_deg *= 0.9;
    }
    loaded
}

fn request(loaded: &LoadedScene, size: [u32; 2]) -> FrameRequest {
    request_of(&Story::new(loaded.scene.clone()), loaded, size)
}

fn request_of(story: &Story, loaded: &LoadedScene, size: [u32; 2]) -> FrameRequest {
    let shot = Shot { size, moment: Moment::default(), full_precision: false, gamut: Gamut::Srgb, pace: Pace::Whole };
    story.request(&loaded.resources, &shot).expect("a scene that can be drawn")
}

/// The cost of a frame from the scene to the picture.
fn planned_ms(renderer: &mut Renderer, clock: Clock, loaded: &LoadedScene, size: [u32; 2], rounds: usize) -> f64 {
    let story = Story::new(loaded.scene.clone());
    clock.median_ms(renderer, rounds, |renderer| draw(renderer, &request_of(&story, loaded, size)))
}
