//! Videos by command.

#[cfg(unix)]
use std::os::unix::fs::PermissionsExt;
use std::process::Command;

use soapfilm::output::read_back::read_png;

use super::*;
use crate::support::REQUIRE_ADAPTER;

const SMALL: &str = "--size 32x18 --fps 10 --set bubble.0.film.cells=64";

/// The frames of an animated PNG are the pictures of a folder, bit by bit.
#[test]
fn an_animated_png_holds_the_frames_of_a_folder() {
    let desk = Desk::new();
    if desk.done(&format!("sequence default -o all.apng --frames 1..3 {SMALL}")).is_none() {
        return;
    }
    desk.done(&format!("sequence default -o frames --frames 1..3 {SMALL}")).unwrap();
    let file = std::io::BufReader::new(std::fs::File::open(desk.path("all.apng")).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    for frame in 1..=3 {
        let mut rgba = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut rgba).unwrap();
        assert!(rgba == read_png(&desk.path(&format!("frames/frame_{frame:06}.png"))).unwrap().rgba, "frame {frame}");
    }
    desk.done(&format!("sequence default -o all.gif --frames 1..3 {SMALL}")).unwrap();
    assert_eq!(desk.files(), ["all.apng", "all.gif", "frames"], "and nothing else is left");
}

/// What stands in for ffmpeg: it lists its encoders, then writes what it reads, as it is told, to its last argument.
#[cfg(unix)]
const FAKE: &str = "#!/bin/sh
case \"$*\" in *-encoders*) echo ' V libx264 V libvpx-vp9'; exit;; esac
for last; do :; done
echo \"$*\" >&2
";

#[cfg(unix)]
impl Desk {
    /// Runs the program where `ffmpeg` is a script.
    fn run_with_ffmpeg(&self, script: &str, arguments: &str) -> Run {
        let tools = tempfile::tempdir().unwrap();
        let path = tools.path().join("ffmpeg");
        std::fs::write(&path, script).unwrap();
        std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o755)).unwrap();
        let search = format!("{}:/usr/bin:/bin", tools.path().display());
        self.run_with(&[("PATH", &search)], arguments)
    }
}

#[test]
#[cfg(unix)]
fn an_mp4_goes_through_ffmpeg() {
    let desk = Desk::new();
    let reference = "--quality reference --size 16x8 --fps 24000/1001";
    let run = desk.run_with_ffmpeg(
        &format!("{FAKE}cat >\"$last\""),
        &format!("sequence furnace -o a.mp4 --frames 0..2 {reference}"),
    );
    assert!(run.success, "{}", run.err);
    assert_eq!(
        std::fs::read(desk.path("a.mp4")).unwrap().len(),
        3 * 16 * 8 * 4,
        "three frames of four bytes per pixel"
    );

    // Its words are told, and half a file is not left.
    let fails = format!("{FAKE}head -c 100 >\"$last\"; echo 'Unknown encoder' >&2; exit 8");
    let run = desk.run_with_ffmpeg(&fails, &format!("sequence furnace -o b.webm --frames 0..2 {reference}"));
    assert!(!run.success && run.err.contains("b.webm: ffmpeg failed (exit status: 8): Unknown encoder"), "{}", run.err);
    let run = desk.run_with_ffmpeg("#!/bin/sh\n", &format!("sequence furnace -o b.mp4 --frames 0..2 {reference}"));
    assert!(!run.success && run.err.contains("lacks the encoder libx264"), "{}", run.err);
    assert_eq!(desk.files(), ["a.mp4"]);
}

#[test]
fn what_no_video_holds_is_refused_before_the_first_frame() {
    let desk = Desk::new();
    for (arguments, told) in [
        ("-o a.gif --fps 60", "--fps 50"),
        ("-o a.gif --alpha", ".apng"),
        ("-o a.gif --gamut p3", "sRGB"),
        ("-o a.mp4 --size 33x18", "use 32x18"),
        ("-o a.mp4 --alpha", ".webm"),
        ("-o a.webm --layers", "--format exr"),
        ("-o a.apng --format exr", "give a folder"),
        ("-o nowhere/a.gif", "nowhere does not exist"),
    ] {
        let line = desk.refused(&format!("sequence nonesuch --frames 0..3 {arguments}"));
        assert!(line.contains(told), "{arguments}: {line}");
    }
    let line = desk.refused_with(&[("PATH", "/nowhere")], "sequence nonesuch -o a.mp4 --frames 0..3");
    assert!(line.contains("install") && line.contains(".gif"), "{line}");
}

/// The real one, where there is one.
#[test]
fn an_mp4_plays_with_the_colours_of_its_frames() {
    let has = |tool: &str| Command::new(tool).arg("-version").output().is_ok();
    if !has("ffmpeg") || !has("ffprobe") {
        eprintln!("skipped: ffmpeg is not installed");
        return;
    }
    let desk = Desk::new();
    // Large areas of saturated colour, which no loss of detail changes.
    let scene = "furnace --quality reference --size 64x32 --set light.constant=[0.7,0.2,0.05] --set bubble=[]";
    let run = desk.run(&format!("sequence {scene} -o a.mp4 --frames 0..4 --fps 24000/1001"));
    assert!(run.success, "{}", run.err);
    desk.run(&format!("render {scene} -o a.png"));
    let tool = |name: &str, arguments: &str| {
        let run = Command::new(name).current_dir(desk.path("")).args(arguments.split(' ')).output().unwrap();
        String::from_utf8(run.stdout).unwrap()
    };
    let told = tool("ffprobe", "-v error -show_streams a.mp4");
    for line in [
        "pix_fmt=yuv420p",
        "color_range=tv",
        "color_space=bt709",
        "color_primaries=bt709",
        "color_transfer=bt709",
        "nb_frames=5",
        "r_frame_rate=24000/1001",
    ] {
        assert!(told.contains(line), "{line}: {told}");
    }
    tool("ffmpeg", "-v error -i a.mp4 -frames:v 1 -pix_fmt rgba shown.png");
    let [meant, shown] = ["a.png", "shown.png"].map(|name| read_png(&desk.path(name)).unwrap().rgba);
    let furthest = meant.iter().zip(&shown).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    // 219 steps of luminance for 256; the matrix of old television would be off by some twenty.
    assert!(furthest <= 4, "{furthest}");
}

/// A run that is told to end takes its half-written video with it, and ffmpeg ends too.
#[test]
#[cfg(target_os = "linux")]
fn an_interrupted_video_leaves_nothing() {
    let desk = Desk::new();
    let mut command = Command::new(env!("CARGO_BIN_EXE_soapfilm"));
    command.current_dir(desk.path("")).stderr(std::process::Stdio::null());
    if let Ok(name) = std::env::var(REQUIRE_ADAPTER) {
        command.env("WGPU_ADAPTER_NAME", name);
    }
    let arguments = "sequence furnace -o a.gif --frames 0..99999 --quality reference --size 16x8";
    let mut program = command.args(arguments.split(' ')).spawn().unwrap();
    let started = std::time::Instant::now();
    while started.elapsed().as_secs() < 60 && desk.files().is_empty() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    assert_ne!(desk.files(), ["a.gif"], "the run is over before it was interrupted");
    assert!(Command::new("kill").args(["-s", "TERM", &program.id().to_string()]).status().unwrap().success());
    program.wait().unwrap();
    assert_eq!(desk.files(), [] as [&str; 0]);
}
