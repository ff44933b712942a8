//! How the bubbles of a picture lie over, among and around one another.
//!
//! A bubble is drawn over the picture of what is behind it, so bubbles that may overlap in the picture are drawn one after the other, in
//! layers, the farthest first. Bubbles that intersect, or lie inside one another, have walls in no such order: they are a *cluster*. With the
//! walls of a cluster in the order in which a ray meets them, R their reflectances and W what all walls in front of one leave of light, the
//! light along the ray is
//!
//! ```text
//! L = B + W₀ R₀ (E₀ − B) + W₁ R₁ (E₁ − B) + …
//! ```
//!
//! where B is the light straight behind the whole cluster and E what each wall mirrors. So each bubble of a cluster adds its own walls' part to
//! the picture, in any order, and takes from it what others leave (`passed_others` in `shaders/light/others.wgsl`).

use std::{collections::BTreeMap, ops::Range};

use glam::DVec2;

use super::passes::small_bubbles::TILE;
use crate::{
    plan::{BubbleKey, DrawKey, FilmColours, Rendering, SmallBubble},
    scene::Quality,
};

/// Radius in pixels of the smallest bubbles that are more than one over the other: in smaller ones nobody sees which wall is in front, or others in
/// a mirror.
const SMALLEST_PIXELS: f64 = 12.0;
/// Radius over distance of the smallest bubbles that others mirror: of what a bubble is surrounded by, they are a part in 600.
const SMALLEST_MIRRORED: f64 = 0.08;

/// A rectangle of pixels: columns and rows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PixelRect {
    /// Columns.
    pub columns: Range<u32>,
    /// Rows, from the top.
    pub rows: Range<u32>,
}

impl PixelRect {
    /// All pixels that may show a bubble within some bounds in clip coordinates, with a little more: rings are polygons around the outline.
    #[must_use]
    pub fn around([low, high]: [DVec2; 2], [width, height]: [u32; 2]) -> Self {
        let span = |low: f64, high: f64, size: u32| {
            let [low, high] = [low, high].map(|clip| 0.5 * (clip + 1.0) * f64::from(size));
            let margin = 2.0 + 1e-3 * (high - low);
            let pixel = |x: f64| x.clamp(0.0, f64::from(size)) as u32;
            pixel((low - margin).floor())..pixel((high + margin).ceil())
        };
        // Clip coordinates point up.
        Self { columns: span(low.x, high.x, width), rows: span(-high.y, -low.y, height) }
    }

    /// The part within some rows, if there is one.
    #[must_use]
    pub fn within(&self, rows: &Range<u32>) -> Option<Self> {
        let rows = self.rows.start.max(rows.start)..self.rows.end.min(rows.end);
        (!rows.is_empty() && !self.columns.is_empty()).then(|| Self { columns: self.columns.clone(), rows })
    }

    /// How many there are.
    #[must_use]
    pub fn pixels(&self) -> u64 {
        self.columns.len() as u64 * self.rows.len() as u64
    }

    fn overlaps(&self, other: &Self) -> bool {
        let overlap = |a: &Range<u32>, b: &Range<u32>| a.start < b.end && b.start < a.end;
        overlap(&self.columns, &other.columns) && overlap(&self.rows, &other.rows)
    }

    /// The tiles that it touches, in a picture that is `across` tiles wide.
    pub fn tiles(&self, across: u32) -> impl Iterator<Item = usize> + use<> {
        let span = |pixels: &Range<u32>| pixels.start / TILE..pixels.end.div_ceil(TILE);
        let columns = span(&self.columns);
        span(&self.rows).flat_map(move |row| columns.clone().map(move |column| (row * across + column) as usize))
    }
}

/// A bubble among the others of its picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Its pixels.
    pub rect: PixelRect,
    /// Its layer. Layer 0 is the backdrop, with all bubbles if none of them may overlap.
    pub layer: usize,
    /// The layer before which all is drawn that is behind its whole cluster.
    pub behind_layer: usize,
    /// The other bubbles of its cluster that may share pixels with it, by their place in the picture's list.
    pub among: Vec<usize>,
    /// Other bubbles that it mirrors too.
    pub mirrored: Vec<usize>,
    /// Whether it is drawn by the shaders that mirror others.
    pub mirrors: bool,
    /// What is drawn at its film.
    pub bodies: Vec<PlacedBody>,
}

/// What is drawn at a film, in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedBody {
    /// Its pixels.
    pub rect: PixelRect,
    /// The layer of what is seen through the bubble, and of the rest.
    pub layers: [usize; 2],
}

/// How a picture is put together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Composition {
    /// The place of each bubble of the picture's list.
    pub placed: Vec<Placed>,
    /// Small bubbles by their layer and their material, farthest first.
    pub small: BTreeMap<[usize; 2], Vec<PlacedSmall>>,
}

/// A small bubble in the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedSmall {
    /// Its place in the picture's list of small ones.
    pub place: usize,
    /// Its pixels.
    pub rect: PixelRect,
}

