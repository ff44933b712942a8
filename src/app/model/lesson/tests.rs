//! Lessons played through as a student would, with the right answers and with wrong ones.

use glam::DVec2;

use super::*;
use crate::{
    app::{
        course::{Outcome, film_point, number},
        model::tests::model,
    },
    input::load_step,
    physics::{
        colour::Gamut,
        sphere::{CubedSphere, HaloTable, PaddedField},
    },
    plan::{DrawKey, FilmKey, Moment, Pace, Shot, request},
    scene::lesson::{Verdict, lesson, lesson_names},
    studio::{FilmsRead, walls_in_sight},
    verify::reference,
};

const SIZE: [u32; 2] = [320, 200];

/// A model on a step, whose scene has been loaded as a worker would.
fn at_step(model: &mut Model, step: usize) {
    model.go_to_step(step);
    if model.requests.contains(&Request::LoadStep) {
        let course = model.course.clone().unwrap();
        model.stage_step(load_step(&course.lesson, &course.folder, step).unwrap().unwrap());
    }
    model.requests.clear();
}

/// What the window draws of a model, and its films in f64: none is moved by the device.
fn drawn(model: &Model) -> (DrawKey, FilmsRead) {
    let moment = model.clock.moment(&model.scene.motion);
    let shot = Shot { size: SIZE, moment, full_precision: false, gamut: Gamut::Srgb, pace: Pace::UNMEASURED };
    let draw = request(&model.scene, &model.resources, &shot).unwrap().picture.draw;
    let mut films = FilmsRead::default();
    for (index, film) in draw.films() {
        let FilmKey::Field(field) = film else { continue };
        assert!(
            field.moment == Moment::default() || !reference_needs_device(&draw, index),
            "{}: no f64 film",
            model.name
        );
        let (map, grid) = (reference::film(field).unwrap(), CubedSphere::new(64).unwrap());
        let value = |cell: usize| map.value(grid.cell_direction(cell));
        films.thickness_nm.insert(index, PaddedField::from_cells(grid, &HaloTable::new(grid), value));
    }
    (draw, films)
}

fn reference_needs_device(draw: &DrawKey, film: usize) -> bool {
    draw.all_bubbles().iter().any(|bubble| bubble.index == film && reference::needs_device(bubble))
}

/// The readings of a grid of points over the picture.
fn readings(model: &Model) -> Vec<Reading> {
    let (draw, films) = drawn(model);
    let places = (0..40 * 64).map(|k| DVec2::new(f64::from(k % 64) + 0.5, f64::from(k / 64) + 0.5) * 5.0);
    places.filter_map(|place| Reading::new(&walls_in_sight(&draw, &films, place), 0.0, 1)).collect()
}

/// A click on a film with this reading.
fn pin(model: &mut Model, reading: &Reading) {
    model.probe.point(Some(DVec2::ZERO), true);
    model.answer_probe(Some(reading.clone()), &[], true);
}

fn verdict(model: &Model) -> Verdict {
    match model.course.as_ref().unwrap().outcome.clone() {
        Some(Outcome::Judged(verdict)) => verdict,
        other => panic!("not judged: {other:?}"),
    }
}

fn answer(model: &mut Model, typed: &str) -> Verdict {
    let pinned = model.probe.pinned.clone().map(|pin| pin.reading);
    let course = model.course.as_mut().unwrap();
    course.typed = typed.to_owned();
    course.answer(pinned.as_ref());
    verdict(model)
}

/// A student who knows all answers: numbers by the optics in f64, and points of the film as it is computed in f64.
#[test]
fn every_lesson_can_be_solved_and_knows_wrong_answers() {
    for name in lesson_names() {
        let mut model = model();
        model.begin_lesson(lesson(name).unwrap(), PathBuf::new());
        let steps = model.course.as_ref().unwrap().lesson.steps.len();
        for step in 0..steps {
            at_step(&mut model, step);
            let Some(task) = model.course.as_ref().unwrap().task().cloned() else { continue };
            let what = format!("{name}, step {}: {}", step + 1, task.ask);
            match task.kind {
                Kind::Number => type_numbers(&mut model, &task, &what),
                Kind::Pin => pin_points(&mut model, &task, &what),
            }
        }
        let course = model.course.unwrap();
        let solved =
            course.lesson.steps.iter().zip(&course.solved).all(|(step, solved)| *solved == step.task.is_some());
        assert!(solved, "{name}: {:?}", course.solved);
    }
}

