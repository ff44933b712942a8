//! A virtual screen with the program on it, seen and touched as by a person.

use std::{
    io::{BufRead, BufReader},
    process::{Child, Command, Output, Stdio},
    sync::{Mutex, PoisonError},
    thread::sleep,
    time::{Duration, Instant},
};

use image::RgbImage;

use crate::support::{REQUIRE_WINDOW, has_tools};

/// What a software rasteriser may take for a picture on a machine that is busy with other tests.
const PATIENCE: Duration = Duration::from_secs(240);

/// Processor time that a program at rest may take while it is watched for 0.6 s, in hundredths of a second.
const IDLE_JIFFIES: u64 = 6;

/// Size of the virtual screen, pixels.
const SIZE: [u32; 2] = [1280, 800];

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
pub struct Screen {
    display: String,
    program: Guarded,
    window: String,
    _server: Guarded,
    /// Where the program runs, and keeps settings and unsaved work: not where its user does.
    home: tempfile::TempDir,
}

impl Screen {
    pub fn open(arguments: &[&str]) -> Self {
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
    pub fn crash(&mut self, arguments: &[&str]) {
        self.program.0.kill().unwrap();
        self.program.0.wait().unwrap();
        self.program = start(arguments, &self.display, &self.home);
        self.find_window();
    }

    pub fn title(&self) -> String {
        String::from_utf8(self.tool(&["getwindowname", &self.window]).stdout).unwrap().trim().to_owned()
    }

    /// What is kept of work that is not saved.
    pub fn kept(&self) -> Option<String> {
        let folder = std::fs::read_dir(self.home.path().join("soapfilm/unsaved")).ok()?;
        let mut files = folder.flatten().filter(|file| file.path().extension().is_some_and(|ending| ending == "toml"));
        std::fs::read_to_string(files.next()?.path()).ok()
    }

    fn tool(&self, arguments: &[&str]) -> Output {
        Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output().unwrap()
    }

    pub fn act(&self, arguments: &[&str]) {
        let output = self.tool(arguments);
        assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        sleep(Duration::from_millis(60));
    }

    /// Presses a key in the window. There is no window manager that would give it the focus.
    pub fn press(&self, key: &str) {
        self.act(&["windowfocus", "--sync", &self.window]);
        self.act(&["key", key]);
    }

    pub fn point_at(&self, [x, y]: [i32; 2]) {
        self.act(&["mousemove", &x.to_string(), &y.to_string()]);
    }

    pub fn drag(&self, from: [i32; 2], by: [i32; 2]) {
        self.point_at(from);
        self.act(&["mousedown", "1"]);
        for step in 1..=8 {
            self.point_at([from[0] + by[0] * step / 8, from[1] + by[1] * step / 8]);
        }
        self.act(&["mouseup", "1"]);
    }

    pub fn resize(&self, width: u32, height: u32) {
        self.act(&["windowsize", &self.window, &width.to_string(), &height.to_string()]);
    }

    pub fn shot(&self) -> RgbImage {
        // Bare pixels: to compress a picture takes longer than to take it.
        let mut import = Command::new("import");
        import.args(["-window", "root", "-depth", "8", "rgb:-"]).env("DISPLAY", &self.display);
        RgbImage::from_raw(SIZE[0], SIZE[1], import.output().unwrap().stdout).unwrap()
    }

    /// Looks again and again until there is what is looked for.
    pub fn wait_for<T>(&mut self, what: &str, look: impl Fn(&Self) -> Option<T>) -> T {
        let start = Instant::now();
        loop {
            if let Some(status) = self.program.0.try_wait().unwrap() {
                panic!("soapfilm ended ({status}) while {what} was awaited");
            }
            if let Some(found) = look(self) {
                return found;
            }
            if start.elapsed() > PATIENCE {
                let seen = concat!(env!("CARGO_TARGET_TMPDIR"), "/screen.png");
                self.shot().save(seen).unwrap();
                panic!("{what} did not come; what the screen shows instead is in {seen}");
            }
            sleep(Duration::from_millis(200));
        }
    }

    /// The screen once it shows a bubble and what is looked for, and nothing moves any more. A window may answer late, so that a screen that stands
    /// still may be the one before.
    pub fn settled(&mut self, what: &str, is_there: impl Fn(&RgbImage) -> bool) -> RgbImage {
        self.still(what, is_there, u64::MAX)
    }

    /// As [`Self::settled`], and the program does nothing any more: on a busy machine a coarse picture may stand for long before the fine one.
    pub fn rested(&mut self, what: &str, is_there: impl Fn(&RgbImage) -> bool) -> RgbImage {
        self.still(what, is_there, IDLE_JIFFIES)
    }

    fn still(&mut self, what: &str, is_there: impl Fn(&RgbImage) -> bool, most_jiffies: u64) -> RgbImage {
        self.wait_for(what, |screen| {
            let (first, before) = (screen.shot(), screen.jiffies());
            sleep(Duration::from_millis(600));
            let (second, jiffies) = (screen.shot(), screen.jiffies() - before);
            let stands = colourfulness(&second) > 8.0 && first == second && jiffies <= most_jiffies;
            (stands && is_there(&second)).then_some(second)
        })
    }

    /// Processor time of all the program's threads so far, in jiffies.
    pub fn jiffies(&self) -> u64 {
        let stat = std::fs::read_to_string(format!("/proc/{}/stat", self.program.0.id())).unwrap();
        // The name in brackets may hold spaces; user and system time are the 12th and 13th field after it.
        let fields = stat.rsplit_once(')').unwrap().1.split_whitespace().skip(11);
        fields.take(2).map(|field| field.parse::<u64>().unwrap()).sum()
    }

    pub fn ends_well(&mut self) {
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
        .current_dir(home.path())
        .env("DISPLAY", display)
        .env("XDG_CONFIG_HOME", home.path())
        .env("XDG_STATE_HOME", home.path())
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .spawn();
    Guarded(program.unwrap())
}

/// A server that answers, and its display. Servers that start side by side can both take the number of one that has just ended: they start one
/// after the other, and one that cannot be reached is replaced.
fn start_server() -> (Guarded, String) {
    static STARTS: Mutex<()> = Mutex::new(());
    let _start = STARTS.lock().unwrap_or_else(PoisonError::into_inner);
    let reached = (0..5).map(|_| start_one_server()).find(|(_, display)| {
        let mut asked = Command::new("xdotool");
        asked.arg("getdisplaygeometry").env("DISPLAY", display).output().unwrap().status.success()
    });
    reached.expect("Xvfb to answer")
}

/// A server on a display number that it finds free.
fn start_one_server() -> (Guarded, String) {
    let mut server = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", &format!("{}x{}x24", SIZE[0], SIZE[1]), "-nolisten", "tcp"])
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
pub type Region = [u32; 4];
/// The middle of the picture, which stands left of the panels.
pub const MIDDLE: Region = [245, 200, 490, 400];
/// The panels.
pub const PANELS: Region = [1000, 0, 280, 760];

pub fn pixels(shot: &RgbImage, [x, y, width, height]: Region) -> Vec<[u8; 3]> {
    let region = image::imageops::crop_imm(shot, x, y, width, height).to_image();
    region.pixels().map(|pixel| pixel.0).collect()
}

pub fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len();
    assert!(count > 0, "nothing to compare");
    values.sum::<f64>() / count as f64
}

/// Mean difference between the largest and the smallest of a pixel's values in the middle.
pub fn colourfulness(shot: &RgbImage) -> f64 {
    let spread = |[r, g, b]: [u8; 3]| f64::from(r.max(g).max(b) - r.min(g).min(b));
    mean(pixels(shot, MIDDLE).into_iter().map(spread))
}

/// Mean difference between two shots' values in a region.
pub fn difference(region: Region, a: &RgbImage, b: &RgbImage) -> f64 {
    let apart = |(a, b): ([u8; 3], [u8; 3])| (0..3).map(|i| f64::from(a[i].abs_diff(b[i]))).sum::<f64>() / 3.0;
    mean(pixels(a, region).into_iter().zip(pixels(b, region)).map(apart))
}

/// Whether a region shows one colour.
pub fn is_plain(shot: &RgbImage, region: Region) -> bool {
    let pixels = pixels(shot, region);
    pixels.iter().all(|pixel| (0..3).all(|i| pixel[i].abs_diff(pixels[0][i]) <= 2))
}

/// Whether there is what a virtual screen needs.
pub fn tools_are_there() -> bool {
    has_tools(&["Xvfb", "xdotool", "import"], REQUIRE_WINDOW)
}