impl Composition {
    /// How many layers there are, at least the backdrop's.
    #[must_use]
    pub fn layers(&self) -> usize {
        let small = self.small.keys().map(|[layer, _]| *layer);
        let bodies = self.placed.iter().flat_map(|placed| &placed.bodies).map(|body| body.layers[1]);
        let bubbles = self.placed.iter().map(|placed| placed.layer);
        bubbles.chain(bodies).chain(small).max().map_or(1, |last| last + 1)
    }

    /// Whether the picture keeps what is polarised of it. Bubbles reflect and pass s light otherwise than p light, and bubbles in front do so once
    /// more: to leave that out is most of the error of spectral pictures. Pictures through a polariser do not keep it. Where it is kept, layer 0 is the
    /// backdrop alone.
    #[must_use]
    pub fn tracks_polarisation(&self, key: &DrawKey) -> bool {
        let is_spectral = |films: &FilmColours| films.quadrature.quality == Quality::Spectral;
        self.placed.len() > 1
            && self.placed.iter().all(|placed| placed.layer > 0)
            && key.rendering == Rendering::Full
            && key.lighting.light.polariser.is_none()
            && key.lighting.films.iter().any(is_spectral)
    }
}

/// What is drawn in a tile so far.
#[derive(Clone, Copy, Default)]
struct TileState {
    /// The first layer that is free.
    free: usize,
    /// The layer and the material of the small bubbles that were drawn last, if nothing was drawn over them since.
    small: Option<[usize; 2]>,
}

/// Puts a picture together, whose bubbles are listed farthest first.
#[must_use]
pub fn composition(key: &DrawKey) -> Composition {
    let mut stack = Stack::new(key);
    let power = |small: &SmallBubble| key.camera.power(small.center_m, small.radius_m);
    let mut small = key.small.iter().map(power).enumerate().peekable();
    for cluster in clusters(key) {
        let nearest = cluster.last().map(|member| &key.bubbles[*member]);
        let nearest = nearest.map_or(0.0, |nearest| key.camera.power(nearest.center_m, nearest.radius_m));
        while let Some((place, _)) = small.next_if(|(_, power)| *power >= nearest) {
            stack.add_small(place);
        }
        stack.add_cluster(&cluster);
    }
    small.for_each(|(place, _)| stack.add_small(place));
    let mut composition = Composition { placed: stack.placed.into_iter().flatten().collect(), small: stack.small };
    share_pipelines(key, &mut composition);
    composition
}

/// A picture that is put together, from behind.
struct Stack<'a> {
    key: &'a DrawKey,
    rects: Vec<PixelRect>,
    /// Tiles side by side.
    across: u32,
    tiles: Vec<TileState>,
    placed: Vec<Option<Placed>>,
    small: BTreeMap<[usize; 2], Vec<PlacedSmall>>,
}

impl<'a> Stack<'a> {
    fn new(key: &'a DrawKey) -> Self {
        let [across, down] = key.size.map(|pixels| pixels.div_ceil(TILE));
        Self {
            key,
            rects: key.bubbles.iter().map(|bubble| PixelRect::around(bubble.bounds, key.size)).collect(),
            across,
            tiles: vec![TileState::default(); (across * down) as usize],
            placed: vec![None; key.bubbles.len()],
            small: BTreeMap::new(),
        }
    }

    /// The first layer that is free wherever a rectangle is.
    fn first_free(&self, rect: &PixelRect) -> usize {
        rect.tiles(self.across).map(|tile| self.tiles[tile].free).max().unwrap_or(0)
    }

    /// Takes a layer of its own wherever a rectangle is, and gives its number.
    fn take_layer(&mut self, rect: &PixelRect) -> usize {
        let layer = self.first_free(rect);
        rect.tiles(self.across).for_each(|tile| self.tiles[tile] = TileState { free: layer + 1, small: None });
        layer
    }

    fn add_cluster(&mut self, cluster: &[usize]) {
        let key = self.key;
        let body_rects = |member: &usize| {
            let member = *member;
            let bodies = key.bubbles[member].bodies.iter();
            bodies.map(move |body| (member, PixelRect::around(body.bounds, key.size)))
        };
        let bodies: Vec<(usize, PixelRect)> = cluster.iter().flat_map(body_rects).collect();
        let far: Vec<usize> = bodies.iter().map(|(_, rect)| self.take_layer(rect)).collect();
        let behind_layer = cluster.iter().map(|member| self.first_free(&self.rects[*member])).max().unwrap_or(0);
        for &member in cluster {
            let rect = self.rects[member].clone();
            let layer = self.first_free(&rect).max(behind_layer);
            rect.tiles(self.across).for_each(|tile| self.tiles[tile] = TileState { free: layer + 1, small: None });
            let overlaps = |other: &usize| *other != member && rect.overlaps(&self.rects[*other]);
            let among: Vec<usize> = cluster.iter().copied().filter(overlaps).collect();
            let mirrored = mirrored(self.key, member, &among);
            let mirrors = !among.is_empty() || !mirrored.is_empty();
            self.placed[member] =
                Some(Placed { rect, layer, behind_layer, among, mirrored, mirrors, bodies: Vec::new() });
        }
        for ((member, rect), far) in bodies.into_iter().zip(far) {
            let layers = [far, self.take_layer(&rect)];
            if let Some(placed) = &mut self.placed[member] {
                placed.bodies.push(PlacedBody { rect, layers });
            }
        }
    }

