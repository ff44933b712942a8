//! Histories: a moment, what holds from a tick on, and what lasts from one tick to another.
//!
//! A history is written once and shared. To cut it off at a tick copies nothing, and two parts of one history are compared without a look at what
//! is in them, however long it is.

use std::{
    fmt,
    ops::{Deref, Range},
    sync::Arc,
};

/// A moment of a film: a tick, and how far towards the next one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moment {
    /// Whole ticks.
    pub tick: u64,
    /// Part of the next tick, in [0, 1).
    pub fraction: f64,
}

impl Moment {
    /// The moment of a tick.
    #[must_use]
    pub fn tick(tick: u64) -> Self {
        Self { tick, fraction: 0.0 }
    }

    /// The moment as a time in ticks.
    #[must_use]
    pub fn ticks(&self) -> f64 {
        self.tick as f64 + self.fraction
    }

    /// The first tick that has no part in this moment.
    #[must_use]
    pub fn end_tick(&self) -> u64 {
        self.tick + u64::from(self.fraction > 0.0)
    }

    /// The moment of a time, for a tick's length. A time within a billionth of a tick counts as the tick.
    #[must_use]
    pub fn of_time(time_s: f64, tick_s: f64) -> Self {
        let ticks = (time_s / tick_s).max(0.0);
        let nearest = ticks.round();
        if (ticks - nearest).abs() < 1e-9 * nearest.max(1.0) {
            return Self::tick(nearest as u64);
        }
        Self { tick: ticks.floor() as u64, fraction: ticks - ticks.floor() }
    }
}

impl fmt::Display for Moment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "tick {}", self.tick)?;
        if self.fraction > 0.0 {
            write!(f, " + {:.3}", self.fraction)?;
        }
        Ok(())
    }
}

/// The first items of a list that is shared.
pub struct Prefix<T> {
    all: Arc<[T]>,
    count: usize,
}

impl<T> Prefix<T> {
    /// The items before the first that does not belong; none behind it may belong.
    #[must_use]
    pub fn cut(&self, belongs: impl FnMut(&T) -> bool) -> Self {
        Self { all: self.all.clone(), count: self.partition_point(belongs) }
    }

    /// Whether both are of one list, which takes no look at their items.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.all, &other.all)
    }
}

impl<T> Deref for Prefix<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.all[..self.count]
    }
}

impl<T> FromIterator<T> for Prefix<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let all: Arc<[T]> = items.into_iter().collect();
        Self { count: all.len(), all }
    }
}

impl<T> Default for Prefix<T> {
    fn default() -> Self {
        std::iter::empty().collect()
    }
}

impl<T> Clone for Prefix<T> {
    fn clone(&self) -> Self {
        Self { all: self.all.clone(), count: self.count }
    }
}

impl<T: fmt::Debug> fmt::Debug for Prefix<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        (**self).fmt(f)
    }
}

impl<T: PartialEq> PartialEq for Prefix<T> {
    fn eq(&self, other: &Self) -> bool {
        self.count == other.count && (self.shares(other) || **self == **other)
    }
}

/// What holds from ticks on, in order, each until the next one does.
#[derive(Clone, Debug, PartialEq)]
pub struct Timeline<T>(Prefix<(u64, T)>);

impl<T> Timeline<T> {
    /// The value in force during a tick; `None` before the first.
    #[must_use]
    pub fn at(&self, tick: u64) -> Option<&T> {
        self.in_force(tick as f64).map(|(_, value)| value)
    }

    /// What holds at a time in ticks, and the tick from which it does.
    #[must_use]
    pub fn in_force(&self, ticks: f64) -> Option<(u64, &T)> {
        let begun = self.0.partition_point(|(from, _)| *from as f64 <= ticks);
        self.0[..begun].last().map(|(from, value)| (*from, value))
    }

    /// The first tick after a tick from which something else holds; none if nothing ever does.
    #[must_use]
    pub fn next_change(&self, tick: u64) -> Option<u64> {
        self.0.get(self.0.partition_point(|(from, _)| *from <= tick)).map(|(from, _)| *from)
    }

