//! Droplets that fly off the rim of a hole: the rim is faster than it can turn with the sphere, and sheds threads of liquid that break up
//! (Lhuissier & Villermaux 2012, "Bursting bubble aerosols", Journal of Fluid Mechanics 696).

use std::f64::consts::PI;

use super::random::Random;

/// A droplet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Droplet {
    /// The meridian of the hole on which it leaves the rim, as a part of a turn.
    pub turn: f64,
    /// Angle from the hole's middle there, radians.
    pub leaves_rad: f64,
    /// Radius, m.
    pub radius_m: f64,
    /// How fast it flies over how fast the rim moves.
    pub speed: f64,
}

/// How many droplets a bubble sheds.
const COUNT: u32 = 3000;
/// Angle from its middle at which a hole begins to shed them, radians: a rim must have gathered liquid.
const SHEDS_FROM_RAD: f64 = 0.25;
/// Radii of droplets of a bubble of 5 cm, m; a choice, as is the rest here. They go as the root of the bubble's radius.
const RADIUS_M: [f64; 2] = [0.03e-3, 0.12e-3];
/// Speeds over the rim's: threads hold them back.
const SPEED: [f64; 2] = [0.65, 0.95];

/// The droplets of a bubble of a radius in m; each number gives others.
pub fn droplets(number: u32, bubble_m: f64) -> impl Iterator<Item = Droplet> {
    let scale = (bubble_m / 0.05).sqrt();
    (0..COUNT).map(move |k| {
        let mut random = Random::new(number, SPRAY_STREAM.wrapping_add(k));
        // As many for each piece of the film's area.
        let height = random.between(-1.0, SHEDS_FROM_RAD.cos());
        Droplet {
            turn: random.between(0.0, 1.0),
            leaves_rad: height.acos().min(PI),
            radius_m: scale * random.between_log(RADIUS_M[0], RADIUS_M[1]),
            speed: random.between(SPEED[0], SPEED[1]),
        }
    })
}

/// First of the streams of random numbers that droplets have, one each.
const SPRAY_STREAM: u32 = 0x7000_0000;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::properties::DENSITY;

    #[test]
    fn droplets_have_no_more_liquid_than_the_film() {
        for bubble_m in [0.01, 0.05, 0.4] {
            let liquid: f64 =
                droplets(1, bubble_m).map(|droplet| droplet.radius_m.powi(3)).sum::<f64>() * 4.0 / 3.0 * PI;
            let film = 4.0 * PI * bubble_m.powi(2) * 500e-9;
            assert!(liquid < film, "{bubble_m} m: {} of {} kg", liquid * DENSITY, film * DENSITY);
        }
    }

    #[test]
    fn they_leave_a_rim_that_has_gathered_liquid() {
        let all: Vec<_> = droplets(3, 0.05).collect();
        assert!(all.iter().all(|droplet| (SHEDS_FROM_RAD..=PI).contains(&droplet.leaves_rad)));
        let half = all.iter().filter(|droplet| droplet.leaves_rad > PI / 2.0).count();
        assert!((1300..1700).contains(&half), "as many on each half of the film: {half}");
        assert_ne!(droplets(4, 0.05).next(), droplets(3, 0.05).next());
    }
}
