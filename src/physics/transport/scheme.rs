//! The schemes that move films, and the f64 twin of the flow map (Taylor & Nave, arXiv 2106.13170 and 2302.01205).
//!
//! Not the tracer but the map to where the fluid was at the last remap is advected; the tracer is looked up through it. The error
//! then follows the number of remaps and not of steps. A remap after each step is plain semi-Lagrangian transport.

use glam::{DVec3, DVec4};

use crate::{
    physics::sphere::{CubedSphere, GridError, PaddedField},
    words::words,
};

words! {
    /// How a tracer is moved.
    #[derive(Default)]
    pub enum Scheme: "scheme" {
        Bilinear = "bilinear", "Semi-Lagrangian with bilinear interpolation, for comparison: the film blurs";
        Bicubic = "bicubic", "Semi-Lagrangian with bicubic interpolation, for comparison: filaments blur";
        Bfecc = "bfecc", "Bilinear with back and forth error compensation, for comparison";
        #[default]
        Map = "map", "A flow map, remapped rarely: filaments stay sharp";
        MapAccurate = "map-accurate", "A flow map, with the thickness on a grid twice as fine";
    }
}

impl Scheme {
    /// Whether it keeps a map from step to step.
    pub fn keeps_map(self) -> bool {
        matches!(self, Self::Map | Self::MapAccurate)
    }

    /// Taps along each side of the stencil that looks the tracer up.
    pub fn taps(self) -> u32 {
        match self {
            Self::Bilinear | Self::Bfecc => 2,
            Self::Bicubic => 4,
            Self::Map | Self::MapAccurate => 6,
        }
    }

    /// Cells of the tracer's grid along one of the film's cells.
    pub fn tracer_refinement(self) -> usize {
        if self == Self::MapAccurate { 2 } else { 1 }
    }

    /// The grid that the tracer is kept on. Fails where it would be too fine.
    pub fn tracer_grid(self, film: CubedSphere) -> Result<CubedSphere, GridError> {
        CubedSphere::new(film.n() * self.tracer_refinement())
    }
}

/// Where the fluid at unit vector `x` and time `t` was a time `dt` earlier: one step of RK4 in Cartesian coordinates, each stage on the
/// sphere.
pub fn backtrace(x: DVec3, t: f64, dt: f64, velocity: impl Fn(DVec3, f64) -> DVec3) -> DVec3 {
    let k1 = velocity(x, t);
    let k2 = velocity((x - 0.5 * dt * k1).normalize(), t - 0.5 * dt);
    let k3 = velocity((x - 0.5 * dt * k2).normalize(), t - 0.5 * dt);
    let k4 = velocity((x - dt * k3).normalize(), t - dt);
    (x - dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)).normalize()
}

/// A tracer and the flow map since it was last resampled: the f64 twin of what the GPU does for non-divergent flows.
#[derive(Clone, Debug)]
pub struct FlowMap {
    scheme: Scheme,
    grid: CubedSphere,
    tracer: PaddedField<f64>,
    /// Unit vectors; none stands for the identity, which needs no interpolation. The fourth number is not used.
    map: Option<PaddedField<DVec4>>,
    /// Means over the sphere to be kept, of the shown field and of the tracer on its own grid.
    means: [f64; 2],
}

impl FlowMap {
    /// A tracer at rest on a film's grid.
    pub fn new(grid: CubedSphere, scheme: Scheme, tracer: impl Fn(DVec3) -> f64 + Sync) -> Result<Self, GridError> {
        let mean = |grid: CubedSphere| {
            let cells: Vec<f64> = (0..grid.cells()).map(|cell| tracer(grid.cell_direction(cell))).collect();
            mean(grid, &cells)
        };
        let fine = scheme.tracer_grid(grid)?;
        let means = [mean(grid), mean(fine)];
        Ok(Self { scheme, grid, tracer: PaddedField::sample(fine, &tracer), map: None, means })
    }

    /// Moves the fluid by one step from time `t` to `t + dt`.
    pub fn step(&mut self, t: f64, dt: f64, velocity: impl Fn(DVec3, f64) -> DVec3 + Sync) {
        let moved = PaddedField::sample(self.grid, |x| {
            let earlier = backtrace(x, t + dt, dt, &velocity);
            self.map.as_ref().map_or(earlier.extend(0.0), |map| unit(map.bicubic(earlier)))
        });
        self.map = Some(moved);
    }

    /// Resamples the tracer through the map and starts a new map.
    pub fn remap(&mut self) {
        let grid = self.tracer.grid();
        let sampled = PaddedField::sample(grid, |x| self.lookup(self.origin(x)));
        let change = self.means[1] - mean(grid, &sampled.cells());
        self.tracer = PaddedField::from_padded(grid, sampled.padded().iter().map(|value| value + change).collect());
        self.map = None;
    }

    /// The tracer's values now, in the film grid's order.
    pub fn values(&self) -> Vec<f64> {
        let values: Vec<f64> = (0..self.grid.cells()).map(|cell| self.value(self.grid.cell_direction(cell))).collect();
        let change = self.means[0] - mean(self.grid, &values);
        values.into_iter().map(|value| value + change).collect()
    }

    /// The tracer's value now at a unit vector, before the correction that keeps its mean.
    pub fn value(&self, x: DVec3) -> f64 {
        self.lookup(self.origin(x))
    }

