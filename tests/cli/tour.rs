//! A walk through the real window, as a newcomer might take it: measure, stir, undo, compare, export. With `SOAPFILM_TOUR=FILE.png` it is
//! filmed, as `./dev tour` does.

use std::{
    path::{Path, PathBuf},
    thread::sleep,
    time::Duration,
};

use image::{RgbImage, RgbaImage, imageops};
use soapfilm::{
    output::{Metadata, Video, VideoFormat},
    physics::colour::Gamut,
};

use crate::screen::{PANELS, Screen, colourfulness, difference, tools_are_there};

/// Where the film of the tour goes, if one is wanted.
const TOUR: &str = "SOAPFILM_TOUR";

/// A film on which nothing acts, so that what moves was stirred.
const SCENE: &str = "version = 1
[[bubble]]
film.state = \"rest\"
film.thickness_nm = 580
film.cells = 64
[motion]
strength = 0
gravity_m_s2 = [0, 0, 0]
[light]
environment = \"windows\"
[view]
backdrop = \"environment\"
quality = \"fast\"
dither = false
";

/// Where the probe's numbers stand.
const PROBE: [u32; 4] = [15, 90, 340, 220];
/// The line between the two sides of a comparison.
const SPLIT: [u32; 4] = [480, 100, 14, 550];
/// The middle of its right side.
const RIGHT_OF_THE_SPLIT: [u32; 4] = [500, 200, 240, 400];

/// Frames of the screen, half as large.
struct Film {
    path: Option<PathBuf>,
    frames: Vec<RgbaImage>,
}

impl Film {
    fn wanted() -> Self {
        Self { path: std::env::var_os(TOUR).map(PathBuf::from), frames: Vec::new() }
    }

    /// Films for some frames.
    fn watch(&mut self, screen: &Screen, frames: usize) {
        if self.path.is_none() {
            return;
        }
        for _ in 0..frames {
            self.frames.push(smaller(&screen.shot()));
            sleep(Duration::from_millis(250));
        }
    }

    fn save(self) {
        let (Some(path), [first, ..]) = (self.path, self.frames.as_slice()) else { return };
        let video = Video {
            format: VideoFormat::Apng,
            size: first.dimensions().into(),
            rate: "3".parse().unwrap(),
            frames: self.frames.len() as u32,
            gamut: Gamut::Srgb,
            has_alpha: false,
            metadata: Metadata::default(),
        };
        let mut writer = video.begin(&path).unwrap();
        self.frames.iter().for_each(|frame| writer.add(frame).unwrap());
        writer.finish().unwrap();
    }
}

/// A shot of half the size, in fewer colours, which compress better.
fn smaller(shot: &RgbImage) -> RgbaImage {
    let mut half = imageops::thumbnail(shot, shot.width() / 2, shot.height() / 2);
    half.iter_mut().for_each(|value| *value &= 0xf8);
    image::DynamicImage::from(half).into_rgba8()
}

#[test]
fn a_newcomer_measures_stirs_undoes_compares_and_exports() {
    if !tools_are_there() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("tour.toml");
    std::fs::write(&scene, SCENE).unwrap();
    let mut film = Film::wanted();
    let mut screen = Screen::open(&["app", scene.to_str().unwrap()]);
    film.watch(&screen, 2);
    screen.wait_for("a colourful picture", |screen| (colourfulness(&screen.shot()) > 8.0).then_some(()));
    film.watch(&screen, 4);
    let plain = measure(&mut screen, &mut film);
    let stirred = compare_with_a_stir(&mut screen, &mut film, &plain);
    undo(&mut screen, &mut film, &stirred);
    export(&mut screen, &mut film, folder.path());
    film.save();
    screen.press("ctrl+q");
    screen.ends_well();
}

/// The numbers under the pointer, and then those that a click keeps; the screen after it, without them.
fn measure(screen: &mut Screen, film: &mut Film) -> RgbImage {
    screen.press("space");
    screen.press("6");
    for x in [380, 440, 500, 560] {
        screen.point_at([x, 360]);
        film.watch(screen, 1);
    }
    let before = screen.shot();
    screen.act(&["click", "1"]);
    screen.wait_for("a probe that stays", |screen| (difference(PROBE, &before, &screen.shot()) > 5.0).then_some(()));
    film.watch(screen, 5);
    let pinned = screen.shot();
    screen.press("Escape");
    screen.press("2");
    screen.rested("a picture without the probe", |shot| difference(PROBE, &pinned, shot) > 5.0)
}

/// The picture as it is, kept beside the film that is stirred; the screen with both.
fn compare_with_a_stir(screen: &mut Screen, film: &mut Film, plain: &RgbImage) -> RgbImage {
    screen.press("k");
    let kept = screen.rested("a split", |shot| difference(SPLIT, plain, shot) > 3.0);
    film.watch(screen, 4);
    screen.press("space");
    screen.point_at([560, 260]);
    screen.act(&["mousedown", "1"]);
    screen.wait_for("a stirred film", |screen| {
        for step in 0..8 {
            screen.point_at([560 + 20 * (step % 5), 260 + 25 * step]);
        }
        (difference(RIGHT_OF_THE_SPLIT, &kept, &screen.shot()) > 1.0).then_some(())
    });
    screen.act(&["mouseup", "1"]);
    film.watch(screen, 6);
    screen.press("space");
    screen.wait_for("an edited scene", |screen| screen.title().ends_with("(edited)").then_some(()));
    let stirred = screen.rested("a stirred film that stands", |_| true);
    assert!(difference([250, 200, 220, 400], &kept, &stirred) < 0.1, "the kept picture stands on the left");
    stirred
}

/// The stir, taken back.
fn undo(screen: &mut Screen, film: &mut Film, stirred: &RgbImage) {
    screen.press("ctrl+z");
    screen.wait_for("a film that was not stirred", |screen| {
        (difference(RIGHT_OF_THE_SPLIT, stirred, &screen.shot()) > 0.5).then_some(())
    });
    screen.wait_for("a scene as it was", |screen| (!screen.title().ends_with("(edited)")).then_some(()));
    film.watch(screen, 5);
}

/// The picture in a file beside the scene, and by its name.
fn export(screen: &mut Screen, film: &mut Film, folder: &Path) {
    let before = screen.shot();
    screen.press("ctrl+e");
    screen.wait_for("a dialog", |screen| (difference(PANELS, &before, &screen.shot()) > 5.0).then_some(()));
    film.watch(screen, 5);
    screen.point_at([405, 563]);
    screen.act(&["click", "1"]);
    let exported = folder.join("tour.png");
    let picture = screen.wait_for("the exported picture", |_| image::open(&exported).ok());
    assert_eq!((picture.width(), picture.height()), (972, 730), "as large as the window shows it");
    film.watch(screen, 5);
}
