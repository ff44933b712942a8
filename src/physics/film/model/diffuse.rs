//! Diffusion of the thickness within the film, which stands for motions finer than cells: the twin of `shaders/pass/diffuse.wgsl`.
//!
//! `∂h/∂t = D Δh` is integrated over the ticks between two remaps in parts, each a Runge-Kutta-Legendre step of first order in s = 3 stages (Meyer,
//! Balsara & Aslam 2012, MNRAS 422), stable for six times as long as one explicit step, and without a new extreme but for what the mixed derivative
//! makes at a panel's corners, a two-thousandth of a jump. With w = 2/(s² + s) and D dt
//! the squared angle that a part spreads over, stage j is
//!
//! ```text
//! Y_j = (2j−1)/j Y_{j−1} + (1−j)/j Y_{j−2} + w (2j−1)/j D dt Δ Y_{j−1},     Y_0 = φ                  (M6)
//! ```
//!
//! Its Laplacian is of second order, and a stage reaches one cell less far into the halo than the one before.

use crate::physics::{
    flow::{Order, laplacian_at},
    sphere::{HALO, HaloTable, PaddedField},
};

/// Stages of a part: as many as a panel's halo is wide.
pub const STAGES: u32 = HALO as u32;
/// Squared cell angles that one part can spread over: s stages are stable for (s² + s)/2 explicit steps, and one of those for 1/6, because at a
/// panel's corners cells are narrower than at its center.
pub const MAX_SPREAD_PER_PART: f64 = 0.9;
/// Parts of one diffusion at most.
const MAX_PARTS: u32 = 4;
/// How long a film is moved without being diffused, if that needs no more parts: filaments reach the grid in a few tenths of a second.
const DEFAULT_S: f64 = 0.1;
/// The longest that it is, if as many parts can do it.
const LONGEST_S: f64 = 0.2;

/// How the diffusion between two remaps is divided, and how far apart those may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffusionPlan {
    /// Squared cell angles that liquid spreads over in a tick.
    pub per_tick: f64,
    /// Parts of the diffusion at a remap.
    pub parts: u32,
    /// The most ticks between two remaps.
    pub latest_ticks: u32,
}

impl DiffusionPlan {
    /// The plan for a diffusivity in rad²/s, on cells of an angle in radians, in ticks of a length in seconds. None if nothing spreads.
    #[must_use]
    pub fn new(rad2_s: f64, tick_s: f64, cell_angle: f64) -> Option<Self> {
        let per_tick = rad2_s * tick_s / cell_angle.powi(2);
        if per_tick <= 0.0 {
            return None;
        }
        let [default_ticks, longest_ticks] = [DEFAULT_S, LONGEST_S].map(|max_s| (max_s / tick_s).max(1.0));
        let parts = (default_ticks * per_tick / MAX_SPREAD_PER_PART).ceil().min(f64::from(MAX_PARTS));
        let latest_ticks = longest_ticks.min(parts * MAX_SPREAD_PER_PART / per_tick).max(1.0) as u32;
        Some(Self { per_tick, parts: parts as u32, latest_ticks })
    }
}

/// Factors of a stage, numbered from 1, in (M6): of the stage before, of that before it, and of D dt Δ.
#[must_use]
pub fn stage_factors(stage: u32) -> [f64; 3] {
    let (j, s) = (f64::from(stage), f64::from(STAGES));
    let before = (2.0 * j - 1.0) / j;
    [before, (1.0 - j) / j, before * 2.0 / (s * s + s)]
}

/// A field after it has spread for some ticks (M6), with a halo in which no value leaves the range of the cells. `halo` is its grid's table.
#[must_use]
pub fn diffuse(field: PaddedField<f64>, plan: &DiffusionPlan, ticks: u32, halo: &HaloTable) -> PaddedField<f64> {
    let spread = (plan.per_tick * f64::from(ticks) / f64::from(plan.parts)).min(MAX_SPREAD_PER_PART);
    (0..plan.parts).fold(field, |field, _| {
        let mut stages = [field.clone(), field];
        for stage in 1..=STAGES {
            let [earlier, before] = stages;
            let next = staged(&before, &earlier, stage, spread);
            stages = [before, next];
        }
        let [_, last] = stages;
        last.with_bounded_halo(halo)
    })
}

/// One stage from the two before it, where a number of cells around each place are known.
fn staged(before: &PaddedField<f64>, earlier: &PaddedField<f64>, stage: u32, spread: f64) -> PaddedField<f64> {
    let [of_before, of_earlier, of_laplacian] = stage_factors(stage);
    let angle2 = before.grid().cell_angle().powi(2);
    PaddedField::from_places(before.grid(), stage as usize, |place| {
        let spread = of_laplacian * spread * angle2 * laplacian_at(before, place, Order::Second).0;
        of_before * before.padded()[place] + of_earlier * earlier.padded()[place] + spread
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::sphere::CubedSphere;
    use glam::DVec3;

    fn spread(n: usize, rad2_s: f64, ticks: u32, value: impl Fn(DVec3) -> f64 + Sync) -> PaddedField<f64> {
        let grid = CubedSphere::new(n).unwrap();
        let plan = DiffusionPlan::new(rad2_s, 1.0 / 60.0, grid.cell_angle()).unwrap();
        assert!(ticks <= plan.latest_ticks);
        diffuse(PaddedField::sample(grid, value), &plan, ticks, &HaloTable::new(grid))
    }

    #[test]
    fn a_harmonic_decays_at_its_rate() {
        // Degree 2: Δ is −6.
        let harmonic = |x: DVec3| x.x * x.y + x.z * x.z - 1.0 / 3.0;
        let left = spread(24, 0.05, 6, harmonic);
        let expected = (-6.0 * 0.05 * 0.1_f64).exp();
        for (cell, value) in left.cells().into_iter().enumerate() {
            let exact = expected * harmonic(left.grid().cell_direction(cell));
            assert!((value - exact).abs() < 1e-3, "first order in time, second in space: {value} {exact}");
        }
    }

    #[test]
    fn there_is_hardly_a_new_extreme_and_an_even_film_stays_as_it_is() {
        let edge = spread(16, 0.3, 6, |x| f64::from(u8::from(x.dot(DVec3::new(0.4, 0.7, 0.5)) > 0.1)));
        // The mixed derivative, which is largest where panels meet in a corner, goes beyond by 4e-4.
        assert!(edge.padded().iter().all(|value| (-1e-3..=1.0 + 1e-3).contains(value)));
        let even = spread(16, 0.3, 6, |_| 7.0);
        assert!(even.padded().iter().all(|value| (value - 7.0).abs() < 1e-12));
    }

    #[test]
    fn no_remap_comes_later_than_its_parts_can_spread() {
        assert_eq!(DiffusionPlan::new(0.0, 1.0 / 60.0, 0.1), None);
        for rad2_s in [1e-4, 0.01, 0.1, 1.0, 3.0] {
            let plan = DiffusionPlan::new(rad2_s, 1.0 / 60.0, 0.1).unwrap();
            assert!((1..=4).contains(&plan.parts) && (1..=12).contains(&plan.latest_ticks), "{plan:?}");
            let of_one = plan.per_tick * f64::from(plan.latest_ticks) / f64::from(plan.parts);
            // Beyond, it spreads as far as it can.
            assert!(of_one <= MAX_SPREAD_PER_PART * (1.0 + 1e-12) || plan.latest_ticks == 1, "{rad2_s}: {of_one}");
        }
    }
}
