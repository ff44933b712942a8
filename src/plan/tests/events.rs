//! Long lists of events: what they cost to load and to plan.

use cpu_time::ThreadTime;

use super::*;

/// The text of a scene with a number of events of all kinds that fit its boundary, spaced so that bubbles live between pricks.
fn text(boundary: &str, count: usize) -> String {
    let mut text = format!("version = 1\n[motion]\nevaporation_nm_s = 5\n[[bubble]]\nboundary = {boundary:?}\n");
    for index in 0..count {
        let happens = match index % 5 {
            0 => format!("kind = \"motion\"\nspin_deg_s = [0, 0, {}]", index % 7),
            1 => "kind = \"blow\"".to_owned(),
            2 => format!("kind = \"drag\"\nto_m = [{}, 0, 0]", 1e-4 * (index % 7) as f64),
            3 => "kind = \"prick\"".to_owned(),
            _ => format!("kind = \"motion\"\nevaporation_nm_s = {}", index % 11),
        };
        text += &format!("[[event]]\ntick = {}\n{happens}\n", 100 * index);
    }
    text
}

/// CPU time of loading and planning a picture after a number of events, s: the minimum of some runs, as the least disturbed.
fn seconds(boundary: &str, count: usize) -> f64 {
    let text = text(boundary, count);
    let run = || {
        let started = ThreadTime::now();
        let scene = Scene::from_toml(&text, "events").unwrap();
        for moment in [100 * count as u64, 100 * count as u64 + 50] {
            let request = frame_request(&scene, moment, Pace::Whole);
            assert!(!plan(&request, &GpuState::default()).is_empty());
        }
        started.elapsed().as_secs_f64()
    };
    (0..3).map(|_| run()).fold(f64::INFINITY, f64::min)
}

/// Four times as many events cost about four times as much; if each event looked at all others, they would cost sixteen times as much.
#[test]
fn the_cost_of_events_grows_as_their_number() {
    for boundary in ["free", "bath", "ring"] {
        let [few, many] = [2_500, 10_000].map(|count| seconds(boundary, count));
        eprintln!("measured: {boundary}: {few:.3} s for 2500 events, {many:.3} s for 10000");
        assert!(many < 9.0 * few, "{boundary}: {few} s, {many} s");
    }
}
