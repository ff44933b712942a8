//! The program from outside. The command line as scripts see it: exit codes, one clear line on stderr, no file left behind, columns and keys;
//! and the window as people see it.

#[cfg(target_os = "linux")]
mod app;
mod colour;
mod files;
mod film;
mod layers;
mod lut;
mod mistakes;
#[cfg(feature = "gui")]
mod probe;
#[cfg(target_os = "linux")]
mod screen;
mod sequence;
#[cfg(unix)]
mod streams;
#[path = "../support/mod.rs"]
mod support;
#[cfg(target_os = "linux")]
mod tour;
mod video;

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use soapfilm::output::read_back::{read_exr, read_png};

use support::REQUIRE_ADAPTER;

/// What a run of the program left.
struct Run {
    success: bool,
    out: String,
    err: String,
}

/// A folder to run in, empty at first.
struct Desk(tempfile::TempDir);

impl Desk {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), content).unwrap();
    }

    fn files(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    fn run_with(&self, variables: &[(&str, &str)], arguments: &str) -> Run {
        let mut command = Command::new(env!("CARGO_BIN_EXE_soapfilm"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace());
        if let Ok(name) = std::env::var(REQUIRE_ADAPTER) {
            command.env("WGPU_ADAPTER_NAME", name);
        }
        command.envs(variables.iter().copied());
        let output = command.output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Run { success: output.status.success(), out: text(output.stdout), err: text(output.stderr) }
    }

    fn run(&self, arguments: &str) -> Run {
        self.run_with(&[], arguments)
    }

    /// Runs what must fail: with one line on stderr, after the adapter's if there is one, and without leaving a file.
    fn refused_with(&self, variables: &[(&str, &str)], arguments: &str) -> String {
        let before = self.files();
        let run = self.run_with(variables, arguments);
        assert!(!run.success, "`{arguments}` succeeded");
        let lines: Vec<&str> = run.err.lines().filter(|line| !line.starts_with("adapter: ")).collect();
        assert_eq!(lines.len(), 1, "`{arguments}` says: {}", run.err);
        assert!(lines[0].starts_with("error: ") && lines[0].len() > 20, "`{arguments}` says: {}", lines[0]);
        assert!(!lines[0].contains("panicked"), "{}", lines[0]);
        assert_eq!(self.files(), before, "`{arguments}` left a file");
        lines[0].to_owned()
    }

    fn refused(&self, arguments: &str) -> String {
        self.refused_with(&[], arguments)
    }

    /// Runs what must succeed on a GPU, or nothing where there is none.
    fn done(&self, arguments: &str) -> Option<Run> {
        support::gpu()?;
        let run = self.run(arguments);
        assert!(run.success, "`{arguments}` fails: {}", run.err);
        assert!(run.err.starts_with("adapter: "), "`{arguments}` does not name the adapter: {}", run.err);
        Some(run)
    }
}

const COMMANDS: [&str; 11] =
    ["app", "render", "sequence", "presets", "film", "colour", "lut", "transport", "flow", "verify", "info"];

#[test]
fn every_help_has_an_example() {
    let desk = Desk::new();
    let all = desk.run("--help");
    assert!(all.success && all.out.contains("Example:"));
    for command in COMMANDS {
        assert!(all.out.contains(&format!("\n  {command}")), "`{command}` is not listed");
        let help = desk.run(&format!("{command} --help"));
        let example = ["Example:\n  soapfilm ", "Examples:\n  soapfilm "].iter().any(|text| help.out.contains(text));
        assert!(help.success && example, "{command}");
        assert!(help.out.contains("--adapter") && help.out.contains("--backend"), "{command}");
    }
}

#[test]
fn broken_scenes_are_refused_by_name_and_line() {
    let desk = Desk::new();
    desk.write("syntax.toml", "version = 1\n[[bubble]\n");
    desk.write("key.toml", "version = 1\n[camera]\ndistance = 3\n");
    desk.write("value.toml", "version = 1\n[[bubble]]\nradius_mm = -4\n");
    desk.write("empty.toml", "");
    for (scene, told) in [
        ("syntax.toml", "syntax.toml:2"),
        ("key.toml", "key.toml:3: unknown key `distance` in [camera]"),
        ("value.toml", "value.toml:3"),
        ("empty.toml", "version"),
        ("missing.toml", "missing.toml"),
        ("nonesuch", "presets: default"),
        (".", "folder"),
    ] {
        let line = desk.refused(&format!("render {scene} -o a.png --size 16x9"));
        assert!(line.contains(told), "{scene}: {line}");
    }
    assert!(desk.refused("render key.toml -o a.png").contains("distance_m"), "the nearest key is named");
}

#[test]
fn broken_environments_are_refused() {
    let desk = Desk::new();
    let scene = |file: &str| format!("version = 1\n[light]\nenvironment = \"{file}\"\n");
    for file in ["text.exr", "cut.exr", "missing.exr", "empty.exr", "text.hdr"] {
        desk.write(&format!("{file}.toml"), scene(file));
    }
    desk.write("text.exr", "this is no picture");
    desk.write("text.hdr", "this is no picture either");
    desk.write("empty.exr", "");
    desk.run("render furnace -o whole.exr --size 64x32 --quality reference");
    let whole = std::fs::read(desk.path("whole.exr")).unwrap();
    desk.write("cut.exr", &whole[..whole.len() / 2]);
    for file in ["text.exr", "cut.exr", "missing.exr", "empty.exr", "text.hdr"] {
        let line = desk.refused(&format!("render {file}.toml -o a.png --size 16x9"));
        assert!(line.contains(file), "{file}: {line}");
    }
}

#[test]
fn arguments_that_make_no_sense_are_refused() {
    let desk = Desk::new();
    for arguments in [
        "render default -o a.png --size 0x0",
        "render default -o a.png --size 100000x100000",
        "render default -o a.png --size many",
        "render default -o a.png --time nan",
        "render default -o a.png --time -1",
        "render default -o a.png --time 1e30",
        "render default -o a.png --quality best",
        "render default -o a.png --gamut rec2020",
        "render default -o a.png --no-such-option",
        "render default -o a.jpg",
        "render default",
        "colour --thickness nan --cos 1",
        "colour --thickness 300",
        "colour --thickness 300 --cos 1.5",
        "colour --thickness 300 --cos 1 --illuminant neon",
        "colour --thickness 300 --cos 1 --film 0.5",
        "colour --thickness 300 --cos 1 --film soap",
        "colour --thickness 300 --cos 1 --illuminant missing.csv",
        "colour --thickness 300 --cos 1 --skin 9",
        "lut -o a.png",
        "lut -o a",
        "sequence default -o a --frames 0..1 --fps 30/0",
        "sequence default -o a --frames 0..1 --fps fast",
        "sequence default -o a --frames 0..1 --quality best",
        "colour --thickness 300 --cos 1 --spectrum lines",
        "lut -o a.exr --range 0",
        "lut -o a.exr --size 1x1",
        "colour --points missing.csv",
        "colour --strip a.jpg",
        "colour --strip a.png --cos 1",
        "transport --wind sb --tracer tc1 --cells 4 --steps 10",
        "transport --wind sb --tracer tc1 --cells 16 --steps 0",
        "transport --wind sb --tracer tc1 --cells 16 --steps 10 --axis 0,0,0",
        "transport --wind nd --tracer cb --cells 16 --steps 10 --map-coarsening 3",
        "transport --wind up --tracer tc1 --cells 16 --steps 10",
        "nonsense --really",
    ] {
        desk.refused(arguments);
    }
}

#[test]
fn outputs_that_cannot_be_written_are_refused() {
    let desk = Desk::new();
    std::fs::create_dir(desk.path("folder.png")).unwrap();
    for output in ["folder.png", "nowhere/a.png"] {
        let line = desk.refused(&format!("render default -o {output} --size 16x9 --quality reference"));
        assert!(line.contains(output), "{line}");
    }
    assert!(std::fs::read_dir(desk.path("folder.png")).unwrap().next().is_none());
}

#[test]
fn adapters_that_are_not_there_are_refused() {
    let desk = Desk::new();
    desk.refused("render default -o a.png --size 16x9 --adapter nonesuch9000");
    desk.refused("info --backend abacus");
    let unset = ("WGPU_ADAPTER_NAME", "");
    if cfg!(target_os = "linux") {
        let line = desk.refused_with(&[unset, ("WGPU_BACKEND", "dx12")], "render default -o a.png --size 16x9");
        assert!(line.contains("adapter"), "{line}");
        let nowhere = [unset, ("VK_DRIVER_FILES", "/nowhere.json"), ("VK_ICD_FILENAMES", "/nowhere.json")];
        desk.refused_with(&nowhere, "render default -o a.png --size 16x9 --backend vulkan");
        desk.refused_with(&nowhere, "colour --thickness 300 --cos 1 --backend vulkan");
        desk.refused_with(&nowhere, "transport --wind sb --tracer tc1 --cells 16 --steps 4 --backend vulkan");
    }
}

/// The reference needs no GPU at all.
#[test]
fn the_reference_works_without_any_adapter() {
    let desk = Desk::new();
    let nowhere = [("WGPU_BACKEND", "dx12"), ("WGPU_ADAPTER_NAME", "nonesuch")];
    let run = desk.run_with(&nowhere, "render furnace -o a.png --size 24x14 --quality reference");
    assert!(run.success, "{}", run.err);
    let run = desk.run_with(&nowhere, "render furnace -o a.exr --size 24x14 --quality reference");
    assert!(run.success, "{}", run.err);
    let picture = read_exr(&desk.path("a.exr")).unwrap();
    // The furnace: 0.5 everywhere, to the rounding of f32.
    assert!(picture.channel("G").unwrap().iter().all(|value| (value - 0.5).abs() < 1e-6));
    assert!(picture.chromaticities.is_some());
    let run = desk.run_with(&nowhere, "colour --thickness 300 --cos 1 --quality reference");
    assert!(run.success && run.out.lines().count() == 2, "{}", run.err);
}

#[test]
fn pictures_have_their_size_and_equal_runs_equal_bytes() {
    let desk = Desk::new();
    for name in ["a.png", "b.png", "a.exr", "b.exr"] {
        if desk.done(&format!("render default -o {name} --size 64x36 --time 0.1")).is_none() {
            return;
        }
    }
    let bytes = |name: &str| std::fs::read(desk.path(name)).unwrap();
    assert!(bytes("a.png") == bytes("b.png") && bytes("a.exr") == bytes("b.exr"));
    let png = read_png(&desk.path("a.png")).unwrap();
    assert_eq!((png.width, png.height), (64, 36));
    assert_eq!(png.metadata.get("Scene"), Some("default"));
    let exr = read_exr(&desk.path("a.exr")).unwrap();
    assert_eq!((exr.width, exr.height), (64, 36));
    assert_eq!(exr.chromaticities.unwrap()[0], [0.64, 0.33]);
    assert_eq!(desk.files(), ["a.exr", "a.png", "b.exr", "b.png"]);
}

#[test]
fn a_plan_and_its_cost_are_told() {
    let desk = Desk::new();
    let Some(run) = desk.done("render default -o a.png --size 64x36 --time 0.1 --explain --repeat 2 --stats s.json")
    else {
        return;
    };
    for pass in ["bake_table", "seed_field", "step_field", "draw", "tonemap", "nothing there yet"] {
        assert!(run.out.contains(pass), "{pass} is not in {}", run.out);
    }
    let stats = json(&desk.path("s.json"));
    has_keys(
        &stats,
        &[
            "adapter",
            "driver",
            "passes",
            "dispatches",
            "draws",
            "pixels_shaded",
            "cells_stepped",
            "bytes_uploaded",
            "pipelines_made",
            "cpu_ms_per_frame",
            "wall_ms_per_frame",
        ],
    );
    assert!(stats["cells_stepped"].as_u64().unwrap() >= 6 * 6 * 256 * 256);
    assert!(stats["cpu_ms_per_frame"].as_f64().unwrap() > 0.0);
}

#[test]
fn transport_reports_its_norms() {
    let desk = Desk::new();
    let arguments =
        "transport --wind nd --tracer cb --cells 16 --steps 20 -o cells.csv --map map.png --json norms.json";
    if desk.done(arguments).is_none() {
        return;
    }
    let norms = json(&desk.path("norms.json"));
    has_keys(
        &norms,
        &[
            "l1",
            "l2",
            "linf",
            "mass_drift",
            "min",
            "max",
            "steps",
            "cells",
            "remaps",
            "scheme",
            "wall_ms_per_step",
            "cpu_ms_per_step",
            "copy_ms_per_step",
        ],
    );
    assert_eq!((norms["cells"].as_u64(), norms["steps"].as_u64()), (Some(6 * 16 * 16), Some(20)));
    let csv = std::fs::read_to_string(desk.path("cells.csv")).unwrap();
    let map = read_png(&desk.path("map.png")).unwrap();
    // Bells stand on the equator, 30° either side of the middle.
    let at = |x: usize, y: usize| map.rgba[4 * (y * 800 + x)];
    assert!(at(333, 200) > 50 && at(467, 200) > 50 && at(10, 200) < 40 && at(333, 20) < 40);
    assert!(csv.starts_with("x,y,z,area,value\n") && csv.lines().count() == 1 + 6 * 16 * 16);
    let area: f64 = csv.lines().skip(1).map(|line| line.split(',').nth(3).unwrap().parse::<f64>().unwrap()).sum();
    assert!((area - 4.0 * std::f64::consts::PI).abs() < 1e-9, "{area}");
}

fn json(path: &Path) -> serde_json::Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn has_keys(value: &serde_json::Value, keys: &[&str]) {
    for key in keys {
        assert!(value.get(key).is_some(), "no key `{key}` in {value}");
    }
}

#[test]
fn info_names_adapters_and_limits() {
    let desk = Desk::new();
    let Some(text) = desk.done("info --json info.json") else { return };
    let keys = ["adapters", "adapter", "driver", "features", "limits"];
    has_keys(&json(&desk.path("info.json")), &keys);
    assert!(text.out.contains("\nuses ") && !text.out.contains('{'), "people read text: {}", text.out);
    assert_eq!(desk.done("info").unwrap().out, text.out);
    let printed: serde_json::Value = serde_json::from_str(&desk.done("info --json").unwrap().out).unwrap();
    has_keys(&printed, &keys);
}

#[test]
fn presets_are_listed_with_a_sentence() {
    let desk = Desk::new();
    let text = desk.run("presets").out;
    let list: serde_json::Value = serde_json::from_str(&desk.run("presets --json").out).unwrap();
    let list = list.as_array().unwrap();
    let count = soapfilm::scene::preset_names().len();
    assert_eq!((list.len(), text.lines().count()), (count, count));
    for (line, preset) in text.lines().zip(list) {
        let [name, sentence] = ["name", "sentence"].map(|key| preset[key].as_str().unwrap());
        assert!(line.starts_with(name) && line.ends_with(sentence) && sentence.ends_with('.'), "{line}");
    }
    assert!(text.starts_with("default "));
}
