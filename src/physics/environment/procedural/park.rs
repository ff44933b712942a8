//! A park on a late afternoon: a ring of dark trees around a meadow, under a sky with broken clouds and a low sun.
//!
//! Radiances are relative to the clear sky's zenith, which shines a little brighter than a white surface in the trees' shade.
//!
//! | what | radiance | from |
//! |---|---|---|
//! | clear sky | 1 above, 3 at the horizon, 15 beside the sun | CIE standard clear sky (CIE S 011), sun 15° high |
//! | clouds | 1.3 below, up to 7 where the sun meets them | albedo 0.8 in 40 klx, where the zenith has some 1.8 kcd/m² |
//! | sun | 7 sr of the zenith in all | 40 klx, of which haze leaves a third |
//! | foliage | 0.001 inside, 0.005 on average, 0.025 in the sun, 0.5 where sky shines through thin leaves | leaves reflect 5 % (Bowker et al. 1985, NASA RP-1139), and 1 to 2 % of the daylight reaches the inside of a forest (Chazdon and Fetcher 1984) |
//! | meadow | 0.07 in shade, 0.12 in the sun | grass reflects 6 % (Bowker et al. 1985) |

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::{
    noise::{Curve, Tile, mix, random, split, turns},
    photographer::Photographer,
    shape::smoothstep,
};
use crate::physics::environment::Lamp;

/// Azimuth and elevation of the sun in degrees: it is to the left of what the photographer sees, in a gap of the trees.
const SUN_DEG: [f64; 2] = [296.0, 15.0];

/// Irradiance from the sun across its rays.
const SUN_IRRADIANCE: f64 = 7.0;

/// Radius of the sun's disc, in radians.
const SUN_RADIUS: f64 = 0.004_65;

/// Heights (see [`height`]) between which trees may stand before sky or meadow.
const TREES: [f64; 2] = [-0.07, 1.5];

static PARK: LazyLock<Park> = LazyLock::new(Park::new);

/// The sun's disc, which is no part of [`radiance`].
pub(super) fn sun() -> Lamp {
    let radiance = SUN_IRRADIANCE / (std::f64::consts::PI * SUN_RADIUS.powi(2));
    Lamp::disc(PARK.sun, SUN_RADIUS, radiance * DVec3::new(1.1, 1.0, 0.75))
}

/// How high a direction looks: about the tangent of its elevation near the horizon, and 2 at the zenith.
fn height(direction: DVec3) -> f64 {
    2.0 * direction.z / (1.0 + direction.truncate().length())
}

/// Radiance from a unit `direction`.
pub(super) fn radiance(direction: DVec3) -> DVec3 {
    PARK.radiance(direction)
}

struct Park {
    sun: DVec3,
    sun_level: DVec2,
    /// Clear sky around the sun by half the chord to it: the CIE's indicatrix, and the glow of haze.
    around_sun: Curve<2>,
    /// Clear sky by the sine of the elevation: the CIE's gradation.
    gradation: Curve<1>,
    /// By azimuth: the ring's outlines.
    ring: Curve<7>,
    /// By azimuth: where there is sky alone.
    ceiling: Curve<1>,
    noise: Tile,
    photographer: Photographer,
}

impl Park {
    fn new() -> Self {
        let [azimuth, elevation] = SUN_DEG.map(f64::to_radians);
        let sun_level = DVec2::from_angle(azimuth);
        let sun = (elevation.cos() * sun_level).extend(elevation.sin());
        let indicatrix = |angle: f64| 0.91 + 10.0 * (-3.0 * angle).exp() + 0.45 * angle.cos().powi(2);
        let gradation = |sine: f64| 1.0 - (-0.32 / sine.max(1e-3)).exp();
        let zenith = indicatrix(std::f64::consts::FRAC_PI_2 - elevation) * gradation(1.0);
        let around_sun = |half_chord: f64| {
            let angle = 2.0 * half_chord.asin();
            [indicatrix(angle) / zenith, 60.0 * (-angle / 0.03).exp()]
        };
        let ring = Curve::new(2048, ring());
        Self {
            sun,
            sun_level,
            around_sun: Curve::new(1024, around_sun),
            gradation: Curve::new(256, |sine| [gradation(sine)]),
            ceiling: Curve::new(512, ceiling(&ring)),
            ring,
            noise: Tile::new(7),
            photographer: Photographer::new(),
        }
    }

