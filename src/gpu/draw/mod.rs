//! Draws the linear picture: the backdrop, then the bubbles, layer by layer, each ring by ring.

mod bodies;
mod shared;
mod small;
mod values;

use super::{
    composition::{Composition, PixelRect, Placed, PlacedBody},
    device::{Gpu, GpuError},
    environment::Environment,
    film_atlas::FilmAtlas,
    formats::radiance_format,
    kernel::Drawable,
    passes::{backdrop::Backdrop, bake_table::Table, bubble::OtherBubble, open_hole::OpenHole},
    quadrature::Quadrature,
    rings::{Ring, disc, middle_everywhere, rings},
    shown_film::{NoFilm, Shown},
    target::Target,
    timing::Recorder,
};
use crate::plan::{BackdropKey, BubbleKey, DrawKey, FilmColours, Lighting, Rendering};
use shared::Shared;
use small::SmallDraw;
use values::backdrop_colour;
pub use values::view_uniform;

/// What a draw reads that other passes left.
pub struct DrawInputs<'a> {
    /// The environment.
    pub environment: &'a Environment,
    /// The environment as it is seen behind the bubbles.
    pub backdrop: &'a Environment,
    /// The table, where the quality has one, and the quadrature of each material, by its index, that a bubble in sight has.
    pub colours: &'a dyn Fn(usize) -> Option<(Option<&'a Table>, &'a Quadrature)>,
    /// What a film shows, by its index.
    pub film: &'a dyn Fn(usize) -> Option<Shown<'a>>,
    /// The hole in a film that bursts, by the film's index.
    pub hole: &'a dyn Fn(usize) -> Option<&'a OpenHole>,
    /// How the bubbles lie over one another.
    pub composition: &'a Composition,
    /// The pictures of what is behind a layer, and of all before it; as large as the picture if there is more than one layer.
    pub drawn: [&'a Target; 2],
    /// What is polarised of the picture, and of what is behind a layer; as large as the picture if that is tracked.
    pub polarised: [&'a Target; 2],
    /// Films of bubbles that others show.
    pub atlas: &'a FilmAtlas,
}

/// Pixels that one submission draws at most, so that none runs long.
const PIXELS_PER_SUBMISSION: u32 = 2_000_000;

/// Horizontal strips that a picture is cut into.
pub fn strips([width, height]: [u32; 2]) -> impl Iterator<Item = std::ops::Range<u32>> {
    let rows = (PIXELS_PER_SUBMISSION / width.max(1)).max(1);
    (0..height).step_by(rows as usize).map(move |top| top..(top + rows).min(height))
}

/// The uniforms and bind groups of one picture, made once and used for each of its strips.
pub struct DrawPass {
    backdrop: BackdropDraw,
    /// The farthest first. Bubbles of one layer do not overlap, but for small ones, which are drawn in their order.
    layers: Vec<Layer>,
    width: u32,
    tracks_polarisation: bool,
}

/// Bubbles that are drawn together.
#[derive(Default)]
struct Layer {
    /// Pixels of what is behind these bubbles, or behind the clusters that begin with them.
    behind: Vec<PixelRect>,
    /// Pixels of what is drawn so far, where bubbles of clusters are added to it.
    so_far: Vec<PixelRect>,
    /// The rings of all bubbles, each with its number of vertices.
    rings: Vec<(Drawable, u32)>,
    /// Small bubbles, of a material each.
    small: Vec<SmallDraw>,
    /// What is drawn at films, each with its number of vertices.
    bodies: Vec<(Drawable, u32)>,
}

/// What stands behind all bubbles.
enum BackdropDraw {
    /// The environment, or what a bath mirrors, at each pixel.
    Drawn(Drawable),
    /// One colour everywhere.
    Colour(wgpu::Color),
}

impl BackdropDraw {
    fn new(gpu: &Gpu, shared: &Shared<'_>) -> Result<Self, GpuError> {
        let Shared { key, lighting, view, light, backdrop: map, .. } = shared;
        if let (BackdropKey::Colour(radiance), false) = (&lighting.light.backdrop, key.on_bath) {
            return Ok(Self::Colour(backdrop_colour(key, lighting, *radiance)));
        }
        let backdrop = Backdrop {
            lit: light.lit,
            ON_BATH: key.on_bath,
            FULL_PRECISION: key.full_precision,
            BACKDROP_IS_ENVIRONMENT: lighting.light.backdrop == BackdropKey::Environment,
            view,
            light: &light.light,
            backdrop_map: &map.view,
            backdrop_sampler: map.backdrop_sampler(),
            lamps: &light.lamps,
        };
        Ok(Self::Drawn(backdrop.cover(gpu, &[radiance_format(key.full_precision)])?))
    }
}

/// The colours of films of one material.
struct Colours<'a> {
    films: &'a FilmColours,
    table: &'a Table,
    quadrature: &'a Quadrature,
}

