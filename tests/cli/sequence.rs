//! Numbered pictures by command.

use soapfilm::output::read_back::{read_exr, read_png};

use super::*;

/// A frame is a pure function of the scene and its time: drawn alone, or after others that cut the film's history into frames.
#[test]
fn a_frame_alone_is_the_frame_of_a_run() {
    let desk = Desk::new();
    let size = "--size 64x36 --fps 7 --set bubble.0.film.cells=64";
    if desk.done(&format!("sequence default -o run --frames 0..5 {size}")).is_none() {
        return;
    }
    desk.done(&format!("sequence default -o alone --frames 5..5 {size}")).unwrap();
    let bytes = |path: &str| std::fs::read(desk.path(path)).unwrap();
    assert_eq!(bytes("run/frame_000005.png"), bytes("alone/frame_000005.png"));
    assert_ne!(bytes("run/frame_000000.png"), bytes("run/frame_000005.png"), "the film moves");
    let before = std::fs::metadata(desk.path("alone/frame_000005.png")).unwrap().modified().unwrap();
    let again = desk.done(&format!("sequence default -o alone --frames 5..5 {size}")).unwrap();
    assert!(again.err.contains("already existed"), "{}", again.err);
    assert_eq!(std::fs::metadata(desk.path("alone/frame_000005.png")).unwrap().modified().unwrap(), before);
}

/// A sequence takes the options of a picture, and its frames are the pictures of their moments.
#[test]
fn sequences_take_the_options_of_pictures() {
    let desk = Desk::new();
    // Nobody sees a bar where stderr is no terminal.
    let run =
        desk.run("sequence furnace -o run --frames 0..1 --quality reference --size 16x9 --format exr --fps 24000/1001");
    assert!(run.success && run.err.is_empty(), "{}", run.err);
    let frame = read_exr(&desk.path("run/frame_000001.exr")).unwrap();
    assert_eq!((frame.frames_per_second, frame.time_code), (Some([24000, 1001]), Some([0, 0, 0, 1])));
    assert_eq!(frame.metadata.get("Time"), Some(format!("{} s", 1001.0 / 24000.0).as_str()));
    let small = "--size 32x18 --set bubble.0.film.cells=64";
    for options in ["--quality spectral", "--gamut p3", "--quality fast"] {
        if desk.done(&format!("sequence default -o run --frames 3..3 --fps 10 --overwrite {small} {options}")).is_none()
        {
            return;
        }
        desk.done(&format!("render default -o once.png --time 0.3 {small} {options}")).unwrap();
        let pixels = |path: &str| read_png(&desk.path(path)).unwrap().rgba;
        assert_eq!(pixels("run/frame_000003.png"), pixels("once.png"), "{options}");
    }
}

/// A history that was saved as a scene replays bit by bit: as one picture, and as a frame of a run.
#[test]
fn a_saved_history_replays() {
    let desk = Desk::new();
    let events = "[[event]]\ntick = 20\nkind = \"motion\"\nflow = \"sloshing\"\nspin_deg_s = [0.0, 0.0, 40.0]\n\
                  [[event]]\ntick = 45\nkind = \"motion\"\nflow = \"stirred\"\nstrength = 1.5\nevaporation_nm_s = 9.0\n";
    desk.write("saved.toml", format!("version = 1\n[[bubble]]\n[bubble.film]\ncells = 32\n{events}"));
    if desk.done("render saved.toml -o once.png --size 64x36 --time 1.5").is_none() {
        return;
    }
    desk.done("sequence saved.toml -o run --frames 7..9 --fps 6 --size 64x36").unwrap();
    let pixels = |path: &str| read_png(&desk.path(path)).unwrap().rgba;
    assert_eq!(pixels("run/frame_000009.png"), pixels("once.png"));

    let Some(mut renderer) = support::renderer() else { return };
    let loaded = support::load(desk.path("saved.toml").to_str().unwrap());
    for time_s in [0.2, 1.0, 0.4, 1.4] {
        support::display(&mut renderer, &support::still(&loaded, [64, 36], time_s));
    }
    let mut request = support::still(&loaded, [64, 36], 1.5);
    request.picture.draw.full_precision = false;
    assert_eq!(support::display(&mut renderer, &request), pixels("once.png"), "another process, after scrubbing");
}

