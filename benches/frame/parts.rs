//! What each part of a frame costs, where the film stands as it was blown, with parts of the shaders switched off one at a time. Frames with
//! and without a part alternate, so that what else the machine does meets both.

use std::{fs, path::Path};

use soapfilm::{
    gpu::{AdapterChoice, Gpu, Renderer, shaders::Library},
    plan::{FrameRequest, Moment},
    scene::{Backdrop, Quality, Scene},
};

use crate::{
    clock::{Clock, median},
    draw, frame_request_of,
};

/// Distance of the camera from which the bubble of 10 cm covers 99 % of the picture's height, as in the bench of three.js' materials.
const DISTANCE_M: f64 = 0.1947;

/// A text in a shader, and what stands in its place to switch a part off.
struct Edit {
    file: &'static str,
    from: &'static str,
    to: &'static str,
}

const fn edit(file: &'static str, from: &'static str, to: &'static str) -> Edit {
    Edit { file, from, to }
}

const GAMUT: Edit = edit(
    "pass/tonemap.wgsl",
    "into_gamut(toned, tonemap.to_xyz, tonemap.from_xyz)",
    "clamp(toned.linear, vec3f(0.0), vec3f(1.0))",
);
const CURVE: Edit = edit("pass/tonemap.wgsl", "encode_srgb(display)", "sqrt(display)");
const DITHER: Edit = edit("colour/display.wgsl", "    let first = hash(", "    return encoded;\n    let first = hash(");
const ENVIRONMENT: Edit = edit(
    "light/environment.wgsl",
    "textureSampleLevel(environment, environment_sampler, turned, level).rgb;",
    "(turned * turned + level);",
);
const FILM: Edit = edit(
    "film/shown.wgsl",
    "    let at = locate(direction, cells);",
    "    return 500.0 + 300.0 * direction.z + 10.0 * direction.x;\n    let at = locate(direction, cells);",
);
const TABLE: Edit = edit(
    "optics/film_colour.wgsl",
    "let red = table_colour(table, place, first);",
    "let red = vec3f(place.part, place.part.x * place.part.y);",
);
const WAVELENGTHS: Edit = edit("pass/bubble.wgsl", "k < WAVELENGTHS;", "k < min(WAVELENGTHS, 1u);");
const INNER: Edit = edit(
    "sphere/hits.wgsl",
    "    if (INNER > 1u) {\n        let a = last;",
    "    if (INNER > 99u) {\n        let a = last;",
);
const LIMB: Edit = edit("sphere/samples.wgsl", "    if (SAMPLES == 1u) {", "    if (SAMPLES < 99u) {");
const STRIPS: Edit = edit("light/strips.wgsl", "ENVIRONMENT_TAPS == 1u", "ENVIRONMENT_TAPS < 99u");

/// Parts by name.
const PARTS: [(&str, &[Edit]); 11] = [
    ("gamut mapping", &[GAMUT]),
    ("sRGB curve (a square root instead)", &[CURVE]),
    ("dither", &[DITHER]),
    ("environment lookups (a formula instead)", &[ENVIRONMENT]),
    ("film lookups (a formula instead)", &[FILM]),
    ("table lookups (a formula instead)", &[TABLE]),
    ("wavelengths but one", &[WAVELENGTHS]),
    ("inner reflections but one, in the middle", &[INNER]),
    ("samples of pixels at the limb but one", &[LIMB]),
    ("lookups along a reflection but one", &[STRIPS]),
    ("all of these", &[GAMUT, CURVE, DITHER, ENVIRONMENT, FILM, TABLE, WAVELENGTHS, INNER, LIMB, STRIPS]),
];