    fn radiance(&self, direction: DVec3) -> DVec3 {
        let slope = height(direction);
        if slope > TREES[1] {
            return self.sky(direction);
        }
        let slope = slope - self.ground(turns(direction.truncate()));
        let seen = if slope < TREES[0] { self.meadow(direction) } else { self.trees(direction, slope) };
        self.photographer.over(seen, direction)
    }

    /// Clear sky, and clouds before it.
    fn sky(&self, direction: DVec3) -> DVec3 {
        let half_chord = 0.5 * direction.distance(self.sun);
        self.clouds(self.clear_sky(direction, half_chord), direction, half_chord)
    }

    /// Air and haze: blue above, white at the horizon, bright around the sun.
    fn clear_sky(&self, direction: DVec3, half_chord: f64) -> DVec3 {
        let [indicatrix, haze] = self.around_sun.at(half_chord);
        let [gradation] = self.gradation.at(direction.z);
        let share = (gradation - self.gradation.at(1.0)[0]) / (1.0 - self.gradation.at(1.0)[0]);
        let air = DVec3::new(0.70, 1.0, 1.88).lerp(DVec3::new(1.06, 1.0, 0.92), share);
        indicatrix * gradation * air + haze * DVec3::new(1.06, 1.0, 0.86)
    }

    /// A layer of broken clouds, seen from below: bright where the sun meets them, grey where they are thick.
    fn clouds(&self, clear: DVec3, direction: DVec3, half_chord: f64) -> DVec3 {
        let place = direction.truncate() / (direction.z.max(0.0) + 0.16);
        let broad = |place: DVec2| self.noise.at(0.11 * place + 0.17);
        let here = broad(place);
        let depth = here + 0.35 * self.noise.at(0.47 * place.perp());
        // The sun looks through.
        let cover = 0.94 * smoothstep(-0.35, 0.75, depth) * smoothstep(0.02, 0.11, half_chord);
        if cover == 0.0 {
            return clear;
        }
        let towards_sun = broad(place + 0.14 * self.sun_level);
        let lit = smoothstep(-1.0, 1.1, here - towards_sun + 0.45 - 0.5 * depth);
        // The nearer to the sun, the more light they scatter forwards.
        let bright = DVec3::new(6.3, 6.0, 5.4) * (1.3 - 0.6 * half_chord);
        clear.lerp(DVec3::new(1.25, 1.32, 1.48).lerp(bright, lit), cover)
    }

