//! The ways back in time: a film begins anew, or goes on from a checkpoint.

use super::*;

/// Where nobody left checkpoints.
#[test]
fn going_back_in_time_seeds_again() {
    let back = ["seed_field", "step_field", "show_field", "draw", "tonemap"];
    assert_eq!(between((&stirred_scene(), 30), (&stirred_scene(), 20)), back);
}

/// Goes to a tick frame by frame, as a window does, and counts the steps and the checkpoints on the way.
fn go(scene: &Scene, tick: u64, state: &mut GpuState) -> (u64, Vec<&'static str>) {
    let (mut steps, mut passes) = (0, Vec::new());
    for _ in 0..100_000 {
        let next = plan(&frame_request(scene, tick, Pace::UNMEASURED), state);
        for (pass, _) in &next.steps {
            if let Pass::StepField { key, ticks, .. } = pass {
                steps += key.steps_from(ticks.start).count() as u64;
            }
            passes.push(pass.name());
        }
        *state = next.after;
        if next.complete {
            return (steps, passes);
        }
    }
    panic!("it never arrives at tick {tick}");
}

/// A film of few cells that takes a step a tick.
pub fn free_scene() -> Scene {
    let mut scene = preset("tent").unwrap();
    scene.bubbles[0].film.cells = 16;
    scene
}

#[test]
fn going_back_in_time_starts_from_a_checkpoint() {
    let (scene, mut state) = (free_scene(), GpuState::default());
    assert_eq!(go(&scene, 610, &mut state).0, 610);
    let (steps, passes) = go(&scene, 605, &mut state);
    assert!(steps == 5 && passes[0] == "restore_field", "{steps}: {passes:?}");
    let (steps, passes) = go(&scene, 30, &mut state);
    assert!(steps == 30 && passes[0] == "seed_field", "{steps}: {passes:?}");
    let (steps, passes) = go(&scene, 610, &mut state);
    assert!(steps == 10 && passes[0] == "restore_field", "forward again: {steps}: {passes:?}");
}

#[test]
fn going_back_costs_about_as_many_steps_as_going_as_far_forward() {
    let scene = free_scene();
    let mut worst: f64 = 0.0;
    for end in [59_u64, 600, 3599, 20_000, 100_001] {
        let mut arrived = GpuState::default();
        go(&scene, end, &mut arrived);
        for back in [1, 10, 60, 100, 300, 600, 1000, 3000, 10_000, 50_000].into_iter().filter(|back| *back <= end) {
            let (steps, _) = go(&scene, end - back, &mut arrived.clone());
            worst = worst.max(steps as f64 / (back as f64 + 60.0));
        }
    }
    eprintln!("measured: steps backward over steps forward {worst:.2}");
    assert!(worst <= 3.0, "{worst}");
}

/// A finger on the time line: the whole history backwards, in tenths of a second.
#[test]
fn scrubbing_backwards_moves_the_film_a_few_times_through_its_history() {
    let (scene, end, mut state) = (free_scene(), 6000, GpuState::default());
    go(&scene, end, &mut state);
    let steps: u64 = (0..end).rev().step_by(6).map(|tick| go(&scene, tick, &mut state).0).sum();
    eprintln!("measured: {} times the history in {} pictures", steps as f64 / end as f64, end / 6);
    assert!(steps < 16 * end, "{steps}");
}

#[test]
fn checkpoints_of_another_past_or_film_are_not_gone_back_to() {
    let mut state = GpuState::default();
    let scene = free_scene();
    go(&scene, 600, &mut state);
    let mut other = scene.clone();
    other.events.push(event(130, Flow::Sloshing));
    let (steps, passes) = go(&other, 600, &mut state.clone());
    assert_eq!((steps, passes[0]), (10 + 78, "restore_field"), "from tick 120, and in longer steps from 130 on");
    other.bubbles[0].film.seed += 1;
    let (steps, passes) = go(&other, 600, &mut state);
    assert_eq!((steps, passes[0]), (130 + 78, "seed_field"));
}

/// The device follows the passes of many journeys through time: what a pass restores is what lies in its slot then, even where the same plan
/// overwrites the slot.
#[test]
fn what_is_restored_is_what_was_saved() {
    let (scene, mut state) = (free_scene(), GpuState::default());
    let mut slots: BTreeMap<usize, Moment> = BTreeMap::new();
    let (mut film, mut overwritten) = (None, 0);
    for journey in 1..60_u64 {
        let tick = journey * journey * 7919 % 2400;
        loop {
            let next = plan(&frame_request(&scene, tick, Pace::UNMEASURED), &state);
            let mut read = BTreeSet::new();
            for (pass, _) in &next.steps {
                match pass {
                    Pass::SeedField { key, .. } => film = Some(key.moment),
                    Pass::RestoreField { slot, key, .. } => {
                        assert_eq!(slots.get(slot), Some(&key.moment), "slot {slot} on the way to {tick}");
                        read.insert(*slot);
                        film = Some(key.moment);
                    }
                    Pass::StepField { key, ticks, .. } => {
                        assert_eq!(film, Some(Moment::tick(ticks.start)));
                        film = Some(key.moment);
                    }
                    Pass::SaveField { slot, key, .. } => {
                        assert_eq!(film, Some(key.moment));
                        overwritten += u32::from(read.contains(slot));
                        slots.insert(*slot, key.moment);
                    }
                    _ => (),
                }
            }
            state = next.after;
            if next.complete {
                break;
            }
        }
    }
    assert!(overwritten > 0, "no plan overwrites what it read");
}

#[test]
fn films_have_as_many_checkpoints_as_there_is_room_for() {
    for (cells, slots) in [(16, 8), (256, 8), (300, 5), (512, 2), (1024, 2)] {
        let mut scene = free_scene();
        scene.bubbles[0].film.cells = cells;
        let mut state = GpuState::default();
        go(&scene, 600, &mut state);
        let film = state.fields[0].as_ref().unwrap();
        let at = |tick| film.checkpoints.latest(&film.key.at(Moment::tick(tick)));
        let used: BTreeSet<usize> = (0..=600).filter_map(at).map(|(slot, _)| slot).collect();
        assert_eq!(used.len(), slots, "{cells} cells");
    }
}
