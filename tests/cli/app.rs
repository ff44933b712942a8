//! The real window, driven as a person would: under a virtual X server, with pointer and keys, judged by screenshots.
//!
//! Needs Xvfb, xdotool and ImageMagick's `import`. Without them the test says that it was skipped, and fails where
//! `SOAPFILM_REQUIRE_WINDOW=1` demands it.

use std::{
    io::{BufRead, BufReader},
    process::{Child, Command, Output, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use image::RgbImage;

use crate::support::{REQUIRE_WINDOW, has_tools};

/// What a software rasteriser on a busy machine may take for its first picture.
const PATIENCE: Duration = Duration::from_secs(120);
/// Time over which an idle window is watched.
const WATCHED: Duration = Duration::from_secs(3);
/// Processor time that an idle window may take of it: 5 %. The toolkit's own wake-ups need a tenth of that.
const IDLE_JIFFIES: u64 = 15;

/// A process that does not outlive its test.
struct Guarded(Child);

impl Drop for Guarded {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A virtual screen, and the program on it.
struct Screen {
    display: String,
    program: Guarded,
    window: String,
    _server: Guarded,
    /// Where the program keeps settings and unsaved work: not where its user does.
    home: tempfile::TempDir,
}

impl Screen {
    fn open(arguments: &[&str]) -> Self {
        let (server, display) = start_server();
        let home = tempfile::tempdir().unwrap();
        let program = start(arguments, &display, &home);
        let mut screen = Self { display, program, window: String::new(), _server: server, home };
        screen.find_window();
        screen
    }

    fn find_window(&mut self) {
        self.window = self.wait_for("a window", |screen| {
            let found = screen.tool(&["search", "--onlyvisible", "--name", "soapfilm"]);
            String::from_utf8(found.stdout).ok()?.lines().next().map(str::to_owned)
        });
    }

    /// Kills the program so that it can do nothing about it, and starts it again.
    fn crash(&mut self, arguments: &[&str]) {
        self.program.0.kill().unwrap();
        self.program.0.wait().unwrap();
        self.program = start(arguments, &self.display, &self.home);
        self.find_window();
    }

    fn title(&self) -> String {
        String::from_utf8(self.tool(&["getwindowname", &self.window]).stdout).unwrap().trim().to_owned()
    }

    /// What is kept of work that is not saved.
    fn kept(&self) -> Option<String> {
        let folder = std::fs::read_dir(self.home.path().join("soapfilm/unsaved")).ok()?;
        let mut files = folder.flatten().filter(|file| file.path().extension().is_some_and(|ending| ending == "toml"));
        std::fs::read_to_string(files.next()?.path()).ok()
    }

    fn tool(&self, arguments: &[&str]) -> Output {
        Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output().unwrap()
    }

    fn act(&self, arguments: &[&str]) {
        let output = self.tool(arguments);
        assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        sleep(Duration::from_millis(60));
    }

    /// Presses a key in the window. There is no window manager that would give it the focus.
    fn press(&self, key: &str) {
        self.act(&["windowfocus", "--sync", &self.window]);
        self.act(&["key", key]);
    }

    fn drag(&self, from: [i32; 2], by: [i32; 2]) {
        let go = |x: i32, y: i32| self.act(&["mousemove", &x.to_string(), &y.to_string()]);
        go(from[0], from[1]);
        self.act(&["mousedown", "1"]);
        for step in 1..=8 {
            go(from[0] + by[0] * step / 8, from[1] + by[1] * step / 8);
        }
        self.act(&["mouseup", "1"]);
    }

    fn resize(&self, width: u32, height: u32) {
        self.act(&["windowsize", &self.window, &width.to_string(), &height.to_string()]);
    }

    fn shot(&self) -> RgbImage {
        let output =
            Command::new("import").args(["-window", "root", "png:-"]).env("DISPLAY", &self.display).output().unwrap();
        image::load_from_memory(&output.stdout).unwrap().into_rgb8()
    }

    /// Looks again and again until there is what is looked for.
    fn wait_for<T>(&mut self, what: &str, look: impl Fn(&Self) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(status) = self.program.0.try_wait().unwrap() {
                panic!("soapfilm ended ({status}) while {what} was awaited");
            }
            if let Some(found) = look(self) {
                return found;
            }
            assert!(start.elapsed() < PATIENCE, "{what} did not come");
            sleep(Duration::from_millis(200));
        }
    }

    /// The screen once it shows a bubble and what is looked for, and nothing moves any more. A window may answer late, so that a screen that stands
    /// still may be the one before.
    fn settled(&mut self, what: &str, is_there: impl Fn(&RgbImage) -> bool) -> RgbImage {
        self.wait_for(what, |screen| {
            let first = screen.shot();
            sleep(Duration::from_millis(600));
            let second = screen.shot();
            (colourfulness(&second) > 8.0 && first == second && is_there(&second)).then_some(second)
        })
    }

    /// Processor time of all the program's threads so far, in jiffies.
    fn jiffies(&self) -> u64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.program.0.id())).unwrap();
        // The name in brackets may hold spaces; user and system time are the 12th and 13th field after it.
        let fields = stat.rsplit_once(')').unwrap().1.split_whitespace().skip(11);
        fields.take(2).map(|field| field.parse::<u64>().unwrap()).sum()
    }

    fn ends_well(&mut self) {
        let start = Instant::now();
        while start.elapsed() < PATIENCE {
            if let Some(status) = self.program.0.try_wait().unwrap() {
                assert!(status.success(), "soapfilm ended with {status}");
                return;
            }
            sleep(Duration::from_millis(50));
        }
        panic!("soapfilm does not end");
    }
}

