//! The motion panel: what moves the films, and its history.

use egui::{Response, Ui};

use super::widgets::{choice, number, number_within, seed, slider_from, tooltip};
use crate::{
    app::{edit::Edit, history, model::Model},
    scene::{Flow, Motion, MotionChange},
};

/// Shows and edits the motion that is in force now.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let now = model.motion();
    let mut motion = model.motion_draft.take().unwrap_or_default().applied_to(now.clone());
    let is_dragged = flow(ui, &mut motion) | film(ui, &mut motion) | life(ui, &mut motion) | method(ui, &mut motion);
    if is_dragged {
        // Events count once the slider is let go, or each value on the way would be one. What else happens meanwhile stays.
        model.motion_draft = Some(MotionChange::between(&now, &motion));
        motion = MotionChange::all_of(&now).applied_to(motion);
    }
    if motion != now {
        model.edit(Edit::Motion(motion.into()));
    }
    events(ui, model);
}

/// The keys that move the film; returns whether a slider is being dragged, as the functions below do.
fn flow(ui: &mut Ui, motion: &mut Motion) -> bool {
    let keys = Motion::KEYS;
    choice(ui, &keys.flow, &mut motion.flow);
    // Nothing flows at rest.
    let is_dragged = motion.flow != Flow::Rest && {
        seed(ui, &keys.seed, &mut motion.seed);
        number(ui, &keys.strength, &mut motion.strength, |slider| slider.max_decimals(2)).dragged()
    };
    let turn_deg_s = &mut motion.spin_deg_s[2];
    let spin = number_within(ui, &keys.spin_deg_s, turn_deg_s, -360.0..=360.0, |slider| slider.max_decimals(1));
    let gravity = gravity(ui, &mut motion.gravity_m_s2);
    is_dragged | spin.dragged() | gravity
}

/// Sliders for the strength of gravity and its tilt about the world's x axis.
fn gravity(ui: &mut Ui, gravity_m_s2: &mut [f64; 3]) -> bool {
    let [_, y, z] = *gravity_m_s2;
    let mut strength = y.hypot(z);
    let mut tilt_deg = if strength > 0.0 { y.atan2(-z).to_degrees() } else { 0.0 };
    let key = Motion::KEYS.gravity_m_s2;
    let [x, y, z] = Motion::default().gravity_m_s2;
    let normal = Some(x.hypot(y).hypot(z));
    let pull = slider_from(ui, key.label, &mut strength, 0.0..=100.0, &tooltip(key.help), normal, |slider| {
        slider.suffix(key.unit).max_decimals(1)
    });
    let help = "Angle from straight down towards +y. The arrow keys tilt gravity as seen in the picture.";
    let tilt = slider_from(ui, "Tilt", &mut tilt_deg, -180.0..=180.0, help, Some(0.0), |slider| {
        slider.suffix("°").max_decimals(1)
    });
    if pull.changed() || tilt.changed() {
        let (sin, cos) = tilt_deg.to_radians().sin_cos();
        let rounded = |part: f64| (part * 1e3).round() / 1e3;
        (gravity_m_s2[1], gravity_m_s2[2]) = (rounded(strength * sin), rounded(-strength * cos));
    }
    pull.dragged() | tilt.dragged()
}

/// What slows the film down, spreads it and lets it run out.
fn film(ui: &mut Ui, motion: &mut Motion) -> bool {
    let keys = Motion::KEYS;
    more(ui, "Liquid", |ui| {
        [
            number(ui, &keys.drag_1_s, &mut motion.drag_1_s, |s| s.logarithmic(true).smallest_positive(0.1)),
            number(ui, &keys.air_drag, &mut motion.air_drag, |slider| slider.max_decimals(2)),
            number(ui, &keys.viscosity_mm2_s, &mut motion.viscosity_mm2_s, |s| {
                s.logarithmic(true).smallest_positive(1.0).max_decimals(0)
            }),
            number(ui, &keys.surface_viscosity_upa_s_m, &mut motion.surface_viscosity_upa_s_m, |s| {
                s.logarithmic(true).smallest_positive(0.001).max_decimals(3)
            }),
            number(ui, &keys.diffusion_mm2_s, &mut motion.diffusion_mm2_s, |s| {
                s.logarithmic(true).smallest_positive(0.1).max_decimals(1)
            }),
            number(ui, &keys.drainage, &mut motion.drainage, |s| {
                s.logarithmic(true).smallest_positive(1.0).max_decimals(0)
            }),
        ]
    })
}

/// What lets the film dry, burst and come again.
fn life(ui: &mut Ui, motion: &mut Motion) -> bool {
    let keys = Motion::KEYS;
    let rate_nm_s = &mut motion.evaporation_nm_s;
    let drying = number_within(ui, &keys.evaporation_nm_s, rate_nm_s, 0.0..=100.0, |slider| slider.max_decimals(1));
    let others = more(ui, "Life", |ui| {
        [
            number(ui, &keys.humidity, &mut motion.humidity, |slider| slider.max_decimals(2)),
            number(ui, &keys.air_speed_m_s, &mut motion.air_speed_m_s, |slider| slider.max_decimals(2)),
            number(ui, &keys.black_film_life_s, &mut motion.black_film_life_s, |s| s.logarithmic(true).max_decimals(1)),
            number(ui, &keys.burst_slowdown, &mut motion.burst_slowdown, |s| s.logarithmic(true).max_decimals(0)),
            number(ui, &keys.renew_s, &mut motion.renew_s, |s| s.logarithmic(true).max_decimals(1)),
        ]
    });
    drying.dragged() | others
}

/// The scheme and the speed of the clock, which hold for the whole history.
fn method(ui: &mut Ui, motion: &mut Motion) -> bool {
    let keys = Motion::KEYS;
    let speed = number(ui, &keys.speed, &mut motion.speed, |slider| slider.logarithmic(true).max_decimals(2));
    choice(ui, &keys.scheme, &mut motion.scheme);
    speed.dragged()
}

/// Rows that are collapsed at first; returns whether a slider in them is being dragged.
fn more<const N: usize>(ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui) -> [Response; N]) -> bool {
    let shown = egui::CollapsingHeader::new(title).default_open(false).show_unindented(ui, rows);
    shown.body_returned.is_some_and(|rows| rows.iter().any(Response::dragged))
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
        model.edit(Edit::Forget(index));
    }
}