    /// Small bubbles of one material share a layer, in which each lies over those before it.
    fn add_small(&mut self, place: usize) {
        let small = &self.key.small[place];
        let material = self.key.lent[small.lent].material;
        let rect = PixelRect::around(small.bounds, self.key.size);
        let layer_of = |tile: &TileState| match tile.small {
            Some([layer, of]) if of == material => layer,
            _ => tile.free,
        };
        let Some(layer) = rect.tiles(self.across).map(|tile| layer_of(&self.tiles[tile])).max() else { return };
        let state = TileState { free: layer + 1, small: Some([layer, material]) };
        rect.tiles(self.across).for_each(|tile| self.tiles[tile] = state);
        self.small.entry([layer, material]).or_default().push(PlacedSmall { place, rect });
    }
}

/// Draws bubbles by the same shaders that differ by little: to compile shaders for each kind takes longer than a frame.
fn share_pipelines(key: &DrawKey, composition: &mut Composition) {
    let Composition { placed, small } = composition;
    // Small bubbles are always drawn over a picture.
    if !small.is_empty() || placed.iter().any(|placed| placed.layer > 0 || !placed.among.is_empty()) {
        for placed in &mut *placed {
            (placed.layer, placed.behind_layer) = (placed.layer + 1, placed.behind_layer + 1);
            placed.bodies.iter_mut().for_each(|body| body.layers = body.layers.map(|layer| layer + 1));
        }
        *small = std::mem::take(small).into_iter().map(|([layer, of], places)| ([layer + 1, of], places)).collect();
    }
    if placed.iter().any(|placed| !placed.mirrored.is_empty()) {
        for (bubble, placed) in key.bubbles.iter().zip(placed) {
            placed.mirrors |= max_mirrored(key, bubble) > 0;
        }
    }
}

/// Radius of a bubble in the picture, in pixels; more than any picture from inside.
fn radius_pixels(key: &DrawKey, bubble: &BubbleKey) -> f64 {
    let distance_m = bubble.center_m.distance(key.camera.eye_m);
    if distance_m <= bubble.radius_m {
        return f64::INFINITY;
    }
    bubble.radius_m / distance_m / key.camera.pixel_height_m
}

/// Bubbles that intersect, directly or through others, in the order of the nearest of each; most are alone.
fn clusters(key: &DrawKey) -> Vec<Vec<usize>> {
    let mut clusters: Vec<Vec<usize>> = Vec::new();
    // Clusters of bubbles that are large enough for one to see.
    let mut large: Vec<usize> = Vec::new();
    for (index, bubble) in key.bubbles.iter().enumerate() {
        if radius_pixels(key, bubble) < SMALLEST_PIXELS {
            clusters.push(vec![index]);
            continue;
        }
        let intersects = |other: &usize| {
            let other = &key.bubbles[*other];
            other.center_m.distance(bubble.center_m) < other.radius_m + bubble.radius_m
        };
        let (joined, apart): (Vec<usize>, Vec<usize>) =
            large.into_iter().partition(|cluster| clusters[*cluster].iter().any(intersects));
        let members: Vec<usize> = joined.iter().flat_map(|cluster| std::mem::take(&mut clusters[*cluster])).collect();
        large = apart;
        large.push(clusters.len());
        clusters.push(members.into_iter().chain([index]).collect());
    }
    clusters.retain(|cluster| !cluster.is_empty());
    clusters
}

/// How many others a bubble mirrors at most.
fn max_mirrored(key: &DrawKey, bubble: &BubbleKey) -> usize {
    match key.lighting.films[bubble.material].quadrature.quality {
        _ if radius_pixels(key, bubble) < SMALLEST_PIXELS => 0,
        Quality::Fast => 0,
        Quality::Standard => 8,
        Quality::Spectral => 32,
    }
}

/// Bubbles that a bubble mirrors: those that look largest from it.
fn mirrored(key: &DrawKey, index: usize, among: &[usize]) -> Vec<usize> {
    let bubble = &key.bubbles[index];
    let most = max_mirrored(key, bubble);
    if most == 0 {
        return Vec::new();
    }
    let size = |other: &usize| {
        let other = &key.bubbles[*other];
        other.radius_m / other.center_m.distance(bubble.center_m)
    };
    let others = (0..key.bubbles.len()).filter(|other| *other != index && !among.contains(other));
    let mut seen: Vec<usize> = others.filter(|other| size(other) >= SMALLEST_MIRRORED).collect();
    seen.sort_by(|a, b| size(b).total_cmp(&size(a)));
    seen.truncate(most);
    seen
}

#[cfg(test)]
mod tests;
