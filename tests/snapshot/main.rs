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

/// A test for each preset, at the moment in seconds at which it shows what it is for: tests run side by side.
macro_rules! presets_look_as_recorded {
    ($($name:ident at $time_s:literal),* $(,)?) => {
        const GOLDENS: &[&str] = &[$(stringify!($name)),*];

        mod looks_as_recorded {
            $(#[test]
            fn $name() {
                super::look_at(stringify!($name), $time_s);
            })*
        }
    };
}

presets_look_as_recorded! {
    default at 0.0,
    tent at 0.4,
    windows at 0.0,
    fresh at 0.9,
    black at 0.0,
    trio at 0.0,
    inside at 0.0,
    bath at 0.5,
    ring at 0.4,
    drop at 0.4,
    polarised at 0.0,
    two_lights at 0.0,
}

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

/// Compares a preset with its golden, or records it.
fn look_at(name: &str, time_s: f64) {
    let Some(mut renderer) = support::renderer() else { return };
    if support::is_set("SOAPFILM_BLESS") {
        return bless(&mut renderer, name, time_s);
    }
    let exact = recorded_maker() == Some(Maker::of(&renderer));
    check(&mut renderer, name, time_s, exact).unwrap();
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

fn bless(renderer: &mut Renderer, name: &str, time_s: f64) {
    std::fs::create_dir_all(folder()).unwrap();
    let rgba = draw(renderer, name, time_s);
    let metadata = Metadata::new().with("Scene", name).with("Time", &format!("{time_s} s"));
    let picture = PngPicture { width: SIZE[0], height: SIZE[1], gamut: Gamut::Srgb, rgba: &rgba, metadata: &metadata };
    picture.save(&folder().join(format!("{name}.png"))).unwrap();
    // Every golden is of one maker, so it does not matter which test writes this last.
    let maker = toml::to_string(&Maker::of(renderer)).unwrap();
    let text =
        format!("# What made the pictures beside this file, by SOAPFILM_BLESS=1 cargo test --test snapshot.\n{maker}");
    std::fs::write(folder().join("goldens.toml"), text).unwrap();
    eprintln!("recorded {name} on {:?}", Maker::of(renderer));
}

#[test]
fn every_golden_belongs_to_a_preset() {
    let pictures =
        std::fs::read_dir(folder()).unwrap().filter_map(|entry| entry.unwrap().file_name().into_string().ok());
    let mut found: Vec<_> = pictures.filter_map(|name| name.strip_suffix(".png").map(str::to_owned)).collect();
    let mut expected = GOLDENS.to_vec();
    found.sort();
    expected.sort_unstable();
    assert_eq!(found, expected);
}
