//! The light tent: cloth lit from outside, with softboxes close to it.

use std::sync::LazyLock;

use glam::{DVec2, DVec3};

use super::{
    shape::{bell, smoothstep},
    softbox::{Look, Softbox},
};

/// Softboxes as azimuth and elevation in degrees, half width and height seen from 1 away, and radiance above the cloth's
/// (linear BT.2020).
///
/// The default camera stands at azimuth 20°, so the key is to its upper left, and two lights behind the bubble draw its rim.
const SOFTBOXES: [(f64, f64, DVec2, DVec3); 5] = [
    (-30.0, 30.0, DVec2::new(0.36, 0.40), DVec3::new(1.95, 1.88, 1.78)),
    (84.0, 16.0, DVec2::new(0.14, 0.60), DVec3::new(1.10, 1.18, 1.30)),
    (205.0, 74.0, DVec2::new(0.50, 0.26), DVec3::new(1.05, 1.05, 1.05)),
    (152.0, 22.0, DVec2::new(0.20, 0.45), DVec3::new(1.15, 1.15, 1.12)),
    (248.0, 18.0, DVec2::new(0.15, 0.50), DVec3::new(0.95, 0.99, 1.06)),
];

/// The tent's upright seams as azimuth in degrees, half width seen from 1 away, and how much of the cloth's light they keep
/// back: dark lines that bend with the bubble and so show its form.
const SEAMS: [(f64, f64, f64); 3] = [(52.0, 0.03, 0.32), (122.0, 0.03, 0.32), (300.0, 0.03, 0.32)];

/// Edges a few degrees soft, and an inner cloth that spreads the light.
const LOOK: Look = Look { corner: 0.09, edge: [0.025, -0.04], rim: 0.6, middle: 0.7 };

static LAMPS: LazyLock<[Softbox; 5]> = LazyLock::new(|| SOFTBOXES.map(|softbox| Softbox::new(softbox, &LOOK)));
static DARK_LINES: LazyLock<[Seam; 3]> = LazyLock::new(|| SEAMS.map(Seam::new));

/// Radiance from a unit `direction`.
pub(super) fn radiance(direction: DVec3) -> DVec3 {
    let shade: f64 = DARK_LINES.iter().map(|seam| seam.shade(direction)).sum();
    let lamps: DVec3 = LAMPS.iter().map(|softbox| softbox.radiance(direction)).sum();
    cloth(direction.z) * (1.0 - shade) + lamps
}

/// Brighter above, a grey floor below that is a little warm.
fn cloth(z: f64) -> DVec3 {
    let floor = DVec3::new(0.46, 0.44, 0.415);
    let horizon = DVec3::splat(0.84);
    let zenith = DVec3::new(1.36, 1.38, 1.41);
    floor.lerp(horizon, smoothstep(-0.8, 0.1, z)) + (zenith - horizon) * smoothstep(-0.1, 1.0, z)
}

/// An upright dark line in the cloth.
struct Seam {
    towards: DVec2,
    half_width: f64,
    depth: f64,
}

impl Seam {
    fn new((azimuth_deg, half_width, depth): (f64, f64, f64)) -> Self {
        Self { towards: DVec2::from_angle(azimuth_deg.to_radians()), half_width, depth }
    }

    /// How much the seam darkens the cloth; it ends before the floor and fades into the roof.
    fn shade(&self, direction: DVec3) -> f64 {
        let level = direction.truncate();
        let along = level.dot(self.towards);
        let across = level.dot(self.towards.perp()).abs() / along;
        if along <= 0.0 || across > 5.0 * self.half_width {
            return 0.0;
        }
        let height = smoothstep(-0.55, -0.3, direction.z) * smoothstep(0.95, 0.7, direction.z);
        self.depth * height * bell(across, self.half_width)
    }
}