    fn origin(&self, x: DVec3) -> DVec3 {
        self.map.as_ref().map_or(x, |map| map.bicubic(x).truncate().normalize())
    }

    fn lookup(&self, origin: DVec3) -> f64 {
        match self.scheme.taps() {
            2 => self.tracer.bilinear(origin),
            4 => self.tracer.bicubic(origin),
            _ => self.tracer.biquintic(origin),
        }
    }
}

/// The same with its first three numbers made a unit vector.
fn unit(v: DVec4) -> DVec4 {
    v.truncate().normalize().extend(v.w)
}

/// The mean over the sphere of values in the grid's order.
fn mean(grid: CubedSphere, values: &[f64]) -> f64 {
    let sum: f64 = values.iter().zip(grid.areas()).map(|(value, area)| value * area).sum();
    sum / (4.0 * std::f64::consts::PI)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::transport::{Measured, PERIOD, Tracer, TracerKind, Wind, WindKind, measure};

    /// The errors after one period of `steps` steps with a remap every `remap_every` of them.
    fn period(n: usize, scheme: Scheme, steps: u32, remap_every: u32, wind: &Wind, tracer: &Tracer) -> Measured {
        let grid = CubedSphere::new(n).unwrap();
        let mut film = FlowMap::new(grid, scheme, |x| tracer.value(x)).unwrap();
        let initial = film.values();
        let dt = PERIOD / f64::from(steps);
        for step in 0..steps {
            film.step(f64::from(step) * dt, dt, |x, t| wind.velocity(x, t));
            if (step + 1) % remap_every == 0 {
                film.remap();
            }
        }
        measure(grid, &film.values(), &initial, &initial)
    }

    fn deformation(n: usize, scheme: Scheme, steps: u32, remap_every: u32, kind: TracerKind) -> Measured {
        let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
        period(n, scheme, steps, remap_every, &wind, &Tracer::new(kind, wind.tracer_rotation()))
    }

    #[test]
    fn a_backtrace_is_a_rotation_in_solid_rotation() {
        let x = DVec3::new(0.3, 0.4, -0.5).normalize();
        let foot = backtrace(x, 1.0, 0.1, |x, _| DVec3::Z.cross(x));
        assert!(foot.distance(glam::DMat3::from_rotation_z(-0.1) * x) < 1e-7, "RK4: 0.1^5 / 120");
    }

    #[test]
    fn semi_lagrangian_reaches_the_measured_norm() {
        let found = deformation(60, Scheme::Bicubic, 120, 1, TracerKind::CosineBells);
        // An independent prototype of the same scheme measured 0.081.
        assert!((0.077..0.085).contains(&found.l2), "{found:?}");
    }

    #[test]
    fn the_flow_map_beats_it_tenfold() {
        let found = deformation(60, Scheme::Map, 120, 30, TracerKind::CosineBells);
        // The prototype's table: 0.0048.
        assert!((0.0043..0.0053).contains(&found.l2), "{found:?}");
        assert!(found.mass_drift.abs() < 1e-13, "{found:?}");
    }

    #[test]
    fn smooth_fields_converge_at_fourth_order() {
        let error = |n, steps| deformation(n, Scheme::Map, steps, steps / 4, TracerKind::GaussianHills).l2;
        let (coarse, fine) = (error(20, 60), error(40, 120));
        assert!(coarse / fine > 10.0, "ideal 16 for the map, 64 for the tracer: {coarse:e} / {fine:e}");
    }

    #[test]
    fn a_bell_crosses_the_poles_and_the_corners() {
        let over_poles = Wind::new(WindKind::SolidBody, None).unwrap();
        let usual = Tracer::new(TracerKind::Bell, over_poles.tracer_rotation());
        // At right angles to its axis lie four corners; the bell starts on one and passes the three others.
        let over_corners = Wind::new(WindKind::SolidBody, Some(DVec3::new(1.0, -1.0, 0.0))).unwrap();
        let at_corner = Tracer::at(TracerKind::Bell, DVec3::ONE).unwrap();
        // 40 steps are a third of a turn; 30 would take cells to cells over the poles, and test nothing.
        let [poles, corners] = [(over_poles, usual), (over_corners, at_corner)]
            .map(|(wind, bell)| period(60, Scheme::Bicubic, 120, 40, &wind, &bell).l2);
        assert!(poles < 0.0015, "{poles:e}");
        assert!(corners < 0.0015, "{corners:e}");
    }

    #[test]
    fn constants_stay_constant() {
        let wind = Wind::new(WindKind::Divergent, Some(DVec3::ONE)).unwrap();
        let mut film = FlowMap::new(CubedSphere::new(15).unwrap(), Scheme::Map, |_| 0.3).unwrap();
        for step in 0..20 {
            film.step(0.1 * f64::from(step), 0.1, |x, t| wind.velocity(x, t));
            if step % 3 == 0 {
                film.remap();
            }
        }
        assert!(film.values().iter().all(|value| (value - 0.3).abs() < 1e-12));
    }

    #[test]
    fn schemes_are_known_by_their_names() {
        for scheme in Scheme::ALL {
            assert_eq!(scheme.name().parse(), Ok(scheme));
        }
        let error = "maps".parse::<Scheme>().unwrap_err().to_string();
        assert_eq!(error, "unknown scheme \"maps\": use one of bilinear, bicubic, bfecc, map, map-accurate");
    }
}
