//! The motion panel: what moves the films, and the clock.

use egui::{Response, Ui};

use super::widgets::{choice, group, seed, slider};
use crate::{
    app::{history, model::Model},
    scene::{Flow, MotionChange, TransportScheme},
};

const FLOWS: [(Flow, &str, &str); 5] = [
    (Flow::Free, "free", "Gravity and the air, as in a real film"),
    (Flow::Rest, "rest", "Nothing moves the film"),
    (Flow::Sloshing, "slosh", "The film swings as a whole about its rest state"),
    (Flow::Draught, "draught", "Slow, large gusts of the air around the bubble"),
    (Flow::Stirred, "stirred", "Many turning vortices, as after a stir"),
];

const SCHEMES: [(TransportScheme, &str, &str); 3] = [
    (TransportScheme::Map, "map", "A flow map, remapped rarely: filaments stay sharp"),
    (TransportScheme::MapAccurate, "accurate", "The same with the thickness on a grid twice as fine"),
    (TransportScheme::Bicubic, "bicubic", "The usual scheme, for comparison: filaments blur"),
];

/// Shows and edits the motion that is in force now.
pub fn show(ui: &mut Ui, model: &mut Model) {
    clock(ui, model);
    time_line(ui, model);
    let motion = model.motion();
    let mut flow = motion.flow;
    if choice(ui, "Flow", &mut flow, &FLOWS) {
        model.change_motion(MotionChange { flow: Some(flow), ..MotionChange::default() });
    }
    dials(ui, model);
    let mut number = motion.seed;
    if seed(ui, "Flow seed", &mut number, "The seed of the random flow: each seed gives another flow") {
        model.change_motion(MotionChange { seed: Some(number), ..MotionChange::default() });
    }
    let speed = &mut model.scene.motion.speed;
    slider(ui, "Speed", speed, 0.01..=100.0, "Film time that passes in a second", |slider| {
        slider.logarithmic(true).suffix("x").max_decimals(2)
    });
    let help = "Factor on drainage between surfaces that do not move, which takes hours at 1";
    slider(ui, "Drainage", &mut model.scene.motion.drainage, 0.0..=1e4, help, |slider| {
        slider.logarithmic(true).smallest_positive(1.0).max_decimals(0)
    });
    choice(ui, "Scheme", &mut model.scene.motion.scheme, &SCHEMES);
    events(ui, model);
}

fn clock(ui: &mut Ui, model: &mut Model) {
    let time_s = model.clock.time_s(&model.scene.motion);
    group(ui, &format!("{time_s:.1} s"), |ui| {
        let pause = if model.clock.running { "Pause" } else { "Run" };
        if ui.button(pause).on_hover_text("Play or pause the film (Space)").clicked() {
            model.clock.running = !model.clock.running;
        }
        if ui.button("Step").on_hover_text("One tick further (.)").clicked() {
            model.clock.step();
        }
        if ui.button("Reset").on_hover_text("Back to the beginning (R)").clicked() {
            model.clock.reset();
        }
    });
    if model.behind_ticks > 0 {
        ui.weak(format!("The film catches up: {} ticks", model.behind_ticks));
    }
}

/// The film's whole history on a line. Going back moves the film anew from a checkpoint: the same history gives the same film.
fn time_line(ui: &mut Ui, model: &mut Model) {
    model.furthest_tick = model.furthest_tick.max(model.clock.tick);
    let tick_s = model.scene.motion.tick_s;
    let mut time_s = model.clock.time_s(&model.scene.motion);
    let end_s = model.last_tick() as f64 * tick_s;
    let response =
        slider(ui, "Time", &mut time_s, 0.0..=end_s, "Goes back and forth in the film's history", |slider| {
            slider.suffix(" s").max_decimals(2)
        });
    if response.changed() {
        model.clock.seek((time_s / tick_s).round() as u64);
    }
}

/// Sliders of what is an event in the history. They count once they are let go: each value on the way would be an event of its own.
fn dials(ui: &mut Ui, model: &mut Model) {
    let motion = model.motion();
    let shown = model.motion_draft.clone().unwrap_or_default().applied_to(motion.clone());
    let MotionChange { mut strength, mut spin_deg_s, mut evaporation_nm_s, .. } = MotionChange::default();
    let mut is_dragged = false;
    let mut dial = |response: Response| {
        is_dragged |= response.dragged();
        response.changed()
    };
    let mut value = shown.strength;
    if dial(slider(ui, "Strength", &mut value, 0.0..=10.0, "Factor on the speed of the flow", |s| s.max_decimals(2))) {
        strength = Some(value);
    }
    let [x, y, mut z] = shown.spin_deg_s;
    let help = "Turn of the whole film about the vertical";
    if dial(slider(ui, "Spin", &mut z, -360.0..=360.0, help, |s| s.suffix(" °/s").max_decimals(1))) {
        spin_deg_s = Some([x, y, z]);
    }
    let mut rate = shown.evaporation_nm_s;
    let help = "Thickness that evaporates from the whole film";
    if dial(slider(ui, "Evaporation", &mut rate, 0.0..=100.0, help, |s| s.suffix(" nm/s").max_decimals(1))) {
        evaporation_nm_s = Some(rate);
    }
    let gravity_m_s2 = gravity(ui, shown.gravity_m_s2, dial);
    let edit = MotionChange { strength, spin_deg_s, evaporation_nm_s, gravity_m_s2, ..MotionChange::default() };
    if edit != MotionChange::default() {
        model.motion_draft = Some(edit);
    }
    if is_dragged {
        return;
    }
    if let Some(change) = model.motion_draft.take().filter(|change| change.applied_to(motion.clone()) != motion) {
        model.change_motion(change);
    }
}

/// Sliders for the strength of gravity and its tilt about the world's x axis; returns gravity if one was moved.
fn gravity(ui: &mut Ui, [x, y, z]: [f64; 3], mut dial: impl FnMut(Response) -> bool) -> Option<[f64; 3]> {
    let mut strength = y.hypot(z);
    let mut tilt_deg = if strength > 0.0 { y.atan2(-z).to_degrees() } else { 0.0 };
    let help = "What pulls a free film down";
    let stronger = dial(slider(ui, "Gravity", &mut strength, 0.0..=100.0, help, |s| s.suffix(" m/s²").max_decimals(1)));
    let help = "From straight down towards +y. The arrow keys tilt it as the picture shows it.";
    let tilted = dial(slider(ui, "Tilt", &mut tilt_deg, -180.0..=180.0, help, |s| s.suffix("°").max_decimals(1)));
    let (sin, cos) = tilt_deg.to_radians().sin_cos();
    let rounded = |part: f64| (part * 1e3).round() / 1e3;
    (stronger || tilted).then(|| [x, rounded(strength * sin), rounded(-strength * cos)])
}

/// The history: what happens at which time, each entry removable.
fn events(ui: &mut Ui, model: &mut Model) {
    if model.scene.events.is_empty() {
        return;
    }
    let mut removed = None;
    egui::CollapsingHeader::new(format!("History ({})", model.scene.events.len())).id_salt("history").show(ui, |ui| {
        for (index, event) in model.scene.events.iter().enumerate() {
            ui.horizontal(|ui| {
                if ui.small_button("×").on_hover_text(format!("Remove event {}", index + 1)).clicked() {
                    removed = Some(index);
                }
                let text = history::describe(event, model.scene.motion.tick_s);
                // What lies ahead is paler than what has happened.
                if event.tick <= model.clock.tick {
                    ui.label(text)
                } else {
                    ui.weak(text)
                };
            });
        }
    });
    if let Some(index) = removed {
        model.scene.events.remove(index);
    }
}
