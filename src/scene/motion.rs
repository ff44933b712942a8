//! How the films move, and what changes on the way.

use super::check::{self, Checked, Fault};
use serde::{Deserialize, Serialize};

/// The clock and the flow of the films: `[motion]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Motion {
    /// Length of a tick, s; 0.0001 ..= 0.1. Default: 1/60.
    pub tick_s: f64,
    /// What moves the film. Default: `free`.
    pub flow: Flow,
    /// Factor on the speed of the flow, of a free film on that of the draught around it; 0 ..= 10. Default: 1.
    pub strength: f64,
    /// Seed of the flow. Default: 1.
    pub seed: u64,
    /// Gravity less the bubble's own acceleration, m/s², along the three axes of the world; -1000 ..= 1000. It moves a free film alone, as
    /// the next four keys do. Default: [0, 0, -9.81].
    pub gravity_m_s2: [f64; 3],
    /// Rate at which a free film is slowed down whatever its thickness, 1/s; 0 ..= 1000. Default: 2.
    pub drag_1_s: f64,
    /// Factor on the drag of the air's boundary layer, which goes as the root of the speed over the thickness; 0 ..= 10. Default: 0.
    pub air_drag: f64,
    /// Kinematic viscosity of the film, mm²/s: that of the liquid and of its surfaces; 0 ..= 1000000. Real films: 20 to 2000. Default: 100.
    pub viscosity_mm2_s: f64,
    /// How fast differences of thickness spread within the film, mm²/s; 0 ..= 1000. Default: 0.5.
    pub diffusion_mm2_s: f64,
    /// Turn of all films as a whole, degrees a second about the three axes of the world; -3600 ..= 3600. Default: [0, 0, 0].
    pub spin_deg_s: [f64; 3],
    /// What evaporates from the whole film, nm of thickness a second, down to 10 nm of black film; 0 ..= 1000. Default: 0.
    pub evaporation_nm_s: f64,
    /// Relative humidity of the air; what evaporates in drier air, by the radius and the air's speed, comes to `evaporation_nm_s`; 0 ..= 1.
    /// Default: 1.
    pub humidity: f64,
    /// Speed of the air that carries vapour away, m/s; 0 ..= 10. Default: 0.1.
    pub air_speed_m_s: f64,
    /// How long black film lasts on average before a bubble bursts of itself, s; 0 ..= 1000000. Default: 10.
    pub black_film_life_s: f64,
    /// How many times slower than in life a bubble bursts; 1 ..= 10000. Default: 1.
    pub burst_slowdown: f64,
    /// From the end of a bubble until a new one is blown, s; 0 ..= 1000000. Default: 2.
    pub renew_s: f64,
    /// How the liquid is moved. Default: `map`.
    pub scheme: TransportScheme,
    /// Most ticks between two remaps of the flow map, which is remapped before where it is too distorted; 1 ..= 1000. Default: 120.
    pub remap_ticks: u32,
    /// Film time that passes in a second of the window's clock, s; 0.01 ..= 100. Default: 1.
    pub speed: f64,
}

impl Default for Motion {
    fn default() -> Self {
        Self {
            tick_s: 1.0 / 60.0,
            flow: Flow::Free,
            strength: 1.0,
            seed: 1,
            gravity_m_s2: [0.0, 0.0, -9.81],
            drag_1_s: 2.0,
            air_drag: 0.0,
            viscosity_mm2_s: 100.0,
            diffusion_mm2_s: 0.5,
            spin_deg_s: [0.0; 3],
            evaporation_nm_s: 0.0,
            humidity: 1.0,
            air_speed_m_s: 0.1,
            black_film_life_s: 10.0,
            burst_slowdown: 1.0,
            renew_s: 2.0,
            scheme: TransportScheme::Map,
            remap_ticks: 120,
            speed: 1.0,
        }
    }
}

impl Motion {
    pub(super) fn check(&self) -> Checked {
        check::in_range("tick_s", self.tick_s, 1e-4..=0.1)?;
        check::in_range("strength", self.strength, 0.0..=10.0)?;
        check::all_in_range("spin_deg_s", self.spin_deg_s, -3600.0..=3600.0)?;
        check::in_range("evaporation_nm_s", self.evaporation_nm_s, 0.0..=1000.0)?;
        check::in_range("humidity", self.humidity, 0.0..=1.0)?;
        check::in_range("air_speed_m_s", self.air_speed_m_s, 0.0..=10.0)?;
        check::in_range("black_film_life_s", self.black_film_life_s, 0.0..=1e6)?;
        check::in_range("burst_slowdown", self.burst_slowdown, 1.0..=1e4)?;
        check::in_range("renew_s", self.renew_s, 0.0..=1e6)?;
        check::all_in_range("gravity_m_s2", self.gravity_m_s2, -1000.0..=1000.0)?;
        check::in_range("drag_1_s", self.drag_1_s, 0.0..=1000.0)?;
        check::in_range("air_drag", self.air_drag, 0.0..=10.0)?;
        check::in_range("viscosity_mm2_s", self.viscosity_mm2_s, 0.0..=1e6)?;
        check::in_range("diffusion_mm2_s", self.diffusion_mm2_s, 0.0..=1000.0)?;
        check::in_range("remap_ticks", self.remap_ticks, 1..=1000)?;
        check::in_range("speed", self.speed, 0.01..=100.0)
    }
}

/// What moves a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Flow {
    /// Gravity and the air, as in a real film: what is thin rises, what is thick sinks.
    Free,
    /// Nothing.
    Rest,
    /// The film swings as a whole about its rest state.
    Sloshing,
    /// Slow, large gusts of the air around the bubble.
    Draught,
    /// Many turning vortices, as after a stir.
    Stirred,
}

/// How the liquid of a film is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TransportScheme {
    /// Semi-Lagrangian, bilinear: for comparison.
    Bilinear,
    /// Semi-Lagrangian, bicubic: for comparison.
    Bicubic,
    /// Back and forth error compensation: for comparison.
    Bfecc,
    /// A flow map.
    Map,
    /// A flow map with the thickness on a grid twice as fine.
    MapAccurate,
}

/// Something that happens at a tick and lasts from then on: one `[[event]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "Entry", into = "Entry")]
pub struct Event {
    /// The tick at which it happens. Default: 0.
    pub tick: u64,
    /// What happens: the key `kind` and the keys of that kind.
    pub change: Change,
}

impl Event {
    pub(super) fn check(&self) -> Checked {
        match &self.change {
            Change::Motion(change) => change.check(),
        }
    }
}

/// What an event changes; the key `kind` names the variant.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// `kind = "motion"`: another flow.
    Motion(MotionChange),
}

/// Keys of `[motion]` that take a new value at an event; those absent stay as they are.
#[derive(Clone, Debug, Default, PartialEq)]
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

/// An `[[event]]` as it stands in a file: flat, with the keys of every kind, because serde's tagged enums lose the line of an error.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Motion,
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
        };
        Self { tick: entry.tick, change }
    }
}

impl From<Event> for Entry {
    fn from(Event { tick, change }: Event) -> Self {
        let Change::Motion(change) = change;
        Self {
            tick,
            kind: Kind::Motion,
            flow: change.flow,
            strength: change.strength,
            seed: change.seed,
            spin_deg_s: change.spin_deg_s,
            evaporation_nm_s: change.evaporation_nm_s,
            gravity_m_s2: change.gravity_m_s2,
            drag_1_s: change.drag_1_s,
            air_drag: change.air_drag,
        }
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
