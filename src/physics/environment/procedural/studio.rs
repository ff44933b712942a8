//! A photographer's table: two large softboxes and a strip light in a dark room.
//!
//! The lamps are some thousand times as bright as the room, as in a studio where only they are lit: walls are black velvet (0.3 %
//! of the light comes back) and out of the lamps' way, the table is grey and catches a little.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::{
    shape::{bell, smoothstep},
    softbox::{Look, Softbox},
};

/// Softboxes as azimuth and elevation in degrees, half width and height seen from 1 away, and radiance in the middle (linear
/// BT.2020). The default camera stands at azimuth 20°: the warm key is to its left, the cool fill to its right and farther away.
const SOFTBOXES: [(f64, f64, DVec2, DVec3); 2] = [
    (-42.0, 24.0, DVec2::new(0.52, 0.66), DVec3::new(7.4, 6.9, 6.1)),
    (112.0, 12.0, DVec2::new(0.34, 0.62), DVec3::new(3.0, 3.4, 3.9)),
];

/// The strip light stands upright behind the bubble and draws its rim.
const STRIP: (f64, f64, DVec2, DVec3) = (176.0, 30.0, DVec2::new(0.06, 0.60), DVec3::new(5.2, 5.2, 5.0));

/// One flash behind two cloths: the rim has a quarter of the middle's light.
const SOFT: Look = Look { corner: 0.05, edge: [0.012, -0.035], rim: 0.22, middle: 0.55 };

/// A tube behind a cloth: even along its length but for the ends.
const TUBE: Look = Look { corner: 0.03, edge: [0.012, -0.05], rim: 0.5, middle: 0.8 };

static LAMPS: LazyLock<[Softbox; 3]> = LazyLock::new(|| {
    let [key, fill] = SOFTBOXES.map(|softbox| Softbox::new(softbox, &SOFT));
    [key, fill, Softbox::new(STRIP, &TUBE)]
});

/// Radiance from a unit `direction`.
pub(super) fn radiance(direction: DVec3) -> DVec3 {
    let lamps: DVec3 = LAMPS.iter().map(|softbox| softbox.radiance(direction)).sum();
    lamps + room(direction)
}

/// Black velvet, and below a table with a pool of the key's light.
fn room(direction: DVec3) -> DVec3 {
    let velvet = DVec3::new(0.0040, 0.0041, 0.0045);
    if direction.z > -0.05 {
        return velvet;
    }
    // In heights of the bubble above the table, from below the bubble.
    let place = direction.truncate() / -direction.z;
    let key = DVec2::from_angle(SOFTBOXES[0].0.to_radians());
    let pool = 0.085 * bell(place.distance(0.8 * key), 1.5) + 0.012 * bell(place.length(), 4.0);
    velvet + pool * smoothstep(-0.05, -0.25, direction.z) * DVec3::new(1.05, 1.0, 0.93)
}

#[cfg(test)]
mod tests {
    use super::super::super::CubeMap;
    use super::*;

    #[test]
    fn three_lamps_light_a_black_room() {
        let map = CubeMap::from_fn(96, 1, |direction| radiance(direction.normalize()));
        let greens: Vec<f64> = map.mips()[0].faces.iter().flatten().map(|texel| texel.radiance().y).collect();
        let share =
            |test: fn(f64) -> bool| greens.iter().filter(|&&green| test(green)).count() as f64 / greens.len() as f64;
        assert!(share(|green| green < 0.1) > 0.8);
        assert!((0.02..0.15).contains(&share(|green| green > 1.0)));
        // In the middle of the key, at its rim, in the room.
        let toward = |azimuth_deg: f64, elevation_deg: f64| {
            let (sin, cos) = f64::to_radians(elevation_deg).sin_cos();
            radiance((cos * DVec2::from_angle(azimuth_deg.to_radians())).extend(sin)).y
        };
        let (middle, rim, room) = (toward(-42.0, 24.0), toward(-42.0, 55.0), toward(-42.0, 80.0));
        assert!((2.0..5.0).contains(&(middle / rim)), "{}", middle / rim);
        assert!((1000.0..3000.0).contains(&(middle / room)), "{}", middle / room);
        // The table is lit a little, before the key most.
        assert!(toward(-42.0, -40.0) > 10.0 * room && toward(-42.0, -40.0) < 0.15);
        assert!(toward(-42.0, -40.0) > toward(138.0, -40.0));
    }
}
