//! The f64 twin of the GPU's transport scheme: the flow map of Taylor & Nave (arXiv 2106.13170), remapped every few steps.
//!
//! Not the tracer but the map to where the fluid was at the last remap is advected; the tracer is looked up through it. The error
//! then follows the number of remaps and not of steps. A remap after each step is plain bicubic semi-Lagrangian transport.

use glam::DVec3;

use crate::physics::sphere::{CubedSphere, HaloTable, PaddedField};

/// Where the fluid at unit vector `x` and time `t` was a time `dt` earlier: one step of RK4 in Cartesian coordinates, then back
/// onto the sphere. `velocity(x, t)` must accept points a little off the sphere.
pub fn backtrace(x: DVec3, t: f64, dt: f64, velocity: impl Fn(DVec3, f64) -> DVec3) -> DVec3 {
    let k1 = velocity(x, t);
    let k2 = velocity(x - 0.5 * dt * k1, t - 0.5 * dt);
    let k3 = velocity(x - 0.5 * dt * k2, t - 0.5 * dt);
    let k4 = velocity(x - dt * k3, t - dt);
    (x - dt / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)).normalize()
}

/// A tracer and the flow map since it was last resampled.
#[derive(Clone, Debug)]
pub struct FlowMap {
    halo: HaloTable,
    tracer: PaddedField<f64>,
    /// Unit vectors; none stands for the identity, which needs no interpolation.
    map: Option<PaddedField<DVec3>>,
}

impl FlowMap {
    /// A tracer at rest.
    pub fn new(grid: CubedSphere, tracer: impl Fn(DVec3) -> f64 + Sync) -> Self {
        Self::from_field(PaddedField::sample(grid, &HaloTable::new(grid), tracer))
    }

    /// A tracer at rest, by its values on a grid.
    pub fn from_field(tracer: PaddedField<f64>) -> Self {
        Self { halo: HaloTable::new(tracer.grid()), tracer, map: None }
    }

    /// Moves the fluid by one step from time `t` to `t + dt`.
    pub fn step(&mut self, t: f64, dt: f64, velocity: impl Fn(DVec3, f64) -> DVec3 + Sync) {
        let moved = PaddedField::sample(self.tracer.grid(), &self.halo, |x| {
            let earlier = backtrace(x, t + dt, dt, &velocity);
            self.map.as_ref().map_or(earlier, |map| map.bicubic(earlier).normalize())
        });
        self.map = Some(moved);
    }

    /// Resamples the tracer through the map and starts a new map.
    pub fn remap(&mut self) {
        let values = self.values();
        self.tracer = PaddedField::from_cells(self.tracer.grid(), &self.halo, |cell| values[cell]);
        self.map = None;
    }

    /// The tracer's values now, in the grid's order.
    pub fn values(&self) -> Vec<f64> {
        match &self.map {
            None => self.tracer.cells(),
            Some(map) => map.cells().into_iter().map(|origin| self.tracer.bicubic(origin)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::transport::{Measured, PERIOD, Tracer, TracerKind, Wind, WindKind, measure};

    /// The errors after one period of `steps` steps with a remap every `remap_every` of them.
    fn period(n: usize, steps: u32, remap_every: u32, wind: &Wind, tracer: &Tracer) -> Measured {
        let grid = CubedSphere::new(n).unwrap();
        let mut film = FlowMap::new(grid, |x| tracer.value(x));
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

    fn deformation(n: usize, steps: u32, remap_every: u32, kind: TracerKind) -> Measured {
        let wind = Wind::new(WindKind::NonDivergent, None).unwrap();
        period(n, steps, remap_every, &wind, &Tracer::new(kind, wind.tracer_rotation()))
    }

    #[test]
    fn a_backtrace_is_a_rotation_in_solid_rotation() {
        let x = DVec3::new(0.3, 0.4, -0.5).normalize();
        let foot = backtrace(x, 1.0, 0.1, |x, _| DVec3::Z.cross(x));
        assert!(foot.distance(glam::DMat3::from_rotation_z(-0.1) * x) < 1e-7, "RK4: 0.1^5 / 120");
    }

    #[test]
    fn semi_lagrangian_reaches_the_measured_norm() {
        let found = deformation(60, 120, 1, TracerKind::CosineBells);
        // An independent prototype of the same scheme measured 0.081.
        assert!((0.077..0.085).contains(&found.l2), "{found:?}");
        assert!(found.mass_drift.abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn the_flow_map_beats_it_tenfold() {
        let found = deformation(60, 120, 30, TracerKind::CosineBells);
        // The prototype's table: 0.0082.
        assert!((0.0078..0.0086).contains(&found.l2), "{found:?}");
    }

    #[test]
    fn smooth_fields_converge_at_second_order_or_better() {
        let [coarse, fine] =
            [(30, 60), (60, 120)].map(|(n, steps)| deformation(n, steps, 15, TracerKind::GaussianHills).l2);
        assert!(coarse / fine > 4.0, "{coarse:e} / {fine:e}");
    }

    #[test]
    fn a_bell_crosses_the_poles_and_the_corners() {
        let over_poles = Wind::new(WindKind::SolidBody, None).unwrap();
        let usual = Tracer::new(TracerKind::Bell, over_poles.tracer_rotation());
        // At right angles to its axis lie four corners; the bell starts on one and passes the three others.
        let over_corners = Wind::new(WindKind::SolidBody, Some(DVec3::new(1.0, -1.0, 0.0))).unwrap();
        let at_corner = Tracer::at(TracerKind::Bell, DVec3::ONE).unwrap();
        // 40 steps are a third of a turn; 30 would take cells to cells over the poles, and test nothing.
        let [poles, corners] =
            [(over_poles, usual), (over_corners, at_corner)].map(|(wind, bell)| period(60, 120, 40, &wind, &bell).l2);
        assert!(poles < 0.0015, "{poles:e}");
        assert!(corners < 0.0015, "{corners:e}");
    }

    #[test]
    fn constants_stay_constant() {
        let wind = Wind::new(WindKind::Divergent, Some(DVec3::ONE)).unwrap();
        let mut film = FlowMap::new(CubedSphere::new(15).unwrap(), |_| 0.3);
        for step in 0..20 {
            film.step(0.1 * f64::from(step), 0.1, |x, t| wind.velocity(x, t));
            if step % 3 == 0 {
                film.remap();
            }
        }
        assert!(film.values().iter().all(|value| (value - 0.3).abs() < 1e-12));
    }
}
