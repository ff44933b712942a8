//! Input in the order in which it came: a slow frame must not lose a press, nor take two for one.

use egui::{Event, RawInput};

/// Takes what came between two frames apart, so that each part has at most one press, or release of a button, with what came before it. Whoever samples the state
/// of a button once a part then sees every press, at its place, and every move up to a release while the button is still held.
#[must_use]
pub fn one_by_one(mut input: RawInput) -> Vec<RawInput> {
    let mut events = std::mem::take(&mut input.events);
    events.iter_mut().for_each(join_fingers);
    // A frame without input is a frame.
    if events.is_empty() {
        return vec![input];
    }
    let mut parts: Vec<RawInput> = Vec::new();
    for events in events.split_inclusive(ends_part) {
        let (before, release) = events.split_at(if is_after_moves(events) { events.len() - 1 } else { 0 });
        let some = [before, release].into_iter().filter(|events| !events.is_empty());
        parts.extend(some.map(|events| part(&mut input, events.to_vec())));
    }
    parts
}

/// Whether events end with a release that follows moves.
fn is_after_moves(events: &[Event]) -> bool {
    let is_move = |event: &Event| match event {
        Event::PointerMoved(_) => true,
        Event::Touch { phase, .. } => *phase == egui::TouchPhase::Move,
        _ => false,
    };
    let is_release = |event: &Event| match event {
        Event::PointerButton { pressed, .. } => !pressed,
        Event::Touch { phase, .. } => *phase == egui::TouchPhase::End,
        _ => false,
    };
    events.last().is_some_and(is_release) && events.iter().any(is_move)
}

/// Browsers name a device for each finger, and egui zooms by the fingers of one device.
fn join_fingers(event: &mut Event) {
    if let Event::Touch { device_id, .. } = event {
        *device_id = egui::TouchDeviceId(0);
    }
}

/// Whether an event is a press or a release that must be seen by itself.
fn ends_part(event: &Event) -> bool {
    match event {
        Event::PointerButton { .. } => true,
        Event::Key { pressed, .. } => *pressed,
        Event::Touch { phase, .. } => *phase != egui::TouchPhase::Move,
        _ => false,
    }
}

/// Some of the events.
fn part(input: &mut RawInput, events: Vec<Event>) -> RawInput {
    let part = RawInput { events, ..input.clone() };
    // A file is dropped once.
    input.dropped_files.clear();
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Context, Modifiers, PointerButton, Pos2, Sense, pos2};

    fn button(pos: Pos2, pressed: bool) -> Event {
        Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers: Modifiers::NONE }
    }

    /// Clicks at several places between two frames; each place counts how often it was clicked.
    fn clicks(places: &[Pos2]) -> Vec<usize> {
        let ctx = Context::default();
        let mut counts = vec![0; places.len()];
        let mut run = |input: RawInput| {
            let output = ctx.run_ui(input, |ui| {
                for (place, count) in places.iter().zip(&mut counts) {
                    let rect = egui::Rect::from_center_size(*place, egui::vec2(20.0, 20.0));
                    let id = egui::Id::unique(("place", place.x as u32));
                    *count += usize::from(ui.interact(rect, id, Sense::click()).clicked());
                }
            });
            output.drop_without_applying_deltas();
        };
        run(RawInput::default());
        let events =
            places.iter().flat_map(|place| [Event::PointerMoved(*place), button(*place, true), button(*place, false)]);
        one_by_one(RawInput { events: events.collect(), ..RawInput::default() }).into_iter().for_each(&mut run);
        counts
    }

    #[test]
    fn every_click_of_a_slow_frame_counts_at_its_place() {
        assert_eq!(clicks(&[pos2(30.0, 30.0), pos2(80.0, 30.0), pos2(130.0, 30.0)]), [1, 1, 1]);
    }

    #[test]
    fn nothing_is_lost_or_made_up() {
        let moved = |x: f32| Event::PointerMoved(pos2(x, 0.0));
        let events = vec![moved(1.0), moved(2.0), button(pos2(2.0, 0.0), true), moved(3.0)];
        let parts = one_by_one(RawInput { events: events.clone(), ..RawInput::default() });
        assert_eq!(parts.iter().map(|part| part.events.len()).collect::<Vec<_>>(), [3, 1]);
        assert_eq!(parts.into_iter().flat_map(|part| part.events).collect::<Vec<_>>(), events);
        assert_eq!(one_by_one(RawInput::default()).len(), 1, "a frame without input is a frame");
    }

    #[test]
    fn a_drag_goes_as_far_as_the_pointer_did() {
        let ctx = Context::default();
        let mut dragged = egui::Vec2::ZERO;
        let moved = |y: f32| Event::PointerMoved(pos2(50.0, y));
        let frames = [
            vec![moved(10.0)],
            vec![button(pos2(50.0, 10.0), true)],
            vec![moved(30.0)],
            vec![moved(60.0), moved(90.0), button(pos2(50.0, 90.0), false)],
        ];
        for events in frames {
            for part in one_by_one(RawInput { events, ..RawInput::default() }) {
                let output = ctx.run_ui(part, |ui| {
                    let rect = egui::Rect::from_min_max(pos2(0.0, 0.0), pos2(100.0, 100.0));
                    dragged += ui.interact(rect, egui::Id::unique("area"), Sense::drag()).drag_delta();
                });
                output.drop_without_applying_deltas();
            }
        }
        assert_eq!(dragged.y, 80.0);
    }

    #[test]
    fn fingers_belong_together_whatever_device_is_named_for_each() {
        let ctx = Context::default();
        let touch = |finger: u64, phase, x: f32| Event::Touch {
            device_id: egui::TouchDeviceId(finger),
            id: egui::TouchId(finger),
            phase,
            pos: pos2(x, 0.0),
            force: None,
        };
        let mut zoom = 1.0;
        for events in [
            vec![Event::PointerMoved(pos2(0.0, 0.0))],
            vec![touch(1, egui::TouchPhase::Start, 0.0), touch(2, egui::TouchPhase::Start, 40.0)],
            vec![touch(2, egui::TouchPhase::Move, 120.0)],
        ] {
            for part in one_by_one(RawInput { events, ..RawInput::default() }) {
                ctx.run_ui(part, |ui| zoom *= ui.input(egui::InputState::zoom_delta)).drop_without_applying_deltas();
            }
        }
        assert!((zoom - 3.0).abs() < 1e-4, "{zoom}");
    }
}