fn type_numbers(model: &mut Model, task: &Task, what: &str) {
    if task.right_answer(None).is_none() {
        model.course.as_mut().unwrap().typed = "1".to_owned();
        model.course.as_mut().unwrap().answer(None);
        assert_eq!(model.course.as_ref().unwrap().outcome, Some(Outcome::PinFirst), "{what}");
        let reading = readings(model).swap_remove(700);
        pin(model, &reading);
    }
    let point = model.probe.pinned.as_ref().map(|pin| film_point(&pin.reading));
    // Of the physics alone: what the file says as the answer is left out.
    let truth = Task { answer: None, ..task.clone() }.right_answer(point.as_ref()).expect(what);
    let off = 3.0 * task.tolerance;
    assert!(matches!(answer(model, &format!("{}", truth + off)), Verdict::Off(by) if by > 0.0), "{what}");
    assert!(matches!(answer(model, &format!("{}", truth - off)), Verdict::Off(by) if by < 0.0), "{what}");
    let typed = format!("{truth:.6}").replace('.', ",");
    assert!(matches!(answer(model, &format!("{typed} nm")), Verdict::Right(_)), "{what}: {truth}");
}

fn pin_points(model: &mut Model, task: &Task, what: &str) {
    let readings = readings(model);
    let target = task.answer.expect(what);
    let off = |reading: &Reading| film_point(reading).measure(task.quantity, task.wavelength_nm).unwrap() - target;
    let far = readings.iter().max_by(|a, b| off(a).abs().total_cmp(&off(b).abs())).expect(what);
    pin(model, far);
    assert_eq!(verdict(model), Verdict::Off(off(far)), "{what}");
    let right = readings.iter().filter(|reading| off(reading).abs() <= task.tolerance).count();
    assert!(right >= 10, "{what}: only {right} of {} places are right", readings.len());
    let near = readings.iter().min_by(|a, b| off(a).abs().total_cmp(&off(b).abs())).expect(what);
    pin(model, near);
    assert_eq!(verdict(model), Verdict::Right(target + off(near)), "{what}");
}

/// The answers that lessons state, worked out by hand from the formulas that their texts give.
#[test]
fn stated_answers_follow_from_the_formulas_of_the_texts() {
    let stated = |name: &str, step: usize| {
        let task = lesson(name).unwrap().steps[step].task.clone().unwrap();
        (task.answer.unwrap(), task.tolerance)
    };
    let n: f64 = 1.333;
    let beta = (60f64.to_radians().sin() / n).asin();
    let alpha = 80f64.to_radians();
    let inside = (alpha.sin() / n).asin();
    let r2 = ((alpha.cos() - n * inside.cos()) / (alpha.cos() + n * inside.cos())).powi(2);
    let delta = std::f64::consts::TAU * 2.0 * n * 103.0 * inside.cos() / 550.0;
    let fringes = 4.0 * r2 * (0.5 * delta).sin().powi(2);
    for ((name, step), by_hand) in [
        (("newton", 1), 0.5 * 550.0 / (2.0 * n)),
        (("newton", 3), 589.0 / (2.0 * n)),
        (("angle", 1), 2.0 * n * 400.0 * beta.cos()),
        (("angle", 2), n.atan().to_degrees()),
        (("angle", 4), 100.0 * fringes / ((1.0 - r2).powi(2) + fringes)),
        (("drainage", 1), (4e12 - 1e12) * 3.0 * 0.0011 * 0.05 / (1000.0 * 9.81)),
        (("drainage", 2), (321.0 - 121.0) / 40.0),
    ] {
        let (answer, tolerance) = stated(name, step);
        assert!((answer - by_hand).abs() <= tolerance, "{name} {step}: {answer} is not {by_hand}");
    }
}

#[test]
fn numbers_are_read_as_people_type_them() {
    assert_eq!(["103", " 103,5 nm", "1.2e3", "-4 %"].map(number), [Some(103.0), Some(103.5), Some(1200.0), Some(-4.0)]);
    assert_eq!(["", "about 5", "1..2", "nan"].map(number), [None; 4]);
}

#[test]
fn a_step_without_a_scene_goes_on_with_the_one_before() {
    let mut model = model();
    model.begin_lesson(lesson("newton").unwrap(), PathBuf::new());
    assert_eq!(std::mem::take(&mut model.requests), [Request::LoadStep]);
    model.go_to_step(1);
    assert_eq!(model.requests, []);
    model.go_to_step(3);
    assert_eq!(std::mem::take(&mut model.requests), [Request::LoadStep], "the sodium lamp");
    model.go_to_step(2);
    assert_eq!(model.requests, [Request::LoadStep], "back in daylight");
}
