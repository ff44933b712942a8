//! The built-in lessons of `assets/lessons/`, in the order in which they build on one another.

use super::Lesson;

macro_rules! lessons {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../../../assets/lessons/", $name, ".toml")))),*]
    };
}

pub(super) const LESSONS: [(&str, &str); 5] = lessons!["newton", "black", "angle", "drainage", "light"];

/// The names of the built-in lessons.
pub fn lesson_names() -> impl ExactSizeIterator<Item = &'static str> {
    LESSONS.iter().map(|(name, _)| *name)
}

/// A built-in lesson, or `None` if none has this name.
pub fn lesson(name: &str) -> Option<Lesson> {
    let (_, text) = LESSONS.iter().find(|(known, _)| *known == name)?;
    // A test reads every lesson, so an error cannot hide here.
    Lesson::from_toml(text, name).ok()
}
