//! Lessons in the panels.

use super::*;
use crate::scene::lesson::lesson;

fn at_lesson(size: egui::Vec2) -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    model.begin_lesson(lesson("newton").unwrap(), std::path::PathBuf::new());
    let mut window = harness(model, size);
    window.run();
    window
}

#[test]
fn a_number_is_typed_and_checked() {
    let mut window = at_lesson(vec2(1280.0, 1200.0));
    assert_eq!(window.state().model.tool, Tool::Orbit, "the scene is not loaded yet");
    click(&mut window, "Next");
    for (typed, told) in
        [("much", "Type a number"), ("206.1", "Off by 103.1 nm: too large."), ("103", "Right: 103 nm.")]
    {
        window.state_mut().model.course.as_mut().unwrap().typed = typed.to_owned();
        click(&mut window, "Check");
        window.get_by_label_contains(told);
    }
    window.get_by_label("1 of 4 tasks solved");
    click(&mut window, "End lesson");
    assert!(window.state().model.course.is_none() && window.query_by_label("Check").is_none());
}

#[test]
fn lessons_stand_in_the_gallery() {
    let mut window = window();
    window.state_mut().model.shows_gallery = true;
    window.run();
    click(&mut window, "Newton's colours");
    assert_eq!(window.state().model.requests, [Request::BeginLesson("newton".to_owned())]);
}

#[test]
fn a_lesson_fits_a_small_window() {
    let window = at_lesson(vec2(640.0, 480.0));
    let screen = egui::Rect::from_min_size(egui::Pos2::ZERO, vec2(640.0, 480.0)).expand(1.0);
    let rect = window.get_by_label("Two faces, two waves").rect();
    assert!(screen.contains_rect(rect), "{rect}");
}

/// Every letter of every lesson has a glyph, else the harness panics; and every step fits the panel.
#[test]
fn every_step_can_be_read() {
    for name in crate::scene::lesson::lesson_names() {
        let mut window = harness(model(), vec2(1280.0, 1600.0));
        window.state_mut().model.clock.running = false;
        window.state_mut().model.begin_lesson(lesson(name).unwrap(), std::path::PathBuf::new());
        let steps = lesson(name).unwrap().steps;
        for (index, step) in steps.iter().enumerate() {
            window.state_mut().model.go_to_step(index);
            if let Some(course) = &mut window.state_mut().model.course {
                course.outcome = Some(crate::app::course::Outcome::Judged(crate::scene::lesson::Verdict::Off(1.0)));
            }
            window.run();
            let rect = window.get_by_label(&step.title).rect();
            assert!(rect.right() < 1280.0, "{name}: {}", step.title);
        }
    }
}
