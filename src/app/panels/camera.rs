//! Ways to look at the bubbles: known views, a turntable, and keyframes.

use egui::{CollapsingHeader, ComboBox, Ui};

use super::widgets::{group, slider};
use crate::{
    Words,
    app::{model::Model, orbit},
    scene::Ease,
};

/// Turns of the turntable that its slider offers, degrees per second.
const TURNS_DEG_S: std::ops::RangeInclusive<f64> = -90.0..=90.0;

/// Shows the views and the turntable.
pub fn show(ui: &mut Ui, model: &mut Model) {
    group(ui, "Look from", |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            for (view, name, help) in orbit::VIEWS {
                if ui.button(name).on_hover_text(help).clicked() {
                    let spheres = model.scene.spheres(model.clock.time_s(&model.scene.motion));
                    model.look_from(orbit::seen_from(&model.scene.camera, &spheres, view));
                }
            }
        });
    });
    let help = "The eye goes around its target by itself, without keyframes; 0: it stays";
    slider(ui, "Turntable", &mut model.turntable_deg_s, TURNS_DEG_S, help, |slider| {
        slider.suffix("°/s").max_decimals(0)
    });
    keyframes(ui, model);
}

/// What happens to a view that is not where the keyframes have it.
const OFF: &str = "This view is off the keyframes: the next moment takes it back. Add a keyframe to keep it, or undo.";

/// The keyframes of the camera: how they come to be, and each of them.
fn keyframes(ui: &mut Ui, model: &mut Model) {
    let count = model.scene.camera.keyframes.len();
    let title = if count == 0 { "Keyframes".to_owned() } else { format!("Keyframes ({count})") };
    CollapsingHeader::new(title).id_salt("keyframes").show_unindented(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            let help = "Keep this view for this time, in the place of a keyframe that is there. Between keyframes the camera moves by itself. \
                        To look from elsewhere pauses; once time moves, the camera is back on its way";
            if ui.button("Add keyframe here").on_hover_text(help).clicked() {
                model.add_keyframe();
            }
            let help = "Two keyframes that let the camera turn once around its target over the length of the time line; they replace those \
                        that are there";
            if ui.button("Add turntable").on_hover_text(help).clicked() {
                model.add_turntable();
            }
        });
        if model.is_off_keyframes() {
            ui.label(OFF);
        }
        list(ui, model);
    });
}

fn list(ui: &mut Ui, model: &mut Model) {
    let (mut removed, mut gone_to, mut eased) = (None, None, None);
    for (index, keyframe) in model.scene.camera.keyframes.iter().enumerate() {
        ui.horizontal(|ui| {
            let number = index + 1;
            if ui.small_button("×").on_hover_text(format!("Delete keyframe {number}")).clicked() {
                removed = Some(index);
            }
            let time = ui.button(format!("{:.2} s", keyframe.time_s));
            let time = time.on_hover_text(format!("Go to the time of keyframe {number}"));
            if time.clicked() {
                gone_to = Some(index);
            }
            let mut ease = keyframe.ease;
            let list = ComboBox::from_id_salt(("ease", index)).width(76.0).selected_text(ease.name());
            let list = list.show_ui(ui, |ui| {
                for choice in Ease::ALL {
                    ui.selectable_value(&mut ease, choice, choice.name()).on_hover_text(choice.help());
                }
            });
            list.response.labelled_by(time.id).on_hover_text(format!("How the camera goes on from keyframe {number}"));
            if ease != keyframe.ease {
                eased = Some((index, ease));
            }
        });
    }
    gone_to.into_iter().for_each(|index| model.go_to_keyframe(index));
    eased.into_iter().for_each(|(index, ease)| model.ease_keyframe(index, ease));
    removed.into_iter().for_each(|index| model.delete_keyframe(index));
}
