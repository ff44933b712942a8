//! The bubble's own oscillation: its lowest mode, l = 2, in which it is longer along one axis and shorter across, and back.
//!
//! A shape is a symmetric matrix S without trace: the affine map exp(S) takes the round bubble to the ellipsoid that is seen. The map has the
//! determinant 1, so the volume is kept exactly; to first order the wall at direction n is displaced by R n·Sn, a harmonic of degree 2.
//!
//! For a small displacement η Yₗ of a wall of tension 2γ, two surfaces, between two spaces of air,
//!
//! ```text
//! M η″ = −2γ (l − 1)(l + 2)/R² η,    M = ρₐ R (2l + 1)/(l (l + 1)) + ρ h (1 + 4/(l (l + 1)))
//! ```
//!
//! M is an area's inertia: of the air inside and outside, R/l and R/(l + 1) thick, and of the film, whose motion along itself, which keeps
//! its area everywhere, adds the 4 (the waves of elasticity that keep it are several times faster than this oscillation). Without film it
//! is Lamb's frequency for two fluids (Hydrodynamics, 1932, § 275) with twice the tension; for the film's part see Grinfeld (2012, Studies in
//! Applied Mathematics 128). A bubble of 5 cm swings in 0.16 s.
//!
//! It is damped where the air slips along the film, in Stokes layers on both sides (Landau & Lifshitz, Fluid Mechanics, § 24): the power
//! `½ ρₐ √(ν ω/2) u²` an area for a slip of amplitude u, of `(l − 1)/(l (l + 1))` inside and `(l + 2)/(l (l + 1))` outside for a wall that
//! moves with 1 Yₗ, with l (l + 1) from the gradient of Yₗ.

use glam::{DMat3, DVec3};

use super::center::{CenterPath, LegMotion};
use crate::physics::film::properties::{AIR_DENSITY, AIR_VISCOSITY, DENSITY, SURFACE_TENSION};

/// The degree of the mode.
const L: f64 = 2.0;
/// L (L + 1).
const LL: f64 = L * (L + 1.0);
/// The largest size of a shape that is shown. Where the linear law asks for more than a fraction of it, shapes bend towards this bound
/// smoothly: a bubble that is really pushed so far breaks.
const LARGEST: f64 = 0.35;
/// Shapes that differ from the round one by less are round: a hundredth of a pixel on a bubble 2000 pixels wide.
const SMALLEST: f64 = 1e-5;

/// The oscillation of a bubble.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillator {
    /// Angular frequency without damping, rad/s.
    pub frequency: f64,
    /// Rate at which it is damped, 1/s.
    pub damping: f64,
    /// An area's inertia M times R, kg/m: what a pressure accelerates S with.
    inertia: f64,
}

/// A shape that changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// S.
    pub shape: DMat3,
    /// S′, 1/s.
    pub rate: DMat3,
}

impl Oscillator {
    /// The oscillation of a bubble of a radius in metres whose film has a mean thickness in metres.
    #[must_use]
    pub fn new(radius_m: f64, thickness_m: f64) -> Self {
        let area_inertia = AIR_DENSITY * radius_m * (2.0 * L + 1.0) / LL + DENSITY * thickness_m * (1.0 + 4.0 / LL);
        let stiffness = 2.0 * SURFACE_TENSION * (L - 1.0) * (L + 2.0) / radius_m.powi(2);
        let frequency = (stiffness / area_inertia).sqrt();
        let slips = ((L - 1.0) / LL).powi(2) + ((L + 2.0) / LL).powi(2);
        let damping = 0.5 * AIR_DENSITY * (0.5 * AIR_VISCOSITY * frequency).sqrt() * LL * slips / area_inertia;
        // A bubble of millimetres is damped as much as a tenth of critically; the smallest must stay an oscillator.
        Self { frequency, damping: damping.min(0.9 * frequency), inertia: area_inertia * radius_m }
    }

    /// The shape some seconds later, if nothing pushes.
    #[must_use]
    pub fn freely(&self, from: Shape, seconds: f64) -> Shape {
        let swing = (self.frequency.powi(2) - self.damping.powi(2)).sqrt();
        let (sin, cos) = (swing * seconds).sin_cos();
        let decay = (-self.damping * seconds).exp();
        let across = (from.rate + self.damping * from.shape) * (1.0 / swing);
        Shape {
            shape: (from.shape * cos + across * sin) * decay,
            rate: (from.rate * cos - (from.shape * swing + across * self.damping) * sin) * decay,
        }
    }