    /// What begins before a tick.
    #[must_use]
    pub fn until(&self, end: u64) -> Self {
        Self(self.0.cut(|(from, _)| *from < end))
    }

    /// All of it, with the ticks from which each holds.
    pub fn iter(&self) -> impl Iterator<Item = (u64, &T)> {
        self.0.iter().map(|(from, value)| (*from, value))
    }

    /// What holds at a tick and from then on, with ticks that count from it.
    pub fn iter_since(&self, born: u64) -> impl Iterator<Item = (u64, &T)> {
        let first = self.0.partition_point(|(from, _)| *from <= born).saturating_sub(1);
        self.0[first..].iter().map(move |(from, value)| (from.saturating_sub(born), value))
    }

    /// Whether both are parts of one history, which takes no look at it.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        self.0.shares(&other.0)
    }
}

impl<T: PartialEq> Timeline<T> {
    /// Without what is the same as before.
    #[must_use]
    pub fn of_changes(entries: impl IntoIterator<Item = (u64, T)>) -> Self {
        let mut entries: Vec<(u64, T)> = entries.into_iter().collect();
        entries.dedup_by(|later, before| later.1 == before.1);
        entries.into_iter().collect()
    }
}

impl<T: Clone> Timeline<T> {
    /// A history of its own that begins at a tick, with what holds then.
    #[must_use]
    pub fn since(&self, born: u64) -> Self {
        self.iter_since(born).map(|(from, value)| (from, value.clone())).collect()
    }
}

impl<T> FromIterator<(u64, T)> for Timeline<T> {
    fn from_iter<I: IntoIterator<Item = (u64, T)>>(entries: I) -> Self {
        Self(entries.into_iter().collect())
    }
}

impl<T> Default for Timeline<T> {
    fn default() -> Self {
        Self(Prefix::default())
    }
}

/// What lasts from one tick to another, in the order of first ticks.
#[derive(Clone, Debug)]
pub struct Spans<T> {
    spans: Prefix<(Range<u64>, T)>,
    /// How long the longest of the whole history lasts, ticks.
    longest: u64,
}

impl<T> Spans<T> {
    /// What begins before a tick.
    #[must_use]
    pub fn until(&self, end: u64) -> Self {
        Self { spans: self.spans.cut(|(ticks, _)| ticks.start < end), longest: self.longest }
    }

    /// How long the longest of the whole history lasts, ticks.
    #[must_use]
    pub fn longest(&self) -> u64 {
        self.longest
    }

    /// All of it, with the ticks during which each lasts.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&Range<u64>, &T)> {
        self.spans.iter().map(|(ticks, value)| (ticks, value))
    }

    /// What has a part in the time between two times in ticks.
    pub fn during(&self, from: f64, to: f64) -> impl Iterator<Item = (&Range<u64>, &T)> {
        let first = self.spans.partition_point(|(ticks, _)| (ticks.start.saturating_add(self.longest)) as f64 <= from);
        let begun = self.spans[first..].iter().take_while(move |(ticks, _)| (ticks.start as f64) < to);
        begun.filter(move |(ticks, _)| ticks.end as f64 > from).map(|(ticks, value)| (ticks, value))
    }

    /// Whether both are parts of one history, which takes no look at it.
    #[must_use]
    pub fn shares(&self, other: &Self) -> bool {
        self.spans.shares(&other.spans)
    }
}

impl<T: Clone> Spans<T> {
    /// A history of its own that begins at a tick, with what lasts beyond it.
    #[must_use]
    pub fn since(&self, born: u64) -> Self {
        let lasting = self.during(born as f64, f64::INFINITY);
        lasting.map(|(ticks, value)| (ticks.start.saturating_sub(born)..ticks.end - born, value.clone())).collect()
    }

    /// The same without what began before.
    #[must_use]
    pub fn begun_since(&self, born: u64) -> Self {
        let first = self.spans.partition_point(|(ticks, _)| ticks.start < born);
        let begun = self.spans[first..].iter();
        begun.map(|(ticks, value)| (ticks.start - born..ticks.end - born, value.clone())).collect()
    }
}

