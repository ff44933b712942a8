//! Pictures as people see them, against recorded ones.
//!
//! On the adapter and driver that made the goldens every byte must agree; elsewhere every byte within 1 and the mean colour difference within
//! 0.05, which is far below what an eye sees. `SOAPFILM_BLESS=1 cargo test --test snapshot` records them anew: look at every difference
//! first. A golden that is missing is a failure, never made by itself. What differs is written as a page to `target/tmp/snapshot/`.

#[path = "../support/mod.rs"]
mod support;

mod compare;
mod report;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use soapfilm::{
    gpu::Renderer,
    output::{Metadata, PngPicture, read_back::read_png},
    physics::colour::Gamut,
};

use compare::Comparison;

/// Presets, and moments in seconds at which each shows what it is for.
const GOLDENS: [(&str, f64); 12] = [
    ("default", 0.0),
    ("tent", 0.4),
    ("windows", 0.0),
    ("fresh", 0.9),
    ("black", 0.0),
    ("trio", 0.0),
    ("inside", 0.0),
    ("bath", 0.5),
    ("ring", 0.4),
    ("drop", 0.4),
    ("polarised", 0.0),
    ("two_lights", 0.0),
];
const SIZE: [u32; 2] = [320, 180];
/// Limits where another adapter or driver draws.
const MAX_STEPS: u8 = 1;
const MEAN_DELTA_E: f64 = 0.05;

/// What made the goldens.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Maker {
    adapter: String,
    driver: String,
}

impl Maker {
    fn of(renderer: &Renderer) -> Self {
        Self { adapter: renderer.gpu.adapter_name(), driver: renderer.gpu.driver() }
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/snapshot/goldens")
}

#[test]
fn presets_look_as_recorded() {
    let Some(mut renderer) = support::renderer() else { return };
    if std::env::var("SOAPFILM_BLESS").is_ok_and(|value| value == "1") {
        return bless(&mut renderer);
    }
    let exact = recorded_maker() == Some(Maker::of(&renderer));
    let failures: Vec<String> =
        GOLDENS.iter().filter_map(|(name, time_s)| check(&mut renderer, name, *time_s, exact).err()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn draw(renderer: &mut Renderer, name: &str, time_s: f64) -> Vec<u8> {
    let mut request = support::still(&support::load(name), SIZE, time_s);
    // As the window draws.
    request.picture.draw.full_precision = false;
    support::display(renderer, &request)
}

fn check(renderer: &mut Renderer, name: &str, time_s: f64, exact: bool) -> Result<(), String> {
    let golden = read_png(&folder().join(format!("{name}.png")))
        .map_err(|error| format!("{name}: no golden ({error}); record it with SOAPFILM_BLESS=1"))?;
    let now = draw(renderer, name, time_s);
    let comparison = Comparison::of([golden.width, golden.height], &golden.rgba, SIZE, &now)?;
    let limits = if exact { (0, 0.0) } else { (MAX_STEPS, MEAN_DELTA_E) };
    if comparison.max_steps <= limits.0 && comparison.mean_delta_e <= limits.1 {
        return Ok(());
    }
    let page = report::write(name, SIZE, &golden.rgba, &now, &comparison);
    let place = page.map_or_else(|error| format!("no report: {error}"), |page| format!("see {}", page.display()));
    Err(format!("{name}: {comparison}, allowed are {} steps and mean ΔE {}; {place}", limits.0, limits.1))
}

fn recorded_maker() -> Option<Maker> {
    toml::from_str(&std::fs::read_to_string(folder().join("goldens.toml")).ok()?).ok()
}

fn bless(renderer: &mut Renderer) {
    std::fs::create_dir_all(folder()).unwrap();
    for (name, time_s) in GOLDENS {
        let rgba = draw(renderer, name, time_s);
        let metadata = Metadata::new().with("Scene", name).with("Time", &format!("{time_s} s"));
        let picture =
            PngPicture { width: SIZE[0], height: SIZE[1], gamut: Gamut::Srgb, rgba: &rgba, metadata: &metadata };
        picture.save(&folder().join(format!("{name}.png"))).unwrap();
    }
    let maker = toml::to_string(&Maker::of(renderer)).unwrap();
    let text =
        format!("# What made the pictures beside this file, by SOAPFILM_BLESS=1 cargo test --test snapshot.\n{maker}");
    std::fs::write(folder().join("goldens.toml"), text).unwrap();
    eprintln!("recorded {} pictures on {:?}", GOLDENS.len(), Maker::of(renderer));
}

#[test]
fn every_golden_belongs_to_a_preset() {
    let pictures =
        std::fs::read_dir(folder()).unwrap().filter_map(|entry| entry.unwrap().file_name().into_string().ok());
    let mut found: Vec<_> = pictures.filter_map(|name| name.strip_suffix(".png").map(str::to_owned)).collect();
    let mut expected = GOLDENS.map(|(name, _)| name.to_owned()).to_vec();
    found.sort();
    expected.sort();
    assert_eq!(found, expected);
}