/// The template for render farms, which others run.
const FARM: &str = include_str!("../../assets/openjd/sequence.yaml");

#[test]
fn the_farms_template_uses_options_that_there_are() {
    let help = Desk::new().run("sequence --help").out;
    let lines = FARM.lines().filter_map(|line| line.trim().strip_prefix("- "));
    let options: Vec<_> = lines.filter(|word| word.starts_with('-')).collect();
    assert_eq!(options, ["-o", "--frames", "--fps", "--size", "--samples", "--format"]);
    assert!(options.iter().all(|option| help.contains(&format!("{option} <"))), "{help}");
}

/// Runs where `openjd` of the Python package `openjd-cli` is installed, or `OPENJD` names it: then it must be there.
#[test]
fn a_sequence_cut_over_machines_is_that_of_one() {
    let named = std::env::var_os("OPENJD");
    let openjd = named.clone().unwrap_or("openjd".into());
    if let Err(error) = Command::new(&openjd).arg("--help").output() {
        assert!(named.is_none(), "{}: {error}", openjd.display());
        eprintln!("skipped: openjd is not installed");
        return;
    }
    let desk = Desk::new();
    desk.write("small.toml", "version = 1\n[[bubble]]\n[bubble.film]\ncells = 32\n");
    desk.write("sequence.yaml", FARM);
    let scene = desk.path("small.toml").display().to_string();
    if desk.done(&format!("sequence {scene} -o one --frames 0..4 --fps 10 --size 32x18")).is_none() {
        return;
    }
    let (farm, program) = (desk.path("farm").display().to_string(), env!("CARGO_BIN_EXE_soapfilm"));
    let parameters = ["Frames=0-4", "FramesPerTask=2", "FramesPerSecond=10", "Size=32x18"].map(str::to_owned);
    let places = [format!("Scene={scene}"), format!("Output={farm}"), format!("Soapfilm={program}")];
    let mut command = Command::new(&openjd);
    command.args(["run", "sequence.yaml"]).current_dir(desk.path(""));
    command.args(parameters.iter().chain(&places).flat_map(|parameter| ["-p", parameter.as_str()]));
    let run = command.output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stdout));
    for frame in 0..=4 {
        let bytes = |folder: &str| std::fs::read(desk.path(&format!("{folder}/frame_{frame:06}.png"))).unwrap();
        assert!(bytes("one") == bytes("farm"), "frame {frame}");
    }
}

/// A picture of a moment is that of a camera that stands where the keyframes have it then; pictures of a sequence are too.
#[test]
fn keyframes_move_the_camera_of_every_picture() {
    let desk = Desk::new();
    desk.write("turntable.toml", include_str!("../data/turntable.toml"));
    // Even light, so that no surroundings are computed, and a bubble beside another, so that each azimuth looks different.
    let scene = "--size 64x36 --set light.constant=[1,1,1] --set view.quality=fast \
                 --set bubble=[{film={state='uniform'}},{center_m=[0.06,0,0],radius_mm=9,film={state='uniform'}}]";
    let moments =
        [(4, "azimuth_deg=180,elevation_deg=30,distance_m=0.2"), (7, "azimuth_deg=315,elevation_deg=0,distance_m=0.4")];
    let bytes = |path: &str| std::fs::read(desk.path(path)).unwrap();
    let mut seen = Vec::new();
    for (time_s, camera) in moments {
        let Some(_) = desk.done(&format!("render turntable.toml -o moved.png --time {time_s} {scene}")) else { return };
        let stands = format!("--set camera={{{camera}}}");
        desk.done(&format!("render turntable.toml -o stands.png --time {time_s} {scene} {stands}"));
        assert!(bytes("moved.png") == bytes("stands.png"), "at {time_s} s");
        seen.push(bytes("moved.png"));
    }
    assert!(seen[0] != seen[1], "the camera moves");
    desk.done(&format!("sequence turntable.toml -o run --frames 7..7 --fps 1 {scene}"));
    let [frame, moved] = ["run/frame_000007.png", "moved.png"].map(|path| read_png(&desk.path(path)).unwrap().rgba);
    assert!(frame == moved);
}
