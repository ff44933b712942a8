//! What happens while time runs: the kinds of `[[event]]`.
//!
//! Another kind takes a struct of its keys, a variant of [`Change`], of `Kind` and of the match below it, the keys in `Entry` that no other
//! kind has, an item of [`Change::every_key`], and its table on the format's page.

use super::check::{self, Checked, Fault};
use super::{Flow, Motion};
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
    /// Checks everything but the order of the events, in a scene of so many bubbles.
    pub(super) fn check(&self, bubbles: usize) -> Checked {
        match &self.change {
            Change::Motion(change) => change.check(),
            Change::Stir(stir) => stir.check(),
            Change::Blow(blow) => blow.check(),
            Change::Drag(drag) => drag.check(),
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
    /// The bubble that it happens to; nothing if it is all of them.
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
        let motion = MotionChange {
            flow: Some(Flow::Rest),
            strength: Some(1.0),
            seed: Some(1),
            spin_deg_s: Some([0.0; 3]),
            evaporation_nm_s: Some(0.0),
            gravity_m_s2: Some([0.0; 3]),
            drag_1_s: Some(0.0),
            air_drag: Some(0.0),
        };
        [
            Self::Motion(motion),
            Self::Stir(Stir::default()),
            Self::Blow(Blow::default()),
            Self::Drag(Drag::default()),
            Self::Prick(Prick::default()),
        ]
    }
}

/// Keys of `[motion]` that take a new value at an event; those absent stay as they are.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MotionChange {
    /// New [`Motion::flow`].
    pub flow: Option<Flow>,
    /// New [`Motion::strength`]; 0 ..= 10.
    pub strength: Option<f64>,
    /// New [`Motion::seed`].
    pub seed: Option<u64>,
    /// New [`Motion::spin_deg_s`]; -3600 ..= 3600.
    pub spin_deg_s: Option<[f64; 3]>,
    /// New [`Motion::evaporation_nm_s`]; 0 ..= 1000.
    pub evaporation_nm_s: Option<f64>,
    /// New [`Motion::gravity_m_s2`]; -1000 ..= 1000.
    pub gravity_m_s2: Option<[f64; 3]>,
    /// New [`Motion::drag_1_s`]; 0 ..= 1000.
    pub drag_1_s: Option<f64>,
    /// New [`Motion::air_drag`]; 0 ..= 10.
    pub air_drag: Option<f64>,
}

impl MotionChange {
    /// A motion with these changes.
    #[must_use]
    pub fn applied_to(&self, motion: Motion) -> Motion {
        Motion {
            flow: self.flow.unwrap_or(motion.flow),
            strength: self.strength.unwrap_or(motion.strength),
            seed: self.seed.unwrap_or(motion.seed),
            spin_deg_s: self.spin_deg_s.unwrap_or(motion.spin_deg_s),
            evaporation_nm_s: self.evaporation_nm_s.unwrap_or(motion.evaporation_nm_s),
            gravity_m_s2: self.gravity_m_s2.unwrap_or(motion.gravity_m_s2),
            drag_1_s: self.drag_1_s.unwrap_or(motion.drag_1_s),
            air_drag: self.air_drag.unwrap_or(motion.air_drag),
            ..motion
        }
    }

    fn check(&self) -> Checked {
        if *self == Self::default() {
            return Err(Fault::new("kind", "is \"motion\" but nothing changes; set `flow` or another key of [motion]"));
        }
        // What is not changed takes a value that is in range.
        self.applied_to(Motion::default()).check()
    }
}

/// Something wet that moves over a free film for a while and takes along what it meets: around a point, the film's velocity is drawn
/// towards a given one. Directions turn with the film.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stir {
    /// Index of the bubble. Default: 0.
    pub bubble: usize,
    /// Direction of the point from the bubble's centre; each component -1 ..= 1, its length is of no account. Default: +x.
    pub at: [f64; 3],
    /// The velocity that the film is given there, m/s; -10 ..= 10. What of it is not along the film is of no account.
    /// Default: [0, 0.2, 0].
    pub velocity_m_s: [f64; 3],
    /// Angle from the point to where the film is pushed half as much; 3 ..= 90. Default: 15.
    pub radius_deg: f64,
    /// For how many ticks; 1 ..= 100000. Default: 12.
    pub ticks: u64,
}

impl Default for Stir {
    fn default() -> Self {
        Self { bubble: 0, at: [1.0, 0.0, 0.0], velocity_m_s: [0.0, 0.2, 0.0], radius_deg: 15.0, ticks: 12 }
    }
}

impl Stir {
    fn check(&self) -> Checked {
        direction("at", self.at)?;
        check::all_in_range("velocity_m_s", self.velocity_m_s, -10.0..=10.0)?;
        check::in_range("radius_deg", self.radius_deg, RADIUS_DEG)?;
        check::in_range("ticks", self.ticks, TICKS)
    }
}

