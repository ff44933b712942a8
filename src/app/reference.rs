//! The reference picture of what is shown: its light path in f64 on the CPU, coarse at first, then finer and finer.

use glam::DVec3;

use crate::{
    parallel,
    plan::TonemapKey,
    verify::reference::{MovedFilms, ReferenceError, radiance_of},
};

/// Distances in pixels between the pixels that are computed first, next, and so on, each half of the one before.
const STRIDES: [u32; 5] = [16, 8, 4, 2, 1];
/// Pixels between two reports.
const BATCH: usize = 8192;

/// The picture so far.
pub struct Progress {
    /// RGBA, 8 bits of sRGB.
    pub rgba: Vec<u8>,
    /// Part of its pixels that are computed.
    pub done: f32,
}

/// Computes a picture; glare, vignetting and grain need all of its pixels, and come last. `films` are films as the device has moved them. `tell` hears of the picture as it becomes finer, and answers whether to go on.
///
/// # Errors
/// A film that must come from the device and is not there.
pub fn paint(
    key: &TonemapKey,
    films: &MovedFilms,
    mut tell: impl FnMut(Progress) -> bool,
) -> Result<(), ReferenceError> {
    let [width, height] = key.draw.size;
    let (display, mut rgba) = (key.display(), vec![0; 4 * (width * height) as usize]);
    let mut whole = vec![DVec3::ZERO; (width * height) as usize];
    let mut computed = 0;
    for stride in STRIDES {
        for pixels in pixels_of(stride, key.draw.size).chunks(BATCH) {
            let radiance = radiance_of(&key.draw, films, pixels)?;
            let colours = parallel::map(pixels.len(), |k| display.encode(radiance[k], pixels[k]));
            pixels
                .iter()
                .zip(colours)
                .for_each(|(pixel, colour)| fill(&mut rgba, [width, height], *pixel, stride, colour));
            pixels.iter().zip(radiance).for_each(|([x, y], radiance)| whole[(y * width + x) as usize] = radiance);
            computed += pixels.len();
            if computed == whole.len() {
                break;
            }
            let done = computed as f32 / whole.len() as f32;
            if !tell(Progress { rgba: rgba.clone(), done }) {
                return Ok(());
            }
        }
    }
    tell(Progress { rgba: key.shown(key.draw.size, whole), done: 1.0 });
    Ok(())
}

/// The pixels at a distance from one another that no coarser distance has, row by row.
fn pixels_of(stride: u32, [width, height]: [u32; 2]) -> Vec<[u32; 2]> {
    let is_known = |x: u32, y: u32| x.is_multiple_of(2 * stride) && y.is_multiple_of(2 * stride);
    let is_new = |x: u32, y: u32| stride == STRIDES[0] || !is_known(x, y);
    let along = |side: u32| (0..side).step_by(stride as usize);
    along(height).flat_map(|y| along(width).filter(move |x| is_new(*x, y)).map(move |x| [x, y])).collect()
}

/// Fills the square of which a pixel is the first one.
fn fill(rgba: &mut [u8], [width, height]: [u32; 2], [x, y]: [u32; 2], stride: u32, [r, g, b]: [u8; 3]) {
    for row in y..(y + stride).min(height) {
        for column in x..(x + stride).min(width) {
            let at = 4 * (row * width + column) as usize;
            rgba[at..at + 4].copy_from_slice(&[r, g, b, u8::MAX]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        input::load_scene,
        physics::{colour::Gamut, picture::Finish},
        plan::{Moment, Pace, Shot},
        scene::Lens,
        verify::reference::radiance,
    };

    #[test]
    fn every_pixel_is_computed_once() {
        let size = [37, 50];
        let mut all: Vec<_> = STRIDES.iter().flat_map(|stride| pixels_of(*stride, size)).collect();
        all.sort_unstable();
        assert_eq!(all.len(), 37 * 50);
        all.dedup();
        assert_eq!(all.len(), 37 * 50);
    }

    #[test]
    fn the_end_is_the_reference_picture_of_the_command_line() {
        let mut scene = load_scene("furnace").unwrap();
        scene.scene.lens = Lens { glare: 0.2, vignetting_ev: 1.0, grain: 0.1, ..Lens::default() };
        let (size, moment) = ([40, 30], Moment::default());
        let shot = Shot { size, moment, full_precision: false, gamut: Gamut::Srgb, pace: Pace::Whole };
        let key = scene.request(&shot).unwrap().picture;
        let (mut last, mut parts) = (Vec::new(), Vec::new());
        let tell = |progress: Progress| {
            (last, _) = (progress.rgba, parts.push(progress.done));
            true
        };
        paint(&key, &MovedFilms::new(), tell).unwrap();
        let whole = radiance(&key.draw, &MovedFilms::new(), &|| ()).unwrap();
        assert!(key.finish != Finish::default() && last == key.shown(size, whole));
        assert!(parts.windows(2).all(|pair| pair[0] < pair[1]) && parts.last() == Some(&1.0), "{parts:?}");
        let mut calls = 0;
        paint(&key, &MovedFilms::new(), |_| {
            calls += 1;
            false
        })
        .unwrap();
        assert_eq!(calls, 1, "it stops where nobody wants more");
    }
}
