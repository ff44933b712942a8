//! Which film a bubble shows.

/// Lives last for a part of their mean between these.
pub(super) const LIVES: [f64; 2] = [0.6, 1.4];

/// How films are lent to bubbles. A film is blown anew from time to time, at other times than the others, and a bubble shows the one that was blown
/// last before the bubble, so that no film changes while it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lending {
    /// How many films there are.
    pub films: u32,
    /// Mean life of a bubble, s; none if all stay.
    pub life_s: Option<f64>,
    /// Length of a tick, s.
    pub tick_s: f64,
}

impl Lending {
    /// Ticks between the beginnings of two films; none if films go on for ever.
    #[must_use]
    pub fn interval_ticks(&self) -> Option<u64> {
        let longest_s = LIVES[1] * self.life_s?;
        let others = self.films.checked_sub(1).filter(|others| *others > 0)?;
        Some((longest_s / self.tick_s / f64::from(others)).ceil().max(1.0) as u64)
    }

    /// The film that a bubble shows which begins at a time in seconds, by a random number where the time leaves a choice.
    pub(super) fn film(&self, born_s: f64, choice: f64) -> u32 {
        match self.interval_ticks() {
            Some(interval) if born_s >= 0.0 => {
                ((born_s / self.tick_s) as u64 / interval % u64::from(self.films)) as u32
            }
            // These two are not blown anew while a bubble lives that was there at the beginning.
            Some(_) if choice < 0.5 => self.films - 1,
            Some(_) => 0,
            None => ((choice * f64::from(self.films)) as u32).min(self.films - 1),
        }
    }
}
