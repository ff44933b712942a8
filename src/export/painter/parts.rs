//! The linear pictures that a file is made of, drawn or computed, at any number of samples per pixel.

use anyhow::Context;
use glam::{DVec3, Vec3};

use super::{Exposure, Painter, carry_out, finished::Passage};
use crate::{
    export::Progress,
    physics::picture::Finish,
    plan::{DrawKey, FrameRequest, TonemapKey},
    verify::reference::radiance,
};

/// Pixels along each side of the largest part of a picture that is drawn at once where pixels take several samples: memory stays bounded.
const TILE_PIXELS: u32 = 2048;

/// Of a picture with several samples per pixel, the rectangles that are drawn at once: the corner and the size of each, in pixels of the file.
pub(super) fn tiles([width, height]: [u32; 2], samples: u32) -> Vec<[[u32; 2]; 2]> {
    let side = if samples == 1 { u32::MAX } else { TILE_PIXELS / samples };
    let spans = |length: u32| (0..length).step_by(side as usize).map(move |start| (start, side.min(length - start)));
    spans(height).flat_map(|(y, rows)| spans(width).map(move |(x, columns)| [[x, y], [columns, rows]])).collect()
}

/// Pictures that [`Painter::passages`] draws.
pub(super) const PICTURES_OF_PASSAGES: u64 = 3;

impl Painter {
    /// Radiance of each pixel of the file, linear BT.2020: of the linear picture of a request, or of a part of it.
    fn radiance(
        &mut self,
        request: &FrameRequest,
        part: &dyn Fn(&DrawKey) -> DrawKey,
        progress: &Progress,
    ) -> anyhow::Result<Vec<Vec3>> {
        let draw = part(&request.picture.draw);
        if self.options.is_reference() {
            self.computed(request, draw, progress)
        } else {
            self.drawn(request, &draw, progress)
        }
    }

    /// As [`Self::radiance`], through the whole lens while the shutter is open, where the scene has them: the mean of pictures of one sample per pixel,
    /// each through another place of the lens.
    pub(super) fn exposed(
        &mut self,
        shot: &Exposure,
        part: &dyn Fn(&DrawKey) -> DrawKey,
        progress: &Progress,
    ) -> anyhow::Result<Vec<Vec3>> {
        let count = self.lens_samples();
        if count == 1 {
            return self.radiance(&shot.request, part, progress);
        }
        let mut sum = vec![DVec3::ZERO; self.options.size.map(|pixels| pixels as usize).iter().product()];
        for k in 0..count {
            let request = self.request_through(shot.moment, k, count)?;
            let draw = part(&request.picture.draw);
            let seen = if self.options.is_reference() {
                self.computed(&request, draw, progress)?
            } else {
                self.draw_tile(&request, draw, progress)?
            };
            sum.iter_mut().zip(seen).for_each(|(sum, seen)| *sum += seen.as_dvec3());
        }
        Ok(sum.into_iter().map(|sum| (sum / f64::from(count)).as_vec3()).collect())
    }

    fn computed(&mut self, request: &FrameRequest, draw: DrawKey, progress: &Progress) -> anyhow::Result<Vec<Vec3>> {
        progress.check()?;
        let films = self.moved_films(request)?;
        let rows = u64::from(draw.size[1]) * draw.lights().count() as u64;
        let part = progress.part(rows);
        let radiance = radiance(&draw, &films, &|| part.add(1))?;
        Ok(radiance.into_iter().map(|pixel| pixel.as_vec3()).collect())
    }

    fn drawn(&mut self, request: &FrameRequest, draw: &DrawKey, progress: &Progress) -> anyhow::Result<Vec<Vec3>> {
        let (size, samples) = (self.options.size, self.options.samples);
        let mut whole = vec![Vec3::ZERO; size[0] as usize * size[1] as usize];
        for [[x, y], [columns, rows]] in tiles(size, samples) {
            let span = |start: u32, length: u32| samples * start..samples * (start + length);
            let tile = self.draw_tile(request, draw.cut(&span(x, columns), &span(y, rows)), progress)?;
            for (row, pixels) in (y..).zip(means(&tile, columns, samples).chunks(columns as usize)) {
                let start = row as usize * size[0] as usize + x as usize;
                whole[start..start + pixels.len()].copy_from_slice(pixels);
            }
        }
        Ok(whole)
    }

    fn draw_tile(&mut self, request: &FrameRequest, draw: DrawKey, progress: &Progress) -> anyhow::Result<Vec<Vec3>> {
        let renderer = self.renderer()?;
        // Only radiance is read.
        let picture = TonemapKey { draw, finish: Finish::default(), ..request.picture.clone() };
        carry_out(renderer, &FrameRequest { picture, ..request.clone() }, progress)?;
        let bytes = renderer.read_radiance().context("no picture was drawn")?.wait(&renderer.gpu)?;
        let rgba: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        Ok(rgba.into_iter().map(|[r, g, b, _]| Vec3::new(r, g, b)).collect())
    }

    /// What bubbles add, and what they leave of light from behind.
    pub(super) fn passages(&mut self, shot: &Exposure, progress: &Progress) -> anyhow::Result<Vec<Passage>> {
        let through = self.exposed(shot, &DrawKey::before_white, progress)?;
        let white = self.exposed(shot, &|draw| draw.before_white().without_bubbles(), progress)?;
        let added = self.exposed(shot, &DrawKey::before_black, progress)?;
        let light = added.into_iter().zip(through).zip(white);
        Ok(light.map(|((added, through), white)| Passage { added, through, white }).collect())
    }
}

/// The mean of each pixel's samples, of a picture `columns` pixels wide.
fn means(samples: &[Vec3], columns: u32, side: u32) -> Vec<Vec3> {
    let (columns, side) = (columns as usize, side as usize);
    let scale = 1.0 / (side * side) as f64;
    let pixel = |row: &[Vec3], column: usize| {
        let lines = row.chunks(columns * side).flat_map(|line| &line[column * side..(column + 1) * side]);
        (lines.map(|sample| sample.as_dvec3()).sum::<glam::DVec3>() * scale).as_vec3()
    };
    let rows = samples.chunks(columns * side * side);
    rows.flat_map(|row| (0..columns).map(move |column| pixel(row, column))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_each_pixel_once() {
        for (size, samples) in [([7, 5], 1), ([1280, 720], 16), ([100, 3], 64)] {
            let mut hits = vec![0; (size[0] * size[1]) as usize];
            for [[x, y], [columns, rows]] in tiles(size, samples) {
                assert!(samples == 1 || columns.max(rows) * samples <= TILE_PIXELS);
                let pixels = (y..y + rows).flat_map(|y| (x..x + columns).map(move |x| y * size[0] + x));
                pixels.for_each(|pixel| hits[pixel as usize] += 1);
            }
            assert!(hits.iter().all(|hits| *hits == 1));
        }
    }

    #[test]
    fn pixels_are_the_means_of_their_samples() {
        let samples: Vec<Vec3> = (0..24).map(|k| Vec3::splat(k as f32)).collect();
        // 6 x 4 samples are 3 x 2 pixels.
        let expected = [3.5, 5.5, 7.5, 15.5, 17.5, 19.5].map(Vec3::splat);
        assert_eq!(means(&samples, 3, 2), expected);
    }
}
