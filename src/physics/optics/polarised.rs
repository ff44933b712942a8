//! The two linear polarisations of light that meets a film.

/// A quantity for the two linear polarisations: `s` with its electric field across the plane of incidence, `p` with it inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polarised {
    /// Across the plane of incidence (⊥).
    pub s: f64,
    /// In the plane of incidence (∥).
    pub p: f64,
}

impl Polarised {
    /// The value for unpolarised light, which is half of each.
    pub fn mean(self) -> f64 {
        0.5 * (self.s + self.p)
    }

    /// What a reflectance leaves to pass.
    pub fn rest(self) -> Self {
        self.map(|r| 1.0 - r)
    }

    /// The product for each polarisation.
    pub fn times(self, other: Self) -> Self {
        Self { s: self.s * other.s, p: self.p * other.p }
    }

    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Self {
        Self { s: f(self.s), p: f(self.p) }
    }
}
