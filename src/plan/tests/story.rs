//! What frames of one story share, so that none pays for the history before it.

use super::*;

/// The preset `tent`, stirred, dragged and blown at once a second.
fn eventful(seconds: u64) -> Scene {
    let happens = |second: u64| match second % 3 {
        0 => Change::Stir(Stir { ticks: 90, ..Stir::default() }),
        1 => Change::Drag(Drag { to_m: [1e-3 * (second % 2) as f64, 0.0, 0.0], ..Drag::default() }),
        _ => Change::Blow(Blow::default()),
    };
    let event = |second| Event { tick: 60 * second, change: happens(second) };
    Scene { events: (0..seconds).map(event).collect(), ..preset("tent").unwrap() }
}

fn field(story: &Story, tick: u64) -> FieldKey {
    match story.film_key(0, Moment::tick(tick)) {
        Some(FilmKey::Field(field)) => field,
        _ => panic!("a film that flows"),
    }
}

fn shares(a: &FieldKey, b: &FieldKey) -> bool {
    a.flows.shares(&b.flows) && a.pushes.shares(&b.pushes) && a.path.shares(&b.path)
}

#[test]
fn frames_share_their_histories() {
    let story = Story::new(eventful(600));
    let (before, now) = (field(&story, 30_000), field(&story, 30_007));
    assert!(shares(&before, &now) && now.continues(&before));
    // Another story of the same scene has histories of its own, which are equal.
    let other = field(&Story::new(eventful(600)), 30_000);
    assert!(!shares(&before, &other) && before == other);
}

#[test]
fn a_story_changes_with_an_event_and_not_with_the_camera() {
    let mut story = Story::new(eventful(60));
    let before = field(&story, 3000);
    story.change(|scene| scene.camera.azimuth_deg += 10.0);
    assert!(shares(&before, &field(&story, 3000)));
    story.change(|scene| scene.events.truncate(10));
    let after = field(&story, 3000);
    assert!(!shares(&before, &after) && before != after);
    assert_eq!(after, field(&Story::new(eventful(10)), 3000));
}

/// After an edit of the future, what is there is compared once with the new history, and shared from then on.
#[test]
fn the_gpu_state_shares_the_history_that_it_was_planned_by() {
    let mut story = Story::new(eventful(20));
    story.change(|scene| scene.bubbles[0].film.cells = 16);
    let mut state = GpuState::default();
    let mut go = |story: &Story, tick| loop {
        let next = plan(&story.request(&resources(), &shot(tick, Pace::UNMEASURED)).unwrap(), &state);
        state = next.after;
        if next.complete {
            return state.fields[0].clone().unwrap();
        }
    };
    go(&story, 600);
    story.change(|scene| scene.events.truncate(12));
    let (there, now) = (go(&story, 607), field(&story, 607));
    assert!(shares(&there.key, &now));
    let (_, kept) = there.checkpoints.latest(&now).unwrap();
    assert!(kept.moment.tick == 600 && shares(kept, &now));
}
