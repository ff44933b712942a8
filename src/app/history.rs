//! The history of a scene, as data: what a user changes while time runs becomes an event, so that a saved scene replays it.

use crate::scene::{Change, Event, MotionChange, Scene};

/// Enters a change of motion at a tick. At tick 0 nothing has happened yet: there it changes how the scene begins.
pub fn record(scene: &mut Scene, tick: u64, change: MotionChange) {
    let after = scene.events.partition_point(|event| event.tick <= tick);
    match scene.events[..after].last_mut() {
        Some(Event { tick: known, change: Change::Motion(motion) }) if *known == tick => *motion = motion.then(&change),
        _ if tick == 0 => scene.motion = change.applied_to(scene.motion.clone()),
        _ => {
            insert(scene, Event { tick, change: Change::Motion(change) });
        }
    }
}

/// Enters what happens at a tick, after all that has happened until then; returns its index.
pub fn insert(scene: &mut Scene, event: Event) -> usize {
    let after = scene.events.partition_point(|known| known.tick <= event.tick);
    scene.events.insert(after, event);
    after
}

/// The events of a scene that loses a bubble: those of the bubble are gone, and those of later ones count one less.
#[must_use]
pub fn without_bubble(events: &[Event], lost: usize) -> Vec<Event> {
    let kept = |event: &Event| {
        let mut event = event.clone();
        if let Some(bubble) = bubble_of(&mut event.change) {
            if *bubble == lost {
                return None;
            }
            *bubble -= usize::from(*bubble > lost);
        }
        Some(event)
    };
    events.iter().filter_map(kept).collect()
}

/// The last of the events until a tick that takes a bubble elsewhere, by its index.
#[must_use]
pub fn last_drag(events: &[Event], bubble: usize, tick: u64) -> Option<usize> {
    let drags = |event: &Event| matches!(&event.change, Change::Drag(drag) if drag.bubble == bubble);
    events.iter().rposition(|event| event.tick <= tick && drags(event))
}

/// The bubble that a change happens to, if it is one.
fn bubble_of(change: &mut Change) -> Option<&mut usize> {
    match change {
        Change::Motion(_) => None,
        Change::Stir(stir) => Some(&mut stir.bubble),
        Change::Blow(blow) => Some(&mut blow.bubble),
        Change::Drag(drag) => Some(&mut drag.bubble),
        Change::Prick(prick) => Some(&mut prick.bubble),
    }
}

/// What happens at an event, in a line for people.
#[must_use]
pub fn describe(event: &Event, tick_s: f64) -> String {
    let what = match &event.change {
        Change::Motion(change) => describe_motion(change),
        Change::Stir(_) => "stirred".to_owned(),
        Change::Blow(_) => "blown at".to_owned(),
        Change::Drag(_) => "dragged".to_owned(),
        Change::Prick(_) => "pricked".to_owned(),
    };
    format!("{:.2} s: {what}", event.tick as f64 * tick_s)
}

/// The keys that change, by their names in panels, with their new values.
fn describe_motion(change: &MotionChange) -> String {
    let changes = toml::Table::try_from(change).unwrap_or_default();
    let parts = MotionChange::ALL_KEYS.iter().filter_map(|key| {
        let value = changes.get(key.name)?;
        Some(format!("{} {}{}", key.label.to_lowercase(), value_text(value), key.unit))
    });
    parts.collect::<Vec<_>>().join(", ")
}

/// A value as people write it, numbers to three decimals.
fn value_text(value: &toml::Value) -> String {
    match value {
        toml::Value::String(word) => word.clone(),
        toml::Value::Float(number) => format!("{}", (number * 1e3).round() / 1e3),
        toml::Value::Array(items) => items.iter().map(value_text).collect::<Vec<_>>().join(", "),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Flow, Motion, Prick};

    fn strength(strength: f64) -> MotionChange {
        MotionChange { strength: Some(strength), ..MotionChange::default() }
    }

    fn stir() -> MotionChange {
        MotionChange { flow: Some(Flow::Stirred), ..MotionChange::default() }
    }

    #[test]
    fn a_change_while_time_runs_is_an_event_and_the_past_stays() {
        let mut scene = Scene::default();
        record(&mut scene, 90, stir());
        record(&mut scene, 30, strength(2.0));
        assert_eq!(scene.events.iter().map(|event| event.tick).collect::<Vec<_>>(), [30, 90]);
        assert_eq!(scene.motion_at(29), Motion::default());
        assert_eq!(scene.motion_at(90), Motion { flow: Flow::Stirred, strength: 2.0, ..Motion::default() });
        assert_eq!(Scene::from_toml(&scene.to_toml(), "saved"), Ok(scene));
    }

    #[test]
    fn changes_at_one_tick_are_one_event() {
        let mut scene = Scene::default();
        record(&mut scene, 30, strength(2.0));
        record(&mut scene, 30, strength(3.0));
        record(&mut scene, 30, stir());
        let both = MotionChange { strength: Some(3.0), ..stir() };
        assert_eq!(scene.events, [Event { tick: 30, change: Change::Motion(both) }]);
    }

    #[test]
    fn at_the_beginning_the_beginning_changes() {
        let mut scene = Scene::default();
        record(&mut scene, 0, strength(2.0));
        assert_eq!((scene.motion.strength, scene.events.len()), (2.0, 0));
        // Unless an event stands there, which would undo it.
        scene.events = vec![Event { tick: 0, change: Change::Motion(strength(5.0)) }];
        record(&mut scene, 0, strength(4.0));
        assert_eq!(scene.motion_at(0).strength, 4.0);
    }

    #[test]
    fn a_lost_bubble_takes_its_events_along() {
        let prick = |bubble| Event { tick: 9, change: Change::Prick(Prick { bubble, ..Prick::default() }) };
        let wind = Event { tick: 9, change: Change::Motion(stir()) };
        let events = [prick(0), prick(1), wind.clone(), prick(2)];
        assert_eq!(without_bubble(&events, 1), [prick(0), wind, prick(1)]);
    }

    #[test]
    fn events_read_like_sentences() {
        let event = Event { tick: 90, change: Change::Motion(MotionChange { seed: Some(7), ..stir() }) };
        assert_eq!(describe(&event, 1.0 / 60.0), "1.50 s: flow stirred, flow seed 7");
        let gravity_m_s2 = Some([0.0, 1.23456, -9.81]);
        let tilted =
            Event { tick: 60, change: Change::Motion(MotionChange { gravity_m_s2, ..MotionChange::default() }) };
        assert_eq!(describe(&tilted, 1.0 / 60.0), "1.00 s: gravity 0, 1.235, -9.81 m/s²");
    }
}