impl<T> FromIterator<(Range<u64>, T)> for Spans<T> {
    fn from_iter<I: IntoIterator<Item = (Range<u64>, T)>>(spans: I) -> Self {
        let spans: Prefix<_> = spans.into_iter().collect();
        Self { longest: spans.iter().map(|(ticks, _)| ticks.end - ticks.start).max().unwrap_or(0), spans }
    }
}

impl<T> Default for Spans<T> {
    fn default() -> Self {
        std::iter::empty().collect()
    }
}

impl<T: PartialEq> PartialEq for Spans<T> {
    fn eq(&self, other: &Self) -> bool {
        self.spans == other.spans
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timeline(entries: &[(u64, char)]) -> Timeline<char> {
        Timeline::of_changes(entries.iter().copied())
    }

    fn entries<'a>(items: impl Iterator<Item = (u64, &'a char)>) -> Vec<(u64, char)> {
        items.map(|(from, value)| (from, *value)).collect()
    }

    #[test]
    fn each_holds_until_the_next_does() {
        let laws = timeline(&[(2, 'a'), (5, 'b'), (7, 'b'), (9, 'c')]);
        assert_eq!(
            [1, 2, 4, 5, 8, 9].map(|tick| laws.at(tick).copied().unwrap_or('-')),
            ['-', 'a', 'a', 'b', 'b', 'c']
        );
        assert_eq!([0, 2, 5, 9].map(|tick| laws.next_change(tick)), [Some(2), Some(5), Some(9), None]);
        assert_eq!(laws.in_force(6.5), Some((5, &'b')));
        assert_eq!(laws.iter().count(), 3, "what stays the same is no change");
    }

    #[test]
    fn a_timeline_is_cut_at_its_beginning_and_its_end() {
        assert_eq!(timeline(&[(0, 'a'), (5, 'b')]).since(0), timeline(&[(0, 'a'), (5, 'b')]));
        assert_eq!(timeline(&[(0, 'a'), (5, 'b'), (9, 'c')]).since(7), timeline(&[(0, 'b'), (2, 'c')]));
        assert_eq!(entries(timeline(&[(0, 'a'), (5, 'b')]).iter_since(5)), [(0, 'b')]);
        assert_eq!(entries(timeline(&[(0, 'a'), (5, 'b')]).until(5).iter()), [(0, 'a')]);
        assert_eq!(timeline(&[(0, 'a')]).until(0), Timeline::default());
    }

    #[test]
    fn parts_share_their_history_and_equal_ones_are_equal() {
        let laws = timeline(&[(0, 'a'), (5, 'b'), (9, 'c')]);
        let (early, late) = (laws.until(6), laws.until(100));
        assert!(early.shares(&late) && early != late && late.until(6) == early);
        let other = timeline(&[(0, 'a'), (5, 'b'), (9, 'd')]);
        assert!(!other.shares(&laws) && other.until(6) == early && other != laws);
    }

    #[test]
    fn spans_are_found_while_they_last() {
        let spans: Spans<char> = [(0..20, 'a'), (3..5, 'b'), (8..9, 'c')].into_iter().collect();
        let during = |from, to| spans.during(from, to).map(|(_, value)| *value).collect::<String>();
        assert_eq!([during(0.0, 3.0), during(3.0, 4.0), during(5.0, 8.0)], ["a", "ab", "a"]);
        assert_eq!([during(8.5, 8.6), during(20.0, 30.0)], ["ac", ""]);
        let since = spans.since(4);
        assert_eq!(
            since.iter().map(|(ticks, value)| (ticks.clone(), *value)).collect::<Vec<_>>(),
            [(0..16, 'a'), (0..1, 'b'), (4..5, 'c')]
        );
        assert!(spans.until(8).shares(&spans) && spans.until(8).iter().count() == 2);
        // A longer one that comes later makes no difference.
        let other: Spans<char> = [(0..20, 'a'), (3..5, 'b'), (8..90, 'c')].into_iter().collect();
        assert!(other != spans && other.until(8) == spans.until(8));
    }
}
