//! Which bubbles are drawn together. A bubble shows what is drawn behind it, so bubbles that may overlap in the picture are drawn one after
//! the other, the farthest first; all others are drawn at once.

use std::ops::Range;

use crate::plan::{BubbleKey, DrawKey};

/// Side of the tiles that overlaps are found by, in pixels.
const TILE: u32 = 16;

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
    pub fn around(bubble: &BubbleKey, [width, height]: [u32; 2]) -> Self {
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

    /// Tiles that it touches.
    fn tiles(&self, across: u32) -> impl Iterator<Item = usize> {
        let span = |pixels: &Range<u32>| pixels.start / TILE..pixels.end.div_ceil(TILE);
        let columns = span(&self.columns);
        span(&self.rows).flat_map(move |row| columns.clone().map(move |column| (row * across + column) as usize))
    }
}

/// The layer of each bubble of a picture, whose bubbles are listed farthest first: 0 for bubbles with nothing but the backdrop behind them, else one more than
/// the highest layer of any bubble that may be behind.
#[must_use]
pub fn layers(key: &DrawKey) -> Vec<usize> {
    let [across, down] = key.size.map(|pixels| pixels.div_ceil(TILE));
    let mut next = vec![0; (across * down) as usize];
    let mut layer = |bubble: &BubbleKey| {
        let rect = PixelRect::around(bubble, key.size);
        let layer = rect.tiles(across).map(|tile| next[tile]).max().unwrap_or(0);
        rect.tiles(across).for_each(|tile| next[tile] = layer + 1);
        layer
    };
    key.bubbles.iter().map(&mut layer).collect()
}
