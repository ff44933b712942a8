//! The films of bubbles that others show, in one texture.

use std::collections::BTreeMap;

use super::{panel_texture::PanelTexture, shown_film::Shown, timing::Recorder};

/// A texture with the films of several bubbles side by side, a layer a panel, halos included.
pub struct FilmAtlas {
    /// The texture.
    pub films: PanelTexture,
    /// Where the film of each bubble lies, in texels, by its index.
    places: BTreeMap<usize, [u32; 2]>,
}

impl FilmAtlas {
    /// The place of each film, and the size of the texture that holds them. Films lie in equal squares; those that a texture of `limit` texels has no
    /// room for have no place.
    fn laid_out(films: &BTreeMap<usize, Shown<'_>>, limit: u32) -> (BTreeMap<usize, [u32; 2]>, [u32; 2]) {
        let side = films.values().map(|shown| shown.film.size()[0]).max().unwrap_or(1);
        let columns = (limit / side).min((films.len() as f64).sqrt().ceil() as u32).max(1);
        let rows = (limit / side).min((films.len() as u32).div_ceil(columns)).max(1);
        let place = |k: u32| [k % columns * side, k / columns * side];
        let places = films.keys().copied().zip((0..columns * rows).map(place)).collect();
        (places, [columns * side, rows * side])
    }

    /// Keeps a texture that fits, else makes a new one, and records the copies of all films.
    pub fn of(old: Option<Self>, recorder: &mut Recorder<'_>, films: &BTreeMap<usize, Shown<'_>>) -> Self {
        let gpu = recorder.gpu;
        let (places, size) = Self::laid_out(films, gpu.device.limits().max_texture_dimension_2d);
        let old = old.map(|atlas| atlas.films).filter(|old| old.size() == size);
        let atlas = old.unwrap_or_else(|| PanelTexture::new(gpu, "films", size, wgpu::TextureFormat::R32Float));
        for (index, [x, y]) in &places {
            let film = &films[index].film.texture;
            let origin = wgpu::Origin3d { x: *x, y: *y, z: 0 };
            let to = wgpu::TexelCopyTextureInfo { origin, ..atlas.texture.as_image_copy() };
            recorder.encoder().copy_texture_to_texture(film.as_image_copy(), to, film.size());
        }
        Self { films: atlas, places }
    }

    /// Where the film of a bubble lies, in texels, if there was room for it.
    #[must_use]
    pub fn place(&self, index: usize) -> Option<[u32; 2]> {
        self.places.get(&index).copied()
    }
}
