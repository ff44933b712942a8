//! Tests of transport on the unit sphere: winds and tracers whose answer is known, that answer, error norms, and the f64 twin of
//! the scheme that the GPU runs.
//!
//! Longitude λ, latitude θ, `x = (cos θ cos λ, cos θ sin λ, sin θ)`; a period lasts T = [`PERIOD`] time units. Sources: Williamson et
//! al. 1992, J. Comput. Phys. 102 (test case 1); Nair & Lauritzen 2010, J. Comput. Phys. 229; Lauritzen et al. 2012, Geosci. Model
//! Dev. 5, 887.

mod errors;
mod exact;
mod scheme;
mod tracer;
mod wind;

pub use errors::{Measured, measure};
pub use exact::{Departure, Quantity, departure, exact};
pub use scheme::{FlowMap, Scheme, backtrace};
pub use tracer::{Tracer, TracerKind};
pub use wind::{PERIOD, Wind, WindKind};

use thiserror::Error;

/// Why a transport test could not be set up.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CaseError {
    /// A direction of length zero, or not finite.
    #[error("the {0} is not a direction: give three finite numbers that are not all zero")]
    NoDirection(&'static str),
}

/// The unit vector along `v`; `what` names it in the error for vectors that have none.
fn unit(v: glam::DVec3, what: &'static str) -> Result<glam::DVec3, CaseError> {
    // Scaled first, so that the squares of very long and very short vectors stay finite and positive.
    (v / v.abs().max_element()).try_normalize().ok_or(CaseError::NoDirection(what))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn only_directions_have_a_unit_vector() {
        assert_eq!(unit(DVec3::new(0.0, -1e-200, 0.0), "axis"), Ok(DVec3::NEG_Y));
        assert_eq!(unit(DVec3::new(1e300, 0.0, 0.0), "axis"), Ok(DVec3::X));
        for v in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
            assert_eq!(unit(v, "axis"), Err(CaseError::NoDirection("axis")));
        }
    }

    #[test]
    fn names_are_read_and_others_refused_with_the_choice() {
        assert_eq!("dv".parse(), Ok(WindKind::Divergent));
        assert_eq!("ccb".parse(), Ok(TracerKind::CorrelatedCosineBells));
        assert_eq!("ratio".parse(), Ok(Quantity::Ratio));
        let message = "GH".parse::<TracerKind>().unwrap_err().to_string();
        assert_eq!(message, "unknown tracer \"GH\": use one of gh, cb, ccb, sc, tc1");
    }
}
