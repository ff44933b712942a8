//! Two pictures beside each other, A and B of a split view, and the map of how far they are apart. A was kept; B is the picture that is shown, or was
//! made in another quality.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::colour_map::viridis;
use crate::{scene::Quality, studio::difference};

/// The CIEDE2000 that the brightest colour of a map stands for.
pub const MAP_SCALE: f64 = 5.0;
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
            let [r, g, b] = viridis(delta_e / MAP_SCALE);
            [r, g, b, 255]
        });
        let pixels = Pixels { size: a.size, rgba: Arc::new(rgba.collect()) };
        Self { pixels, mean: difference.mean, p999: difference.p999 }
    }
}

/// One of the two pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The one on the left.
    A,
    /// The one on the right.
    B,
}

/// What is asked of the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Want {
    /// The picture that is shown, to be kept as A.
    Keep,
    /// The picture that is shown, to be compared with A.
    Map,
    /// To go to the clipboard.
    Copy,
    /// The moment that is shown, in another quality.
    Draw(Side, Quality),
    /// The moment that is shown, computed in f64.
    Reference(Side),
}

/// A picture with what it is called.
pub type Named = (Pixels, String);

/// Two pictures, and how they are compared.
#[derive(Clone, Debug, Default)]
pub struct Compare {
    /// A.
    pub kept: Option<Named>,
    /// B, unless it is the picture as it is shown.
    pub other: Option<Named>,
    /// Part of the picture's width that shows A.
    pub split: f32,
    /// How far A and B were apart when they were compared.
    pub map: Option<Map>,
    /// What is asked of the device.
    pub wants: Option<Want>,
    /// Part of a reference picture that is computed, while it is.
    pub done: Option<f32>,
    /// Tells the computation of a reference picture to stop, once it is set.
    pub stop: Arc<AtomicBool>,
}

impl Compare {
    /// Keeps a picture as A.
    pub fn keep(&mut self, pixels: Pixels, name: String) {
        self.stop.store(true, Ordering::Relaxed);
        *self = Self { kept: Some((pixels, name)), split: 0.5, ..Self::default() };
    }

    /// Puts a picture on a side; what was measured of the two no longer holds.
    pub fn put(&mut self, side: Side, pixels: Pixels, name: String) {
        self.map = None;
        *(match side {
            Side::A => &mut self.kept,
            Side::B => &mut self.other,
        }) = Some((pixels, name));
    }

    /// Forgets both pictures.
    pub fn close(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        *self = Self::default();
    }

    /// The signal that stops a new computation of a reference picture; an older one stops.
    pub fn begin_reference(&mut self) -> Arc<AtomicBool> {
        self.stop.store(true, Ordering::Relaxed);
        self.stop = Arc::default();
        self.done = Some(0.0);
        self.stop.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_map_has_the_colours_of_its_scale() {
        let pixels = |grey: u8| Pixels { size: [2, 1], rgba: Arc::new(vec![grey, grey, grey, 255, 9, 9, 9, 255]) };
        let map = Map::new(&pixels(0), &pixels(255));
        assert_eq!(map.pixels.rgba[..3], viridis(1.0));
        assert_eq!(map.pixels.rgba[4..7], viridis(0.0));
        assert!((map.mean - 50.0).abs() < 1e-6, "black and white are 100 apart: {}", map.mean);
    }
}
