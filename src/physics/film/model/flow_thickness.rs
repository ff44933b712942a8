//! What the flow feels of its film, of the air and of what pushes it: the twins of `shaders/pass/flow_thickness.wgsl`, `flow_gusts.wgsl` and
//! `flow_push.wgsl`.
//!
//! With h₀ a reference, e what has evaporated and h_b black film, at which that ends, the thickness h of a film that would be φ thick without
//! evaporation enters the flow as
//!
//! ```text
//! ln (h/h₀),     h = max(φ − e, min(φ, h_b))                                                         (M7)
//! ```
//!
//! The air stirs it by `α₀ n·curl u_air`, at the rate α₀ at which air at rest would slow film of the mean thickness down (M8).

use super::FreePart;
use crate::physics::{
    film::Push,
    flow::{FlowForces, FlowSolver, MIN_AIR_SPEED},
};

/// The logarithm of the thickness over a reference in nm (M7), for departures of the tracer from a level in nm.
#[must_use]
pub fn log_thickness(departures: &[f64], level_nm: f64, part: &FreePart, reference_nm: f64) -> Vec<f64> {
    let nm =
        |departure: f64| (departure + level_nm - part.evaporated_nm).max((departure + level_nm).min(part.black_nm));
    departures.iter().map(|departure| (nm(*departure) / reference_nm).ln()).collect()
}

/// Rate at which the air drags film of a mean thickness in nm along (M8), 1/s.
#[must_use]
pub fn air_rate(forces: &FlowForces, mean_nm: f64) -> f64 {
    forces.drag + forces.air_drag * MIN_AIR_SPEED.sqrt() / mean_nm
}

/// What pushes make of a flow, in each cell: a source of vorticity, 1/s².
#[must_use]
pub fn source(pushes: &[Push], flow: &FlowSolver) -> Vec<f64> {
    let (grid, u, zeta) = (flow.zeta().grid(), flow.velocity().cells(), flow.zeta().cells());
    let at = |cell: usize| {
        let of = |push: &Push| push.source(grid.cell_direction(cell), u[cell], zeta[cell]);
        pushes.iter().map(of).sum()
    };
    (0..grid.cells()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::model::remaining_nm;

    #[test]
    fn the_flow_feels_what_evaporation_has_left() {
        let part = FreePart {
            from_s: 0.0,
            dt_s: 0.1,
            forces: FlowForces::default(),
            pushes: Vec::new(),
            evaporated_nm: 120.0,
            black_nm: 10.0,
            strain: 0.0,
        };
        assert_eq!((part.reference_nm(600.0), part.reference_nm(90.0)), (480.0, 10.0));
        let felt = log_thickness(&[0.0, -100.0, 100.0, -195.0], 200.0, &part, 80.0);
        for (log, nm) in felt.into_iter().zip([200.0, 100.0, 300.0, 5.0]) {
            assert!((80.0 * log.exp() / remaining_nm(nm, 120.0) - 1.0).abs() < 1e-12, "{nm}");
        }
    }
}
