//! A scene with all that follows from it before a moment is named: its motions and the life cycles of its bubbles.

use std::{ops::Deref, sync::OnceLock};

use glam::{DQuat, DVec3};

use super::{
    FilmKey, Moment,
    detail::{film_grids, shared_grids},
    films::{film, has_field},
    laws::courses,
    lender::{Lender, film_owners},
    turns::Turns,
};
use crate::{
    physics::{
        bubble::{Age, LifeCycle},
        timeline::Timeline,
    },
    scene::{Bubble, Event, Generator, Motion, Scene},
};

/// A scene and its story. It reads as the scene, and changes by [`Story::change`] alone, so that both always agree. What follows from the scene
/// is found when it is first asked for, and once: a moment an hour into a story of thousands of events costs no more than its first.
#[derive(Debug)]
pub struct Story {
    scene: Scene,
    plot: OnceLock<Plot>,
    grids: OnceLock<Vec<[u32; 2]>>,
}

/// What follows from the parts of a scene that shape its films.
#[derive(Debug)]
struct Plot {
    /// The parts that it follows from.
    source: (Motion, Vec<Bubble>, Vec<Generator>, Vec<Event>),
    owners: Vec<Bubble>,
    lenders: Vec<Lender>,
    motions: Timeline<Motion>,
    turns: Turns,
    life_cycles: Vec<LifeCycle>,
}

impl Story {
    /// The story of a scene.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self { scene, plot: OnceLock::new(), grids: OnceLock::new() }
    }

    /// Changes the scene, and returns what the change does.
    pub fn change<T>(&mut self, change: impl FnOnce(&mut Scene) -> T) -> T {
        let result = change(&mut self.scene);
        self.grids.take();
        // A camera that moves leaves what happens as it is, and lives that were found stay found.
        if self.plot.get().is_some_and(|plot| !plot.is_of(&self.scene)) {
            self.plot.take();
        }
        result
    }

    /// The motion in force at a tick.
    #[must_use]
    pub fn motion_in_force(&self, tick: u64) -> &Motion {
        // There is one from tick 0 on.
        self.plot().motions.at(tick).unwrap_or(&self.scene.motion)
    }

    /// How far all films have turned as a whole at a time in ticks.
    #[must_use]
    pub fn film_turn(&self, ticks: f64) -> DQuat {
        self.plot().turns.at(ticks)
    }

    /// The owners of all films: see [`film_owners`].
    #[must_use]
    pub fn owners(&self) -> &[Bubble] {
        &self.plot().owners
    }

    /// The list of the scene that names a film, and the item there: a bubble or a generator.
    pub(super) fn place_of_film(&self, index: usize) -> (&'static str, usize) {
        if index < self.bubbles.len() {
            return ("bubble", index);
        }
        ("generator", self.lenders().partition_point(|lender| lender.first_owner <= index) - 1)
    }

    /// What the generators of the scene make.
    pub(super) fn lenders(&self) -> &[Lender] {
        &self.plot().lenders
    }

    /// Where the center of a bubble is at a time in seconds, m; the origin for a bubble that there is not.
    #[must_use]
    pub fn center_m(&self, index: usize, time_s: f64) -> DVec3 {
        self.life_cycle(index).map_or(DVec3::ZERO, |life_cycle| life_cycle.path().at(time_s).place_m)
    }

    /// All bubbles at a time in seconds, those of generators included: the center and the radius of each, m.
    #[must_use]
    pub fn spheres(&self, time_s: f64) -> Vec<(DVec3, f64)> {
        let own = self.bubbles.iter().enumerate().map(|(index, bubble)| {
            let radius_m = 1e-3 * bubble.radius_mm;
            (self.center_m(index, time_s), radius_m)
        });
        let made = self.lenders().iter().flat_map(|lender| lender.swarm.at(time_s));
        own.chain(made.map(|member| (member.center_m, member.radius_m))).collect()
    }

    /// A bubble at a moment; `None` between two lives, or if there is no such bubble.
    #[must_use]
    pub fn age(&self, index: usize, moment: Moment) -> Option<Age> {
        self.life_cycle(index)?.at(moment)
    }

    /// The life cycle of a bubble; `None` if there is no such bubble.
    #[must_use]
    pub fn life_cycle(&self, index: usize) -> Option<&LifeCycle> {
        self.plot().life_cycles.get(index)
    }

    /// The film of a bubble at a moment; `None` if there is no such bubble then.
    #[must_use]
    pub fn film_key(&self, index: usize, moment: Moment) -> Option<FilmKey> {
        self.age(index, moment).map(|age| self.film_of_age(index, &age))
    }

    /// What the film of a bubble of the scene is at an age.
    pub(super) fn film_of_age(&self, index: usize, age: &Age) -> FilmKey {
        film(&self.owners()[index], age, self.grids()[index], &self.motion)
    }

    /// Cells along a panel's edge of a bubble's film, and of its flow where that is coarser; `None` for a film of one thickness.
    #[must_use]
    pub fn field_grids(&self, index: usize) -> Option<[u32; 2]> {
        self.owners().get(index).filter(|bubble| has_field(bubble)).map(|_| self.grids()[index])
    }

    fn grids(&self) -> &[[u32; 2]] {
        self.grids.get_or_init(|| {
            let own = (0..self.bubbles.len()).map(|index| film_grids(self, index));
            own.chain(self.owners()[self.bubbles.len()..].iter().map(|owner| shared_grids(&owner.film))).collect()
        })
    }

    fn plot(&self) -> &Plot {
        self.plot.get_or_init(|| Plot::new(&self.scene))
    }
}

impl Deref for Story {
    type Target = Scene;

    fn deref(&self) -> &Scene {
        &self.scene
    }
}

impl Plot {
    fn new(scene: &Scene) -> Self {
        let motions = scene.motions().collect();
        let turns = Turns::new(&motions, scene.motion.tick_s);
        let owners = film_owners(&scene.bubbles, &scene.generators);
        let lenders = scene.generators.iter().scan(scene.bubbles.len(), |owner, generator| {
            let first_owner = std::mem::replace(owner, *owner + generator.films as usize);
            Some(Lender::new(generator, first_owner, scene.motion.tick_s))
        });
        let lenders: Vec<Lender> = lenders.collect();
        let mut courses = courses(&owners, &scene.events, &motions, &turns).into_iter();
        let mut life_cycles: Vec<LifeCycle> = courses.by_ref().take(scene.bubbles.len()).map(LifeCycle::new).collect();
        let renewals = lenders.iter().flat_map(Lender::renewals);
        life_cycles.extend(courses.zip(renewals).map(|(course, renewal)| LifeCycle::shared(course, renewal)));
        let source = (scene.motion.clone(), scene.bubbles.clone(), scene.generators.clone(), scene.events.clone());
        Self { source, owners, lenders, motions, turns, life_cycles }
    }

    /// Whether it follows from a scene.
    fn is_of(&self, scene: &Scene) -> bool {
        let (motion, bubbles, generators, events) = &self.source;
        (motion, bubbles, generators, events) == (&scene.motion, &scene.bubbles, &scene.generators, &scene.events)
    }
}
