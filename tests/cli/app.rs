//! The real window, driven as a person would: under a virtual X server, with pointer and keys, judged by screenshots.
//!
//! Needs Xvfb, xdotool and ImageMagick's `import`. Without them the test says that it was skipped, and fails where
//! `SOAPFILM_REQUIRE_WINDOW=1` demands it.

use std::{thread::sleep, time::Duration};

use crate::screen::{MIDDLE, PANELS, Screen, colourfulness, difference, is_plain, mean, pixels, tools_are_there};

/// Time over which an idle window is watched.
const WATCHED: Duration = Duration::from_secs(3);
/// Processor time that an idle window may take of it: 5 %. The toolkit's own wake-ups need a tenth of that.
const IDLE_JIFFIES: u64 = 15;

/// A film on which nothing acts, so that what moves was moved by hand.
const STILL: &str = "version = 1
[[bubble]]
film.state = \"rest\"
film.cells = 32
[motion]
strength = 0
gravity_m_s2 = [0, 0, 0]
drag_1_s = 8
[view]
dither = false
";

#[test]
fn a_film_is_stirred_and_a_bubble_is_moved() {
    if !tools_are_there() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("still.toml");
    std::fs::write(&scene, STILL).unwrap();
    let mut screen = Screen::open(&["app", scene.to_str().unwrap()]);
    // The panels and the time line show the time that passes.
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 4.0).then_some(()));
    screen.press("F11");
    let still = screen.settled("a film at rest while time runs", |shot| is_plain(shot, PANELS));

    screen.press("2");
    let go = |screen: &Screen, x: i32| screen.point_at([x, 400]);
    go(&screen, 540);
    // To and fro until it is seen: a busy machine may let little film time pass, and shows coarse pictures while it is stirred.
    let stirred = (0..20).find_map(|_| {
        screen.act(&["mousedown", "1"]);
        (0..24).for_each(|step| go(&screen, 540 + 200 * (step % 5) / 4));
        screen.act(&["mouseup", "1"]);
        screen.press("space");
        let shot = screen.rested("a film that stands", |_| true);
        let is_stirred = difference(MIDDLE, &still, &shot) > 2.0;
        if !is_stirred {
            screen.press("space");
        }
        is_stirred.then_some(shot)
    });
    let stirred = stirred.expect("a stirred film that stands");
    assert!(difference([0, 100, 60, 600], &still, &stirred) < 0.01, "the camera stands");

    screen.press("space");
    screen.press("4");
    go(&screen, 640);
    screen.act(&["mousedown", "1"]);
    let left_of_it = [330, 300, 80, 200];
    screen.wait_for("a moved bubble", |screen| {
        go(screen, 840);
        let around = mean(pixels(&screen.shot(), left_of_it).iter().map(|[r, g, b]| f64::from(*r.max(g).max(b))));
        (around < 20.0).then_some(())
    });
    screen.act(&["mouseup", "1"]);

    screen.press("ctrl+q");
    screen.settled("a question before work is lost", |shot| difference(MIDDLE, &stirred, shot) > 2.0);
    screen.press("Escape");
    (0..20).for_each(|_| screen.press("ctrl+z"));
    screen.wait_for("the first state", |screen| (!screen.title().ends_with("(edited)")).then_some(()));
    screen.press("ctrl+q");
    screen.ends_well();
}

/// A few large bubbles of a generator, all alike, and a camera that follows the pointer.
const FOLLOWED: &str = "version = 1
bubble = []
[[generator]]
count = 5
films = 1
radius_mm = 30
size_m = [0.3, 0.3, 0.3]
film.state = \"uniform\"
[camera]
distance_m = 0.8
follow_deg = 60
[view]
dither = false
";

#[test]
fn a_camera_follows_the_pointer_and_generators_have_a_panel() {
    if !tools_are_there() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("followed.toml");
    std::fs::write(&scene, FOLLOWED).unwrap();
    let mut screen = Screen::open(&["app", scene.to_str().unwrap()]);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 1.0).then_some(()));
    screen.press("space");
    let go = |screen: &Screen, x: i32| screen.point_at([x, 400]);
    go(&screen, 480);
    sleep(Duration::from_secs(2));
    let before = screen.shot();
    screen.wait_for("a camera that follows", |screen| {
        (0..5).for_each(|step| go(screen, 480 + 60 * step));
        sleep(Duration::from_secs(1));
        (difference(MIDDLE, &before, &screen.shot()) > 1.0).then_some(())
    });
    assert!(!screen.title().ends_with("(edited)"), "looking around changes no work");

    // The title of the panel, which folds it away.
    let (title, panel) = ([1020, 184], [980, 195, 290, 450]);
    let open = screen.shot();
    screen.point_at(title);
    screen.act(&["click", "1"]);
    screen.wait_for("a folded panel", |screen| (difference(panel, &open, &screen.shot()) > 2.0).then_some(()));
    screen.press("ctrl+q");
    screen.ends_well();
}

