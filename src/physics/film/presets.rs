//! What moves a film, by name, and the seeded flows in closed form: the air's draught, a stirred film, and a film that sloshes.
//!
//! Another flow is a row of [`Flow`], an arm of [`Flow::prescribed`] and its constructor; the page of the scene format lists its name.

use std::f64::consts::TAU;

use glam::DVec3;

use super::{PrescribedFlow, Vortex, Wave, random::Random};
use crate::words::words;

words! {
    /// What moves a film.
    pub enum Flow: "flow" {
        Free = "free", "Gravity and the air, as in a real film: thin film rises, thick film sinks";
        Rest = "rest", "Nothing moves the film";
        Sloshing = "sloshing", "The film swings as a whole about its rest state";
        Draught = "draught", "Slow, large gusts of the air around the bubble";
        Stirred = "stirred", "Many turning vortices, as after a stir";
        Jets = "jets", "Bands that turn about the vertical in opposite directions, like the clouds of Jupiter";
    }
}

impl Flow {
    /// The flow in closed form, of a seed and a factor on all speeds; none if the film moves by itself, or not at all.
    #[must_use]
    pub fn prescribed(self, seed: u32, strength: f64) -> Option<PrescribedFlow> {
        match self {
            Self::Free | Self::Rest => None,
            Self::Sloshing => Some(PrescribedFlow::sloshing(seed, strength)),
            Self::Draught => Some(PrescribedFlow::draught(seed, strength)),
            Self::Stirred => Some(PrescribedFlow::stirred(seed, strength)),
            Self::Jets => Some(PrescribedFlow::jets(seed, strength)),
        }
    }
}

/// Root mean square speeds at strength 1, rad/s.
const DRAUGHT_RAD_S: f64 = 0.12;
const SLOSH_RAD_S: f64 = 0.45;
const JETS_RAD_S: f64 = 0.3;
const DRAUGHT_WAVES: usize = 14;
const SLOSH_WAVES: usize = 3;
const JET_WAVES: usize = 3;
const STIR_VORTICES: usize = 36;

/// Streams of random numbers, one for each use, so that a stirred film feels the draught of its seed.
const DRAUGHT_STREAM: u32 = 1;
const STIR_STREAM: u32 = 2;
const SLOSH_STREAM: u32 = 3;
const JETS_STREAM: u32 = 4;

impl PrescribedFlow {
    /// The draught that air never stops to make: slow and large-scale, swinging with many periods of 2 to 9 s, so that the film goes
    /// back and forth and is not mixed away. About 0.12 rad/s at strength 1, in proportion to it.
    pub fn draught(seed: u32, strength: f64) -> Self {
        let mut random = Random::new(seed, DRAUGHT_STREAM);
        let mut waves: Vec<Wave> = (0..DRAUGHT_WAVES).map(|_| draught_wave(&mut random)).collect();
        scale_to_rms(&mut waves, DRAUGHT_RAD_S * strength);
        Self { waves, vortices: Vec::new() }
    }

    /// A stirred film: the draught, and vortices of 5° to 25° that wander, curl the film up and unwind it again.
    pub fn stirred(seed: u32, strength: f64) -> Self {
        let mut random = Random::new(seed, STIR_STREAM);
        let vortices = (0..STIR_VORTICES).map(|_| stirring_vortex(&mut random, strength)).collect();
        Self { vortices, ..Self::draught(seed, strength) }
    }

    /// A film that sloshes: rocked about horizontal axes every 2 to 3 s, nearly as a whole, in a weaker draught.
    pub fn sloshing(seed: u32, strength: f64) -> Self {
        let mut random = Random::new(seed, SLOSH_STREAM);
        let mut waves: Vec<Wave> = (0..SLOSH_WAVES).map(|_| sloshing_wave(&mut random)).collect();
        scale_to_rms(&mut waves, SLOSH_RAD_S * strength);
        let draught = Self::draught(seed, 0.5 * strength);
        Self { waves: [waves, draught.waves].concat(), vortices: Vec::new() }
    }

    /// Jets: some ten bands of latitude that turn about the vertical, each against its neighbours, and wander slowly; in a weaker draught,
    /// which bends them. Patches are drawn out into bands.
    pub fn jets(seed: u32, strength: f64) -> Self {
        let mut random = Random::new(seed, JETS_STREAM);
        let mut waves: Vec<Wave> = (0..JET_WAVES).map(|_| jet_wave(&mut random)).collect();
        // These waves do not swing: for the same amplitude they are faster by the root of two.
        scale_to_rms(&mut waves, JETS_RAD_S * strength / std::f64::consts::SQRT_2);
        let draught = Self::draught(seed, 0.5 * strength);
        Self { waves: [waves, draught.waves].concat(), vortices: Vec::new() }
    }
}

