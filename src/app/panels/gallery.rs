//! Lessons and presets as pictures with their sentences, in groups.

use std::sync::Arc;

use egui::{
    Button, ColorImage, Context, Id, Image, Modal, RichText, ScrollArea, TextureHandle, TextureOptions, Ui, vec2,
};
use include_dir::{Dir, include_dir};

use crate::{
    app::{model::Model, request::Request},
    scene::{
        PRESET_GROUPS, TEST_PRESETS,
        lesson::{lesson, lesson_names},
        preset_sentence,
    },
};

/// Pictures of the presets, made by `./dev thumbnails`.
static PICTURES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/thumbnails");

/// Size of a picture, points.
const SIZE: egui::Vec2 = vec2(168.0, 105.0);

/// The pictures on the device, by the names of their presets.
type Pictures = Arc<Vec<(String, TextureHandle)>>;

/// Shows the presets over everything, until one is chosen.
pub fn show(ctx: &Context, model: &mut Model) {
    if !model.shows_gallery {
        return;
    }
    let (pictures, room) = (pictures(ctx), ctx.content_rect().size());
    let (mut chosen, mut chosen_lesson) = (None, None);
    let modal = Modal::new(Id::unique("gallery")).show(ctx, |ui| {
        ui.set_width((room.x - 60.0).clamp(60.0, 940.0));
        ScrollArea::vertical().max_height((room.y - 90.0).max(60.0)).show(ui, |ui| {
            lessons(ui, &pictures, &mut chosen_lesson);
            let tests = [("For testing", &TEST_PRESETS[..])];
            for (title, names) in PRESET_GROUPS.iter().chain(&tests) {
                ui.heading(*title);
                ui.horizontal_wrapped(|ui| {
                    for name in *names {
                        let picture = pictures.iter().find(|(known, _)| known == name).map(|(_, picture)| picture);
                        if card(ui, name, &preset_sentence(name).unwrap_or_default(), picture) {
                            chosen = Some((*name).to_owned());
                        }
                    }
                });
            }
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
            let picture =
                pictures.iter().find(|(known, _)| *known == lesson.steps[0].scene).map(|(_, picture)| picture);
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

/// The pictures, loaded when they are first shown.
fn pictures(ctx: &Context) -> Pictures {
    let id = Id::unique("preset pictures");
    if let Some(known) = ctx.data(|data| data.get_temp::<Pictures>(id)) {
        return known;
    }
    let pictures = PICTURES.files().filter_map(|file| {
        let name = file.path().file_stem()?.to_str()?;
        let image = image::load_from_memory(file.contents()).ok()?.into_rgba8();
        let size = [image.width() as usize, image.height() as usize];
        let image = ColorImage::from_rgba_unmultiplied(size, image.as_raw());
        Some((name.to_owned(), ctx.load_texture(name, image, TextureOptions::LINEAR)))
    });
    let pictures: Pictures = pictures.collect::<Vec<_>>().into();
    ctx.data_mut(|data| data.insert_temp(id, pictures.clone()));
    pictures
}

/// Forgets the pictures, because the device that held them is lost.
pub fn forget(ctx: &Context) {
    ctx.data_mut(|data| data.remove_temp::<Pictures>(Id::unique("preset pictures")));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::preset_names;

    #[test]
    fn every_preset_has_a_picture() {
        for name in preset_names() {
            let file = PICTURES.get_file(format!("{name}.png"));
            let image = file.and_then(|file| image::load_from_memory(file.contents()).ok());
            let size = image.map(|image| (image.width(), image.height()));
            assert_eq!(size, Some((192, 120)), "{name}: run ./dev thumbnails");
        }
    }
}
