//! The motion panel: what moves the films, and the clock.

use egui::{Slider, SliderClamping, Ui};

use super::widgets::{choice, group, row, seed, slider};
use crate::{
    app::{history, model::Model},
    scene::{Flow, Motion, MotionChange},
};

const FLOWS: [(Flow, &str, &str); 5] = [
    (Flow::Free, "free", "Gravity and the air, as in a real film"),
    (Flow::Rest, "rest", "Nothing moves the film"),
    (Flow::Sloshing, "slosh", "The film swings as a whole about its rest state"),
    (Flow::Draught, "draught", "Slow, large gusts of the air around the bubble"),
    (Flow::Stirred, "stirred", "Many turning vortices, as after a stir"),
];

/// Shows and edits the motion that is in force now.
pub fn show(ui: &mut Ui, model: &mut Model) {
    clock(ui, model);
    let motion = model.motion();
    let mut flow = motion.flow;
    if choice(ui, "Flow", &mut flow, &FLOWS) {
        model.change_motion(MotionChange { flow: Some(flow), ..MotionChange::default() });
    }
    strength(ui, model, &motion);
    let mut number = motion.seed;
    if seed(ui, "Flow seed", &mut number, "Which of all such flows") {
        model.change_motion(MotionChange { seed: Some(number), ..MotionChange::default() });
    }
    let speed = &mut model.scene.motion.speed;
    slider(ui, "Speed", speed, 0.01..=100.0, "Film time that passes in a second", |slider| {
        slider.logarithmic(true).suffix("x").max_decimals(2)
    });
    events(ui, model);
}

fn clock(ui: &mut Ui, model: &mut Model) {
    let time_s = model.clock.time_s(&model.scene.motion);
    group(ui, &format!("{time_s:.1} s"), |ui| {
        let pause = if model.clock.running { "Pause" } else { "Run" };
        if ui.button(pause).on_hover_text("Lets film time stand or run (Space)").clicked() {
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

/// The strength counts once its slider is let go: each value on the way would be an event of its own.
fn strength(ui: &mut Ui, model: &mut Model, motion: &Motion) {
    let mut strength = model.strength_draft.unwrap_or(motion.strength);
    let response = row(ui, "Strength", "Factor on the speed of the flow", |ui| {
        ui.spacing_mut().slider_width = (ui.available_width() - 76.0).max(40.0);
        ui.add(Slider::new(&mut strength, 0.0..=10.0).clamping(SliderClamping::Edits).max_decimals(2))
    });
    if response.dragged() {
        model.strength_draft = Some(strength);
        return;
    }
    model.strength_draft = None;
    if strength != motion.strength {
        model.change_motion(MotionChange { strength: Some(strength), ..MotionChange::default() });
    }
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
