//! One step traced back, from each cell to where its liquid was when the step began: the twin of `shaders/pass/trace_step.wgsl` for flows in
//! closed form and of `shaders/pass/trace_flow.wgsl` for a solved one. The cells of the halo are places like any others.

use glam::DVec3;

use crate::physics::{
    film::PrescribedFlow,
    flow::origin,
    sphere::{CubedSphere, PaddedField},
    transport::backtrace,
};

/// Unit vectors to where the liquid of each cell was `dt_s` seconds ago, in a flow that is given in closed form and has been asked for its velocity
/// until `to_s` seconds: one step of the classic Runge-Kutta scheme of fourth order.
#[must_use]
pub fn trace_prescribed(grid: CubedSphere, flow: &PrescribedFlow, to_s: f64, dt_s: f64) -> PaddedField<DVec3> {
    PaddedField::sample(grid, |x| backtrace(x, to_s, dt_s, |x, t| flow.velocity(x, t)))
}

/// Traces a step in a solved velocity in rad/s, constant during the step, by the implicit midpoint rule (F3).
#[must_use]
pub fn trace_solved(velocity: &PaddedField<DVec3>, dt_s: f64) -> PaddedField<DVec3> {
    let grid = velocity.grid();
    PaddedField::from_places(grid, 0, |place| {
        origin(velocity, grid.padded_direction(place), velocity.padded()[place], dt_s)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_traces_agree_in_a_steady_flow() {
        let grid = CubedSphere::new(32).unwrap();
        let flow = PrescribedFlow::draught(3, 1.0);
        let at_rest_s = 0.02;
        let velocity = PaddedField::sample(grid, |x| flow.velocity(x, 0.5 * at_rest_s));
        let [exact, solved] = [trace_prescribed(grid, &flow, at_rest_s, at_rest_s), trace_solved(&velocity, at_rest_s)];
        let way = exact.padded().iter().enumerate().map(|(place, x)| x.distance(grid.padded_direction(place)));
        let apart = exact.padded().iter().zip(solved.padded()).map(|(a, b)| a.distance(*b));
        let (way, apart) = (way.fold(0.0, f64::max), apart.fold(0.0, f64::max));
        assert!(apart < 1e-3 * way, "{apart:e} of {way:e}: the flow changes within the step, and is interpolated");
    }
}
