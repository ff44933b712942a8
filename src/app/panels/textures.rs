//! Pictures on the device that panels show, each remembered in a slot until its pixels change.

use std::sync::Arc;

use egui::{ColorImage, Context, Id, TextureHandle, TextureOptions};

use crate::app::compare::Pixels;

/// Where the texture of a slot is remembered, with the pixels that it shows.
type Remembered = (Arc<Vec<u8>>, TextureHandle);

/// The slots.
const SLOTS: [&str; 3] = ["compared", "other", "false colour"];

/// The texture of a picture, made when it is first shown in the slot.
pub fn texture(ctx: &Context, slot: &'static str, pixels: &Pixels, options: TextureOptions) -> TextureHandle {
    debug_assert!(SLOTS.contains(&slot));
    let known = ctx.data(|data| data.get_temp::<Remembered>(Id::unique(slot)));
    if let Some((_, texture)) = known.filter(|(rgba, _)| Arc::ptr_eq(rgba, &pixels.rgba)) {
        return texture;
    }
    let image = ColorImage::from_rgba_unmultiplied(pixels.size.map(|side| side as usize), &pixels.rgba);
    let texture = ctx.load_texture(slot, image, options);
    ctx.data_mut(|data| data.insert_temp(Id::unique(slot), (pixels.rgba.clone(), texture.clone())));
    texture
}

/// Forgets all textures, because the device that held them is lost.
pub fn forget(ctx: &Context) {
    SLOTS.iter().for_each(|slot| ctx.data_mut(|data| data.remove::<Remembered>(Id::unique(*slot))));
}
