//! What a lens and a film do to the linear picture before it is shown: glare, vignetting, grain.

use bytemuck::Zeroable;

use crate::{
    gpu::{
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::{Drawable, Texture2d, Uniform, kernels, shader_struct},
        target::Target,
        timing::Recorder,
        uniform_buffer::UniformBuffer,
    },
    plan::{Finish, TonemapKey},
};

shader_struct! {
    /// See `shaders/pass/finish.wgsl`.
    pub struct FinishUniform {
        /// Part of light that goes to a level of glare, or to all.
        pub share: f32,
        /// 1 if a coarser level is added, else 0.
        pub coarser: f32,
        /// Stops that the corners lose.
        pub vignetting_ev: f32,
        /// Grain of a radiance that is exposed as 1.
        pub grain: f32,
        /// Factor that exposes the picture.
        pub exposure: f32,
        /// Seed of the grain.
        pub grain_seed: u32,
        padding: [f32; 2],
    }
}

kernels! {
    pass finish;

    /// A picture at half its size.
    struct Halve {
        @1 picture: Texture2d;
    }
    draw cover as halved;

    /// A level of glare with all coarser ones.
    struct Spread {
        @0 finish: Uniform<FinishUniform>;
        @1 picture: Texture2d;
        @2 halves: Texture2d;
    }
    draw cover as spread;

    /// The linear picture as it is shown.
    struct FinishPicture {
        @0 finish: Uniform<FinishUniform>;
        @1 picture: Texture2d;
        @2 halves: Texture2d;
    }
    draw cover as finished;
}

/// The finished linear picture, and what it is made through.
#[derive(Default)]
pub struct Finished {
    /// Halves of halves of the picture, and the sums of each with all coarser ones.
    halves: Vec<[Option<Target>; 2]>,
    picture: Option<Target>,
}

/// Widths of glare: bells of an eighth of the picture's height, and so on down to a 256th.
const WIDTHS: u32 = 6;

/// Part of the glare of each level, the first half as large as the picture. Each bell takes 1.4 times the light of the next wider one, so the
/// point-spread function falls about as the power −2.5 of the distance, as those of lenses do, of −2 to −3 (McCann and Rizzi, The Art and Science
/// of HDR Imaging, 2012). Bells narrower than two pixels stay with the sharp picture.
fn shares(height: u32) -> Vec<f64> {
    let levels = f64::from(height.max(1)).log2().round() as usize;
    let of_width = |width: u32| 0.5f64.sqrt().powi(WIDTHS as i32 - 1 - width as i32);
    let total: f64 = (0..WIDTHS).map(of_width).sum();
    // Width 0 is an eighth of the height: level log2(height) − 3.
    let share = |level: usize| match levels.saturating_sub(3).checked_sub(level) {
        Some(width) if (width as u32) < WIDTHS => of_width(width as u32) / total,
        _ => 0.0,
    };
    (1..=levels.saturating_sub(3)).map(share).collect()
}

impl Finished {
    /// Records the finish of a linear picture, and returns its result.
    pub fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        key: &TonemapKey,
        radiance: &Target,
    ) -> Result<&Target, GpuError> {
        let gpu = recorder.gpu;
        let Finish { glare, vignetting_ev, grain, grain_seed } = key.finish;
        let [width, height] = key.draw.size;
        let shares: Vec<f64> = shares(width.min(height)).into_iter().map(|share| glare * share).collect();
        let count = if glare > 0.0 { shares.len() } else { 0 };
        self.halves.resize_with(count, Default::default);
        let format = radiance_format(false);
        for (level, slots) in self.halves.iter_mut().enumerate() {
            let size = key.draw.size.map(|pixels| pixels.div_ceil(1 << (level + 1)));
            for slot in slots {
                *slot = Some(Target::fit(slot.take(), gpu, "glare", size, format));
            }
        }
        self.picture = Some(Target::fit(self.picture.take(), gpu, "finished", key.draw.size, format));
        let levels: Vec<[&Target; 2]> =
            self.halves.iter().map(|slots| slots.each_ref().map(|slot| slot.as_ref().expect("made above"))).collect();
        for (level, [half, _]) in levels.iter().enumerate() {
            let finer = if level == 0 { radiance } else { levels[level - 1][0] };
            draw(recorder, half, Halve { picture: &finer.view }.cover(gpu, format)?);
        }
        for (level, [half, sum]) in levels.iter().enumerate().rev() {
            let coarser = levels.get(level + 1);
            let uniform = uniform(
                gpu,
                FinishUniform {
                    share: shares[level] as f32,
                    coarser: if coarser.is_some() { 1.0 } else { 0.0 },
                    ..FinishUniform::zeroed()
                },
            );
            let halves = &coarser.map_or(half, |[_, sum]| sum).view;
            draw(recorder, sum, Spread { finish: &uniform, picture: &half.view, halves }.cover(gpu, format)?);
        }
        let first = levels.first().map(|[_, sum]| *sum);
        let uniform = uniform(
            gpu,
            FinishUniform {
                share: shares[..count].iter().sum::<f64>() as f32,
                coarser: if first.is_some() { 1.0 } else { 0.0 },
                vignetting_ev: vignetting_ev as f32,
                grain: grain as f32,
                exposure: key.exposure() as f32,
                grain_seed,
                ..FinishUniform::zeroed()
            },
        );
        let halves = &first.unwrap_or(radiance).view;
        let picture = self.picture.as_ref().expect("made above");
        draw(
            recorder,
            picture,
            FinishPicture { finish: &uniform, picture: &radiance.view, halves }.cover(gpu, format)?,
        );
        Ok(picture)
    }
}

fn uniform(gpu: &Gpu, value: FinishUniform) -> UniformBuffer<FinishUniform> {
    gpu.uniform("finish", &value)
}

fn draw(recorder: &mut Recorder<'_>, target: &Target, drawable: Drawable) {
    recorder.render("finish", &target.view, None, |pass| drawable.draw(pass, 3));
    recorder.counts.draws += 1;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn glare_has_the_same_widths_in_pictures_of_all_sizes() {
        let (small, large) = (shares(256), shares(2048));
        assert_eq!((small.len(), large.len()), (5, 8));
        // From the widest on; the narrowest of the small picture is less than two pixels wide.
        let widest = |shares: &[f64]| shares.iter().rev().copied().take(5).collect::<Vec<_>>();
        assert_eq!(widest(&small), widest(&large));
        assert!((large.iter().sum::<f64>() - 1.0).abs() < 1e-12 && small.iter().sum::<f64>() < 1.0);
        assert!(shares(4).is_empty());
    }
}
