//! What evaporates from a film, by rates that change.

use crate::physics::timeline::Timeline;

/// What evaporates from a film from its beginning on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Evaporation {
    tick_s: f64,
    rates: Timeline<Rate>,
}

/// A rate, and what has evaporated when it comes into force.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rate {
    nm_s: f64,
    before_nm: f64,
}

impl Evaporation {
    /// Evaporation at rates in nm per second, for ticks of a length in seconds.
    #[must_use]
    pub fn new(rates_nm_s: &Timeline<f64>, tick_s: f64) -> Self {
        let mut last = (0, Rate { nm_s: 0.0, before_nm: 0.0 });
        let rates = rates_nm_s.iter().map(|(from, nm_s)| {
            last = (from, Rate { nm_s: *nm_s, before_nm: last.1.until(last.0, from as f64, tick_s) });
            last
        });
        Self { rates: rates.collect(), tick_s }
    }

    /// What has evaporated at a time in ticks, nm.
    #[must_use]
    pub fn nm(&self, ticks: f64) -> f64 {
        self.rates.in_force(ticks).map_or(0.0, |(from, rate)| rate.until(from, ticks, self.tick_s))
    }

    /// This evaporation without rates that come into force at a tick or later.
    #[must_use]
    pub fn until(&self, end: u64) -> Self {
        Self { rates: self.rates.until(end), tick_s: self.tick_s }
    }
}

impl Rate {
    /// What has evaporated at a time in ticks, nm, where the rate holds from a tick on.
    fn until(&self, from: u64, ticks: f64, tick_s: f64) -> f64 {
        self.before_nm + self.nm_s * tick_s * (ticks - from as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evaporation_adds_up() {
        let film = Evaporation::new(&[(0, 30.0), (60, 60.0), (120, 0.0)].into_iter().collect(), 0.1);
        assert_eq!([0.0, 10.0, 60.0, 70.0, 500.0].map(|ticks| film.nm(ticks)), [0.0, 30.0, 180.0, 240.0, 540.0]);
        assert_eq!(film.until(60).nm(70.0), 210.0);
        assert_eq!(Evaporation::default().nm(1e9), 0.0);
    }
}
