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
//! the picture, in any order, and takes from it what others leave (`passed_others` in `shaders/pass/bubble.wgsl`).

use std::ops::Range;

use crate::{
    plan::{BubbleKey, DrawKey},
    scene::Quality,
};

/// Side of the tiles that overlaps are found by, in pixels.
const TILE: u32 = 16;
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
    /// All pixels that a bubble's rings touch, with a little more: rings are polygons around the outline.
    #[must_use]
    fn around(bubble: &BubbleKey, [width, height]: [u32; 2]) -> Self {
        let [low, high] = bubble.bounds;
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

    /// Tiles that it touches, of a picture that is so many of them wide.
    fn tiles(&self, across: u32) -> impl Iterator<Item = usize> + use<> {
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
    /// Its layer; 0 for bubbles with nothing but the backdrop behind them.
    pub layer: usize,
    /// The layer before which all is drawn that is behind its whole cluster.
    pub behind_layer: usize,
    /// The other bubbles of its cluster, by their place in the picture's list.
    pub among: Vec<usize>,
    /// Bubbles outside of its cluster that it mirrors.
    pub mirrored: Vec<usize>,
}

/// The place of each bubble of a picture, whose bubbles are listed farthest first.
#[must_use]
pub fn composition(key: &DrawKey) -> Vec<Placed> {
    let clusters = clusters(key);
    let [across, down] = key.size.map(|pixels| pixels.div_ceil(TILE));
    let mut next = vec![0; (across * down) as usize];
    let mut placed: Vec<Option<Placed>> = vec![None; key.bubbles.len()];
    for first in 0..key.bubbles.len() {
        if placed[first].is_some() {
            continue;
        }
        let rect = |member: usize| PixelRect::around(&key.bubbles[member], key.size);
        let cluster = &clusters[first];
        let tiles = cluster.iter().flat_map(|member| rect(*member).tiles(across));
        // A cluster adds to a picture, which the backdrop is the first of.
        let behind_layer = tiles.map(|tile| next[tile]).max().unwrap_or(0).max(usize::from(cluster.len() > 1));
        for &member in cluster {
            let rect = rect(member);
            let layer = rect.tiles(across).map(|tile| next[tile]).max().unwrap_or(0).max(behind_layer);
            rect.tiles(across).for_each(|tile| next[tile] = layer + 1);
            let among = cluster.iter().copied().filter(|other| *other != member).collect();
            let mirrored = mirrored(key, member, cluster);
            placed[member] = Some(Placed { rect, layer, behind_layer, among, mirrored });
        }
    }
    placed.into_iter().flatten().collect()
}

/// Radius of a bubble in the picture, in pixels; more than any picture from inside.
fn radius_pixels(key: &DrawKey, bubble: &BubbleKey) -> f64 {
    let distance_m = bubble.center_m.distance(key.camera.eye_m);
    if distance_m <= bubble.radius_m {
        return f64::INFINITY;
    }
    bubble.radius_m / distance_m / key.camera.pixel_height_m
}

/// For each bubble the bubbles of its cluster, itself too.
fn clusters(key: &DrawKey) -> Vec<Vec<usize>> {
    let count = key.bubbles.len();
    let is_large = |index: &usize| radius_pixels(key, &key.bubbles[*index]) >= SMALLEST_PIXELS;
    let large: Vec<usize> = (0..count).filter(is_large).collect();
    let mut cluster_of: Vec<usize> = (0..count).collect();
    for (k, &one) in large.iter().enumerate() {
        for &other in &large[..k] {
            let [a, b] = [&key.bubbles[one], &key.bubbles[other]];
            let [from, to] = [cluster_of[one], cluster_of[other]];
            if from != to && a.center_m.distance(b.center_m) < a.radius_m + b.radius_m {
                cluster_of.iter_mut().filter(|cluster| **cluster == from).for_each(|cluster| *cluster = to);
            }
        }
    }
    let members = |index: usize| (0..count).filter(|other| cluster_of[*other] == cluster_of[index]).collect();
    (0..count).map(members).collect()
}

/// Bubbles that a bubble mirrors: those that look largest from it.
fn mirrored(key: &DrawKey, index: usize, cluster: &[usize]) -> Vec<usize> {
    let bubble = &key.bubbles[index];
    let most = match key.lighting.films[bubble.material].quadrature.quality {
        Quality::Fast => 0,
        Quality::Standard => 8,
        Quality::Spectral => 32,
    };
    if most == 0 || radius_pixels(key, bubble) < SMALLEST_PIXELS {
        return Vec::new();
    }
    let size = |other: &usize| {
        let other = &key.bubbles[*other];
        other.radius_m / other.center_m.distance(bubble.center_m)
    };
    let others = (0..key.bubbles.len()).filter(|other| !cluster.contains(other));
    let mut seen: Vec<usize> = others.filter(|other| size(other) >= SMALLEST_MIRRORED).collect();
    seen.sort_by(|a, b| size(b).total_cmp(&size(a)));
    seen.truncate(most);
    seen
}
