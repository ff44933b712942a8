//! The key of the photograph behind the bubbles.

use std::sync::Arc;

use crate::physics::picture::Plate;

/// A photograph behind the bubbles, and the part of the picture that is drawn.
#[derive(Clone, Debug)]
pub struct PlateKey {
    /// The photograph.
    pub plate: Arc<Plate>,
    /// Width and height in pixels of the picture that it fills.
    pub whole: [u32; 2],
    /// Column and row in that picture of the first pixel that is drawn.
    pub corner: [u32; 2],
    /// Width and height in pixels of what is drawn.
    pub size: [u32; 2],
}

impl PartialEq for PlateKey {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.plate, &other.plate)
            && (self.whole, self.corner, self.size) == (other.whole, other.corner, other.size)
    }
}

impl PlateKey {
    /// Its pixels in what is drawn, linear BT.709, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> Vec<[f32; 3]> {
        let [columns, rows] = [0, 1].map(|axis| self.corner[axis]..self.corner[axis] + self.size[axis]);
        self.plate.fitted(self.whole, &columns, &rows)
    }
}