/// A ring of a bubble, and what it shows.
struct Drawn<'a> {
    bubble: &'a BubbleKey,
    placed: &'a Placed,
    first_other: u32,
    ring: &'a Ring,
    colours: &'a Colours<'a>,
    film: &'a Shown<'a>,
    hole: &'a OpenHole,
}

impl DrawPass {
    /// Makes ready what a key asks for in one of its lights.
    pub fn new<'a>(
        gpu: &Gpu,
        key: &'a DrawKey,
        lighting: &'a Lighting,
        inputs: &DrawInputs<'a>,
    ) -> Result<Self, GpuError> {
        let (count, most) = (key.small.len(), gpu.most_values::<OtherBubble>());
        if count as u64 > most {
            return Err(GpuError::TooManyBubbles { count, most });
        }
        let shared = Shared::new(gpu, key, lighting, inputs);
        let mut pass = Self {
            backdrop: BackdropDraw::new(gpu, &shared)?,
            layers: Vec::new(),
            width: key.size[0],
            tracks_polarisation: shared.tracks_polarisation,
        };
        // Fills the binding where the quality has no table.
        let unread = |films: &FilmColours| films.table.is_none().then(|| Table::unread(gpu, &films.quadrature.optics));
        let unread: Vec<Option<Table>> = lighting.films.iter().map(unread).collect();
        let (no_film, no_hole) = (NoFilm::new(gpu), OpenHole::new(gpu));
        pass.layers.resize_with(inputs.composition.layers(), Layer::default);
        let colours = |material: usize| {
            let (table, quadrature) = (inputs.colours)(material)?;
            Some(Colours { films: &lighting.films[material], table: unread[material].as_ref().or(table)?, quadrature })
        };
        for (place, (bubble, placed)) in key.bubbles.iter().zip(&inputs.composition.placed).enumerate() {
            let Some(colours) = colours(bubble.material) else { continue };
            let film = (inputs.film)(bubble.index).unwrap_or_else(|| no_film.shown());
            let hole = (inputs.hole)(bubble.index).unwrap_or(&no_hole);
            let first_other = shared.first_other(place);
            for ring in bubble_rings(key, lighting, bubble) {
                let drawn = Drawn { bubble, placed, first_other, ring: &ring, colours: &colours, film: &film, hole };
                pass.layers[placed.layer].rings.push((shared.ring(gpu, &drawn)?, ring.vertices()));
            }
            let bodies = bubble.bodies.iter().zip(&placed.bodies);
            for (body, placed) in bodies.filter(|_| key.rendering == Rendering::Full) {
                pass.add_body(placed, shared.body(gpu, (bubble, hole), body.kind)?);
            }
            pass.layers[placed.behind_layer].behind.push(placed.rect.clone());
            if !placed.among.is_empty() {
                pass.layers[placed.layer].so_far.push(placed.rect.clone());
            }
        }
        for ([layer, material], bubbles) in &inputs.composition.small {
            let Some(colours) = colours(*material) else { continue };
            let small = shared.small(gpu, &colours, bubbles)?;
            pass.layers[*layer].behind.extend(small.rects.iter().cloned());
            pass.layers[*layer].small.push(small);
        }
        Ok(pass)
    }

    /// Adds what is drawn of a body before its bubble, and after it.
    fn add_body(&mut self, placed: &PlacedBody, halves: [(Drawable, u32); 2]) {
        for (layer, half) in placed.layers.into_iter().zip(halves) {
            self.layers[layer].behind.push(placed.rect.clone());
            self.layers[layer].bodies.push(half);
        }
    }

    /// Records some rows of the picture.
    pub fn record(
        &self,
        recorder: &mut Recorder<'_>,
        target: &Target,
        ([behind, so_far], [polarised, polarised_behind]): ([&Target; 2], [&Target; 2]),
        rows: &std::ops::Range<u32>,
    ) {
        let (backdrop, colour) = match &self.backdrop {
            BackdropDraw::Drawn(backdrop) => (Some(backdrop), None),
            // The first rows clear the whole picture.
            BackdropDraw::Colour(colour) => (None, (rows.start == 0).then_some(*colour)),
        };
        let Some((first, later)) = self.layers.split_first() else { return };
        self.draw(recorder, first, (target, polarised), rows, (backdrop, colour));
        if self.tracks_polarisation {
            // Light from the backdrop is not polarised.
            let nothing = Some(wgpu::Color::TRANSPARENT);
            recorder.render("draw", &polarised.view, nothing, |_| {});
        }
        for layer in later {
            let copies = [(&layer.behind, target, behind), (&layer.so_far, target, so_far)];
            let of_polarised = (&layer.behind, polarised, polarised_behind);
            for (rects, from, to) in copies.into_iter().chain(self.tracks_polarisation.then_some(of_polarised)) {
                let parts = rects.iter().filter_map(|rect| rect.within(rows));
                parts.for_each(|part| copy_part(recorder.encoder(), from, to, &part));
            }
            self.draw(recorder, layer, (target, polarised), rows, (None, None));
        }
    }

    /// Records some rows of a layer, over a backdrop or a colour where there is one.
    fn draw(
        &self,
        recorder: &mut Recorder<'_>,
        layer: &Layer,
        (target, polarised): (&Target, &Target),
        rows: &std::ops::Range<u32>,
        (backdrop, colour): (Option<&Drawable>, Option<wgpu::Color>),
    ) {
        let small_parts = || layer.small.iter().flat_map(|small| small.parts(rows).map(|part| (&small.draw, part)));
        let draw_rings = |pass: &mut wgpu::RenderPass<'_>| {
            pass.set_scissor_rect(0, rows.start, self.width, rows.len() as u32);
            layer.rings.iter().for_each(|(ring, vertices)| ring.draw(pass, *vertices));
        };
        // Only bubbles change what is polarised.
        if self.tracks_polarisation && !layer.rings.is_empty() {
            recorder.render_into("draw", &[(&target.view, None), (&polarised.view, None)], draw_rings);
        }
        recorder.render("draw", &target.view, colour, |pass| {
            pass.set_scissor_rect(0, rows.start, self.width, rows.len() as u32);
            backdrop.into_iter().for_each(|backdrop| backdrop.draw(pass, 3));
            if !self.tracks_polarisation {
                draw_rings(pass);
            }
            layer.bodies.iter().for_each(|(body, vertices)| body.draw(pass, *vertices));
            for (small, PixelRect { columns, rows }) in small_parts() {
                pass.set_scissor_rect(columns.start, rows.start, columns.len() as u32, rows.len() as u32);
                small.draw(pass, 3);
            }
        });
        let draws = usize::from(backdrop.is_some()) + layer.rings.len() + layer.bodies.len() + small_parts().count();
        recorder.counts.draws += draws as u64;
    }
}

