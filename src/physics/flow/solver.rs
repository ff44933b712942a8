//! The time stepper: semi-Lagrangian, leapfrogged against the thickness.
//!
//! Vorticity lives half a step before and after the thickness. A step from t − ½dt to t + ½dt, given ln h at t:
//!
//! 1. The velocity at t is 1.5 u(t − ½dt) − 0.5 u(t − 3/2 dt); each cell is traced back along it, by the implicit midpoint rule on the
//!    sphere, which is symmetric in time and so neither gains nor loses energy. Where eddies turn or move on by more than a part of
//!    themselves in a step, the extrapolated velocity is not theirs any more, and such steps gain energy out of nothing: they are taken
//!    twice, with the mean of the velocities before and after, as the first trial found it, the second time. See [`FOLLOWED_TURN`].
//! 2. Vorticity is looked up there by cubic interpolation. Half of the drag and of what the forces add acts before and half after.
//! 3. Viscosity acts by an L-stable rule of second order, and on what the forces add as on a source that lasts through the step: what is
//!    so small that viscosity balances its weight then moves as fast as it does, and in its direction. See [`FlowSolver::viscous`].
//! 4. ψ(t + ½dt) is found from it by multigrid, starting from 2ψ(t − ½dt) − ψ(t − 3/2 dt).
//!
//! The thickness then moves from t to t + dt with the velocity of ψ(t + ½dt): waves of buoyancy keep their amplitude for ever
//! (Störmer-Verlet).

use glam::{DVec2, DVec3};

use super::{
    force::{FlowForces, HalfStep, VISCOUS_STAGE},
    mirror_vorticity::mirrored,
    multigrid::Multigrid,
    operators::{CellMetric, turned_gradient},
    pinned_region::PinnedRegion,
    trace::advected,
};
use crate::{
    parallel,
    physics::sphere::{Cap, CubedSphere, FieldValue, HaloTable, PaddedField},
};

/// Cycles that find ψ, each of which leaves less than a fifth of the residual.
pub const POISSON_CYCLES: usize = 2;
/// Cycles of each of the two viscous solves.
pub const VISCOUS_CYCLES: usize = 1;
/// Turn of an eddy in a step, in radians, up to which the extrapolated velocity is good enough: vortex pairs of 6° to 25° on 32 cells gain at
/// most 6e-4 of their energy at 0.5 in steps taken once, but up to 1.5 % at 1 and 7 % at 2.
pub const FOLLOWED_TURN: f64 = 0.5;
/// The same for steps that are tried first. The same pairs gain nothing at any turn up to 4, but lose: in 24 steps 5 to 13 % at 2 and 25 to
/// 40 % at 4, part of it by interpolation. At 8 some gain again.
pub const CORRECTED_TURN: f64 = 4.0;

/// The longest step in seconds that is stable under gravity `g` (over the radius, 1/s²) where ln h changes by at most `slope` a radian: the
/// leapfrog's 2/σ for the fastest wave of buoyancy. Take shorter ones where a tick is longer.
#[must_use]
pub fn stable_step_s(g: f64, slope: f64) -> f64 {
    2.0 / (g * slope).abs().sqrt()
}

/// Vorticity, stream function, and what a step needs besides.
pub struct FlowSolver {
    multigrid: Multigrid,
    zeta: PaddedField<f64>,
    psi: PaddedField<f64>,
    /// ψ one step before; `None` before the first step.
    psi_before: Option<PaddedField<f64>>,
    /// What stirs the film besides, 1/s².
    forcing: PaddedField<f64>,
    /// Where the film ends, if anywhere.
    cap: Option<Cap>,
    /// What holds it fast, if anything does.
    pinned: Option<PinnedRegion>,
}

impl FlowSolver {
    /// A film whose vorticity, of mean zero, is given in 1/s at each cell.
    pub fn new(grid: CubedSphere, zeta: impl Fn(DVec3) -> f64 + Sync) -> Self {
        Self::bounded(grid, None, None, zeta)
    }

