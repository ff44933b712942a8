//! A lesson that is taken: where the student is, what was answered, and how it was judged.

use std::{path::PathBuf, sync::Arc};

use super::probe::Reading;
use crate::scene::lesson::{FilmPoint, Lesson, LessonStep, Task, Verdict};

/// A lesson in progress.
#[derive(Clone, Debug)]
pub struct Course {
    /// What is taught.
    pub lesson: Arc<Lesson>,
    /// Folder that paths in the lesson start from.
    pub folder: PathBuf,
    /// Index of the step that is shown.
    pub step: usize,
    /// The number that is being typed.
    pub typed: String,
    /// What became of the last answer.
    pub outcome: Option<Outcome>,
    /// Which steps were solved.
    pub solved: Vec<bool>,
}

/// What became of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// It was judged.
    Judged(Verdict),
    /// What was typed is not a number.
    NotANumber,
    /// A point must be pinned first.
    PinFirst,
}

impl Course {
    /// A lesson at its first step.
    #[must_use]
    pub fn new(lesson: Lesson, folder: PathBuf) -> Self {
        let solved = vec![false; lesson.steps.len()];
        Self { lesson: lesson.into(), folder, step: 0, typed: String::new(), outcome: None, solved }
    }

    /// The step that is shown.
    #[must_use]
    pub fn current(&self) -> &LessonStep {
        // A lesson has steps, and `step` is one of them.
        &self.lesson.steps[self.step]
    }

    /// Its task, if it has one.
    #[must_use]
    pub fn task(&self) -> Option<&Task> {
        self.current().task.as_ref()
    }

    fn judged(&mut self, outcome: Outcome) {
        if matches!(outcome, Outcome::Judged(Verdict::Right(_))) {
            self.solved[self.step] = true;
        }
        self.outcome = Some(outcome);
    }

    /// Judges the number that was typed.
    pub fn answer(&mut self, pinned: Option<&Reading>) {
        let Some(task) = self.task() else { return };
        let point = pinned.map(film_point);
        let outcome = match number(&self.typed) {
            None => Outcome::NotANumber,
            Some(typed) => task.judge_number(typed, point.as_ref()).map_or(Outcome::PinFirst, Outcome::Judged),
        };
        self.judged(outcome);
    }

    /// Judges a point that was just pinned.
    pub fn pin(&mut self, pinned: &Reading) {
        let verdict = self.task().and_then(|task| task.judge_pin(&film_point(pinned)));
        verdict.into_iter().for_each(|verdict| self.judged(Outcome::Judged(verdict)));
    }
}

/// A number as people type it, with a decimal point or comma, and perhaps a unit behind it.
pub(super) fn number(typed: &str) -> Option<f64> {
    let plain = typed.trim().replace(',', ".").replace('−', "-");
    let end = plain.find(|letter: char| !(letter.is_ascii_digit() || "+-.eE".contains(letter))).unwrap_or(plain.len());
    plain[..end].parse().ok().filter(|number: &f64| number.is_finite())
}

/// The nearest wall under a pin, as tasks see it.
pub(super) fn film_point(reading: &Reading) -> FilmPoint {
    // A reading has a wall at least.
    let (wall, optics) = (&reading.walls[0], &reading.optics);
    FilmPoint {
        film: optics.film.clone(),
        illuminant: (*optics.illuminant).clone(),
        thickness_nm: wall.thickness_nm,
        cos_theta: wall.cos_theta,
    }
}
