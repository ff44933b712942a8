//! Where the stored pixels lie in the picture.

use std::path::Path;

use ::exr::meta::header::Header;
use ::exr::prelude::Vec2;

use crate::input::InputError;
use crate::input::picture::{Shape, check_size};

/// The place of a part's stored pixels, its data window, in the picture, its display window.
///
/// Windows of the same size are one and the same wherever they lie. Else what is stored beyond the display window is cropped, and
/// what is not stored is black, as OpenEXR's viewers show it.
pub(super) struct Placement {
    /// Width and height of the picture.
    pub size: [usize; 2],
    /// Width and height of what is stored.
    stored: [usize; 2],
    /// Column and row of the first stored pixel in the picture.
    first: [i64; 2],
}

impl Placement {
    /// Refuses pictures of another shape, and pictures whose data window is outside of the display window.
    pub fn of(path: &Path, header: &Header, shape: Shape) -> Result<Self, InputError> {
        let (data, display) = (header.data_window(), header.shared_attributes.display_window);
        let (Vec2(width, height), Vec2(stored_width, stored_height)) = (display.size, data.size);
        check_size(path, width, height, shape)?;
        let shift = |data: i32, display: i32| i64::from(data) - i64::from(display);
        let first = match data.size == display.size {
            true => [0, 0],
            false => [shift(data.position.0, display.position.0), shift(data.position.1, display.position.1)],
        };
        let placement = Self { size: [width, height], stored: [stored_width, stored_height], first };
        if placement.both(|first, stored, size| first < size && first + stored > 0) {
            return Ok(placement);
        }
        let reason = format!(
            "its data window, {stored_width}x{stored_height} pixels at {},{}, is outside of its display window",
            first[0], first[1]
        );
        Err(InputError::Unsupported { path: path.to_owned(), reason })
    }

    /// Whether something holds of the first pixel, the stored pixels and the picture's pixels, along the columns and along the rows.
    fn both(&self, holds: impl Fn(i64, i64, i64) -> bool) -> bool {
        (0..2).all(|axis| holds(self.first[axis], self.stored[axis] as i64, self.size[axis] as i64))
    }

    /// What a user should know of it.
    pub fn note(&self) -> Option<String> {
        let is_whole = self.both(|first, stored, size| first <= 0 && first + stored >= size);
        let ([width, height], [stored_width, stored_height]) = (self.size, self.stored);
        let told =
            format!("holds only {stored_width}x{stored_height} of its {width}x{height} pixels; the others are black");
        (!is_whole).then_some(told)
    }

    /// The index in the picture of a stored pixel, unless it is cropped.
    pub fn index(&self, x: usize, y: usize) -> Option<usize> {
        let inside = |axis: usize, stored: usize| {
            let place = usize::try_from(self.first[axis] + stored as i64).ok()?;
            (place < self.size[axis]).then_some(place)
        };
        Some(inside(1, y)? * self.size[0] + inside(0, x)?)
    }
}