#[test]
fn work_survives_a_crash_and_is_saved_by_its_path() {
    if !tools_are_there() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let [scene, other] = ["still.toml", "other.toml"].map(|name| folder.path().join(name));
    std::fs::write(&scene, STILL).unwrap();
    let arguments = ["app", scene.to_str().unwrap()];
    let mut screen = Screen::open(&arguments);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 4.0).then_some(()));
    screen.press("Right");
    screen.wait_for("an edited scene", |screen| screen.title().ends_with("(edited)").then_some(()));
    screen.wait_for("kept work", Screen::kept);

    screen.crash(&arguments);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 4.0).then_some(()));
    assert!(!screen.title().ends_with("(edited)"), "the work is offered first");
    screen.press("Return");
    screen.wait_for("the recovered scene", |screen| screen.title().ends_with("(edited)").then_some(()));

    // Where no dialog can ask for a path, it is typed, once the window asks.
    let before = screen.shot();
    screen.press("ctrl+shift+s");
    let typed = other.to_str().unwrap();
    screen.wait_for("a question", |screen| (difference(MIDDLE, &before, &screen.shot()) > 10.0).then_some(()));
    screen.press("ctrl+a");
    screen.act(&["type", typed]);
    screen.press("Return");
    screen.wait_for("the other file", |_| other.exists().then_some(()));
    let saved = std::fs::read_to_string(&other).unwrap();
    assert!(saved.contains("gravity_m_s2"), "{saved}");
    screen.wait_for("a saved scene", |screen| (screen.title() == format!("soapfilm – {typed}")).then_some(()));
    assert_eq!(std::fs::read_to_string(&scene).unwrap(), STILL, "the first file is as it was");
    screen.wait_for("no kept work", |screen| screen.kept().is_none().then_some(()));
    screen.press("ctrl+q");
    screen.ends_well();
}

#[test]
fn a_window_shows_a_bubble_obeys_and_rests() {
    if !tools_are_there() {
        return;
    }
    // As a file: while a preset's first picture is drawn, a smaller one stands in, which must not be taken for it.
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("windows.toml");
    std::fs::write(&scene, soapfilm::scene::preset_toml("windows").unwrap()).unwrap();
    let mut screen = Screen::open(&["app", scene.to_str().unwrap()]);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 8.0).then_some(()));

    screen.press("space");
    screen.point_at([500, 400]);
    let paused = screen.rested("a paused picture", |_| true);

    // On a busy machine the last of the work may come after the picture.
    screen.wait_for("a window at rest", |screen| {
        let before = screen.jiffies();
        sleep(WATCHED);
        (screen.jiffies() - before <= IDLE_JIFFIES).then_some(())
    });

    screen.drag([500, 400], [200, 60]);
    let turned = screen.rested("a view that a drag has turned", |shot| difference(MIDDLE, &paused, shot) > 2.0);
    assert!(screen.title().ends_with("(edited)"));

    screen.press("h");
    screen.rested("a picture without panels", |shot| difference(PANELS, &turned, shot) > 2.0);
    screen.press("h");
    screen.rested("the panels' return", |shot| difference(PANELS, &turned, shot) < 1.0);

    for (width, height) in [(200, 150), (1, 1), (1280, 800)] {
        screen.resize(width, height);
        sleep(Duration::from_millis(400));
    }
    screen.rested("the picture as it was, at its size", |shot| difference(MIDDLE, &turned, shot) < 1.0);

    // Debug builds can lose their device at a key.
    if cfg!(debug_assertions) {
        screen.press("F12");
        sleep(Duration::from_millis(400));
        screen.settled("the picture on the new device", |shot| difference(MIDDLE, &turned, shot) < 1.0);
    }

    screen.press("ctrl+z");
    // A drag is one step, and is taken back whole.
    screen.settled("the picture before the drag", |shot| difference(MIDDLE, &paused, shot) < 1.0);

    screen.press("ctrl+q");
    screen.ends_well();
}
