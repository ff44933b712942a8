//! Slips of the fingers, and what helps.

use super::Desk;

#[test]
fn mistakes_are_answered_with_what_was_meant() {
    let desk = Desk::new();
    for (arguments, told) in [
        ("rendre", "did you mean `render`?"),
        ("rendre default -o a.png", "did you mean `render`?"),
        ("windws", "did you mean `windows`?"),
        ("qqqqqq", "commands: app, render"),
        ("render windws -o a.png", "did you mean `windows`?"),
        ("render default -o a.png --sise 3x3", "a similar argument exists: '--size'"),
        ("render default -o a.png --time -1", "use 0 or later"),
        ("render default -o a.png --time nan", "'nan' for '--time <SECONDS>': not a finite number"),
        ("render default -o a.png --size -3x3", "`-3` is not a number of pixels"),
        ("sequence default -o d --frames 5..2", "the first frame, 5, comes after the last, 2"),
        ("sequence default -o d --frames -1..2", "A..B, like 0..299"),
        ("sequence default -o d --frames 0..1 --format pgn", "[possible values: png, exr]"),
        ("flow --case poisson --cells 32 --k 1e300", "use -1000000 to 1000000"),
        ("flow --case poisson --cells -3", "-3 is not in 16..=512"),
        ("flow --case sloshing --cells 32 --drag -1", "use 0 to 1000000"),
        ("flow --case sloshing --cells 32 --stratification 1e9", "use -20 to 20"),
        ("colour --thickness 300 --cos -1", "a cosine lies between 0 and 1"),
        (
            "render default -o a.png --set view.exposure=2",
            "--set view.exposure=2: unknown key `exposure` in [view]; did you mean `exposure_ev`?",
        ),
        ("render default -o a.png --set view.exposure_ev", "KEY=VALUE"),
        (
            "sequence default -o d --frames 0..1 --set light.illuminant=D66",
            "--set light.illuminant=D66: `illuminant` in [light]",
        ),
        (
            "app default --set camera.fov=3",
            "--set camera.fov=3: unknown key `fov` in [camera]; did you mean `fov_y_deg`?",
        ),
    ] {
        let line = desk.refused(arguments);
        assert!(line.contains(told), "`{arguments}` says: {line}");
    }
}

#[test]
fn settings_change_the_picture() {
    let desk = Desk::new();
    let render = |name: &str, settings: &str| {
        let run = desk.run(&format!("render furnace -o {name} --size 16x9 --quality reference {settings}"));
        assert!(run.success, "{}", run.err);
        soapfilm::output::read_back::read_exr(&desk.path(name)).unwrap().channel("G").unwrap().to_vec()
    };
    let (plain, brighter) =
        (render("a.exr", ""), render("b.exr", "--set light.constant=[2,2,2] --set view.dither=false"));
    assert!(plain.iter().zip(&brighter).all(|(a, b)| (b - 4.0 * a).abs() < 1e-5), "0.5 and 2 everywhere");
}

/// What cannot be drawn is refused before the first frame.
#[test]
fn a_sequence_is_drawn_whole_or_not_at_all() {
    let desk = Desk::new();
    desk.write("below.toml", "version = 1\n[camera]\nelevation_deg = -9\n[[bubble]]\nboundary = \"bath\"\n");
    let line = desk.refused("sequence below.toml -o frames --frames 0..90 --size 32x18");
    assert!(line.contains("below.toml:3: `elevation_deg` in [camera] looks from below the bath"), "{line}");
    // A camera that is above it at the start and at the end.
    let keyframes: String = [(0, 9), (1, -9), (2, 9)]
        .map(|(time_s, deg)| format!("[[camera.keyframe]]\ntime_s = {time_s}\nelevation_deg = {deg}\n"))
        .concat();
    desk.write("dips.toml", format!("version = 1\n{keyframes}[[bubble]]\nboundary = \"bath\"\n"));
    let line = desk.refused("sequence dips.toml -o frames --frames 0..120 --size 32x18");
    assert!(line.contains("looks from below the bath") && line.contains(" s; raise it"), "{line}");
    assert!(!desk.path("frames").exists());
}