/// Prints the table for pictures of a size: whole frames first, then what is saved without each part. One round shows that it works: it is of the
/// last part alone, which is all of them.
pub fn print(size: [u32; 2], rounds: usize) {
    let [mut whole, mut without] = [(); 2].map(|()| renderer());
    println!("adapter: {}, {}", whole.gpu.adapter_name(), whole.gpu.driver());
    let clock = Clock::of(&whole.gpu);
    println!("{} of a frame of {}x{}, ms, median of {rounds}", clock.name(), size[0], size[1]);
    for (name, request) in frames(size) {
        println!("{name:<45}{:>8.2}", frame_ms(&mut whole, clock, &request, rounds));
    }
    println!("\nsaved without a part, ms{:>29}{:>10}", "fast", "standard");
    let requests = [Quality::Fast, Quality::Standard].map(|quality| bubble(size, quality));
    let folder = tempfile::tempdir().expect("a temporary folder");
    let first = if rounds > 1 { 0 } else { PARTS.len() - 1 };
    for (name, edits) in PARTS.into_iter().skip(first) {
        write_shaders(folder.path(), edits);
        let library = Library::Directory(folder.path().to_owned());
        without.gpu.pipelines.reload(&without.gpu.device, library).expect("shaders that still compile");
        let saved = requests.each_ref().map(|request| saved_ms([&mut whole, &mut without], clock, request, rounds));
        println!("{name:<45}{:>8.2}{:>10.2}", saved[0], saved[1]);
    }
}

/// A renderer on the adapter that is measured.
pub fn renderer() -> Renderer {
    Renderer::new(
        pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env())).expect("an adapter to measure on"),
    )
}

/// The cost of a frame that is drawn again and again.
pub fn frame_ms(renderer: &mut Renderer, clock: Clock, request: &FrameRequest, rounds: usize) -> f64 {
    clock.median_ms(renderer, rounds, |renderer| draw(renderer, request))
}

fn saved_ms([whole, without]: [&mut Renderer; 2], clock: Clock, request: &FrameRequest, rounds: usize) -> f64 {
    clock.warm_up(|| {
        draw(whole, request);
        draw(without, request);
    });
    let ms = |renderer: &mut Renderer| clock.ms(renderer, |renderer| draw(renderer, request));
    median((0..rounds).map(|_| ms(whole) - ms(without)).collect())
}

/// Frames as a whole.
fn frames(size: [u32; 2]) -> Vec<(String, FrameRequest)> {
    let empty = |backdrop: Backdrop| {
        let change = |scene: &mut Scene| {
            scene.bubbles.clear();
            scene.view.backdrop = backdrop;
        };
        frame_request_of(size, Moment::default(), change)
    };
    let mut frames = vec![
        ("one colour, no bubble".to_owned(), empty(Backdrop::Radiance([0.2; 3]))),
        ("the environment, no bubble".to_owned(), empty(Backdrop::Environment)),
        (
            "a mirror sphere".to_owned(),
            frame_request_of(size, Moment::default(), |scene| scene.camera.distance_m = DISTANCE_M),
        ),
    ];
    frames.extend(Quality::ALL.map(|quality| (format!("a bubble, {}", quality.name()), bubble(size, quality))));
    frames
}

fn bubble(size: [u32; 2], quality: Quality) -> FrameRequest {
    frame_request_of(size, Moment::default(), |scene| {
        scene.camera.distance_m = DISTANCE_M;
        scene.view.quality = quality;
    })
}

/// Writes all shaders to a folder, some of them changed.
fn write_shaders(folder: &Path, edits: &[Edit]) {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    for group in fs::read_dir(&shaders).expect("the folder of shaders").flatten() {
        let target = folder.join(group.file_name());
        fs::create_dir_all(&target).expect("a folder that can be written to");
        for file in fs::read_dir(group.path()).expect("a folder of shaders").flatten() {
            fs::copy(file.path(), target.join(file.file_name())).expect("a file that can be copied");
        }
    }
    for Edit { file, from, to } in edits {
        let path = folder.join(file);
        let text = fs::read_to_string(&path).expect("a shader");
        assert!(
            text.contains(from),
            "{file} has no `{from}` any more: say in benches/frame/parts.rs how to switch that part off"
        );
        fs::write(&path, text.replace(from, to)).expect("a file that can be written to");
    }
}
