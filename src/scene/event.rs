//! What happens while time runs: the kinds of `[[event]]`.
//!
//! Another kind takes a section of its keys, a variant of [`Change`], of `Kind` and of the match below it, the keys in `Entry` that no other
//! kind has, an item of [`Change::every_key`], and its heading on the format's page.

use super::{
    Flow, Motion, MotionChange,
    check::{Checked, Fault},
    motion::with_changing_keys,
    section::section,
};
use crate::words::words;
use serde::{Deserialize, Serialize};

/// Something that happens at a tick: one `[[event]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Entry")]
pub struct Event {
    /// The tick at which it happens. Default: 0.
    pub tick: u64,
    /// What happens: the key `kind` and the keys of that kind.
    #[serde(flatten)]
    pub change: Change,
}

impl Event {
    /// Checks everything but the order of the events, in a scene of a number of bubbles.
    pub(super) fn check(&self, bubbles: usize) -> Checked {
        match &self.change {
            Change::Motion(change) => change.check(),
            Change::Stir(stir) => stir.check(),
            Change::Blow(blow) => blow.check(),
            Change::Drag(drag) => drag.check_ranges(),
            Change::Prick(prick) => prick.check(),
        }?;
        match self.change.bubble() {
            Some(bubble) if bubble >= bubbles => {
                Err(Fault::new("bubble", format!("is {bubble}; the scene has bubbles from 0 to below {bubbles}")))
            }
            _ => Ok(()),
        }
    }
}

/// What an event does; the key `kind` names the variant.
#[expect(
    clippy::large_enum_variant,
    reason = "ten thousand events take 3 MB, and one that is not boxed is simpler to match"
)]
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Change {
    /// `kind = "motion"`: another flow, from then on.
    Motion(MotionChange),
    /// `kind = "stir"`: something moves over the film.
    Stir(Stir),
    /// `kind = "blow"`: a jet of air meets the film.
    Blow(Blow),
    /// `kind = "drag"`: the bubble goes elsewhere.
    Drag(Drag),
    /// `kind = "prick"`: the bubble bursts.
    Prick(Prick),
}

impl Change {
    /// The bubble that it acts on; `None` for all bubbles.
    #[must_use]
    pub fn bubble(&self) -> Option<usize> {
        match self {
            Self::Motion(_) => None,
            Self::Stir(stir) => Some(stir.bubble),
            Self::Blow(blow) => Some(blow.bubble),
            Self::Drag(drag) => Some(drag.bubble),
            Self::Prick(prick) => Some(prick.bubble),
        }
    }

    /// One of each kind, with no key left out.
    pub(super) fn every_key() -> [Self; 5] {
        [
            Self::Motion(MotionChange::all_of(&Motion::default())),
            Self::Stir(Stir::default()),
            Self::Blow(Blow::default()),
            Self::Drag(Drag::default()),
            Self::Prick(Prick::default()),
        ]
    }
}

section! {
    /// Something wet that moves over a free film for a while and takes along what it meets: around a point, the film's velocity is drawn
    /// towards a given one. Directions turn with the film.
    pub struct Stir, StirKeys:
    bubble: usize = 0, [whole], "Bubble", "", "index of the bubble, in the order of the file";
    at: [f64; 3] = [1.0, 0.0, 0.0], [-1.0 ..= 1.0], "At", "", "direction of the point";
    velocity_m_s: [f64; 3] = [0.0, 0.2, 0.0], [-10.0 ..= 10.0], "Velocity", " m/s", "velocity that the film is drawn to, m/s; only its component along the film counts";
    radius_deg: f64 = 15.0, [3.0 ..= 90.0], "Radius", "°", "angle from the point to half of the strength";
    ticks: u64 = 12, [1 ..= 100000], "Duration", " ticks", "duration; at its end a film that was at rest has four fifths of the velocity at the center";
}

impl Stir {
    fn check(&self) -> Checked {
        self.check_ranges()?;
        direction("at", self.at)
    }
}

section! {
    /// A jet of air that meets a free film at a point for a while. Only what blows along the film moves it, for it is incompressible: a jet
    /// straight at it moves nothing, an oblique one a pair of vortices. Directions turn with the film.
    pub struct Blow, BlowKeys:
    bubble: usize = 0, [whole], "Bubble", "", "index of the bubble, in the order of the file";
    at: [f64; 3] = [1.0, 0.0, 0.0], [-1.0 ..= 1.0], "At", "", "direction of the point";
    toward: [f64; 3] = [-1.0, 1.0, 0.0], [-1.0 ..= 1.0], "Toward", "", "direction in which the air flows";
    speed_m_s: f64 = 1.0, [0.0 ..= 30.0], "Speed", " m/s", "speed of the air, m/s";
    radius_deg: f64 = 15.0, [3.0 ..= 90.0], "Radius", "°", "angle from the point to half of the strength";
    ticks: u64 = 12, [1 ..= 100000], "Duration", " ticks", "duration";
}

impl Blow {
    fn check(&self) -> Checked {
        self.check_ranges()?;
        direction("at", self.at)?;
        direction("toward", self.toward)
    }
}