    /// Like [`Self::new`], for a film that may end at the rim of a cap, across which nothing flows, and that a drop at its lowest point may hold
    /// fast, by its angular radius in radians.
    pub fn bounded(
        grid: CubedSphere,
        cap: Option<Cap>,
        drop_rad: Option<f64>,
        zeta: impl Fn(DVec3) -> f64 + Sync,
    ) -> Self {
        let multigrid = Multigrid::new(grid);
        let zeta = PaddedField::sample_cells(grid, multigrid.halo(), zeta);
        let psi = PaddedField::from_cells(grid, multigrid.halo(), |_| 0.0);
        let pinned = drop_rad.map(|radius| PinnedRegion::new(radius, grid.cell_angle()));
        let mut solver = Self { multigrid, zeta, forcing: psi.clone(), psi, psi_before: None, cap, pinned };
        solver.zeta = solver.reflected(solver.zeta.clone());
        solver.psi = solver.stream_function(solver.psi.clone(), &solver.zeta, Self::FIRST_CYCLES);
        solver
    }

    /// Vorticity with its image beyond the rim, if there is one (F9).
    fn reflected(&self, zeta: PaddedField<f64>) -> PaddedField<f64> {
        self.cap.map_or_else(|| zeta.clone(), |cap| mirrored(&zeta, cap, self.halo()))
    }

    /// Cycles that find the first ψ, from nothing.
    pub const FIRST_CYCLES: usize = 12;

    /// The halo of its grid.
    pub fn halo(&self) -> &HaloTable {
        self.multigrid.halo()
    }

    /// Vorticity, 1/s.
    pub fn zeta(&self) -> &PaddedField<f64> {
        &self.zeta
    }

    /// Stream function, rad²/s.
    pub fn psi(&self) -> &PaddedField<f64> {
        &self.psi
    }

    /// The velocity of ψ, rad/s.
    pub fn velocity(&self) -> PaddedField<DVec3> {
        self.field(|cell| turned_gradient(&self.psi, cell))
    }

    /// Sets what stirs the film from now on: a source of vorticity in 1/s², such as α n·curl of the air's velocity.
    pub fn stir(&mut self, forcing: PaddedField<f64>) {
        self.forcing = forcing;
    }

    /// Takes a step under forces, with ln h half a step from now.
    pub fn step(&mut self, dt: f64, forces: &FlowForces, log_thickness: &PaddedField<f64>) {
        self.take(dt, forces, log_thickness, 0);
    }

    /// A step for flows whose eddies turn by more than [`FOLLOWED_TURN`] in a step: it is tried first.
    pub fn step_corrected(&mut self, dt: f64, forces: &FlowForces, log_thickness: &PaddedField<f64>) {
        self.take(dt, forces, log_thickness, 1);
    }

    /// The ψ a step before from which a straight line leads to where a trial step does.
    fn tried(
        &self,
        dt: f64,
        forces: &FlowForces,
        log_thickness: &PaddedField<f64>,
        before: &PaddedField<f64>,
    ) -> PaddedField<f64> {
        let (_, ahead) = self.stepped(dt, forces, log_thickness, before);
        combined(self.halo(), &[(2.0, &self.psi), (-1.0, &ahead)])
    }

    fn take(&mut self, dt: f64, forces: &FlowForces, log_thickness: &PaddedField<f64>, trials: usize) {
        // Without a trial the first step would be of first order, and all that follow inherit its error.
        let is_first = self.psi_before.is_none();
        for _ in 0..trials + usize::from(is_first) {
            let before = self.psi_before.as_ref().unwrap_or(&self.psi);
            self.psi_before = Some(self.tried(dt, forces, log_thickness, before));
        }
        let before = self.psi_before.as_ref().unwrap_or(&self.psi);
        let (zeta, psi) = self.stepped(dt, forces, log_thickness, before);
        self.zeta = zeta;
        self.psi_before = Some(std::mem::replace(&mut self.psi, psi));
    }

    /// Vorticity and stream function after a step, given ψ before the last one.
    fn stepped(
        &self,
        dt: f64,
        forces: &FlowForces,
        log_thickness: &PaddedField<f64>,
        before: &PaddedField<f64>,
    ) -> (PaddedField<f64>, PaddedField<f64>) {
        let (moved, added) = self.moved(dt, forces, log_thickness, before);
        let zeta = self.reflected(self.viscous(moved, &added, dt, forces));
        let guess = combined(self.halo(), &[(2.0, &self.psi), (-1.0, before)]);
        let psi = self.stream_function(guess, &zeta, POISSON_CYCLES);
        self.pinned.map_or((zeta.clone(), psi.clone()), |region| region.stopped(&zeta, &psi, self.halo()))
    }

