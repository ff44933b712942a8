//! Published tests of transport on the sphere.

use super::Run;
use crate::{
    gpu::{
        GpuError,
        transport_case::{Case, values},
    },
    physics::{
        sphere::CubedSphere,
        transport::{Quantity, Scheme, Tracer, TracerKind, Wind, WindKind},
    },
};

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    // The axis and the grid are right by construction, and both constructors say so.
    let (Ok(wind), Ok(grid)) = (Wind::new(WindKind::NonDivergent, None), CubedSphere::new(60)) else { return Ok(()) };
    let tracer = Tracer::new(TracerKind::CosineBells, wind.tracer_rotation());
    let (quantity, scheme, limiter) = (Quantity::Density, Scheme::Map, false);
    let case = Case { grid, wind, tracer, quantity, scheme, limiter, steps_a_period: 120, steps: 120 };
    let mut field = case.seed(run.gpu)?;
    case.advance(run.gpu, &mut field)?;
    let measured = case.measure(&values(run.gpu, &mut field)?);
    run.at_most("map, cosine bells, one period, l2", measured.l2, 0.0075);
    Ok(())
}
