//! Exact answers: the initial field at the foot of the trajectory.

use glam::DVec3;

use super::{PERIOD, Tracer, Wind};
use crate::words::words;

words! {
    /// What a tracer's values mean in a divergent wind.
    pub enum Quantity: "kind" {
        Density = "density", "Amount per area: thins where the wind diverges; its integral is conserved";
        Ratio = "ratio", "Amount per amount, a mixing ratio: carried unchanged";
    }
}

/// Where a point of the fluid was at time 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// The unit vector X.
    pub point: DVec3,
    /// J: the area there of a small patch, relative to its area now.
    pub area_ratio: f64,
}

/// The departure at time 0 of the fluid that is at `x` at time `t`, by `steps` steps of RK4 backwards.
///
/// J = exp(−∫ div dt) along the trajectory, with the divergence in closed form: it converges at the trajectory's own fourth order,
/// where finite differences of the backward map would cancel digits. After whole periods every wind has undone itself, and
/// the departure is `x` without any step.
pub fn departure(wind: &Wind, x: DVec3, t: f64, steps: u32) -> Departure {
    let periods = t / PERIOD;
    if (periods - periods.round()).abs() < 1e-12 || steps == 0 {
        return Departure { point: x, area_ratio: 1.0 };
    }
    let dt = t / f64::from(steps);
    let (point, stretch) = (0..steps).fold((x, 0.0), |(x, stretch), step| {
        let (x, change) = step_back(wind, x, t - f64::from(step) * dt, dt);
        (x, stretch + change)
    });
    Departure { point, area_ratio: (-stretch).exp() }
}

/// The exact value at `x` and time `t` of a tracer that started as `tracer`; `steps` as in [`departure`].
pub fn exact(wind: &Wind, tracer: &Tracer, quantity: Quantity, x: DVec3, t: f64, steps: u32) -> f64 {
    let departure = departure(wind, x, t, steps);
    let factor = match quantity {
        Quantity::Density => departure.area_ratio,
        Quantity::Ratio => 1.0,
    };
    tracer.value(departure.point) * factor
}

/// One RK4 step backwards from time `t`: the earlier point, and ∫ div dt over the step.
fn step_back(wind: &Wind, x: DVec3, t: f64, dt: f64) -> (DVec3, f64) {
    let rate = |x: DVec3, t: f64| (wind.velocity(x, t), wind.divergence(x, t));
    let (v1, d1) = rate(x, t);
    let (v2, d2) = rate((x - 0.5 * dt * v1).normalize(), t - 0.5 * dt);
    let (v3, d3) = rate((x - 0.5 * dt * v2).normalize(), t - 0.5 * dt);
    let (v4, d4) = rate((x - dt * v3).normalize(), t - dt);
    let point = x - dt / 6.0 * (v1 + 2.0 * (v2 + v3) + v4);
    (point.normalize(), dt / 6.0 * (d1 + 2.0 * (d2 + d3) + d4))
}

#[cfg(test)]
mod tests {
    use glam::DMat3;

    use super::*;
    use crate::physics::{
        sphere::CubedSphere,
        transport::{TracerKind, WindKind},
    };

    fn wind(kind: WindKind) -> Wind {
        Wind::new(kind, None).unwrap()
    }

    #[test]
    fn solid_rotation_departs_from_the_turned_point() {
        let x = DVec3::new(0.2, 0.6, -0.5).normalize();
        let turned = DMat3::from_rotation_x(-std::f64::consts::PI) * x;
        let found = departure(&wind(WindKind::SolidBody), x, PERIOD / 2.0, 480);
        assert!(found.point.distance(turned) < 1e-8);
        assert_eq!(found.area_ratio, 1.0);
    }

    #[test]
    fn trajectories_converge_at_fourth_order_or_better() {
        let wind = wind(WindKind::Divergent);
        let x = DVec3::new(-0.7, 0.3, 0.6).normalize();
        let [coarse, fine, truth] = [60, 120, 3000].map(|steps| departure(&wind, x, 2.5, steps));
        let error = |d: Departure| [d.point.distance(truth.point), (d.area_ratio - truth.area_ratio).abs()];
        for (coarse, fine) in error(coarse).into_iter().zip(error(fine)) {
            assert!(fine < 1e-6 && coarse / fine > 12.0, "ideal 16: {coarse:e} / {fine:e}");
        }
    }

    #[test]
    fn the_area_ratio_is_that_of_the_backward_map() {
        let wind = wind(WindKind::Divergent);
        let d = 1e-5;
        for x in
            [DVec3::new(-0.7, 0.3, 0.6), DVec3::new(0.1, -0.8, -0.4), DVec3::new(0.5, 0.5, 0.5)].map(DVec3::normalize)
        {
            let (e1, e2) = x.any_orthonormal_pair();
            let foot = |step: DVec3| departure(&wind, (x + step).normalize(), 2.5, 240).point;
            let slope = |e: DVec3| (foot(d * e) - foot(-d * e)) / (2.0 * d);
            let area = slope(e1).cross(slope(e2)).length();
            let ratio = departure(&wind, x, 2.5, 240).area_ratio;
            assert!((area - ratio).abs() < 1e-7, "{area} against {ratio}");
            assert!((ratio - 1.0).abs() > 1e-3, "a case that tests nothing");
        }
    }

    #[test]
    fn density_keeps_its_mass_and_ratio_does_not() {
        let grid = CubedSphere::new(40).unwrap();
        let wind = wind(WindKind::Divergent);
        let tracer = Tracer::new(TracerKind::GaussianHills, DMat3::IDENTITY);
        let areas = grid.areas();
        let mass = |value: &dyn Fn(DVec3) -> f64| -> f64 {
            areas.iter().enumerate().map(|(cell, area)| area * value(grid.cell_direction(cell))).sum()
        };
        let initial = mass(&|x| tracer.value(x));
        let [density, ratio] = [Quantity::Density, Quantity::Ratio]
            .map(|quantity| mass(&|x| exact(&wind, &tracer, quantity, x, 2.5, 100)) / initial - 1.0);
        // The cell sum is a midpoint rule, second order in D = 0.04, on a sheared field.
        assert!(density.abs() < 1e-3, "{density:e}");
        assert!(ratio.abs() > 1e-2, "{ratio:e}");
    }
}