    /// Vorticity advected and slowed by drag, and what buoyancy and stirring add to it.
    fn moved(
        &self,
        dt: f64,
        forces: &FlowForces,
        log_thickness: &PaddedField<f64>,
        before: &PaddedField<f64>,
    ) -> (PaddedField<f64>, PaddedField<f64>) {
        let psi = combined(self.halo(), &[(1.5, &self.psi), (-0.5, before)]);
        let velocity = self.field(|cell| turned_gradient(&psi, cell));
        // Here, and not after the step, because the sum that finds it then finds what else must be known of the whole film.
        let zeta = self.without_mean(&self.zeta).cells();
        let (at, thickness) = (velocity.cells(), log_thickness.cells());
        let forcing = self.forcing.cells();
        let half_step = |cell: usize| {
            let turned = turned_gradient(log_thickness, cell);
            HalfStep::new(forces, dt, at[cell], (thickness[cell], turned), forcing[cell])
        };
        let half_steps = parallel::map(zeta.len(), half_step);
        let pushed = self.field(|cell| DVec2::new(half_steps[cell].decay * zeta[cell], half_steps[cell].push));
        let carried = advected(self.halo(), &pushed, &velocity, dt).cells();
        let slowed = self.field(|cell| half_steps[cell].decay * carried[cell].x);
        (slowed, self.field(|cell| half_steps[cell].applied(carried[cell].y)))
    }

    /// Vorticity after a step of viscosity in which forces add to it. With S the implicit stage `(1 − ε (Δ + 2))⁻¹`, ε = (1 − 1/√2) ν dt,
    /// it is `S (S a + b)`, `a = (1 + √2) ζ + F/√2` and `b = (1 − 1/√2) F − √2 ζ`, where F is what forces add without viscosity: the
    /// singly diagonally implicit rule of Alexander (1977) for ζ' = ν (Δ + 2) ζ + F/dt, of second order and L-stable.
    ///
    /// F is part of the rule because alone it multiplies ζ by −0.2 to 0 where ν dt l² exceeds 2.4: forces that act before it would move
    /// what is that small backwards, and no stable film would ever come to rest.
    fn viscous(
        &self,
        zeta: PaddedField<f64>,
        added: &PaddedField<f64>,
        dt: f64,
        forces: &FlowForces,
    ) -> PaddedField<f64> {
        let sum = |terms: &[(f64, &PaddedField<f64>)]| combined(self.halo(), terms);
        let Some(stage) = forces.viscous_stage(dt) else { return sum(&[(1.0, &zeta), (1.0, added)]) };
        let shift = (1.0 - 2.0 * stage) / stage;
        let solve = |from: &PaddedField<f64>, guess: PaddedField<f64>| {
            let f: Vec<f64> = from.cells().iter().map(|value| -value / stage).collect();
            (0..VISCOUS_CYCLES).fold(guess, |guess, _| self.multigrid.cycle(&guess, &f, shift))
        };
        let root = std::f64::consts::SQRT_2;
        let first = self.reflected(sum(&[(1.0 + root, &zeta), (1.0 / root, added)]));
        let second = self.reflected(sum(&[(-root, &zeta), (VISCOUS_STAGE, added)]));
        let once = solve(&first, first.clone());
        // What the first stage took away, the second nearly will of its part.
        let guess = sum(&[(root, &once), (1.0, &second), (1.0 - root, &first)]);
        solve(&sum(&[(1.0, &once), (1.0, &second)]), guess)
    }

    fn stream_function(&self, guess: PaddedField<f64>, zeta: &PaddedField<f64>, cycles: usize) -> PaddedField<f64> {
        let f = zeta.cells();
        let psi = (0..cycles).fold(guess, |psi, _| self.multigrid.cycle(&psi, &f, 0.0));
        self.without_mean(&psi)
    }

    fn without_mean(&self, field: &PaddedField<f64>) -> PaddedField<f64> {
        let (grid, values) = (field.grid(), field.cells());
        let area = |cell| CellMetric::new(grid, cell).area_density() * grid.cell_angle().powi(2);
        let integral: f64 = values.iter().enumerate().map(|(cell, value)| value * area(cell)).sum();
        self.field(|cell| values[cell] - integral / (4.0 * std::f64::consts::PI))
    }

