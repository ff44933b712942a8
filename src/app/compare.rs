//! A picture that is kept beside the one that is shown: A and B of a split view, and the map of how far they are apart.

use std::sync::Arc;

use crate::studio::difference;

/// The CIEDE2000 that the brightest colour of a map stands for.
pub const MAP_SCALE: f64 = 5.0;
/// Colours of a map from 0 to [`MAP_SCALE`]: five of viridis, as equally spaced as people see them.
pub const MAP_COLOURS: [[u8; 3]; 5] = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

/// Pixels of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Width and height.
    pub size: [u32; 2],
    /// Rows of RGBA, 8 bits of sRGB.
    pub rgba: Arc<Vec<u8>>,
}

/// How far the two pictures are apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// The map as a picture.
    pub pixels: Pixels,
    /// Mean CIEDE2000.
    pub mean: f64,
    /// What 99.9 % of the pixels do not exceed.
    pub p999: f64,
}

impl Map {
    /// The map of two pictures of one size.
    #[must_use]
    pub fn new(a: &Pixels, b: &Pixels) -> Self {
        let difference = difference(&a.rgba, &b.rgba);
        let rgba = difference.delta_e.iter().flat_map(|delta_e| {
            let [r, g, b] = map_colour(delta_e / MAP_SCALE);
            [r, g, b, 255]
        });
        let pixels = Pixels { size: a.size, rgba: Arc::new(rgba.collect()) };
        Self { pixels, mean: difference.mean, p999: difference.p999 }
    }
}

/// The colour of a part of the scale.
#[must_use]
pub fn map_colour(part: f64) -> [u8; 3] {
    let place = part.clamp(0.0, 1.0) * (MAP_COLOURS.len() - 1) as f64;
    let from = (place as usize).min(MAP_COLOURS.len() - 2);
    let mix = |k: usize| {
        let [low, high] = [from, from + 1].map(|stop| f64::from(MAP_COLOURS[stop][k]));
        (low + (place - from as f64) * (high - low)).round() as u8
    };
    [0, 1, 2].map(mix)
}

/// What the picture that is shown is read back for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// To be kept as A.
    Keep,
    /// To be compared with A.
    Map,
    /// To go to the clipboard.
    Copy,
}

/// A kept picture, and how it is compared.
#[derive(Clone, Debug, Default)]
pub struct Compare {
    /// A, with its name.
    pub kept: Option<(Pixels, String)>,
    /// Part of the picture's width that shows A.
    pub split: f32,
    /// How far A and B were apart when they were compared.
    pub map: Option<Map>,
    /// What is asked of the device.
    pub wants: Option<Want>,
}

impl Compare {
    /// Keeps a picture as A.
    pub fn keep(&mut self, pixels: Pixels, name: String) {
        *self = Self { kept: Some((pixels, name)), split: 0.5, ..Self::default() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_the_colours_of_its_scale() {
        assert_eq!(
            [0.0, 0.25, 1.0, 7.0].map(map_colour),
            [MAP_COLOURS[0], MAP_COLOURS[1], MAP_COLOURS[4], MAP_COLOURS[4]]
        );
        let pixels = |grey: u8| Pixels { size: [2, 1], rgba: Arc::new(vec![grey, grey, grey, 255, 9, 9, 9, 255]) };
        let map = Map::new(&pixels(0), &pixels(255));
        assert_eq!(map.pixels.rgba[..3], MAP_COLOURS[4]);
        assert_eq!(map.pixels.rgba[4..7], MAP_COLOURS[0]);
        assert!((map.mean - 50.0).abs() < 1e-6, "black and white are 100 apart: {}", map.mean);
    }
}
