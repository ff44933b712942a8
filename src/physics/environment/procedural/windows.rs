//! The dark room: a box around the bubble, with windows in its walls and an overcast sky outside.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::{
    noise::{Curve, Tile, random, turns},
    shape::{panes, rounded_box_distance, smoothstep},
};

/// The room's corners in metres, the bubble at the origin.
const ROOM_MIN: DVec3 = DVec3::new(-3.4, -2.1, -1.35);
const ROOM_MAX: DVec3 = DVec3::new(2.4, 2.2, 1.7);

/// Width of the bars between panes, and of their soft edges, in metres.
const BAR_M: f64 = 0.05;
const EDGE_M: f64 = 0.018;

/// A side of the room that has windows.
#[derive(Clone, Copy, PartialEq)]
enum Wall {
    /// At +x: behind the default camera.
    Behind,
    /// At −y: to its left.
    Left,
    /// At +y: to its right.
    Right,
    /// At +z: skylights.
    Ceiling,
}

/// A window of rectangular panes.
struct Window {
    wall: Wall,
    /// Its middle in metres: along the wall (y behind, x at the sides) and up; x and y in the ceiling.
    center_m: DVec2,
    half_size_m: DVec2,
    /// Panes along the wall and up.
    panes: DVec2,
    /// Colour and strength of the sky that it shows.
    sky: DVec3,
}

const COOL_SKY: DVec3 = DVec3::new(0.80, 0.86, 0.95);

const WINDOWS: [Window; 5] = [
    Window {
        wall: Wall::Behind,
        center_m: DVec2::new(-0.40, 0.28),
        half_size_m: DVec2::new(1.08, 1.02),
        panes: DVec2::new(3.0, 3.0),
        sky: DVec3::new(0.94, 1.0, 1.08),
    },
    Window {
        wall: Wall::Left,
        center_m: DVec2::new(0.50, 0.24),
        half_size_m: DVec2::new(0.58, 1.02),
        panes: DVec2::new(2.0, 3.0),
        sky: COOL_SKY,
    },
    Window {
        wall: Wall::Left,
        center_m: DVec2::new(-1.25, 0.24),
        half_size_m: DVec2::new(0.58, 1.02),
        panes: DVec2::new(2.0, 3.0),
        sky: COOL_SKY,
    },
    Window {
        wall: Wall::Right,
        center_m: DVec2::new(0.0, 0.26),
        half_size_m: DVec2::new(0.82, 0.98),
        panes: DVec2::new(2.0, 2.0),
        sky: DVec3::new(0.98, 0.90, 0.79),
    },
    Window {
        wall: Wall::Ceiling,
        center_m: DVec2::new(0.15, 0.35),
        half_size_m: DVec2::new(0.42, 1.0),
        panes: DVec2::new(1.0, 4.0),
        sky: DVec3::new(0.72, 0.80, 0.92),
    },
];

/// Radiance from a unit `direction`.
pub(super) fn radiance(direction: DVec3) -> DVec3 {
    let hit = room_hit(direction);
    let window = wall_at(hit).and_then(|(wall, on_wall)| {
        let mut windows = WINDOWS.iter().filter(|window| window.wall == wall);
        windows.find_map(|window| window.seen(on_wall - window.center_m))
    });
    let Some((window, position, frame)) = window else {
        return room(hit);
    };
    let glass = window.glass(position);
    let light = if glass > 0.0 { window.pane(position) * outside(direction) * window.sky } else { DVec3::ZERO };
    if glass == 1.0 {
        return light;
    }
    // Bars stand against the light: only a little of it creeps round them.
    room(hit).lerp(0.16 * window.sky, frame).lerp(light, glass)
}

/// Where a ray from the bubble meets the room.
fn room_hit(direction: DVec3) -> DVec3 {
    let reach = |towards: f64, low: f64, high: f64| {
        if towards.abs() < 1e-12 { f64::INFINITY } else { (if towards > 0.0 { high } else { low }) / towards }
    };
    let x = reach(direction.x, ROOM_MIN.x, ROOM_MAX.x);
    let y = reach(direction.y, ROOM_MIN.y, ROOM_MAX.y);
    let z = reach(direction.z, ROOM_MIN.z, ROOM_MAX.z);
    direction * x.min(y).min(z)
}

/// The windowed wall that a point of the room lies on, and where: along it and up, in metres.
fn wall_at(hit: DVec3) -> Option<(Wall, DVec2)> {
    let on = |coordinate: f64, wall: f64| (coordinate - wall).abs() < 1e-9;
    if on(hit.x, ROOM_MAX.x) {
        Some((Wall::Behind, DVec2::new(hit.y, hit.z)))
    } else if on(hit.y, ROOM_MIN.y) {
        Some((Wall::Left, DVec2::new(hit.x, hit.z)))
    } else if on(hit.y, ROOM_MAX.y) {
        Some((Wall::Right, DVec2::new(hit.x, hit.z)))
    } else if on(hit.z, ROOM_MAX.z) {
        Some((Wall::Ceiling, DVec2::new(hit.x, hit.y)))
    } else {
        None
    }
}

/// Walls, ceiling and a warm floor, dim, with corners darker still and pools of light before the windows.
fn room(hit: DVec3) -> DVec3 {
    let height = (hit.z - ROOM_MIN.z) / (ROOM_MAX.z - ROOM_MIN.z);
    let wall = DVec3::new(0.024, 0.025, 0.027);
    let floor = DVec3::new(0.042, 0.032, 0.023);
    let surface = floor.lerp(wall, smoothstep(0.0, 0.06, height)) * corner_shade(hit);
    let pools: DVec3 = WINDOWS.iter().map(|window| window.pool(hit)).sum();
    surface + floor.lerp(wall, 0.35 + 0.65 * height) * pools
}