/// A jet of air that meets a free film at a point for a while. Only what blows along the film moves it, for it is incompressible: a jet
/// straight at it moves nothing, an oblique one a pair of vortices. Directions turn with the film.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Blow {
    /// Index of the bubble. Default: 0.
    pub bubble: usize,
    /// Direction of the point from the bubble's centre; each component -1 ..= 1, its length is of no account. Default: +x.
    pub at: [f64; 3],
    /// Where the air goes: each component -1 ..= 1, its length is of no account. Default: [-1, 1, 0], obliquely.
    pub toward: [f64; 3],
    /// Speed of the air, m/s; 0 ..= 30. Default: 1.
    pub speed_m_s: f64,
    /// Angle from the point to where the jet is half as strong; 3 ..= 90. Default: 15.
    pub radius_deg: f64,
    /// For how many ticks; 1 ..= 100000. Default: 12.
    pub ticks: u64,
}

impl Default for Blow {
    fn default() -> Self {
        Self { bubble: 0, at: [1.0, 0.0, 0.0], toward: [-1.0, 1.0, 0.0], speed_m_s: 1.0, radius_deg: 15.0, ticks: 12 }
    }
}

impl Blow {
    fn check(&self) -> Checked {
        direction("at", self.at)?;
        direction("toward", self.toward)?;
        check::in_range("speed_m_s", self.speed_m_s, 0.0..=30.0)?;
        check::in_range("radius_deg", self.radius_deg, RADIUS_DEG)?;
        check::in_range("ticks", self.ticks, TICKS)
    }
}

/// The bubble's centre goes to another place, as quickly as it can without passing it; a free film feels the acceleration.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Drag {
    /// Index of the bubble. Default: 0.
    pub bubble: usize,
    /// Where the centre goes, m; each coordinate -1000 ..= 1000. Default: the origin.
    pub to_m: [f64; 3],
}

impl Drag {
    fn check(&self) -> Checked {
        check::all_in_range("to_m", self.to_m, check::POSITION_M)
    }
}

/// Something sharp and dry touches the film, and the bubble bursts from there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Prick {
    /// Index of the bubble. Default: 0.
    pub bubble: usize,
    /// Direction of the point from the bubble's centre; each component -1 ..= 1, its length is of no account. Default: +x.
    pub at: [f64; 3],
}

impl Default for Prick {
    fn default() -> Self {
        Self { bubble: 0, at: [1.0, 0.0, 0.0] }
    }
}

impl Prick {
    fn check(&self) -> Checked {
        direction("at", self.at)
    }
}

/// Range of a push's radius: what the coarsest flow resolves, and half of the sphere.
const RADIUS_DEG: std::ops::RangeInclusive<f64> = 3.0..=90.0;
/// Range of a push's duration.
const TICKS: std::ops::RangeInclusive<u64> = 1..=100_000;

/// A vector whose direction alone counts.
fn direction(key: &str, vector: [f64; 3]) -> Checked {
    const SHORTEST: f64 = 1e-3;
    check::all_in_range(key, vector, -1.0..=1.0)?;
    if vector.iter().all(|component| component.abs() < SHORTEST) {
        return Err(Fault::new(key, format!("has no direction; make one of its numbers at least {SHORTEST}")));
    }
    Ok(())
}

/// An `[[event]]` as it stands in a file: flat, with the keys of every kind, because serde's tagged enums lose the line of an error.
/// Which kind has which keys is checked before, where the lines are known.
#[derive(Deserialize)]
struct Entry {
    #[serde(default)]
    tick: u64,
    kind: Kind,
    flow: Option<Flow>,
    strength: Option<f64>,
    seed: Option<u64>,
    spin_deg_s: Option<[f64; 3]>,
    evaporation_nm_s: Option<f64>,
    gravity_m_s2: Option<[f64; 3]>,
    drag_1_s: Option<f64>,
    air_drag: Option<f64>,
    bubble: Option<usize>,
    at: Option<[f64; 3]>,
    velocity_m_s: Option<[f64; 3]>,
    toward: Option<[f64; 3]>,
    speed_m_s: Option<f64>,
    radius_deg: Option<f64>,
    ticks: Option<u64>,
    to_m: Option<[f64; 3]>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Motion,
    Stir,
    Blow,
    Drag,
    Prick,
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
            Kind::Motion => Change::Motion(MotionChange {
                flow: entry.flow,
                strength: entry.strength,
                seed: entry.seed,
                spin_deg_s: entry.spin_deg_s,
                evaporation_nm_s: entry.evaporation_nm_s,
                gravity_m_s2: entry.gravity_m_s2,
                drag_1_s: entry.drag_1_s,
                air_drag: entry.air_drag,
            }),
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
