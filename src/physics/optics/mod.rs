//! Reflectance of a thin film in air.
//!
//! # The equations
//!
//! They come from M. Ding, "Rendering Thin Film Interference on Soap Bubbles" (project proposal, 2017), which takes them from
//! K. Iwasaki, K. Matsuzawa and T. Nishita, "Real-time rendering of soap bubbles taking into account light interference" (CGI 2004).
//! As printed there:
//!
//! ```text
//! (1)  L_P(λ) = (1 − R(λ,θ,d)) L_it(λ) + R(λ,θ,d) L_ir(λ)
//!
//!                       1 − cos δ                       1 − cos δ
//! (2)  R = 2R⊥² ───────────────────────── + 2R∥² ─────────────────────────
//!               1 + R⊥⁴ − 2R⊥² cos δ             1 + R∥⁴ − 2R∥² cos δ
//!
//! (3)  δ = (4π/λ) n d cos θ
//! ```
//!
//! # What is corrected
//!
//! - **A missing ½ in (2).** Unpolarised light is half s and half p, so R is the mean of the two terms and not their sum. With (2) as
//!   printed R is exactly twice the truth, and passes 1 near grazing.
//! - **θ in (3) is the refracted angle**, inside the film: δ = (4π/λ) n d cos θ_t, with Snell's cos θ_t = √(1 − sin²θ / n²). The text
//!   leaves open which angle is meant, and (1) and (2) use the outer one.
//! - R⊥ and R∥ in (2) are Fresnel's *amplitude* coefficients of the outer face; they are written `r_s` and `r_p` here.
//!
//! With both, the formula is Airy's sum over all reflections within the film (M. Born and E. Wolf, *Principles of Optics*, 7.6.1), and
//! equals the transfer-matrix package `tmm` 0.2.0 within 2e-14. No further half-wave term is needed: the two faces' opposite signs
//! are in r and −r already, so that a film of no thickness reflects nothing and the black film comes out of the formula.
//!
//! # How far to trust it
//!
//! The physics is less certain than the arithmetic. An error of 0.001 in n (a little glycerol, ten degrees) shifts colours by CIEDE2000
//! 0.44 on average, 1 nm in d by 0.64. Small numerical budgets make the numerics invisible; they are no claim about a real film.
//! The soap's own skins (about 2 nm of n = 1.45 on each face) change a colour by up to 5.5 at equal total thickness; adding 1.64 nm to
//! d, as the GPU does, brings that to 1.1 (0.7 for cosθ ≥ 0.26), 0.08 in the mean. Refraction shifts a ray by less than the film's thickness, below 1 µm, so rays are straight.

mod airy;
mod coherence;
mod index;
mod liquids;
mod material;
mod polarised;
mod skins;

pub use airy::{Incidence, SpectralIncidence, amplitudes, cos_refracted, max_reflectance, reflectance};
pub use coherence::Coherence;
pub use index::{FilmIndex, FilmIndexError, REFERENCE_NM};
pub use material::{FilmMaterial, ORDER_NM, SpectralWall, WATER_INDEX, Wall, newton_order};
pub use polarised::Polarised;
pub use skins::{SKIN_INDEX, coated_coherence, coated_reflectance, equivalent_extra_nm};