    /// The trees, and what is seen between them.
    fn trees(&self, direction: DVec3, slope: f64) -> DVec3 {
        let azimuth = turns(direction.truncate());
        let [ceiling] = self.ceiling.at(azimuth);
        if slope > ceiling {
            return self.sky(direction);
        }
        // The noise repeats seven times, so that it closes around.
        let place = DVec2::new(azimuth * 7.0, slope);
        let coarse = self.noise.at(place * DVec2::new(1.0, 1.4));
        let fine = self.noise.at(place * DVec2::new(4.0, 4.9));
        let leaves = self.noise.at(place * DVec2::new(13.0, 15.1));
        let leaves_aside = self.noise.at(place.perp() * DVec2::new(11.3, 13.0));
        let ragged = 0.030 * coarse + 0.018 * fine + 0.020 * leaves;
        // Crowns are as ragged at their sides as at their tops.
        let aside = (0.014 * fine - 0.012 * coarse + 0.022 * leaves_aside) / std::f64::consts::TAU;
        let [far_top, top, bottom, _, near_top, near_bottom, _] = self.ring.at((azimuth + aside).rem_euclid(1.0));
        let [_, _, _, trunk_cover, _, _, near_trunk] = self.ring.at(azimuth);
        let soft = 0.012;
        let cover = |inside: f64| smoothstep(-soft, soft, inside);
        // How much the sun shines on what is seen of the trees: all opposite of it, nothing before it.
        let front = 0.5 - 0.5 * direction.truncate().dot(self.sun_level);
        let leaf = (0.35 + 0.3 * coarse + 0.4 * fine).max(0.05);
        let high = smoothstep(-0.05, 0.7, slope);

        let inside = |top: f64, bottom: f64| (top - slope).min(slope - bottom) + 1.2 * ragged;
        let (inside_middle, inside_near) = (inside(top, bottom), inside(near_top, near_bottom));
        let (middle, near) = (cover(inside_middle), cover(inside_near));
        // Thin foliage at the edge of a crown lets light through, here more and there less.
        let through = |inside: f64| {
            let thin = (-inside.max(0.0) / 0.022).exp() * (0.35 + 0.65 * leaves).max(0.0) * high;
            thin * DVec3::new(0.42, 0.56, 0.14)
        };
        let foliage = DVec3::new(0.0105, 0.0144, 0.0052) * leaf * (0.25 + 0.8 * high + 1.1 * front);
        let near_foliage = 0.55 * foliage + through(inside_near);
        let foliage = foliage + through(inside_middle);
        let seen = if near == 1.0 {
            near_foliage
        } else if middle == 1.0 && near == 0.0 && near_trunk == 0.0 {
            foliage
        } else {
            let bark = DVec3::new(0.0032, 0.0027, 0.0023) * (0.7 + 1.5 * front);
            let above_ground = smoothstep(-0.05 - soft, -0.05 + soft, slope);
            let trunk = |trunk: f64, bottom: f64| trunk * above_ground * smoothstep(0.08, 0.0, slope - bottom);
            let woods_cover = cover(far_top - slope + 0.4 * ragged) * smoothstep(-0.03 - soft, -0.03 + soft, slope);
            let stems = self.noise.at(place * DVec2::new(2.0, 0.3) + 0.6);
            let woods = DVec3::new(0.0028, 0.0037, 0.0026) * (0.7 + 0.3 * stems + 0.5 * high + 0.5 * front).max(0.15);
            let open = if woods_cover == 1.0 {
                woods
            } else {
                let behind = if slope > 0.0 { self.sky(direction) } else { self.meadow(direction) };
                behind.lerp(woods, woods_cover)
            };
            let behind = open.lerp(bark, trunk(trunk_cover, bottom)).lerp(foliage, middle);
            behind.lerp(0.55 * bark, trunk(near_trunk, near_bottom)).lerp(near_foliage, near)
        };
        // Shrubs around the trees' feet.
        let shrubs = 0.035 * self.noise.at(DVec2::new(azimuth * 21.0, 0.3)) + 0.8 * ragged - slope;
        let shrubs = cover(shrubs) * smoothstep(-0.066, -0.054, slope + 0.2 * ragged);
        let seen = seen.lerp(DVec3::new(0.011, 0.015, 0.006) * leaf * (0.5 + front), shrubs);
        self.gaps(seen, place, top.max(near_top))
    }

    /// Gaps between leaves: points of the sky's light.
    fn gaps(&self, seen: DVec3, place: DVec2, top: f64) -> DVec3 {
        if place.y < 0.0 || place.y > top {
            return seen;
        }
        // A turn is 2π of height near the horizon.
        let level = DVec2::new(std::f64::consts::TAU / 7.0, 1.0);
        let layer = |seen: DVec3, turn: DVec2, seed: u64| {
            let turned = turn.rotate(place * level);
            let ((column, x), (row, y)) = (split(turned.x), split(turned.y));
            let cell = (column as u64).wrapping_mul(4096).wrapping_add(row as u64);
            let center = DVec2::new(0.2 + 0.6 * random(cell, seed + 1), 0.2 + 0.6 * random(cell, seed + 2));
            let out = DVec2::new(x, y) - center;
            // Holes of no shape, of all sizes below that of a leaf.
            let size = 0.03 + 0.10 * random(cell, seed + 4).powi(3);
            let ragged = size * (1.0 + 0.5 * self.noise.at(place * DVec2::new(6.0, 7.0)));
            let cover = smoothstep(1.3 * ragged, 0.7 * ragged, out.length());
            if cover == 0.0 {
                return seen;
            }
            // Each gap as a whole is as bright as the leaves in its middle are open.
            let middle = place - DVec2::new(turn.x, -turn.y).rotate(out) / (turn.length_squared() * level);
            let open = smoothstep(0.08, 0.24, middle.y) * smoothstep(top, top - 0.06, middle.y);
            // Where branches part.
            let gaps = open * smoothstep(-0.1, 1.3, self.noise.at(middle * DVec2::new(1.3, 1.8) + 0.5));
            let bright = (1.0 - 3.2 * random(cell, seed) / gaps.max(1e-3)).max(0.0);
            let light = DVec3::new(6.6, 6.4, 5.2).lerp(DVec3::new(2.4, 3.2, 1.2), random(cell, seed + 3));
            seen + cover * bright * bright * light
        };
        let turns = [(10.0, 3.0, 24), (-7.0, 8.0, 34)];
        turns.into_iter().fold(seen, |seen, (x, y, seed)| layer(seen, DVec2::new(x, y), seed))
    }