    /// The shape at some seconds after a jet began to meet a round bubble. `push_1_s2` is [`Self::jet_push`], and it lasts for `lasts_s`.
    #[must_use]
    pub fn after_push(&self, push_1_s2: DMat3, lasts_s: f64, seconds: f64) -> Shape {
        let held = Shape { shape: push_1_s2 * self.frequency.powi(2).recip(), rate: DMat3::ZERO };
        let pushed = |seconds: f64| held + self.freely(Shape::ROUND + held * -1.0, seconds);
        match seconds {
            s if s <= 0.0 => Shape::ROUND,
            s if s <= lasts_s => pushed(s),
            s => self.freely(pushed(lasts_s), s - lasts_s),
        }
    }

    /// What a jet of air of a speed in m/s does that goes along a unit vector and meets the bubble around another: its stagnation pressure,
    /// `½ ρₐ u²` of what goes inwards, as wide as `exp(κ (c·n − 1))`. 1/s².
    #[must_use]
    pub fn jet_push(&self, center: DVec3, sharpness: f64, toward: DVec3, speed_m_s: f64) -> DMat3 {
        let inwards = (-toward.dot(center)).max(0.0) * speed_m_s;
        self.push(0.5 * AIR_DENSITY * inwards.powi(2) * second_degree(sharpness), center)
    }

    /// The S″ of a pressure `p₂ P₂(n·axis)` from outside.
    fn push(&self, pressure: f64, axis: DVec3) -> DMat3 {
        // P₂(n·a) = n·(3/2)(a aᵀ − 1/3) n.
        traceless(axis) * (-1.5 * pressure / self.inertia)
    }

    /// The shape of a bubble that follows a path in metres, from round at time 0.
    ///
    /// Air that streams past with u has the pressure `ρₐ u²/2 (1 − 9/4 sin² ϑ)` on a sphere (Lamb § 95), whose second degree is
    /// `3/4 ρₐ u² P₂`: a bubble is flattened along its way. The path's u is `(b + c s) e^(−s)` on each leg, and so the shape is in closed form.
    #[must_use]
    pub fn along(&self, path: &CenterPath) -> DraggedShape {
        let mut last = ShapeLeg { from_s: 0.0, start: Shape::ROUND, motion: None };
        let legs = path.motions().map(|motion| {
            let start = last.at(self, motion.from_s);
            last = ShapeLeg { from_s: motion.from_s, start, motion: Some(motion) };
            last
        });
        DraggedShape { oscillator: *self, legs: legs.collect() }
    }

    /// The shape some seconds into a leg that began with another.
    fn on_leg(&self, motion: Option<LegMotion>, from: Shape, seconds: f64) -> Shape {
        let Some(motion) = motion else { return self.freely(from, seconds) };
        let forced = |seconds: f64| self.forced(&motion, seconds);
        forced(seconds) + self.freely(from + forced(0.0) * -1.0, seconds)
    }

    /// The particular solution for a leg's wind: `e^(−2s)` times a polynomial of second degree.
    fn forced(&self, motion: &LegMotion, seconds: f64) -> Shape {
        let LegMotion { start, slope, settling_s, .. } = *motion;
        let push = -1.5 * 0.75 * AIR_DENSITY / self.inertia;
        let f = [
            traceless(start) * push,
            (traceless(start + slope) + traceless(start) * -1.0 + traceless(slope) * -1.0) * push,
            traceless(slope) * push,
        ];
        // In s, with q the polynomial: p0 q + p1 q′ + p2 q″ = f.
        let p2 = settling_s.powi(-2);
        let p1 = 2.0 * self.damping / settling_s - 4.0 * p2;
        let p0 = 4.0 * p2 - 4.0 * self.damping / settling_s + self.frequency.powi(2);
        let q2 = f[2] * p0.recip();
        let q1 = (f[1] + q2 * (-2.0 * p1)) * p0.recip();
        let q0 = (f[0] + q1 * -p1 + q2 * (-2.0 * p2)) * p0.recip();
        let s = seconds / settling_s;
        let decay = (-2.0 * s).exp();
        let value = q0 + q1 * s + q2 * (s * s);
        Shape { shape: value * decay, rate: (q1 + q2 * (2.0 * s) + value * -2.0) * (decay / settling_s) }
    }
}