    fn field<T: FieldValue>(&self, value: impl Fn(usize) -> T + Sync) -> PaddedField<T> {
        PaddedField::from_cells(self.multigrid.grid(), self.multigrid.halo(), value)
    }
}

/// A sum of fields with factors, of one at least.
fn combined(halo: &HaloTable, terms: &[(f64, &PaddedField<f64>)]) -> PaddedField<f64> {
    let terms: Vec<_> = terms.iter().map(|(factor, field)| (*factor, field.grid(), field.cells())).collect();
    PaddedField::from_cells(terms[0].1, halo, |cell| terms.iter().map(|(factor, _, cells)| factor * cells[cell]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::{Push, gained};
    use crate::physics::flow::{FlowCase, FlowCaseKind, Mode, Oscillation, fit_oscillation, invariants, relative_l2};

    fn case(kind: FlowCaseKind, mode: (u32, u32), k: f64) -> FlowCase {
        FlowCase::new(kind, DVec3::ONE.normalize(), Mode::new(mode.0, mode.1, 0).unwrap(), 1.0, k).unwrap()
    }

    /// Relative error of vorticity after steps of which `steps` make the case's span.
    fn error(case: &FlowCase, n: usize, steps: u32, take: u32) -> f64 {
        let grid = CubedSphere::new(n).unwrap();
        let mut solver = FlowSolver::new(grid, |x| case.zeta(x, 0.0));
        let still = PaddedField::from_cells(grid, solver.halo(), |_| 0.0);
        let dt = case.span_s() / f64::from(steps);
        (0..take).for_each(|_| solver.step(dt, &case.forces(), &still));
        let time = dt * f64::from(take);
        let exact: Vec<f64> = (0..grid.cells()).map(|cell| case.zeta(grid.cell_direction(cell), time)).collect();
        relative_l2(grid, &solver.zeta().cells(), &exact)
    }

    #[test]
    fn a_rossby_haurwitz_wave_turns() {
        let wave = case(FlowCaseKind::RossbyHaurwitz, (1, 1), 1.0);
        let [coarse, fine] = [(16, 20), (32, 40)].map(|(n, steps)| error(&wave, n, steps, steps));
        // The steps' error is of second order; the first of these is too large to be asymptotic.
        assert!(fine < 0.016 && coarse / fine > 3.5, "{coarse} {fine}");
    }

    #[test]
    fn a_jet_stands_still() {
        let jet = error(&case(FlowCaseKind::Stationary, (1, 1), 0.1), 24, 80, 40);
        assert!(jet < 1e-3, "{jet}");
    }

    #[test]
    fn viscosity_wears_a_harmonic_down() {
        let decay = error(&case(FlowCaseKind::Decay, (5, 3), 0.0), 24, 20, 20);
        assert!(decay < 3e-3, "{decay}");
    }

    #[test]
    fn the_stable_step_is_where_the_fastest_wave_begins_to_grow() {
        // The (l, l) mode of a film of unit slope nearly has the bound's frequency: σ² = l/(l + 1).
        let case = FlowCase::new(FlowCaseKind::Sloshing, DVec3::Z, Mode::new(9, 9, 1).unwrap(), 1.0, 0.0).unwrap();
        let largest_after = |dt: f64| {
            let grid = CubedSphere::new(24).unwrap();
            let mut solver = FlowSolver::new(grid, |_| 0.0);
            let mut film = PaddedField::sample_cells(grid, solver.halo(), |x| case.log_thickness(x));
            for _ in 0..40 {
                solver.step(dt, &case.forces(), &film);
                film = advected(solver.halo(), &film, &solver.velocity(), dt);
            }
            solver.zeta().cells().iter().fold(0.0, |max: f64, zeta| max.max(zeta.abs()))
        };
        let limit = stable_step_s(1.0, 1.0);
        assert!(largest_after(0.9 * limit) < 0.1, "{}", largest_after(0.9 * limit));
        assert!(largest_after(1.3 * limit) > 1.0, "{}", largest_after(1.3 * limit));
    }

    /// Energy of a weightless vortex pair, which no force drives, over its energy at the start: the maximum over steps in which it turns by `turn`.
    fn max_energy(turn: f64, is_corrected: bool) -> f64 {
        let grid = CubedSphere::new(24).unwrap();
        let center = DVec3::new(0.2, 0.7, 0.5).normalize();
        let sharpness = Push::sharpness_of(0.3);
        let velocity = center.cross(DVec3::X).normalize() / gained(sharpness);
        let pair = Push { center, sharpness, velocity, rate: 1.0 };
        let mut solver = FlowSolver::new(grid, |x| pair.source(x, DVec3::ZERO, 0.0));
        let still = PaddedField::from_cells(grid, solver.halo(), |_| 0.0);
        let energy = |solver: &FlowSolver| invariants(grid, &solver.zeta().cells(), &solver.psi().cells()).energy;
        let (start, dt) = (energy(&solver), turn / sharpness.sqrt());
        let mut max: f64 = 0.0;
        for _ in 0..16 {
            if is_corrected {
                solver.step_corrected(dt, &FlowForces::default(), &still);
            } else {
                solver.step(dt, &FlowForces::default(), &still);
            }
            max = max.max(energy(&solver) / start);
        }
        max
    }

    #[test]
    fn nothing_gains_energy_out_of_nothing() {
        let corrected = [0.5, 1.0, 2.0, CORRECTED_TURN].map(|turn| max_energy(turn, true));
        assert!(corrected.iter().all(|max| *max < 1.0), "{corrected:?}");
        let [within, beyond] = [FOLLOWED_TURN, 2.0].map(|turn| max_energy(turn, false));
        assert!(within < 1.001 && beyond > 1.02, "{within} {beyond}");
    }

    /// Waves that viscosity damps within a step, on a film that is thin above a narrow border and thick below, where buoyancy is as
    /// fast as steps may follow.
    #[test]
    fn a_steep_film_comes_to_rest_under_viscosity() {
        let (grid, width) = (CubedSphere::new(24).unwrap(), 0.12);
        let forces = FlowForces { gravity: 0.6 * width * DVec3::NEG_Z, viscosity: 0.02, ..FlowForces::default() };
        let mut solver = FlowSolver::new(grid, |_| 0.0);
        let border = |x: DVec3| (x.z - 0.02 * (12.0 * x.y.atan2(x.x)).sin()) / width;
        let mut film = PaddedField::sample_cells(grid, solver.halo(), |x| -border(x).tanh());
        let mut fastest = Vec::new();
        for _ in 0..60 {
            solver.step(1.0, &forces, &film);
            let velocity = solver.velocity();
            film = advected(solver.halo(), &film, &velocity, 1.0);
            fastest.push(velocity.cells().iter().fold(0.0, |max: f64, u| max.max(u.length())));
        }
        let [early, late] = [&fastest[..5], &fastest[50..]].map(|part| part.iter().copied().fold(0.0, f64::max));
        assert!(late < 0.1 * early, "{early} {late}");
    }

    fn slosh(stratification: f64, drag: f64) -> (FlowCase, Oscillation) {
        let case = case(FlowCaseKind::Sloshing, (3, 2), 0.0).with_film(stratification, drag);
        let (grid, dt) = (CubedSphere::new(24).unwrap(), case.span_s() / 60.0);
        let mut solver = FlowSolver::new(grid, |x| case.zeta(x, -0.5 * dt));
        let mut film = PaddedField::sample_cells(grid, solver.halo(), |x| case.log_thickness(x));
        let samples: Vec<f64> = (0..60)
            .map(|_| {
                solver.step(dt, &case.forces(), &film);
                film = advected(solver.halo(), &film, &solver.velocity(), dt);
                let zeta = solver.zeta().cells();
                grid.areas()
                    .iter()
                    .enumerate()
                    .map(|(c, area)| area * zeta[c] * case.mode_at(grid.cell_direction(c)))
                    .sum()
            })
            .collect();
        (case, fit_oscillation(&samples, dt).unwrap())
    }

    #[test]
    fn a_stratified_film_sloshes_and_an_inverted_one_overturns() {
        for drag in [0.0, 0.4] {
            let (case, found) = slosh(1.0, drag);
            // A leapfrog of 60 steps per period is fast by (2π/60)²/24 = 4.6e-4.
            assert!((found.frequency / case.frequency() - 1.0).abs() < 1e-3, "{found:?}");
            assert!((found.growth + 0.5 * drag).abs() < 1e-3, "{found:?}");
        }
        let (case, found) = slosh(-1.0, 0.0);
        assert!((found.growth / case.growth() - 1.0).abs() < 2e-3, "{found:?}");
    }
}
