//! How the films move, and what changes on the way.
//!
//! What moves a film may change while time runs: those keys of `[motion]` are also keys of an event, and a change of theirs in the window is
//! an event from then on. The clock and the scheme hold for the whole history; to change them is to change the past.

use super::{
    check::{Checked, Fault},
    section::section,
};
use crate::physics::{
    film::{
        Flow,
        properties::{VISCOSITY, kinematic_viscosity},
    },
    transport::Scheme,
};

/// Hands the keys of `[motion]` that events may change to a macro, after what is given.
macro_rules! with_changing_keys {
    ($then:ident! { $($before:tt)* }) => {
        $then! {
            $($before)*
            flow: Flow = Flow::Free, [word], "Flow", "", "what moves the film";
            strength: f64 = 1.0, [0.0 ..= 10.0], "Strength", "", "factor on the speed of the flow; for a free film, on the speed of the draught around it";
            seed: u64 = 1, [whole], "Flow seed", "", "random seed of the flow";
            gravity_m_s2: [f64; 3] = [0.0, 0.0, -9.81], [-1000.0 ..= 1000.0], "Gravity", " m/s²", "gravity minus the acceleration of the bubble, m/s²; this and the next six act on `flow = \"free\"`";
            drag_1_s: f64 = 2.0, [0.0 ..= 1000.0], "Drag", " 1/s", "rate at which the flow decays at any thickness, 1/s";
            air_drag: f64 = 0.0, [0.0 ..= 10.0], "Air drag", "", "factor on the drag of the air's boundary layer; at 1 it stops a film of 1 µm in a tenth of a second";
            viscosity_mm2_s: f64 = 100.0, [0.0 ..= 1000000.0], "Viscosity", " mm²/s", "kinematic viscosity of the film, mm²/s; real films have 20 to 2000";
            surface_viscosity_upa_s_m: f64 = 0.0, [0.0 ..= 1000.0], "Surface viscosity", " µPa s m", "shear viscosity of each of the film's two surfaces, µPa s m; above 0, the film's viscosity follows from it and from the thickness that the film is blown with, in place of `viscosity_mm2_s`; layers of soap have 0.01 to 10";
            diffusion_mm2_s: f64 = 0.5, [0.0 ..= 1000.0], "Diffusion", " mm²/s", "diffusivity of the thickness within the film, mm²/s";
            drainage: f64 = 0.0, [0.0 ..= 10000.0], "Drainage", "", "factor on the drainage between immobile surfaces, which takes hours at 1; the liquid is counted in the drop, the ring or the bath";
            spin_deg_s: [f64; 3] = [0.0; 3], [-3600.0 ..= 3600.0], "Spin", " °/s", "rotation of all films as a whole, degrees per second about the three axes of the world; gravity turns with a free film";
            evaporation_nm_s: f64 = 0.0, [0.0 ..= 1000.0], "Evaporation", " nm/s", "evaporation from the whole film, nm of thickness per second, down to 10 nm of black film";
            humidity: f64 = 1.0, [0.0 ..= 1.0], "Humidity", "", "relative humidity of the air; below 1, evaporation that follows from the bubble's radius and the air speed is added to `evaporation_nm_s`";
            air_speed_m_s: f64 = 0.1, [0.0 ..= 10.0], "Air speed", " m/s", "speed of the air that carries the vapour away, m/s";
            black_film_life_s: f64 = 10.0, [0.0 ..= 1000000.0], "Black film", " s", "mean life of black film before a bubble bursts by itself, s";
            burst_slowdown: f64 = 1.0, [1.0 ..= 10000.0], "Slow motion", "x", "factor by which a bubble bursts more slowly than in reality";
            renew_s: f64 = 2.0, [0.0 ..= 1000000.0], "New bubble", " s", "time from the end of a bubble until a new one is blown, s";
        }
    };
}
pub(super) use with_changing_keys;

with_changing_keys!(section! {
    /// The clock and the flow of the films: `[motion]`.
    pub struct Motion, MotionKeys:
    tick_s: f64 = 1.0 / 60.0, [0.0001 ..= 0.1], "Tick", " s", "length of a tick, s";
    scheme: Scheme = Scheme::Map, [word], "Scheme", "", "how the liquid is moved";
    remap_ticks: u32 = 120, [1 ..= 1000], "Remap", " ticks", "maximum ticks between two remaps of the flow map; a map that is too distorted is remapped earlier";
    speed: f64 = 1.0, [0.01 ..= 100.0], "Speed", "x", "film time per second of the window's clock, s";
});

/// Declares what an event may change of a section.
macro_rules! change {
    ($($name:ident: $type:ty = $default:expr, [$($range:tt)+], $label:literal, $unit:literal, $help:literal;)+) => {
        /// Keys of `[motion]` that take a new value at an event; those absent stay as they are.
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
        pub struct MotionChange {
            $(#[doc = concat!("New [`Motion::", stringify!($name), "`].")] pub $name: Option<$type>,)+
        }

        impl MotionChange {
            /// The keys that may change, in the order of the format's page.
            pub const ALL_KEYS: &'static [super::Key] = &[$(Motion::KEYS.$name),+];

            /// A motion with these changes.
            #[must_use]
            pub fn applied_to(&self, motion: Motion) -> Motion {
                Motion { $($name: self.$name.unwrap_or(motion.$name),)+ ..motion }
            }

            /// These changes, and then newer ones.
            #[must_use]
            pub fn then(&self, newer: &Self) -> Self {
                Self { $($name: newer.$name.or(self.$name),)+ }
            }

            /// The change that leads from one motion to another, in the keys that an event can change.
            #[must_use]
            pub fn between(before: &Motion, after: &Motion) -> Self {
                Self { $($name: (before.$name != after.$name).then_some(after.$name),)+ }
            }

            /// All keys that can change, as a motion has them.
            #[must_use]
            pub fn all_of(motion: &Motion) -> Self {
                Self { $($name: Some(motion.$name),)+ }
            }
        }
    };
}
with_changing_keys!(change! {});

impl Motion {
    /// Kinematic viscosity of a film that is blown with a mean thickness, m²/s: what is given, or what follows from the viscosity of its
    /// surfaces, up to the largest value that can be given.
    #[must_use]
    pub fn film_viscosity_m2_s(&self, thickness_m: f64) -> f64 {
        if self.surface_viscosity_upa_s_m > 0.0 {
            kinematic_viscosity(VISCOSITY, 1e-6 * self.surface_viscosity_upa_s_m, thickness_m).min(1.0)
        } else {
            1e-6 * self.viscosity_mm2_s
        }
    }

    pub(super) fn check(&self) -> Checked {
        self.check_ranges()
    }

    /// Checks what films that end somewhere do not bear: to turn that end away, or to be carried across it.
    pub(super) fn check_with_rims(&self) -> Checked {
        if self.spin_deg_s[..2] != [0.0; 2] {
            let reason =
                "turns over films that have a rim; only a turn about the vertical, [0, 0, z], leaves the rim in place";
            return Err(Fault::new("spin_deg_s", reason));
        }
        if !matches!(self.flow, Flow::Free | Flow::Rest) {
            let reason = "would carry film across a rim; films with a rim move only by `\"free\"` or `\"rest\"`";
            return Err(Fault::new("flow", reason));
        }
        Ok(())
    }
}

impl MotionChange {
    pub(super) fn check(&self) -> Checked {
        if *self == Self::default() {
            return Err(Fault::new("kind", "is \"motion\" but nothing changes; set `flow` or another key of [motion]"));
        }
        // What is not changed takes a value that is in range.
        self.applied_to(Motion::default()).check()
    }
}
