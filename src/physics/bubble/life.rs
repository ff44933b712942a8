//! The life cycle of a bubble: it is blown, it bursts where it is pricked or when its film has been black for long enough, and a new one is blown.
//!
//! When it bursts follows from what happens to it alone, so that any moment of any life can be shown without those before it.

use std::sync::{Arc, Mutex, PoisonError};

use glam::{DMat3, DVec3};

use super::{
    center::CenterPath,
    shape::{DraggedShape, Oscillator, Shape},
};
use crate::physics::{
    film::{
        Evaporation, FlowLaw, InitialFilm, Pushes, Random, Thinning, burst_s, fold_seed,
        properties::{BLACK_FILM_NM, BLACK_FILM_ONSET},
        thins_at_tick,
    },
    timeline::{Moment, Spans, Timeline},
};

/// E-foldings after which nothing is left of an oscillation, beside any that is seen.
const RUNG_DOWN: f64 = 100.0;

/// How long a bubble takes to be blown, s.
const BLOWN_S: f64 = 0.4;

/// Radius of a bubble at an age in s, over that which it has once it is blown: air comes at an even rate.
#[must_use]
pub fn blown(age_s: f64) -> f64 {
    (age_s / BLOWN_S).min(1.0).cbrt()
}

/// All that ever happens to a bubble, in ticks from the first one on, and what it is.
#[derive(Clone, Debug)]
pub struct Course {
    /// Length of a tick, s.
    pub tick_s: f64,
    /// Radius, m.
    pub radius_m: f64,
    /// The first film as it was blown.
    pub film: InitialFilm,
    /// Seed of all films.
    pub seed: u64,
    /// Tells the random numbers of bubbles of one seed apart.
    pub stream: u32,
    /// What drives the film.
    pub flows: Timeline<FlowLaw>,
    /// What evaporates, nm/s.
    pub evaporation_nm_s: Timeline<f64>,
    /// What the top of the film thins by once it is sorted.
    pub thinning: Timeline<Thinning>,
    /// How bubbles burst.
    pub bursting: Timeline<Bursting>,
    /// What pushes the film, in directions that turn with it.
    pub pushes: Pushes,
    /// What of jets dents the bubble as [`Oscillator::after_push`] has it, 1/s².
    pub jets: Spans<DMat3>,
    /// Ticks at which it is pricked, in order, and the directions in its film, unit vectors.
    pub pricks: Vec<(u64, DVec3)>,
    /// Where the center is at first, m.
    pub rest_m: DVec3,
    /// Ticks from which on the center goes elsewhere, in order, and where to, m.
    pub drags: Vec<(u64, DVec3)>,
}

/// How a bubble bursts, and what follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bursting {
    /// How long black film lasts on average, s.
    pub black_film_life_s: f64,
    /// How many times slower than in life it bursts.
    pub slowdown: f64,
    /// From its end until a new one is blown, s.
    pub renew_s: f64,
}

/// The hole in a bubble that bursts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Direction of its middle in the film; none where the film is thinnest.
    pub at: Option<DVec3>,
    /// For how long it has opened, s.
    pub seconds: f64,
}

/// How a life ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    /// The tick at which the hole opens.
    tick: u64,
    /// Where it does, if something pricks the film; else it is where the film is thinnest.
    at: Option<DVec3>,
    /// How many times slower than in life it grows.
    slowdown: f64,
    /// How long the burst lasts, s of film time without slow motion.
    lasts_s: f64,
    /// The tick at which the next bubble is blown.
    next: u64,
}

