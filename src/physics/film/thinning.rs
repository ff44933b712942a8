//! How the top of a sorted film thins: evenly by evaporation, and by drainage, which goes as the cube of the thickness.

/// What film thins by, from some tick on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thinning {
    /// By evaporation, nm/s.
    pub evaporation_nm_s: f64,
    /// By drainage, over the cube of the thickness, 1/(nm² s): at the top `dh/dt = −(ρ g / 6 μ R) h³`.
    pub drainage_1_nm2_s: f64,
}

impl Thinning {
    /// How fast film of a thickness in nm thins, nm/s.
    fn rate_nm_s(&self, nm: f64) -> f64 {
        self.evaporation_nm_s + self.drainage_1_nm2_s * nm.powi(3)
    }

    /// The time in which film thins from one thickness to another, both in nm and above 0, s; infinite where it never does.
    fn seconds(&self, from_nm: f64, to_nm: f64) -> f64 {
        /// Pieces of Simpson's rule in ln h, an even number: for thicknesses a factor of 100 apart it errs by less than 1e-6.
        const PIECES: u32 = 64;
        if self.drainage_1_nm2_s == 0.0 {
            return (from_nm - to_nm).max(0.0) / self.evaporation_nm_s;
        }
        let step = (from_nm / to_nm).ln().max(0.0) / f64::from(PIECES);
        let value = |piece: u32| {
            let nm = to_nm * (step * f64::from(piece)).exp();
            nm / self.rate_nm_s(nm)
        };
        let weight = |piece: u32| if piece == 0 || piece == PIECES { 1.0 } else { f64::from(2 + 2 * (piece % 2)) };
        step / 3.0 * (0..=PIECES).map(|piece| weight(piece) * value(piece)).sum::<f64>()
    }

    /// The thickness in nm that is left of film after some seconds, if it does not thin to a lower one before.
    fn remaining_nm(&self, from_nm: f64, to_nm: f64, seconds: f64) -> f64 {
        let [mut low, mut high] = [to_nm, from_nm];
        for _ in 0..48 {
            let middle = 0.5 * (low + high);
            if self.seconds(from_nm, middle) > seconds { low = middle } else { high = middle }
        }
        high
    }
}

/// The time in ticks at which film has thinned from one thickness to another, in nm, by laws that hold from ticks on, in order. Nothing if
/// it never does.
pub fn thins_at_tick(
    laws: impl IntoIterator<Item = (u64, Thinning)>,
    tick_s: f64,
    from_nm: f64,
    to_nm: f64,
) -> Option<f64> {
    let mut laws = laws.into_iter().peekable();
    let mut nm = from_nm;
    while let Some((from, law)) = laws.next() {
        let end = laws.peek().map_or(f64::INFINITY, |(tick, _)| *tick as f64);
        let lasts_s = tick_s * (end - from as f64);
        // Where nothing thins, the time is NaN if the thickness need not change.
        let needs_s = if nm <= to_nm { 0.0 } else { law.seconds(nm, to_nm) };
        if needs_s.is_finite() && needs_s <= lasts_s {
            return Some(from as f64 + needs_s / tick_s);
        }
        nm = if needs_s.is_finite() { law.remaining_nm(nm, to_nm, lasts_s) } else { nm };
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::film::properties::{DENSITY, Drainage, GRAVITY, VISCOSITY};

    fn thinning(evaporation_nm_s: f64, drainage_1_nm2_s: f64) -> Thinning {
        Thinning { evaporation_nm_s, drainage_1_nm2_s }
    }

    #[test]
    fn film_that_evaporates_thins_evenly() {
        let laws = [(0, thinning(0.0, 0.0)), (60, thinning(10.0, 0.0)), (120, thinning(20.0, 0.0))];
        assert_eq!(thins_at_tick(laws, 0.1, 300.0, 280.0), Some(80.0), "20 nm at a nanometre a tick");
        // The first sixty nanometres until tick 120, to what bisection tells.
        assert!((thins_at_tick(laws, 0.1, 300.0, 200.0).unwrap() - 140.0).abs() < 1e-9);
        assert_eq!(thins_at_tick([laws[0]], 0.1, 300.0, 200.0), None);
        assert_eq!(thins_at_tick(laws, 0.1, 40.0, 50.0), Some(0.0), "thin already");
        assert_eq!(thins_at_tick([], 0.1, 300.0, 200.0), None);
    }

    #[test]
    fn film_that_drains_thins_as_the_closed_form_has_it() {
        let drainage = Drainage { thickness_m: 1e-6, radius_m: 0.05, viscosity: VISCOSITY };
        let law = thinning(0.0, 1e-18 * DENSITY * GRAVITY / (6.0 * VISCOSITY * drainage.radius_m));
        for time_s in [1e3, 1e4, 1e6] {
            let found = thins_at_tick([(0, law)], 1.0, 1e3, 1e9 * drainage.apex_m(time_s)).unwrap();
            assert!((found / time_s - 1.0).abs() < 1e-6, "{found} {time_s}");
        }
    }

    #[test]
    fn both_together_are_faster_than_either_and_no_slower_in_pieces() {
        let (dry, drains, both) = (thinning(5.0, 0.0), thinning(0.0, 1e-7), thinning(5.0, 1e-7));
        let time = |laws: &[(u64, Thinning)]| thins_at_tick(laws.iter().copied(), 0.1, 1000.0, 50.0).unwrap();
        assert!(time(&[(0, both)]) < time(&[(0, dry)]).min(time(&[(0, drains)])));
        let in_pieces = time(&[(0, both), (100, both), (350, both)]);
        assert!((in_pieces / time(&[(0, both)]) - 1.0).abs() < 1e-6, "{in_pieces}");
    }
}
