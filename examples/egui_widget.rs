//! A bubble as an egui widget: an image that is drawn again when its size or time changes. Here a test harness in memory stands in for the
//! window; in an application call `BubbleImage::show` in the same way.
//!
//!     cargo run --example egui_widget

use egui::{ColorImage, Image, TextureHandle, TextureOptions, accesskit::Role, load::SizedTexture, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use soapfilm::{Error, LoadedScene, Studio, load_scene};

/// A scene, and the picture of it that egui has.
struct BubbleImage {
    studio: Studio,
    scene: LoadedScene,
    drawn: Option<Drawn>,
}

/// A texture, and what it shows.
struct Drawn {
    pixels: [u32; 2],
    time_s: f64,
    texture: TextureHandle,
}

impl BubbleImage {
    /// Shows the scene at a time in seconds, in a size in points.
    fn show(&mut self, ui: &mut egui::Ui, size: egui::Vec2, time_s: f64) -> Result<egui::Response, Error> {
        let pixels = [size.x, size.y].map(|points| (points * ui.pixels_per_point()).round().max(1.0) as u32);
        let kept = self.drawn.take().filter(|drawn| (drawn.pixels, drawn.time_s) == (pixels, time_s));
        let drawn = kept.map_or_else(|| self.draw(ui, pixels, time_s), Ok)?;
        let texture = SizedTexture::from_handle(&self.drawn.insert(drawn).texture);
        Ok(ui.add(Image::from(texture).fit_to_exact_size(size).alt_text("bubble")))
    }

    fn draw(&mut self, ui: &egui::Ui, pixels: [u32; 2], time_s: f64) -> Result<Drawn, Error> {
        let picture = self.studio.render(&self.scene, pixels, time_s)?;
        let image = ColorImage::from_rgba_unmultiplied(pixels.map(|side| side as usize), &picture.rgba);
        Ok(Drawn { pixels, time_s, texture: ui.ctx().load_texture("bubble", image, TextureOptions::LINEAR) })
    }
}

fn main() -> Result<(), Error> {
    let mut bubble = BubbleImage { studio: Studio::open()?, scene: load_scene("default")?, drawn: None };
    let (mut time_s, mut failed) = (0.0, None);
    let mut window = Harness::new_ui(|ui| {
        if ui.button("one second on").clicked() {
            time_s += 1.0;
        }
        failed = bubble.show(ui, vec2(160.0, 120.0), time_s).err();
    });
    window.get_by_label("one second on").click();
    window.run();
    let place = window.get_by_role_and_label(Role::Image, "bubble").rect();
    drop(window);
    println!("egui shows the bubble at {time_s} s in {place:?}");
    failed.map_or(Ok(()), Err)
}
