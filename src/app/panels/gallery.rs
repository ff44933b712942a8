//! Lessons and presets as pictures with their sentences, in groups.

use std::{collections::BTreeMap, sync::Arc, time::Duration};

use egui::{Button, ColorImage, Context, Id, Image, Modal, RichText, TextureHandle, TextureOptions, Ui, vec2};

use super::{dialog, widgets::follow_focus};
use crate::{
    app::{model::Model, request::Request, system::thumbnail},
    scene::{
        PRESET_GROUPS, TEST_PRESETS,
        lesson::{lesson, lesson_names},
        preset_names, preset_sentence,
    },
};

/// Pictures decoded a frame: about 10 ms.
const PER_FRAME: usize = 8;
/// Time between two looks whether pictures have come.
const LOOK: Duration = Duration::from_millis(50);

/// Size of a picture, points.
const SIZE: egui::Vec2 = vec2(168.0, 105.0);

/// The pictures on the device, by the names of their presets; none for those that there are no pictures of.
type Pictures = Arc<BTreeMap<&'static str, Option<TextureHandle>>>;

/// Shows the presets over everything, until one is chosen.
pub fn show(ctx: &Context, model: &mut Model) {
    if !model.shows_gallery {
        return;
    }
    let pictures = pictures(ctx);
    let (mut chosen, mut chosen_lesson) = (None, None);
    let modal = Modal::new(Id::unique("gallery")).show(ctx, |ui| {
        ui.set_width(dialog::width(ui, 940.0));
        dialog::scroll(ui, 40.0).show(ui, |ui| {
            lessons(ui, &pictures, &mut chosen_lesson);
            let tests = [("For testing", &TEST_PRESETS[..])];
            for (title, names) in PRESET_GROUPS.iter().chain(&tests) {
                ui.heading(*title);
                ui.horizontal_wrapped(|ui| {
                    for name in *names {
                        let picture = pictures.get(name).and_then(Option::as_ref);
                        if card(ui, name, &preset_sentence(name).unwrap_or_default(), picture) {
                            chosen = Some((*name).to_owned());
                        }
                    }
                });
            }
            follow_focus(ui);
        });
        ui.button("Close").clicked()
    });
    model.shows_gallery = chosen.is_none() && chosen_lesson.is_none() && !modal.inner && !modal.should_close();
    chosen.into_iter().for_each(|name| model.ask_for(Request::LoadScene(name)));
    chosen_lesson.into_iter().for_each(|name| model.ask_for(Request::BeginLesson(name)));
}

/// The built-in lessons, each with the picture of its first scene.
fn lessons(ui: &mut Ui, pictures: &Pictures, chosen: &mut Option<String>) {
    ui.heading("Lessons");
    ui.horizontal_wrapped(|ui| {
        for (name, lesson) in lesson_names().filter_map(|name| Some((name, lesson(name)?))) {
            let picture = pictures.get(lesson.steps[0].scene.as_str()).and_then(Option::as_ref);
            if card(ui, &lesson.title, &lesson.about, picture) {
                *chosen = Some(name.to_owned());
            }
        }
    });
}

/// A preset's picture, name and sentence; returns whether it was chosen.
fn card(ui: &mut Ui, name: &str, sentence: &str, picture: Option<&TextureHandle>) -> bool {
    let layout = egui::Layout::top_down(egui::Align::Min);
    let card = ui.allocate_ui_with_layout(SIZE + vec2(8.0, 66.0), layout, |ui| {
        ui.set_width(SIZE.x + 8.0);
        let button = match picture {
            Some(picture) => Button::image(Image::from_texture(picture).fit_to_exact_size(SIZE)),
            None => Button::new("").min_size(SIZE),
        };
        let button = ui.add(button);
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, name));
        let text = egui::Label::new(RichText::new(format!("{name}: {sentence}")).small()).wrap();
        ui.add(text).on_hover_text(sentence);
        button.on_hover_text(sentence).clicked()
    });
    card.inner
}

/// The pictures, loaded a few at a time once they are first shown.
fn pictures(ctx: &Context) -> Pictures {
    let pictures = loaded(ctx, preset_names());
    if pictures.len() < preset_names().count() {
        ctx.request_repaint_after(LOOK);
    }
    pictures
}

/// The picture of a preset, once it is there; other scenes have none.
pub fn picture(ctx: &Context, name: &str) -> Option<TextureHandle> {
    loaded(ctx, preset_names().filter(|preset| *preset == name)).get(name).cloned().flatten()
}

/// All pictures so far, and a few more of those that are asked for.
fn loaded(ctx: &Context, names: impl Iterator<Item = &'static str>) -> Pictures {
    let id = Id::unique("preset pictures");
    let mut pictures = ctx.data(|data| data.get_temp::<Pictures>(id)).unwrap_or_default();
    let missing = names.filter(|name| !pictures.contains_key(name));
    let come = |name: &'static str| Some((name, decoded(ctx, name, &thumbnail(name)?)));
    let new: Vec<_> = missing.filter_map(come).take(PER_FRAME).collect();
    if !new.is_empty() {
        Arc::make_mut(&mut pictures).extend(new);
        ctx.data_mut(|data| data.insert_temp(id, pictures.clone()));
    }
    pictures
}

fn decoded(ctx: &Context, name: &str, png: &[u8]) -> Option<TextureHandle> {
    let image = image::load_from_memory(png).ok()?.into_rgba8();
    let size = [image.width() as usize, image.height() as usize];
    let image = ColorImage::from_rgba_unmultiplied(size, image.as_raw());
    Some(ctx.load_texture(name, image, TextureOptions::LINEAR))
}

/// Forgets the pictures, because the device that held them is lost.
pub fn forget(ctx: &Context) {
    ctx.data_mut(|data| data.remove_temp::<Pictures>(Id::unique("preset pictures")));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_has_a_picture() {
        for name in preset_names() {
            let image = image::load_from_memory(&thumbnail(name).unwrap()).ok();
            let size = image.map(|image| (image.width(), image.height()));
            assert_eq!(size, Some((192, 120)), "{name}: run ./dev thumbnails");
        }
    }

    #[test]
    fn presets_have_a_picture_to_stand_in_and_other_scenes_have_none() {
        let ctx = Context::default();
        assert_eq!(picture(&ctx, "windows").map(|picture| picture.size()), Some([192, 120]));
        assert!(picture(&ctx, "windows.toml").is_none());
    }
}
