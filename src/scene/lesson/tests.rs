//! The built-in lessons, the format's page, and what is refused.

use super::*;

impl LessonStep {
    /// A step with a task, each key at its default.
    pub fn with_task() -> Self {
        Self { task: Some(Task::default()), ..Self::default() }
    }
}

impl Lesson {
    /// The tables of the format's page.
    pub fn tables() -> [(&'static str, Vec<Key>); 3] {
        let keys = |keys: &[Key]| keys.to_vec();
        [("", keys(Self::ALL_KEYS)), ("step", keys(LessonStep::ALL_KEYS)), ("step.task", keys(Task::ALL_KEYS))]
    }
}

#[test]
fn built_in_lessons_are_read() {
    for (name, text) in super::built_in::LESSONS {
        let lesson = Lesson::from_toml(text, name).unwrap_or_else(|error| panic!("{error}"));
        assert!(
            Lesson::is_lesson(text) && lesson.steps.len() >= 4 && lesson.steps[0].task.is_some() || name == "drainage"
        );
        assert!(lesson.steps.iter().filter(|step| step.task.is_some()).count() >= 3, "{name}");
        assert_eq!(lesson.staged_by(0), Some(0), "{name}: the first step has a scene");
        for step in lesson.steps.iter().filter(|step| !step.scene.is_empty()) {
            let scene = SceneSource::new(
                &step.scene,
                crate::scene::preset_toml(&step.scene).expect("a preset"),
                &step.settings().unwrap(),
            );
            scene.read().unwrap_or_else(|error| panic!("{name}, {}: {error}", step.title));
        }
    }
}

/// Each mistake of a teacher is answered with file, line and key.
#[test]
fn mistakes_are_located() {
    let lesson = |step: &str| format!("version = 1\ntitle = 'T'\n[[step]]\n{step}");
    let task = |keys: &str| lesson(&format!("[step.task]\n{keys}\n"));
    for (text, told) in [
        ("title = 'T'\n[[step]]".to_owned(), "my.toml:1: no version; add `version = 1` at the top"),
        ("version = 1\n[[step]]".to_owned(), "my.toml:1: `title` is empty; give the lesson a name"),
        (lesson("scen = 'bands'"), "my.toml:4: unknown key `scen` in [[step]]; did you mean `scene`?"),
        (
            lesson("time_s = 'late'"),
            "my.toml:4: `time_s` in [[step]] is wrong: invalid type: string \"late\", expected a number",
        ),
        (
            lesson("time_s = 3"),
            "my.toml:3: `scene` in [[step]] is empty, but the step sets keys or the time of a scene; name one",
        ),
        (
            lesson("scene = 'bands'\nset = ['view.exposure_ev']"),
            "my.toml:5: `set` in [[step]] cannot be used: write it as KEY=VALUE, as in view.exposure_ev=2 or bubble.0.radius_mm=30",
        ),
        (task("tolerance = -1"), "my.toml:5: `tolerance` in [step.task] is -1; it must be within 0 ..= 1000000"),
        (task("kind = 'pin'"), "my.toml:4: `answer` in [step.task] is missing; say what the pinned point must have"),
        (
            task("kind = 'pin'\nquantity = 'drainage-time'"),
            "my.toml:6: `quantity` in [step.task] is \"drainage-time\", which no point of a film has; ask for a number",
        ),
        (
            task("quantity = 'drainage-time'"),
            "my.toml:5: `quantity` in [step.task] is \"drainage-time\"; give `thickness_nm` and, for a time, `to_nm`",
        ),
        (
            task("quantity = 'brewster-angle'\nanswer = 56.3\ntolerance = 1"),
            "my.toml:6: `answer` in [step.task] is 56.3, but the physics of films says 53.15793",
        ),
        (task("illuminant = 'moon'"), "my.toml:5: `illuminant` in [step.task] cannot be used: "),
    ] {
        let error = Lesson::from_toml(&text, "my.toml").unwrap_err().to_string();
        assert!(error.starts_with(told), "{error}\ninstead of\n{told}");
    }
}
