//! What a lens and a film do to the linear picture before it is shown: glare, vignetting, grain.

use bytemuck::Zeroable;

use crate::{
    gpu::{
        device::{Gpu, GpuError},
        formats::radiance_format,
        kernel::{Drawable, Texture2d, Uniform, kernels, shader_struct},
        target::Target,
        timing::Recorder,
    },
    physics::picture::Finish,
    plan::TonemapKey,
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
    halves: Vec<[Target; 2]>,
    picture: Option<Target>,
}

impl Finished {
    /// Records the finish of a linear picture, and returns its result.
    pub fn record(
        &mut self,
        recorder: &mut Recorder<'_>,
        key: &TonemapKey,
        radiance: &Target,
    ) -> Result<&Target, GpuError> {
        let (gpu, format) = (recorder.gpu, radiance_format(false));
        let Finish { vignetting_ev, grain, grain_seed, .. } = key.finish;
        let shares: Vec<f32> = key.finish.shares(key.draw.size).into_iter().map(|share| share as f32).collect();
        self.fit_halves(gpu, key.draw.size, shares.len());
        let glare = self.record_glare(recorder, radiance, &shares)?;
        let uniform = FinishUniform {
            share: shares.iter().sum(),
            coarser: if glare.is_some() { 1.0 } else { 0.0 },
            vignetting_ev: vignetting_ev as f32,
            grain: grain as f32,
            exposure: key.exposure() as f32,
            grain_seed,
            ..FinishUniform::zeroed()
        };
        let uniform = gpu.uniform("finish", &uniform);
        let halves = &glare.unwrap_or(radiance).view;
        let finish = FinishPicture { finish: &uniform, picture: &radiance.view, halves }.cover(gpu, &[format])?;
        let picture = Target::fit(self.picture.take(), gpu, "finished", key.draw.size, format);
        draw(recorder, &picture, &finish);
        Ok(self.picture.insert(picture))
    }

    /// Room for a number of levels of a picture.
    fn fit_halves(&mut self, gpu: &Gpu, size: [u32; 2], count: usize) {
        let mut before = std::mem::take(&mut self.halves).into_iter();
        let level = |level: usize| {
            let slots = before.next().map_or([None, None], |slots| slots.map(Some));
            let size = size.map(|pixels| pixels.div_ceil(1 << level));
            slots.map(|slot| Target::fit(slot, gpu, "glare", size, radiance_format(false)))
        };
        self.halves = (1..=count).map(level).collect();
    }

    /// Records the sum of all levels, each with its share, and returns it at the size of the first; none without levels.
    fn record_glare(
        &self,
        recorder: &mut Recorder<'_>,
        radiance: &Target,
        shares: &[f32],
    ) -> Result<Option<&Target>, GpuError> {
        let (gpu, format) = (recorder.gpu, radiance_format(false));
        let mut finer = radiance;
        for [half, _] in &self.halves {
            draw(recorder, half, &Halve { picture: &finer.view }.cover(gpu, &[format])?);
            finer = half;
        }
        let mut coarser: Option<&Target> = None;
        for ([half, sum], &share) in self.halves.iter().zip(shares).rev() {
            let uniform =
                FinishUniform { share, coarser: if coarser.is_some() { 1.0 } else { 0.0 }, ..FinishUniform::zeroed() };
            let uniform = gpu.uniform("finish", &uniform);
            let halves = &coarser.unwrap_or(half).view;
            draw(recorder, sum, &Spread { finish: &uniform, picture: &half.view, halves }.cover(gpu, &[format])?);
            coarser = Some(sum);
        }
        Ok(coarser)
    }
}

fn draw(recorder: &mut Recorder<'_>, target: &Target, drawable: &Drawable) {
    recorder.render("finish", &target.view, None, |pass| drawable.draw(pass, 3));
    recorder.counts.draws += 1;
}
