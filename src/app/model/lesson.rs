//! The lesson that is taken, with the scenes of its steps.

use std::path::PathBuf;

use super::Model;
use crate::{
    app::{course::Course, probe::Reading, request::Request, tools::Tool},
    input::LoadedScene,
    scene::lesson::{Kind, Lesson, LessonStep, Task},
    studio::WallInSight,
};

impl Model {
    /// Begins a lesson.
    pub fn begin_lesson(&mut self, lesson: Lesson, folder: PathBuf) {
        self.course = Some(Course::new(lesson, folder));
        self.shows_panels = true;
        self.presents = false;
        self.go_to_step(0);
    }

    /// Shows a step of the lesson, with its scene.
    pub fn go_to_step(&mut self, step: usize) {
        let Some(course) = &mut self.course else { return };
        let (before, steps) = (course.step, course.lesson.steps.len());
        course.step = step.min(steps - 1);
        (course.typed, course.outcome) = (String::new(), None);
        let stage = |step| course.lesson.staged_by(step);
        // A step without a scene of its own goes on with what the student has made of the one before.
        let staged = stage(course.step);
        if staged.is_some() && (step == 0 || stage(before) != staged) {
            self.requests.push(Request::LoadStep);
        } else {
            self.take_probe();
        }
    }

    /// Shows the scene of a step of the lesson, which has been loaded.
    pub fn stage_step(&mut self, loaded: LoadedScene) {
        self.adopt(loaded);
        let Some(course) = &self.course else { return };
        let Some(staged_by) = course.lesson.staged_by(course.step) else { return };
        let LessonStep { time_s, runs, .. } = course.lesson.steps[staged_by];
        self.clock.seek((time_s / self.scene.motion.tick_s).round() as u64);
        self.clock.running = runs;
        self.take_probe();
    }

    /// Puts the probe in the pointer's hand if the step needs it.
    fn take_probe(&mut self) {
        let pins = |task: &Task| task.kind == Kind::Pin || task.right_answer(None).is_none();
        if self.course.as_ref().and_then(Course::task).is_some_and(pins) {
            self.tool = Tool::Probe;
        }
    }

    /// Takes what the probe has read, as [`Probe::answer`](crate::app::probe::Probe::answer); the lesson judges a new pin.
    pub fn answer_probe(&mut self, reading: Option<Reading>, walls: &[WallInSight], is_read: bool) -> bool {
        let is_pinned = is_read && self.probe.is_clicked();
        let is_new = self.probe.answer(reading, walls, is_read);
        if let (true, Some(course), Some(pin)) = (is_pinned, &mut self.course, &self.probe.pinned) {
            course.pin(&pin.reading);
        }
        is_new
    }
}

#[cfg(test)]
mod tests;
