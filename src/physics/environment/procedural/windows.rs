//! The dark room: a box around the bubble, with windows in its walls and an overcast sky outside.

use glam::{DVec2, DVec3};

use super::shape::{bell, panes, rounded_box_distance, smoothstep};

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
    let inside = room(hit);
    let Some((wall, on_wall)) = wall_at(hit) else {
        return inside;
    };
    let windows = WINDOWS.iter().filter(|window| window.wall == wall);
    windows.fold(inside, |behind, window| window.over(behind, on_wall, direction))
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
        self.sky * (1.6 * bell(hit.distance(pool), 0.75) + 0.8 * bell(hit.distance(middle), 1.2))
    }

    /// The window in front of the wall's radiance `behind`, seen at `on_wall` along `direction`.
    fn over(&self, behind: DVec3, on_wall: DVec2, direction: DVec3) -> DVec3 {
        let position = on_wall - self.center_m;
        let half = self.half_size_m;
        let frame = smoothstep(0.10, 0.06, rounded_box_distance(position, half, 0.02));
        let across = |axis: usize| panes(position[axis], half[axis], self.panes[axis], BAR_M, EDGE_M);
        let glass = across(0) * across(1);
        // Bars stand against the light: only a little of it creeps round them.
        let painted = behind.lerp(0.16 * self.sky, frame);
        if glass > 0.0 { painted.lerp(outside(direction) * self.sky, glass) } else { painted }
    }
}

/// Overcast sky, brighter above, over a soft line of trees.
fn outside(direction: DVec3) -> DVec3 {
    let slope = direction.z / direction.truncate().length().max(1e-9);
    let azimuth = direction.y.atan2(direction.x);
    let tree_line =
        -0.08 + 0.035 * (5.0 * azimuth).sin() + 0.02 * (13.0 * azimuth + 1.0).sin() + 0.01 * (29.0 * azimuth).sin();
    let sky = DVec3::splat(9.0 + 4.5 * smoothstep(-0.1, 0.7, slope));
    let trees = DVec3::new(2.6, 3.0, 2.5);
    trees.lerp(sky, smoothstep(tree_line - 0.02, tree_line + 0.03, slope))
}
