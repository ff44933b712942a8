//! Pictures as they are drawn against the mean of many samples per pixel: what is left of jagged edges, moiré and missed highlights.

use glam::DVec3;

use super::{Extent, Run, picture::radiance};
use crate::{
    gpu::{GpuError, Renderer},
    physics::colour::Gamut,
    plan::{DrawKey, FrameRequest, Moment, Pace, Resources, Shot, TonemapKey, request},
    scene::{Quality, Scene},
};

/// When pictures are taken: films have begun to flow.
const TIME_S: f64 = 0.5;
/// Pixels along each side of a part of a supersampled picture: memory stays bounded.
const TILE_PIXELS: u32 = 2048;
/// Qualities that take few samples per pixel, and their smallest PSNR in dB.
const TARGETS_DB: [(Quality, f64); 2] = [(Quality::Standard, 40.0), (Quality::Fast, 36.0)];
/// Pictures of a size, and the samples along each side of a pixel that they are compared with.
struct Comparison {
    presets: &'static [&'static str],
    side: u32,
    samples: u32,
}

/// What a developer waits for: the smallest bubble, of 76 pixels, that does not take many samples everywhere. Its pixels span more, and errors are
/// larger: 4 dB above what one sample per pixel and lookup reaches.
const SHORT: (Comparison, f64) = (Comparison { presets: &["windows"], side: 192, samples: 4 }, 36.0);
/// At a common size.
const FULL: Comparison = Comparison { presets: &["windows"], side: 640, samples: 4 };
/// With as many samples as a reference needs, among films and surroundings of all kinds.
const LONG: Comparison =
    Comparison { presets: &["two_lights", "windows", "fresh", "giant", "park"], side: 640, samples: 8 };

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    let mut renderer = Renderer::new(pollster::block_on(run.gpu.another())?);
    let compared = match run.extent {
        Extent::Short => &SHORT.0,
        Extent::Full => &FULL,
        Extent::Long => &LONG,
    };
    for preset in compared.presets {
        let Some((mut scene, resources)) = (run.preset)(preset) else {
            return Err(GpuError::Refused(format!("there is no preset {preset}")));
        };
        scene.view.dither = false;
        // In a short run the quality whose pipelines are made soonest: both take the same lookups and samples in lines.
        let is_short = run.extent == Extent::Short;
        for (quality, target_db) in TARGETS_DB.into_iter().filter(|(quality, _)| !is_short || *quality == Quality::Fast)
        {
            scene.view.quality = quality;
            let error = error_over_white(&mut renderer, &scene, &resources, compared)?;
            let target_db = if is_short { SHORT.1 } else { target_db };
            let name = format!(
                "{preset}, {}, {} pixels: PSNR {:.1} dB, RMS error over white",
                quality.name(),
                compared.side,
                psnr_db(error)
            );
            run.at_most(name, error, 10f64.powf(-target_db / 20.0));
        }
    }
    Ok(())
}

/// Peak signal-to-noise ratio in dB, from the root of the mean squared error over the largest value.
fn psnr_db(error_over_white: f64) -> f64 {
    -20.0 * error_over_white.log10()
}

/// Root mean square difference of a picture's bytes from those of the mean of many samples, over white.
fn error_over_white(
    renderer: &mut Renderer,
    scene: &Scene,
    resources: &Resources,
    Comparison { side, samples, .. }: &Comparison,
) -> Result<f64, GpuError> {
    let size = [*side; 2];
    let plain = shot(scene, resources, size)?;
    let seen = radiance(renderer, &plain)?;
    let fine = shot(scene, resources, size.map(|pixels| samples * pixels))?;
    let truth = supersampled(renderer, &fine, *side, *samples)?;
    let [seen, truth] = [seen, truth].map(|pixels| plain.picture.shown(size, pixels));
    Ok(rms(&seen, &truth) / 255.0)
}

/// Root mean square difference of the colours of pixels of four bytes, in steps of 8 bits.
fn rms(seen: &[u8], truth: &[u8]) -> f64 {
    let squares = seen.iter().zip(truth).map(|(seen, truth)| f64::from(seen.abs_diff(*truth)).powi(2));
    // Alpha is the same everywhere: three of four bytes can differ.
    (squares.sum::<f64>() / (0.75 * seen.len() as f64)).sqrt()
}

fn shot(scene: &Scene, resources: &Resources, size: [u32; 2]) -> Result<FrameRequest, GpuError> {
    let shot = Shot {
        size,
        moment: Moment::of_time(TIME_S, scene.motion.tick_s),
        full_precision: true,
        gamut: Gamut::Srgb,
        pace: Pace::Whole,
    };
    request(scene, resources, &shot).map_err(|error| GpuError::Refused(error.to_string()))
}

/// The mean of each pixel's samples, in a square picture of a side; `fine` is the picture of all samples.
fn supersampled(renderer: &mut Renderer, fine: &FrameRequest, side: u32, samples: u32) -> Result<Vec<DVec3>, GpuError> {
    let mut sums = vec![DVec3::ZERO; (side * side) as usize];
    let tile = TILE_PIXELS / samples * samples;
    let starts = || (0..side * samples).step_by(tile as usize);
    for (top, left) in starts().flat_map(|top| starts().map(move |left| (top, left))) {
        let span = |start: u32| start..(start + tile).min(side * samples);
        let columns = span(left).len() as u32;
        let pixels = drawn(renderer, fine, fine.picture.draw.cut(&span(left), &span(top)))?;
        for (k, radiance) in (0u32..).zip(pixels) {
            let (column, row) = ((left + k % columns) / samples, (top + k / columns) / samples);
            sums[(row * side + column) as usize] += radiance;
        }
    }
    let scale = f64::from(samples * samples).recip();
    Ok(sums.into_iter().map(|sum| scale * sum).collect())
}

fn drawn(renderer: &mut Renderer, request: &FrameRequest, draw: DrawKey) -> Result<Vec<DVec3>, GpuError> {
    let picture = TonemapKey { draw, ..request.picture.clone() };
    radiance(renderer, &FrameRequest { picture, ..request.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn psnr_follows_from_the_colours_alone() {
        let error = rms(&[0, 0, 0, 255, 10, 10, 10, 255], &[3, 3, 3, 255, 7, 7, 7, 255]) / 255.0;
        assert!((error - 3.0 / 255.0).abs() < 1e-12);
        assert!((psnr_db(0.01) - 40.0).abs() < 1e-12);
    }
}