section! {
    /// The bubble's center goes to another place, as quickly as it can without passing it; a free film feels the acceleration.
    pub struct Drag, DragKeys:
    bubble: usize = 0, [whole], "Bubble", "", "index of the bubble, in the order of the file";
    to_m: [f64; 3] = [0.0; 3], [-1000.0 ..= 1000.0], "To", " m", "new place of the center, m";
}

section! {
    /// Something sharp and dry touches the film, and the bubble bursts from there.
    pub struct Prick, PrickKeys:
    bubble: usize = 0, [whole], "Bubble", "", "index of the bubble, in the order of the file";
    at: [f64; 3] = [1.0, 0.0, 0.0], [-1.0 ..= 1.0], "At", "", "direction of the point";
}

impl Prick {
    fn check(&self) -> Checked {
        self.check_ranges()?;
        direction("at", self.at)
    }
}

/// A vector whose direction alone counts.
fn direction(key: &str, vector: [f64; 3]) -> Checked {
    const SHORTEST: f64 = 1e-3;
    if vector.iter().all(|component| component.abs() < SHORTEST) {
        return Err(Fault::new(key, format!("has no direction; make one of its numbers at least {SHORTEST}")));
    }
    Ok(())
}

/// Declares what `[motion]` lends to entries.
macro_rules! entry {
    ($($name:ident: $type:ty = $default:expr, [$($range:tt)+], $label:literal, $unit:literal, $help:literal;)+) => {
        /// An `[[event]]` as it stands in a file: flat, with the keys of every kind, because serde's tagged enums lose the line of an error.
        /// Which kind has which keys is checked before, where the lines are known.
        #[derive(Deserialize)]
        struct Entry {
            #[serde(default)]
            tick: u64,
            kind: Kind,
            $($name: Option<$type>,)+
            bubble: Option<usize>,
            at: Option<[f64; 3]>,
            velocity_m_s: Option<[f64; 3]>,
            toward: Option<[f64; 3]>,
            speed_m_s: Option<f64>,
            radius_deg: Option<f64>,
            ticks: Option<u64>,
            to_m: Option<[f64; 3]>,
        }

        impl Entry {
            fn motion(&self) -> MotionChange {
                MotionChange { $($name: self.$name,)+ }
            }
        }
    };
}
with_changing_keys!(entry! {});

words! {
    /// What the key `kind` of an event may be.
    pub enum Kind: "kind of event" {
        Motion = "motion", "The motion changes from then on";
        Stir = "stir", "A wet object moves over the film";
        Blow = "blow", "A jet of air meets the film";
        Drag = "drag", "The bubble moves to another place";
        Prick = "prick", "The bubble bursts";
    }
}

/// A kind's keys as an entry has them; those absent have their defaults.
macro_rules! keys {
    ($entry:ident: $kind:ident { $($key:ident),* }) => {{
        let default = $kind::default();
        $kind { $($key: $entry.$key.unwrap_or(default.$key)),* }
    }};
}

impl From<Entry> for Event {
    fn from(entry: Entry) -> Self {
        let change = match entry.kind {
            Kind::Motion => Change::Motion(entry.motion()),
            Kind::Stir => Change::Stir(keys!(entry: Stir { bubble, at, velocity_m_s, radius_deg, ticks })),
            Kind::Blow => Change::Blow(keys!(entry: Blow { bubble, at, toward, speed_m_s, radius_deg, ticks })),
            Kind::Drag => Change::Drag(keys!(entry: Drag { bubble, to_m })),
            Kind::Prick => Change::Prick(keys!(entry: Prick { bubble, at })),
        };
        Self { tick: entry.tick, change }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Scene;
    use super::*;

    fn at(tick: u64, change: MotionChange) -> Event {
        Event { tick, change: Change::Motion(change) }
    }

    #[test]
    fn motion_changes_at_its_tick_and_stays_changed() {
        let stir = MotionChange { flow: Some(Flow::Stirred), seed: Some(7), ..MotionChange::default() };
        let calm = MotionChange { strength: Some(0.5), ..MotionChange::default() };
        let scene = Scene { events: vec![at(10, stir), at(20, calm)], ..Scene::default() };
        let stirred = Motion { flow: Flow::Stirred, seed: 7, ..Motion::default() };
        assert_eq!(scene.motion_at(9), Motion::default());
        assert_eq!(scene.motion_at(10), stirred);
        assert_eq!(scene.motion_at(19), stirred);
        assert_eq!(scene.motion_at(u64::MAX), Motion { strength: 0.5, ..stirred });
    }

    #[test]
    fn of_two_events_at_one_tick_the_later_entry_wins() {
        let seed = |seed| MotionChange { seed: Some(seed), ..MotionChange::default() };
        let scene = Scene { events: vec![at(5, seed(2)), at(5, seed(3))], ..Scene::default() };
        assert_eq!(scene.validate(), Ok(()));
        assert_eq!(scene.motion_at(5).seed, 3);
    }
}