/// Two surfaces that meet shade each other: 1 in the open, about a half where they join.
fn corner_shade(hit: DVec3) -> f64 {
    let gaps = (hit - ROOM_MIN).min(ROOM_MAX - hit).max(DVec3::ZERO);
    // The smallest gap is the surface itself.
    let middle = gaps.element_sum() - gaps.max_element() - gaps.min_element();
    0.5 + 0.5 * smoothstep(0.0, 0.9, middle)
}

impl Window {
    /// The window's middle in the room, and the direction into the room there.
    fn middle(&self) -> (DVec3, DVec3) {
        let DVec2 { x: along, y: up } = self.center_m;
        match self.wall {
            Wall::Behind => (DVec3::new(ROOM_MAX.x, along, up), DVec3::NEG_X),
            Wall::Left => (DVec3::new(along, ROOM_MIN.y, up), DVec3::Y),
            Wall::Right => (DVec3::new(along, ROOM_MAX.y, up), DVec3::NEG_Y),
            Wall::Ceiling => (DVec3::new(along, up, ROOM_MAX.z), DVec3::NEG_Z),
        }
    }

    /// Light that the window throws on the room at `hit`, relative to the surface there: a pool on the floor, a glow on the
    /// wall around.
    fn pool(&self, hit: DVec3) -> DVec3 {
        let (middle, inwards) = self.middle();
        let pool = (middle + 1.1 * inwards).with_z(ROOM_MIN.z);
        self.sky * (1.6 * glow(hit.distance_squared(pool), 0.75) + 0.8 * glow(hit.distance_squared(middle), 1.2))
    }

    /// The window, the position in it and how much of its frame covers, if it is seen at that position at all.
    fn seen(&self, position: DVec2) -> Option<(&Self, DVec2, f64)> {
        let outline = rounded_box_distance(position, self.half_size_m, 0.02);
        (outline < 0.10).then(|| (self, position, smoothstep(0.10, 0.06, outline)))
    }

    /// How much of the wall is glass at a position in the window.
    fn glass(&self, position: DVec2) -> f64 {
        let across = |axis: usize| panes(position[axis], self.half_size_m[axis], self.panes[axis], BAR_M, EDGE_M);
        across(0) * across(1)
    }

    /// How much light a pane lets through at a position in the window: no two panes are equally clean, and dust gathers in corners.
    fn pane(&self, position: DVec2) -> f64 {
        let along = (position / self.half_size_m + 1.0) * 0.5 * self.panes;
        let number = along.floor().max(DVec2::ZERO);
        let middle = 2.0 * (along - number) - 1.0;
        let index = number.x + 8.0 * number.y + 64.0 * (1.0 + self.center_m.x.abs()) * (1.0 + self.wall as u8 as f64);
        let clean = 0.84 + 0.16 * random(index as u64, 5);
        let dust = 0.16 * (middle.x * middle.y).powi(2) + 0.10 * middle.y.min(0.0).powi(2);
        clean - dust
    }
}

/// A bell of a squared distance, of height 1 and width `sigma`, that is 0 from 2.4 widths on.
fn glow(distance_squared: f64, sigma: f64) -> f64 {
    (1.0 - distance_squared / (6.0 * sigma * sigma)).max(0.0).powi(3)
}

/// Slope of the skyline by azimuth: roofs, chimneys and trees.
static SKYLINE: LazyLock<Curve<1>> = LazyLock::new(|| Curve::new(2048, |turn| [skyline(turn)]));

static CLOUDS: LazyLock<Tile> = LazyLock::new(|| Tile::new(11));

fn skyline(turn: f64) -> f64 {
    let house = |count: u64, seed: u64| {
        let place = turn * count as f64;
        let (index, inside) = (place as u64 % count, place.fract());
        let height = 0.13 * random(index, seed) - 0.03;
        let gable = 0.05 * (1.0 - (2.0 * inside - 1.0).abs()) * random(index, seed + 1);
        let chimney_at = 0.2 + 0.6 * random(index, seed + 2);
        let chimney = if (inside - chimney_at).abs() < 0.05 { 0.025 } else { 0.0 };
        height + gable + chimney
    };
    let angle = turn * std::f64::consts::TAU;
    let trees = 0.01 + 0.04 * (5.0 * angle).sin() + 0.02 * (13.0 * angle + 1.0).sin() + 0.008 * (61.0 * angle).sin();
    house(53, 1).max(house(31, 11) - 0.01).max(trees) - 0.04
}

/// Overcast sky with some structure, brighter above, over dark roofs and trees.
fn outside(direction: DVec3) -> DVec3 {
    let slope = direction.z / direction.truncate().length().max(1e-9);
    let turn = turns(direction.truncate());
    let [line] = SKYLINE.at(turn);
    let above = smoothstep(line - 0.004, line + 0.010, slope);
    let fronts = CLOUDS.at(DVec2::new(6.0 * turn, 0.7 * slope)).clamp(-1.5, 1.5);
    let street = DVec3::new(0.55, 0.56, 0.55) * (1.0 + 0.5 * smoothstep(0.1, -0.8, slope) + 0.25 * fronts);
    if above == 0.0 {
        return street;
    }
    let high = smoothstep(-0.05, 0.9, slope);
    let place = direction.truncate() / (direction.z.max(0.0) + 0.3);
    let clouds = CLOUDS.at(0.14 * place) + 0.4 * CLOUDS.at(0.5 * place.perp());
    let sky = (8.4 + 4.0 * high) * (1.0 + 0.17 * clouds).clamp(0.6, 1.5);
    street.lerp(sky * DVec3::new(1.0, 1.0, 1.02), above)
}