fn start(arguments: &[&str], display: &str, home: &tempfile::TempDir) -> Guarded {
    let program = Command::new(env!("CARGO_BIN_EXE_soapfilm"))
        .args(arguments)
        .env("DISPLAY", display)
        .env("XDG_CONFIG_HOME", home.path())
        .env("XDG_STATE_HOME", home.path())
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .spawn();
    Guarded(program.unwrap())
}

/// An X server on a display number that it finds free.
fn start_server() -> (Guarded, String) {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map(Guarded)
        .unwrap();
    let mut number = String::new();
    BufReader::new(server.0.stdout.take().unwrap()).read_line(&mut number).unwrap();
    (server, format!(":{}", number.trim()))
}

/// A part of the screen: left, top, width and height.
type Region = [u32; 4];
/// The middle of the picture, which stands left of the panels.
const MIDDLE: Region = [245, 200, 490, 400];
/// The panels.
const PANELS: Region = [1000, 0, 280, 760];

fn pixels(shot: &RgbImage, [x, y, width, height]: Region) -> Vec<[u8; 3]> {
    let region = image::imageops::crop_imm(shot, x, y, width, height).to_image();
    region.pixels().map(|pixel| pixel.0).collect()
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len();
    assert!(count > 0, "nothing to compare");
    values.sum::<f64>() / count as f64
}

/// Mean difference between the largest and the smallest of a pixel's values in the middle.
fn colourfulness(shot: &RgbImage) -> f64 {
    let spread = |[r, g, b]: [u8; 3]| f64::from(r.max(g).max(b) - r.min(g).min(b));
    mean(pixels(shot, MIDDLE).into_iter().map(spread))
}

/// Mean difference between two shots' values in a region.
fn difference(region: Region, a: &RgbImage, b: &RgbImage) -> f64 {
    let apart = |(a, b): ([u8; 3], [u8; 3])| (0..3).map(|i| f64::from(a[i].abs_diff(b[i]))).sum::<f64>() / 3.0;
    mean(pixels(a, region).into_iter().zip(pixels(b, region)).map(apart))
}

/// Whether a region shows one colour.
fn is_plain(shot: &RgbImage, region: Region) -> bool {
    let pixels = pixels(shot, region);
    pixels.iter().all(|pixel| (0..3).all(|i| pixel[i].abs_diff(pixels[0][i]) <= 2))
}

fn tools_are_there() -> bool {
    has_tools(&["Xvfb", "xdotool", "import"], REQUIRE_WINDOW)
}

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
    let go = |screen: &Screen, x: i32| screen.act(&["mousemove", &x.to_string(), "400"]);
    go(&screen, 540);
    screen.act(&["mousedown", "1"]);
    // To and fro until it is seen: a busy machine may let little film time pass.
    screen.wait_for("a stirred film", |screen| {
        (0..8).for_each(|step| go(screen, 540 + 200 * (step % 5) / 4));
        (difference(MIDDLE, &still, &screen.shot()) > 2.0).then_some(())
    });
    screen.act(&["mouseup", "1"]);
    screen.press("space");
    let stirred = screen.settled("a stirred film that stands", |shot| difference(MIDDLE, &still, shot) > 2.0);
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
    let go = |screen: &Screen, x: i32| screen.act(&["mousemove", &x.to_string(), "400"]);
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
    screen.act(&["mousemove", &title[0].to_string(), &title[1].to_string()]);
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
    let mut screen = Screen::open(&["app", "windows"]);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 8.0).then_some(()));

    screen.press("space");
    screen.act(&["mousemove", "500", "400"]);
    let paused = screen.settled("a paused picture", |_| true);

    // On a busy machine the last of the work may come after the picture.
    screen.wait_for("a window at rest", |screen| {
        let before = screen.jiffies();
        sleep(WATCHED);
        (screen.jiffies() - before <= IDLE_JIFFIES).then_some(())
    });

    screen.drag([500, 400], [200, 60]);
    let turned = screen.settled("a view that a drag has turned", |shot| difference(MIDDLE, &paused, shot) > 2.0);
    assert!(screen.title().ends_with("(edited)"));

    screen.press("h");
    screen.settled("a picture without panels", |shot| difference(PANELS, &turned, shot) > 2.0);
    screen.press("h");
    screen.settled("the panels' return", |shot| difference(PANELS, &turned, shot) < 1.0);

    for (width, height) in [(200, 150), (1, 1), (1280, 800)] {
        screen.resize(width, height);
        sleep(Duration::from_millis(400));
    }
    screen.settled("the picture as it was, at its size", |shot| difference(MIDDLE, &turned, shot) < 1.0);

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