    /// How high the ground rises to the trees, by azimuth: it is not quite level.
    fn ground(&self, azimuth: f64) -> f64 {
        0.014 * self.noise.at(DVec2::new(azimuth * 2.0, 0.8)) + 0.004 * self.noise.at(DVec2::new(azimuth * 7.0, 0.1))
    }

    /// Grass, with the long shadows that trees throw away from the sun, and what the sun finds between them.
    fn meadow(&self, direction: DVec3) -> DVec3 {
        // In metres from below the bubble, which hangs at 1.4 m.
        let place = direction.truncate() * (1.4 / (-direction.z).max(0.02));
        let shadow = DVec2::new(place.dot(self.sun_level) * 0.004, place.perp_dot(self.sun_level) * 0.016);
        let edge = 0.3 * self.noise.at(shadow * DVec2::new(3.0, 3.7) + 0.3);
        let lit = smoothstep(0.05, 0.75, self.noise.at(shadow) + edge);
        let near = smoothstep(0.03, 0.3, -direction.z);
        let detail = near * (self.noise.at(place * 0.11) + 0.7 * near * self.noise.at(place.perp() * 0.43));
        let worn = self.noise.at(place * 0.031 + 0.4);
        let tufts = (1.0 + 0.16 * detail + 0.20 * worn).max(0.3);
        let shade = DVec3::new(0.052, 0.066, 0.030);
        let sunny = DVec3::new(0.107, 0.116, 0.043);
        shade.lerp(sunny, lit) * tufts
    }
}

/// A tree of the ring, in slopes, and turns for its azimuth.
struct Tree {
    azimuth: f64,
    half_width: f64,
    top: f64,
    bottom: f64,
    trunk: f64,
}

impl Tree {
    /// `count` trees around, of random sizes.
    fn row(count: u64, seed: u64, width: f64, top: [f64; 2], bottom: [f64; 2]) -> Vec<Self> {
        let tree = |index: u64| {
            let chance = |what: u64| random(index, seed + what);
            let half_width = width * (0.7 + 0.6 * chance(1));
            Self {
                azimuth: (index as f64 + 0.8 * chance(0)) / count as f64,
                half_width,
                top: mix(top[0], top[1], chance(2)),
                bottom: mix(bottom[0], bottom[1], chance(3)),
                trunk: half_width * (0.05 + 0.05 * chance(4)),
            }
        };
        (0..count).map(tree).collect()
    }

    /// Slope of the crown's top and bottom, and how much of the trunk covers, at an azimuth; a top of −1 where there is nothing.
    fn outline(&self, azimuth: f64) -> [f64; 3] {
        let apart = (azimuth - self.azimuth + 0.5).rem_euclid(1.0) - 0.5;
        let across = apart * std::f64::consts::TAU;
        let out = across / (1.15 * self.half_width);
        let edge = 0.003;
        let trunk = smoothstep(self.trunk + edge, self.trunk - edge, across.abs());
        if out.abs() >= 1.0 {
            return [-1.0, 1.0, trunk];
        }
        // At the sides the bottom would lie above the top, so that trees which overlap join without steps.
        let round = (1.0 - out * out).sqrt();
        [mix(self.bottom, self.top, round), mix(self.top, self.bottom, round), trunk]
    }
}

/// The ring by azimuth: top of the woods far away; top, bottom and trunks of the trees before them, and of single trees before these.
fn ring() -> impl Fn(f64) -> [f64; 7] {
    let woods = Tree::row(70, 100, 0.10, [0.16, 0.28], [0.0, 0.0]);
    let middle = Tree::row(34, 200, 0.17, [0.40, 0.70], [0.03, 0.10]);
    let near = Tree::row(11, 300, 0.32, [0.70, 1.25], [0.12, 0.22]);
    let union = |trees: &[Tree], azimuth: f64| {
        let outlines = trees.iter().map(|tree| tree.outline(azimuth));
        outlines
            .fold([-1.0f64, 1.0f64, 0.0f64], |all, one| [all[0].max(one[0]), all[1].min(one[1]), all[2].max(one[2])])
    };
    move |azimuth| {
        let apart = |degrees: f64| (azimuth - degrees / 360.0 + 0.5).rem_euclid(1.0) - 0.5;
        let [far_top, ..] = union(&woods, azimuth);
        let [top, bottom, trunk] = union(&middle, azimuth);
        let [near_top, near_bottom, near_trunk] = union(&near, azimuth);
        // The sun stands in a gap.
        let gap = 0.17 + 500.0 * apart(SUN_DEG[0]).powi(2);
        [far_top.max(0.08).min(gap), top.min(gap), bottom, trunk, near_top.min(gap), near_bottom, near_trunk]
    }
}