/// One life of a bubble. Its ticks count from its beginning, and it knows of nothing that comes after its end.
#[derive(Clone, Debug)]
pub struct Life {
    /// The tick at which it was blown.
    pub born: u64,
    /// How many there were before it.
    pub generation: u32,
    /// The film as it was blown.
    pub film: InitialFilm,
    /// What drives the film.
    pub flows: Timeline<FlowLaw>,
    /// The first tick from which the film moves by itself, if it ever does.
    pub free_from: Option<u64>,
    /// What evaporates.
    pub evaporation: Evaporation,
    /// What pushes the film.
    pub pushes: Pushes,
    /// Where the center goes, in radii, from where it was at the very first.
    pub path: CenterPath,
    end: Option<End>,
    tick_s: f64,
    oscillator: Oscillator,
    dragged: DraggedShape,
    jets: Spans<DMat3>,
}

/// A bubble at a moment.
#[derive(Clone, Debug)]
pub struct Age {
    /// The life that the moment falls into.
    pub life: Arc<Life>,
    /// The moment of its film since it was blown; while it bursts, the moment of the burst.
    pub moment: Moment,
    /// The hole in it, while it bursts.
    pub hole: Option<Opening>,
}

impl Age {
    /// Radius of the bubble over that which it has once it is blown. The first bubble is there from the beginning.
    #[must_use]
    pub fn size(&self) -> f64 {
        if self.life.generation == 0 { 1.0 } else { blown(self.moment.ticks() * self.life.tick_s) }
    }
}

/// When a film that bubbles share is blown anew, whatever became of it: at a tick, and again each time that a period has passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Renewal {
    /// The first tick at which it is blown anew; it is there from tick 0 on. 0 counts as the first beginning.
    pub first_tick: u64,
    /// Ticks from then on until it is blown anew again.
    pub period_ticks: u64,
}

impl Renewal {
    /// The tick at which the film of a tick was blown, and how many there were before it.
    #[must_use]
    pub fn born(&self, tick: u64) -> (u64, u32) {
        let Some(since) = tick.checked_sub(self.first_tick) else { return (0, 0) };
        let periods = since / self.period_ticks;
        (self.first_tick + periods * self.period_ticks, periods as u32 + u32::from(self.first_tick > 0))
    }
}

/// The lives of a bubble, each found once: with thousands of events there may be thousands of lives.
#[derive(Debug)]
pub struct LifeCycle {
    course: Course,
    path: CenterPath,
    ending: Ending,
    found: Mutex<Found>,
}

/// What ends the lives of a bubble.
#[derive(Clone, Copy, Debug)]
enum Ending {
    /// What happens to it.
    Bursts,
    /// Nothing, or the clock alone.
    Renewed(Option<Renewal>),
}

/// The lives that have been asked for so far.
#[derive(Debug, Default)]
struct Found {
    /// When each begins and how it ends, in order.
    spans: Vec<(u64, Option<End>)>,
    /// The one that was asked for last.
    latest: Option<Arc<Life>>,
}

impl LifeCycle {
    /// The life cycle of a bubble.
    #[must_use]
    pub fn new(course: Course) -> Self {
        let path = course.path(0, u64::MAX, course.rest_m, DVec3::ZERO, 1.0);
        Self { course, path, ending: Ending::Bursts, found: Mutex::default() }
    }

    /// The lives of a film that bubbles share, which never bursts.
    #[must_use]
    pub fn shared(course: Course, renewal: Option<Renewal>) -> Self {
        Self { ending: Ending::Renewed(renewal), ..Self::new(course) }
    }

    /// Where the center goes in all lives, m.
    #[must_use]
    pub fn path(&self) -> &CenterPath {
        &self.path
    }

    /// The bubble at a moment; `None` between two lives.
    #[must_use]
    pub fn at(&self, moment: Moment) -> Option<Age> {
        let life = self.life(moment.tick);
        let Some(end) = life.end.filter(|end| end.tick <= moment.tick) else {
            let moment = Moment { tick: moment.tick - life.born, ..moment };
            return Some(Age { life, moment, hole: None });
        };
        let seconds = ((moment.tick - end.tick) as f64 + moment.fraction) * self.course.tick_s / end.slowdown;
        let hole = Some(Opening { at: end.at, seconds });
        (seconds < end.lasts_s).then(|| Age { moment: Moment::tick(end.tick - life.born), hole, life })
    }