fn draught_wave(random: &mut Random) -> Wave {
    let k = random.between_log(1.5, 6.0);
    Wave {
        k: k * random.direction(),
        phase: random.between(0.0, TAU),
        // Speed goes as k A: a spectrum that favours the large scales.
        amplitude: k.powf(-1.7),
        drift_rad_s: random.sign() * random.between(0.05, 0.3),
        swing_rad_s: TAU / random.between(2.0, 9.0),
        swing_phase: random.between(0.0, TAU),
    }
}

/// Long waves with their node near the middle: nearly rigid turns about k.
fn sloshing_wave(random: &mut Random) -> Wave {
    let k = random.direction() * DVec3::new(1.0, 1.0, 0.25);
    let length = random.between(0.7, 1.5);
    Wave {
        k: length * k.normalize(),
        phase: random.between(-0.4, 0.4),
        amplitude: 1.0 / length,
        drift_rad_s: 0.0,
        swing_rad_s: TAU / random.between(2.0, 3.0),
        swing_phase: random.between(0.0, TAU),
    }
}

/// A wave along the vertical, whose crests are circles of latitude.
fn jet_wave(random: &mut Random) -> Wave {
    let k = random.between(7.0, 13.0);
    Wave {
        k: k * DVec3::Z,
        phase: random.between(0.0, TAU),
        amplitude: 1.0 / k,
        drift_rad_s: random.sign() * random.between(0.02, 0.1),
        swing_rad_s: 0.0,
        swing_phase: 0.0,
    }
}

fn stirring_vortex(random: &mut Random, strength: f64) -> Vortex {
    let radius = random.between_log(5.0, 25.0).to_radians();
    let mut vortex = Vortex {
        center: random.direction(),
        turn_axis: random.direction(),
        turn_rad_s: random.between(0.02, 0.12),
        strength: random.sign(),
        sharpness: radius.powi(-2),
        swing_rad_s: TAU / random.between(9.0, 25.0),
        swing_phase: random.between(-1.0, 1.0),
    };
    // Larger vortices are faster, yet turn slower: speed goes as the square root of the radius.
    let speed = random.between(0.4, 0.8) * radius.sqrt() * strength;
    vortex.strength *= speed / vortex.peak_speed();
    vortex
}

/// Scales amplitudes to a root mean square speed over the sphere and all time: a wave's is |k A| √(1/2 · 1/2 · 2/3), from
/// the swing, the wave, and the angle between k and x.
fn scale_to_rms(waves: &mut [Wave], speed_rad_s: f64) {
    let square: f64 = waves.iter().map(|wave| wave.k.length_squared() * wave.amplitude.powi(2) / 6.0).sum();
    let scale = speed_rad_s / square.sqrt();
    waves.iter_mut().for_each(|wave| wave.amplitude *= scale);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All flows in closed form.
    fn flows() -> impl Iterator<Item = impl Fn(u32, f64) -> PrescribedFlow> {
        let prescribed = Flow::ALL.into_iter().filter(|flow| flow.prescribed(1, 1.0).is_some());
        prescribed.map(|flow| move |seed, strength| flow.prescribed(seed, strength).unwrap())
    }

    #[test]
    fn prescribed_flows_have_the_speeds_of_a_film_at_all_times() {
        for seed in 0..4 {
            for flow in flows() {
                for t in 0..40 {
                    let (rms, max) = flow(seed, 1.0).speeds_at(0.7 * f64::from(t));
                    assert!((0.02..1.2).contains(&rms) && max < 3.0, "seed {seed}, {t}: {rms} rms, {max} max");
                }
            }
        }
    }

    #[test]
    fn strength_is_a_factor_and_zero_is_rest() {
        let x = DVec3::new(0.6, 0.0, -0.8);
        for flow in flows() {
            let [one, two] = [1.0, 2.0].map(|strength| flow(9, strength).velocity(x, 1.0));
            assert!((2.0 * one).distance(two) < 1e-12 && one.length() > 1e-6);
            assert_eq!(flow(9, 0.0).velocity(x, 1.0).length(), 0.0);
        }
    }

    #[test]
    fn flows_fit_the_shader_and_depend_on_the_seed() {
        for flow in flows() {
            let made = flow(1, 1.0);
            assert!(PrescribedFlow::new(made.waves().to_vec(), made.vortices().to_vec()).is_ok());
            assert_eq!(made, flow(1, 1.0));
            assert_ne!(made, flow(2, 1.0));
        }
    }
}