/// Records the copy of a part of a picture to the same place of another.
fn copy_part(encoder: &mut wgpu::CommandEncoder, from: &Target, to: &Target, part: &PixelRect) {
    let origin = wgpu::Origin3d { x: part.columns.start, y: part.rows.start, z: 0 };
    let [from, to] = [from, to].map(|target| wgpu::TexelCopyTextureInfo { origin, ..target.texture.as_image_copy() });
    let size =
        wgpu::Extent3d { width: part.columns.len() as u32, height: part.rows.len() as u32, depth_or_array_layers: 1 };
    encoder.copy_texture_to_texture(from, to, size);
}

/// Pixels that the picture's draws cover: all of the backdrop, and each bubble's bounding rectangle.
#[must_use]
pub fn pixels_shaded(key: &DrawKey) -> u64 {
    let bounds = key.bubbles.iter().map(|bubble| bubble.bounds).chain(key.small.iter().map(|small| small.bounds));
    let bubbles: u64 = bounds.map(|bounds| PixelRect::around(bounds, key.size).pixels()).sum();
    key.size.map(u64::from).iter().product::<u64>() + bubbles
}

fn bubble_rings(key: &DrawKey, lighting: &Lighting, bubble: &BubbleKey) -> Vec<Ring> {
    let quadrature = &lighting.films[bubble.material].quadrature;
    // Of the scene's own light: beside it, lights of other illuminants are dark everywhere but in their places.
    let contrast = key.lighting.environment.0.contrast();
    let rings = rings(&key.camera, bubble, quadrature.quality, &quadrature.optics.film, contrast);
    match key.rendering {
        Rendering::Full => rings,
        Rendering::Preview => vec![middle_everywhere(&key.camera, bubble, rings[0])],
        Rendering::Yardstick => vec![disc(&key.camera, bubble)],
    }
}