    /// When a bubble blown at a tick as number `generation` ends, and where the hole opens if something pricks it.
    #[must_use]
    pub fn end_of(&self, born: u64, generation: u32) -> Option<(u64, Option<DVec3>)> {
        self.course.end(born, generation).map(|end| (end.tick, end.at))
    }

    /// The life that a tick falls into, with the time until the next one.
    fn life(&self, tick: u64) -> Arc<Life> {
        // What is found is whole even where another thread panicked.
        let mut found = self.found.lock().unwrap_or_else(PoisonError::into_inner);
        if let Ending::Renewed(renewal) = self.ending {
            let (born, generation) = renewal.map_or((0, 0), |renewal| renewal.born(tick));
            return found.latest(generation, || self.course.life(&self.path, born, generation, None));
        }
        while let Some(born) = found.next_born().filter(|born| *born <= tick) {
            let generation = found.spans.len() as u32;
            found.spans.push((born, self.course.end(born, generation)));
        }
        // The first life begins at tick 0.
        let generation = found.spans.partition_point(|(born, _)| *born <= tick) - 1;
        let (born, end) = found.spans[generation];
        found.latest(generation as u32, || self.course.life(&self.path, born, generation as u32, end))
    }
}

impl Found {
    /// Life number `generation`, which is made if another was asked for last.
    fn latest(&mut self, generation: u32, make: impl FnOnce() -> Life) -> Arc<Life> {
        match &self.latest {
            Some(life) if life.generation == generation => life.clone(),
            _ => self.latest.insert(Arc::new(make())).clone(),
        }
    }

    /// When the life after all those that were found begins, if there is another.
    fn next_born(&self) -> Option<u64> {
        self.spans.last().map_or(Some(0), |(_, end)| end.map(|end| end.next))
    }
}

impl Life {
    /// How far from round the bubble has been pushed at a moment, by the air that it is dragged through and by jets.
    #[must_use]
    pub fn shape(&self, moment: Moment) -> Shape {
        let (now, tick_s) = (moment.ticks(), self.tick_s);
        let rung_down = now - RUNG_DOWN / (self.oscillator.damping * tick_s);
        let jets = self.jets.during(rung_down, now).map(|(ticks, push)| {
            let (lasts, since_s) = (ticks.end - ticks.start, now * tick_s - ticks.start as f64 * tick_s);
            self.oscillator.after_push(*push, lasts as f64 * tick_s, since_s)
        });
        jets.fold(self.dragged.at(now * tick_s), |sum, jet| sum + jet)
    }
}

impl Course {
    /// Life number `generation`, which begins at a tick and has an end, of a bubble whose center goes along a path.
    fn life(&self, path: &CenterPath, born: u64, generation: u32, end: Option<End>) -> Life {
        let gone = end.map_or(u64::MAX, |end| end.tick);
        let start_m = path.at(born as f64 * self.tick_s).place_m;
        let oscillator = self.oscillator();
        let flows = self.flows.until(gone).since(born);
        let free_from = flows.iter().find(|(_, law)| matches!(law, FlowLaw::Free(_))).map(|(from, _)| from);
        Life {
            born,
            generation,
            film: self.film(generation),
            flows,
            free_from,
            evaporation: self.evaporation(born, gone),
            pushes: self.pushes.until(gone).since(born),
            path: self.path(born, gone, start_m, self.rest_m, self.radius_m),
            end,
            tick_s: self.tick_s,
            oscillator,
            dragged: oscillator.along(&self.path(born, gone, start_m, self.rest_m, 1.0)),
            jets: self.jets.until(gone).begun_since(born),
        }
    }

