//! The history of a scene, as data: what a user changes while time runs becomes an event, so that a saved scene replays it.

use crate::scene::{Change, Event, Flow, MotionChange, Scene};

/// Enters a change of motion at a tick. At tick 0 nothing has happened yet: there it changes how the scene begins.
pub fn record(scene: &mut Scene, tick: u64, change: MotionChange) {
    let after = scene.events.partition_point(|event| event.tick <= tick);
    match scene.events[..after].last_mut() {
        Some(Event { tick: known, change: Change::Motion(motion) }) if *known == tick => merge(motion, &change),
        _ if tick == 0 => begin(scene, &change),
        _ => insert(scene, Event { tick, change: Change::Motion(change) }),
    }
}

/// Enters what happens at a tick, after all that has happened until then.
pub fn insert(scene: &mut Scene, event: Event) {
    let after = scene.events.partition_point(|known| known.tick <= event.tick);
    scene.events.insert(after, event);
}

fn merge(known: &mut MotionChange, newer: &MotionChange) {
    known.flow = newer.flow.or(known.flow);
    known.strength = newer.strength.or(known.strength);
    known.seed = newer.seed.or(known.seed);
    known.spin_deg_s = newer.spin_deg_s.or(known.spin_deg_s);
    known.evaporation_nm_s = newer.evaporation_nm_s.or(known.evaporation_nm_s);
    known.gravity_m_s2 = newer.gravity_m_s2.or(known.gravity_m_s2);
    known.drag_1_s = newer.drag_1_s.or(known.drag_1_s);
    known.air_drag = newer.air_drag.or(known.air_drag);
}

fn begin(scene: &mut Scene, change: &MotionChange) {
    scene.motion = change.applied_to(scene.motion.clone());
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

fn describe_motion(change: &MotionChange) -> String {
    let parts = [
        change.flow.map(|flow| flow_name(flow).to_owned()),
        change.strength.map(|strength| format!("strength {strength}")),
        change.seed.map(|seed| format!("seed {seed}")),
        change.spin_deg_s.map(|[x, y, z]| format!("spin {x}, {y}, {z} °/s")),
        change.evaporation_nm_s.map(|rate| format!("evaporation {rate} nm/s")),
        change.gravity_m_s2.map(|[x, y, z]| format!("gravity {x:.1}, {y:.1}, {z:.1} m/s²")),
        change.drag_1_s.map(|rate| format!("drag {rate} 1/s")),
        change.air_drag.map(|factor| format!("air drag {factor}")),
    ];
    parts.into_iter().flatten().collect::<Vec<_>>().join(", ")
}

/// A flow's name, as scene files have it.
#[must_use]
pub fn flow_name(flow: Flow) -> &'static str {
    match flow {
        Flow::Free => "free",
        Flow::Rest => "rest",
        Flow::Sloshing => "sloshing",
        Flow::Draught => "draught",
        Flow::Stirred => "stirred",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Motion;

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
    fn events_read_like_sentences() {
        let event = Event { tick: 90, change: Change::Motion(MotionChange { seed: Some(7), ..stir() }) };
        assert_eq!(describe(&event, 1.0 / 60.0), "1.50 s: stirred, seed 7");
    }
}