/// The ring's highest top within 7°, and as high above it as leaves reach.
fn ceiling(ring: &Curve<7>) -> impl Fn(f64) -> [f64; 1] + '_ {
    let top = |azimuth: f64| {
        let [far_top, top, _, _, near_top, ..] = ring.at(azimuth.rem_euclid(1.0));
        far_top.max(top).max(near_top)
    };
    move |azimuth| [(-8..=8).map(|k| top(azimuth + f64::from(k) * 0.0025)).fold(0.0, f64::max) + 0.16]
}

#[cfg(test)]
mod tests {
    use super::{super::photographer::PHOTOGRAPHER_DEG, *};

    fn toward(azimuth_deg: f64, elevation_deg: f64) -> DVec3 {
        let (sin, cos) = elevation_deg.to_radians().sin_cos();
        (cos * DVec2::from_angle(azimuth_deg.to_radians())).extend(sin)
    }

    fn clear_sky(azimuth_deg: f64, elevation_deg: f64) -> f64 {
        let direction = toward(azimuth_deg, elevation_deg);
        PARK.clear_sky(direction, 0.5 * direction.distance(PARK.sun)).y
    }

    #[test]
    fn the_clear_sky_is_that_of_the_cie() {
        assert!((clear_sky(0.0, 90.0) - 1.0).abs() < 0.01);
        let horizon = clear_sky(SUN_DEG[0] + 90.0, 2.0);
        assert!((2.5..4.0).contains(&horizon), "{horizon}");
        let beside = clear_sky(SUN_DEG[0] + 8.0, SUN_DEG[1]);
        assert!((12.0..20.0).contains(&beside), "{beside}");
    }

    #[test]
    fn the_sun_sends_what_it_should_and_nothing_stands_before_it() {
        let (sun, beside) = (sun(), 0.03);
        assert!((sun.area() * sun.radiance.y / SUN_IRRADIANCE - 1.0).abs() < 1e-12);
        for k in 0..16 {
            let around = DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 16.0);
            let (right, up) = (sun.right, sun.towards.cross(sun.right));
            let near = (sun.towards + beside * (around.x * right + around.y * up)).normalize();
            // The bright haze around it, no leaf.
            assert!(radiance(near).y > 10.0, "{k}");
        }
    }

    #[test]
    fn radiances_are_those_of_the_table() {
        let greens = |elevation_deg: std::ops::Range<i32>| {
            let directions = elevation_deg.flat_map(|e| (0..360).map(move |a| toward(f64::from(a), f64::from(e))));
            let mut greens: Vec<f64> = directions.map(|direction| radiance(direction).y).collect();
            greens.sort_by(f64::total_cmp);
            move |share: f64| greens[(share * (greens.len() - 1) as f64) as usize]
        };
        let sky = greens(70..90);
        // Above all trees, far from the sun, clouds are not at their brightest.
        assert!((0.8..1.4).contains(&sky(0.02)) && (2.5..7.0).contains(&sky(0.98)), "{} {}", sky(0.02), sky(0.98));
        let trees = greens(2..9);
        assert!(
            (0.0006..0.003).contains(&trees(0.1)) && (0.005..0.02).contains(&trees(0.8)),
            "{} {}",
            trees(0.1),
            trees(0.8)
        );
        let meadow = greens(-60..-6);
        assert!(
            (0.04..0.09).contains(&meadow(0.3)) && (0.08..0.15).contains(&meadow(0.98)),
            "{} {}",
            meadow(0.3),
            meadow(0.98)
        );
    }

    #[test]
    fn the_photographer_is_dark_and_stands_behind_the_default_camera() {
        let (body, beside) =
            (radiance(toward(PHOTOGRAPHER_DEG, -20.0)).y, radiance(toward(PHOTOGRAPHER_DEG + 25.0, -20.0)).y);
        assert!(body < 0.3 * beside, "{body} before {beside}");
    }
}