    /// Where the center goes from a tick on, at which it rests at a place, until another: seen from an origin, in a unit of length in metres.
    fn path(&self, born: u64, gone: u64, start_m: DVec3, origin_m: DVec3, unit_m: f64) -> CenterPath {
        let in_units = |place_m: DVec3| (place_m - origin_m) / unit_m;
        let time_s = |tick: u64| tick as f64 * self.tick_s;
        let first = self.drags.partition_point(|(tick, _)| *tick < born);
        let drags = self.drags[first..].iter().take_while(|(tick, _)| *tick < gone);
        let jumps = drags.map(|(tick, place_m)| (time_s(*tick) - time_s(born), in_units(*place_m)));
        CenterPath::new(in_units(start_m), jumps)
    }

    /// What evaporates from a bubble between two ticks.
    fn evaporation(&self, born: u64, gone: u64) -> Evaporation {
        Evaporation::new(&self.evaporation_nm_s.until(gone).since(born), self.tick_s)
    }

    fn oscillator(&self) -> Oscillator {
        Oscillator::new(self.radius_m, 1e-9 * self.film.mean_nm())
    }

    /// The film of the bubble number `generation` as it is blown.
    fn film(&self, generation: u32) -> InitialFilm {
        match self.film {
            InitialFilm::Blown { thickness_nm, stratification, .. } => {
                let seed = fold_seed(self.seed.wrapping_add(generation.into()));
                InitialFilm::Blown { thickness_nm, stratification, seed }
            }
            film => film,
        }
    }

    /// How life number `generation`, which begins at a tick, ends, if it does.
    fn end(&self, born: u64, generation: u32) -> Option<End> {
        let next = self.pricks.partition_point(|(tick, _)| *tick < born);
        let pricked = self.pricks.get(next).map(|(tick, at)| (*tick, Some(*at)));
        let before = pricked.map_or(u64::MAX, |(tick, _)| tick);
        let worn = self.worn_at(born, generation, before).map(|tick| (tick, None));
        let (tick, at) = [worn, pricked].into_iter().flatten().min_by_key(|(tick, _)| *tick)?;
        let Bursting { slowdown, renew_s, .. } = *self.bursting.at(tick)?;
        let lasts_s = self.burst_s(born, generation, tick);
        let ticks = ((lasts_s * slowdown + renew_s) / self.tick_s).ceil().max(1.0) as u64;
        Some(End { tick, at, slowdown, lasts_s, next: tick.saturating_add(ticks) })
    }

    /// The tick at which black film gives way: it lasts for a random time, exponential with a mean, once the top of the sorted film is thin
    /// enough to collapse. Laws that begin later than a tick are of no account.
    fn worn_at(&self, born: u64, generation: u32, before: u64) -> Option<u64> {
        let laws = self.thinning.until(before);
        let laws = laws.iter_since(born).map(|(from, law)| (from, *law));
        let top_nm = self.film(generation).sorted_top_nm();
        let black_at = born as f64 + thins_at_tick(laws, self.tick_s, top_nm, 1e9 * BLACK_FILM_ONSET)?;
        let life_s = self.bursting.at(black_at as u64)?.black_film_life_s;
        let lasts_s = -life_s * self.chance(generation).ln();
        let ticks = black_at + lasts_s / self.tick_s;
        // A bubble is seen before it bursts, and times beyond all clocks are never.
        (ticks < 1e15).then(|| (ticks.ceil() as u64).max(born + 1))
    }

    /// How long the burst lasts that ends a life at a tick, s of film time without slow motion.
    fn burst_s(&self, born: u64, generation: u32, tick: u64) -> f64 {
        let evaporated_nm = self.evaporation(born, tick).nm((tick - born) as f64);
        let thickest_nm = self.film(generation).range_nm().1 - evaporated_nm;
        burst_s(thickest_nm.max(BLACK_FILM_NM), self.radius_m)
    }

    /// A random number in (0, 1] that belongs to a life.
    fn chance(&self, generation: u32) -> f64 {
        let stream = self.stream.wrapping_shl(16) ^ generation;
        1.0 - Random::new(fold_seed(self.seed), stream).between(0.0, 1.0)
    }
}
