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
    /// Factor on the drainage of a free film between surfaces that do not move, which takes hours at 1; 0 ..= 10000. Default: 0.
    pub drainage: f64,
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
            drainage: 0.0,
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
        check::in_range("drainage", self.drainage, 0.0..=1e4)?;
        check::in_range("remap_ticks", self.remap_ticks, 1..=1000)?;
        check::in_range("speed", self.speed, 0.01..=100.0)
    }

    /// Checks what films that end somewhere do not bear: to turn that end away, or to be carried across it.
    pub(super) fn check_with_rims(&self) -> Checked {
        if self.spin_deg_s[..2] != [0.0; 2] {
            let reason =
                "turns films that have a rim over; only a turn about the vertical, [0, 0, z], leaves it in place";
            return Err(Fault::new("spin_deg_s", reason));
        }
        if !matches!(self.flow, Flow::Free | Flow::Rest) {
            let reason = "would carry film across a rim; films that have one move by `\"free\"` or `\"rest\"` alone";
            return Err(Fault::new("flow", reason));
        }
        Ok(())
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