/// The shape of a bubble that is dragged along a path, ready for any time.
#[derive(Clone, Debug)]
pub struct DraggedShape {
    oscillator: Oscillator,
    legs: Vec<ShapeLeg>,
}

/// The shape on a leg of the path: how it is at first, and what then moves the bubble.
#[derive(Clone, Copy, Debug)]
struct ShapeLeg {
    from_s: f64,
    start: Shape,
    motion: Option<LegMotion>,
}

impl DraggedShape {
    /// The shape at a time in seconds.
    #[must_use]
    pub fn at(&self, time_s: f64) -> Shape {
        let begun = self.legs.partition_point(|leg| leg.from_s <= time_s);
        self.legs[..begun].last().map_or(Shape::ROUND, |leg| leg.at(&self.oscillator, time_s))
    }
}

impl ShapeLeg {
    fn at(&self, oscillator: &Oscillator, time_s: f64) -> Shape {
        oscillator.on_leg(self.motion, self.start, time_s - self.from_s)
    }
}

impl Shape {
    /// A round bubble at rest.
    pub const ROUND: Self = Self { shape: DMat3::ZERO, rate: DMat3::ZERO };

    /// exp(S), which takes the unit sphere to the bubble's wall over its radius; exactly the identity for what looks round.
    #[must_use]
    pub fn stretch(&self) -> DMat3 {
        let size = norm(self.shape);
        if size < SMALLEST {
            return DMat3::IDENTITY;
        }
        // Bent towards the largest shape: by less than a hundredth below a quarter of it.
        exponential(self.shape * (LARGEST / size * (size / LARGEST).tanh()))
    }
}

impl std::ops::Add for Shape {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { shape: self.shape + other.shape, rate: self.rate + other.rate }
    }
}

impl std::ops::Mul<f64> for Shape {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self { shape: self.shape * factor, rate: self.rate * factor }
    }
}

/// A bound on how far a matrix stretches any vector: the largest sum over a row.
#[must_use]
pub fn reach(stretch: DMat3) -> f64 {
    DVec3::AXES.map(|axis| (stretch * axis).abs().element_sum()).into_iter().fold(0.0, f64::max)
}

/// v vᵀ − v²/3.
pub(super) fn traceless(v: DVec3) -> DMat3 {
    let outer = DMat3::from_cols(v.x * v, v.y * v, v.z * v);
    outer + DMat3::IDENTITY * (-v.length_squared() / 3.0)
}

/// The largest component's bound: the root of the sum of squares.
fn norm(matrix: DMat3) -> f64 {
    DVec3::AXES.map(|axis| (matrix * axis).length_squared()).iter().sum::<f64>().sqrt()
}

/// exp of a symmetric matrix no larger than [`LARGEST`], by its series: the last term is below 1e-15.
fn exponential(matrix: DMat3) -> DMat3 {
    const TERMS: u32 = 12;
    (1..=TERMS).rev().fold(DMat3::IDENTITY, |sum, k| DMat3::IDENTITY + matrix * sum * f64::from(k).recip())
}

