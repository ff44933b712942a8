//! Lessons: text in steps, each with a scene and a task whose answer the program checks.
//!
//! The file format, which a test holds to the code:
#![doc = include_str!("../../../assets/lessons/README.md")]

mod built_in;
mod quantity;
mod task;
#[cfg(test)]
mod tests;

pub use built_in::{lesson, lesson_names};
pub use quantity::{FilmPoint, Quantity};
pub use task::{Kind, Task, TaskKeys, Verdict};

use serde::{Deserialize, Serialize};

use super::{
    Key, SceneError, SceneSource, Setting,
    check::{self, Checked, Fault},
    document::read_as,
    section::{Value, section},
};

/// Text of several lines.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Text(pub String);

impl Value for Text {
    fn check(&self, _: &Key) -> Checked {
        Ok(())
    }
}

section! {
    /// A lesson.
    pub struct Lesson, LessonKeys: [
        #[serde(rename = "step")]
        steps: Vec<LessonStep> = Vec::new(), "Its steps, in their order";
    ]
    version: u32 = 1, [1 ..= 1], "Version", "", "version of this format; required";
    title: String = String::new(), ["text"], "Title", "", "name of the lesson";
    about: String = String::new(), ["text"], "About", "", "what it teaches, in a sentence";
}

section! {
    /// A step of a lesson: one `[[step]]`.
    pub struct LessonStep, LessonStepKeys: [
        #[serde(skip_serializing_if = "Option::is_none")]
        task: Option<Task> = None, "What is to be found out";
    ]
    title: String = String::new(), ["text"], "Title", "", "heading of the step";
    text: Text = Text::default(), ["text"], "Text", "", "what is read: paragraphs with an empty line between them, items that begin with `- `, and `**words**` that stand out";
    scene: String = String::new(), ["a preset, or the path of a scene file"], "Scene", "", "the scene that is shown; without it, that of the step before";
    set: Vec<String> = Vec::new(), ["a list of `\"KEY=VALUE\"`"], "Set", "", "keys of the scene with other values than in its file, as `--set` has them";
    time_s: f64 = 0.0, [0.0 ..= 3600.0], "Time", " s", "film time at which the scene begins, s";
    runs: bool = false, [flag], "Runs", "", "whether time passes; otherwise it stands";
}

impl Lesson {
    /// Whether a text is meant as a lesson: scenes have no steps.
    #[must_use]
    pub fn is_lesson(text: &str) -> bool {
        text.lines().any(|line| line.trim_start().starts_with("[[step]]"))
    }

    /// Reads a lesson from TOML. `name` stands for the text in messages.
    ///
    /// # Errors
    ///
    /// As [`super::Scene::from_toml`], and for an answer that is not what the optics say.
    pub fn from_toml(text: &str, name: &str) -> Result<Self, SceneError> {
        let source = SceneSource::new(name, text, &[]);
        read_as(&source, &every_key(), Self::check).map_err(|located| source.place(located))
    }

    fn check(&self) -> Checked {
        self.check_ranges()?;
        if self.title.trim().is_empty() {
            return Err(Fault::new("title", "is empty; give the lesson a name"));
        }
        if self.steps.is_empty() {
            return Err(Fault::new("step", "is an empty list; a lesson has at least one [[step]]"));
        }
        check::each("step", &self.steps, LessonStep::check)
    }

    /// The number of the step whose scene a step shows, if any before it has one.
    #[must_use]
    pub fn staged_by(&self, step: usize) -> Option<usize> {
        (0..=step).rev().find(|index| self.steps.get(*index).is_some_and(|step| !step.scene.is_empty()))
    }
}

impl LessonStep {
    fn check(&self) -> Checked {
        self.check_ranges()?;
        self.settings().map(drop)?;
        if self.scene.is_empty() && (!self.set.is_empty() || self.time_s != 0.0 || self.runs) {
            return Err(Fault::new("scene", "is empty, but the step sets keys or the time of a scene; name one"));
        }
        self.task.as_ref().map_or(Ok(()), |task| task.check().map_err(|fault| fault.inside("task")))
    }

    /// What it sets of its scene.
    ///
    /// # Errors
    ///
    /// One is not `KEY=VALUE`.
    pub fn settings(&self) -> Result<Vec<Setting>, Fault> {
        self.set.iter().map(|text| text.parse().map_err(|error| Fault::unusable("set", error))).collect()
    }
}

/// Every key that a lesson can have, as the TOML of one where nothing is absent.
fn every_key() -> toml::Table {
    let step = LessonStep { task: Some(Task::with_every_key()), ..LessonStep::default() };
    let lesson = Lesson { steps: vec![step], ..Lesson::default() };
    // Structs with named fields always make a table.
    toml::Table::try_from(lesson).expect("plain data is always TOML")
}
