//! Two pictures beside each other, A and B of a split view, and the map of how far they are apart. A was kept; B is the picture that is shown, or was
//! made in another quality.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

use super::colour_map::viridis;
use crate::{scene::Quality, studio::difference};

/// Memory that earlier pictures may take, bytes.
const MEMORY_BYTES: usize = 256 << 20;

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
    /// All pictures that were A since the comparison began, the oldest first, as far as memory allows.
    pub memory: Vec<Named>,
    /// The place of A among them.
    pub at: usize,
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
        let split = if self.memory.is_empty() { 0.5 } else { self.split };
        *self = Self { memory: std::mem::take(&mut self.memory), split, ..Self::default() };
        self.remember((pixels, name));
    }

    /// A, if there is one.
    #[must_use]
    pub fn kept(&self) -> Option<&Named> {
        self.memory.get(self.at)
    }

    /// Makes a picture A, and the latest of all.
    fn remember(&mut self, picture: Named) {
        let bytes = |(pixels, _): &Named| pixels.rgba.len();
        self.memory.push(picture);
        while self.memory.len() > 1 && self.memory.iter().map(bytes).sum::<usize>() > MEMORY_BYTES {
            self.memory.remove(0);
        }
        self.at = self.memory.len() - 1;
    }

    /// Makes an earlier or a later picture A.
    pub fn flip(&mut self, places: isize) {
        self.at = self.at.saturating_add_signed(places).min(self.memory.len().saturating_sub(1));
        self.map = None;
    }

    /// Puts a picture on a side; what was measured of the two no longer holds.
    pub fn put(&mut self, side: Side, pixels: Pixels, name: String) {
        self.map = None;
        match (side, self.memory.last_mut()) {
            (Side::B, _) => self.other = Some((pixels, name)),
            // A reference picture comes again and again, each time finer, whatever is looked at meanwhile.
            (Side::A, Some(last)) if last.1 == name => last.0 = pixels,
            (Side::A, _) => self.remember((pixels, name)),
        }
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

    fn pixels(grey: u8) -> Pixels {
        Pixels { size: [2, 1], rgba: Arc::new(vec![grey, grey, grey, 255, 9, 9, 9, 255]) }
    }

    #[test]
    fn earlier_pictures_are_flipped_through() {
        let mut compare = Compare::default();
        let name = |compare: &Compare| compare.kept().unwrap().1.clone();
        for (grey, name) in [(1, "one"), (2, "two"), (3, "three")] {
            compare.keep(pixels(grey), name.to_owned());
        }
        assert_eq!((name(&compare), compare.memory.len()), ("three".to_owned(), 3));
        compare.flip(-2);
        assert_eq!(name(&compare), "one");
        compare.flip(-1);
        assert_eq!(name(&compare), "one", "there is none before it");
        compare.flip(1);
        assert_eq!((name(&compare), compare.at), ("two".to_owned(), 1));
        compare.put(Side::A, pixels(4), "reference".to_owned());
        compare.put(Side::A, pixels(5), "reference".to_owned());
        assert_eq!((compare.memory.len(), compare.at), (4, 3), "a finer picture takes the place of the coarser one");
        compare.flip(-3);
        compare.put(Side::A, pixels(6), "reference".to_owned());
        assert_eq!((compare.memory.len(), name(&compare)), (4, "one".to_owned()), "what is looked at stays");
        let whole = Pixels { size: [1, 1], rgba: Arc::new(vec![0; MEMORY_BYTES]) };
        compare.keep(whole, "large".to_owned());
        assert_eq!((compare.memory.len(), name(&compare)), (1, "large".to_owned()));
        compare.close();
        assert_eq!(compare.kept(), None);
    }

    #[test]
    fn a_map_has_the_colours_of_its_scale() {
        let map = Map::new(&pixels(0), &pixels(255));
        assert_eq!(map.pixels.rgba[..3], viridis(1.0));
        assert_eq!(map.pixels.rgba[4..7], viridis(0.0));
        assert!((map.mean - 50.0).abs() < 1e-6, "black and white are 100 apart: {}", map.mean);
    }
}
