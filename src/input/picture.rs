//! Pictures as files have them.

use std::path::Path;

use super::chromaticities::RgbSpace;
use super::error::{InputError, MAX_ENVIRONMENT_WIDTH, MAX_PLATE_SIDE};

/// A picture as its file has it.
#[derive(Debug)]
pub(super) struct DecodedPicture {
    pub width: usize,
    pub height: usize,
    /// Linear RGB, row by row from the top left.
    pub pixels: Vec<[f32; 3]>,
    pub space: RgbSpace,
    /// What a user should know of how it was read, a sentence each that goes on from the file's name.
    pub notes: Vec<String>,
}

/// What a picture is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    /// The whole sphere in one picture, twice as wide as high.
    Panorama,
    /// A picture of any shape.
    Any,
}

/// Checks the size that a file's header claims, before memory is set aside for it.
pub(super) fn check_size(path: &Path, width: usize, height: usize, shape: Shape) -> Result<(), InputError> {
    let path = || path.to_owned();
    if shape == Shape::Any {
        let fits = (1..=MAX_PLATE_SIDE).contains(&width) && (1..=MAX_PLATE_SIDE).contains(&height);
        return if fits { Ok(()) } else { Err(InputError::PlateSize { path: path(), width, height }) };
    }
    if width < 2 || height < 1 {
        Err(InputError::TooSmall { path: path(), width, height })
    } else if Some(width) != height.checked_mul(2) {
        Err(InputError::NotTwoToOne { path: path(), width, height })
    } else if width > MAX_ENVIRONMENT_WIDTH {
        Err(InputError::TooLarge { path: path(), width, height })
    } else {
        Ok(())
    }
}
