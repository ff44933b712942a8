//! What a scene's TOML may hold, and what is wrong where it is none.

use super::check::BACKSLASHES;
use super::error::{Located, Problem};
use super::words::shorten;
use super::{
    Bubble, Camera, Change, Event, Generator, Keyframe, Lens, Light, LightLamp, LightPatch, LightSpectrum, Scene, View,
};
use toml::Table;
use toml::de::Error;

/// Characters that messages show of what stands in a text.
const LONGEST_QUOTE: usize = 60;

/// Every key a scene can have, as the TOML of a scene where nothing is absent. A key forgotten here fails the round trip of random scenes.
pub(super) fn every_key() -> Table {
    let every_number = Camera { focal_mm: Some(50.0), ..Camera::default() };
    let scene = Scene {
        bubbles: vec![Bubble::default()],
        generators: vec![Generator::default()],
        light: Light {
            constant: Some([0.0; 3]),
            // Empty: lists of numbers that have an item each are lists of three.
            spectrum: Some(LightSpectrum { wavelengths_nm: Vec::new(), power: Vec::new() }),
            lamps: vec![LightLamp { kelvin: Some(5000.0), ..LightLamp::default() }],
            patches: vec![LightPatch { radiance: Some([0.0; 3]), ..LightPatch::default() }],
            ..Light::default()
        },
        lens: Lens { focus_m: Some(1.0), ..Lens::default() },
        camera: Camera {
            keyframes: vec![Keyframe { fov_y_deg: Some(30.0), ..every_number.keyframe(0.0) }],
            ..every_number
        },
        view: View { polariser_deg: Some(0.0), plate: Some(String::new()), ..View::default() },
        events: Change::every_key().map(|change| Event { tick: 0, change }).into(),
        ..Scene::default()
    };
    // Structs with named fields always make a table.
    Table::try_from(scene).expect("plain data is always TOML")
}

/// What is wrong with the TOML at the end of a text, from a byte on, which the error's place counts from.
pub(super) fn parse_error(text: &str, from: usize, error: &Error) -> Located {
    let span = error.span().unwrap_or_default();
    let (start, end) = (from + span.start, from + span.end);
    let found = text.get(start..end).and_then(|found| found.lines().next()).filter(|found| !found.is_empty());
    let found = found.map_or(String::new(), |found| format!(": `{}`", shorten(found, LONGEST_QUOTE)));
    let advice = if breaks_in_escape(text, start) { format!("; {BACKSLASHES}") } else { String::new() };
    let message = shorten_line(error.message());
    Located { offset: start, problem: Problem::Syntax(format!("{message}{found}{advice}")) }
}

/// Whether a backslash stands shortly before a byte, or at it, between double quotes.
fn breaks_in_escape(text: &str, offset: usize) -> bool {
    /// Bytes of the longest escape, `\U0001F600`, and of the quote after it.
    const REACH: usize = 12;
    let before = &text.as_bytes()[..text.len().min(offset + 1)];
    let line = before.iter().rposition(|byte| *byte == b'\n').map_or(before, |end| &before[end + 1..]);
    let backslash = line.iter().rposition(|byte| *byte == b'\\').filter(|at| line.len() - at <= REACH);
    backslash.is_some_and(|at| line[..at].iter().filter(|byte| **byte == b'"').count() % 2 == 1)
}

/// A text in one line that is not too long for a message.
pub(super) fn shorten_line(text: &str) -> String {
    const LONGEST: usize = 300;
    shorten(&text.split_whitespace().collect::<Vec<_>>().join(" "), LONGEST).into_owned()
}