/// The part of second degree of `exp(κ (μ − 1))`, the factor of P₂(μ): 5/2 ∫ e^(κ(μ−1)) P₂ dμ, for κ of 0.1 or more.
fn second_degree(sharpness: f64) -> f64 {
    let k = sharpness;
    let far = (-2.0 * k).exp();
    let zeroth = (1.0 - far) / k;
    let square = (1.0 / k - 2.0 / k.powi(2) + 2.0 / k.powi(3)) - far * (1.0 / k + 2.0 / k.powi(2) + 2.0 / k.powi(3));
    1.25 * (3.0 * square - zeroth)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bubble() -> Oscillator {
        Oscillator::new(0.05, 700e-9)
    }

    #[test]
    fn without_film_it_swings_as_lamb_says() {
        // ω² = σ (l − 1) l (l + 1) (l + 2) / (R³ (2l + 1) ρ) for two fluids of density ρ, of which σ is the tension of both surfaces.
        let lamb = (2.0 * SURFACE_TENSION * 24.0 / (0.05f64.powi(3) * 5.0 * AIR_DENSITY)).sqrt();
        let found = Oscillator::new(0.05, 0.0).frequency;
        assert!((found / lamb - 1.0).abs() < 1e-12, "{found} {lamb}");
        let heavier = bubble().frequency;
        assert!(
            (0.97..0.995).contains(&(heavier / lamb)),
            "film of 700 nm weighs as two hundredths of the air: {heavier}"
        );
        // The oscillation outlives many periods.
        assert!((0.4..0.8).contains(&bubble().damping), "{:?}", bubble());
    }

    #[test]
    fn it_swings_freely_and_decays_at_its_rate() {
        let (bubble, from) = (bubble(), Shape { shape: traceless(DVec3::X), rate: DMat3::ZERO });
        let period = std::f64::consts::TAU / (bubble.frequency.powi(2) - bubble.damping.powi(2)).sqrt();
        let after = bubble.freely(from, period);
        let decay = (-bubble.damping * period).exp();
        assert!(norm(after.shape - from.shape * decay) < 1e-12);
    }

    /// S″ + 2β S′ + ω² S by finite differences of a motion.
    fn law(bubble: &Oscillator, shape: impl Fn(f64) -> Shape, time: f64) -> DMat3 {
        let d = 1e-5;
        let [before, now, after] = [time - d, time, time + d].map(shape);
        let rate = (after.shape - before.shape) * (0.5 / d);
        assert!(norm(rate - now.rate) < 1e-6 * (1.0 + norm(now.rate)), "the rate is the slope");
        (after.rate - before.rate) * (0.5 / d)
            + now.rate * (2.0 * bubble.damping)
            + now.shape * bubble.frequency.powi(2)
    }

    #[test]
    fn a_dragged_bubble_obeys_its_law() {
        let bubble = bubble();
        let path = CenterPath::new(DVec3::ZERO, [(0.2, DVec3::new(0.2, 0.1, 0.0)), (0.33, DVec3::Z * 0.1)]);
        for time in [0.1, 0.25, 0.32, 0.34, 0.5, 1.0] {
            let found = law(&bubble, |time| bubble.along(&path).at(time), time);
            let wind = path.at(time).velocity_m_s;
            let expected = bubble.push(0.75 * AIR_DENSITY * wind.length_squared(), wind.normalize_or(DVec3::X));
            assert!(norm(found - expected) < 1e-3 * norm(expected).max(0.1), "{time}: {found} {expected}");
        }
        let max = (0..100).map(|k| norm(bubble.along(&path).at(0.01 * f64::from(k)).shape)).fold(0.0, f64::max);
        assert!((0.01..0.5).contains(&max), "seen, and not torn: {max}");
        assert!(norm(bubble.along(&path).at(20.0).shape) < 1e-4 * max);
    }

    #[test]
    fn a_jet_dents_and_what_blows_away_does_not() {
        let bubble = bubble();
        let push = bubble.jet_push(DVec3::X, 20.0, DVec3::NEG_X, 3.0);
        for time in [0.05, 0.19, 0.3] {
            let found = law(&bubble, |time| bubble.after_push(push, 0.2, time), time);
            let expected = if time < 0.2 { push } else { DMat3::ZERO };
            assert!(norm(found - expected) < 1e-3 * norm(push), "{time}");
        }
        assert!(bubble.after_push(push, 0.2, 0.05).shape.x_axis.x < 0.0, "flatter along the jet");
        assert_eq!(bubble.jet_push(DVec3::X, 20.0, DVec3::X, 3.0), DMat3::ZERO);
    }

    #[test]
    fn the_jets_second_degree_is_its_integral() {
        for kappa in [0.7, 5.0, 300.0] {
            let steps = 200_000;
            let sum: f64 = (0..steps)
                .map(|k| {
                    let mu = -1.0 + 2.0 * (f64::from(k) + 0.5) / f64::from(steps);
                    (kappa * (mu - 1.0)).exp() * 0.5 * (3.0 * mu * mu - 1.0) * 2.0 / f64::from(steps)
                })
                .sum();
            assert!((second_degree(kappa) - 2.5 * sum).abs() < 1e-7, "{kappa}");
        }
    }

    #[test]
    fn volume_is_kept_however_far_it_is_pushed() {
        let turned = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7) * DVec3::X;
        for size in [1e-4, 0.1, 1.0, 1e6] {
            let stretch = Shape { shape: traceless(turned) * size, rate: DMat3::ZERO }.stretch();
            assert!((stretch.determinant() - 1.0).abs() < 1e-14, "{size}");
            assert!(norm(stretch) < 2.6, "{size}");
        }
        let still = Shape { shape: traceless(turned) * 1e-6, rate: DMat3::ZERO };
        assert_eq!(still.stretch(), DMat3::IDENTITY);
    }
}
