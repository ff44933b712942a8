//! Pictures that are sums: of all lights of a scene, and of what bubbles add to what they leave of a photograph.

use super::{Renderer, Target};
use crate::{
    gpu::{
        composition::Composition,
        device::GpuError,
        draw::view_uniform,
        formats::radiance_format,
        passes::{add_light::add_light, lay_plate::lay_plate},
        timing::Recorder,
    },
    plan::{DrawKey, Lighting},
};

impl Renderer {
    /// Adds to the picture in the scene's own light the pictures in all other lights, and lays the photograph behind the sum.
    pub(super) fn add_lights(
        &mut self,
        key: &DrawKey,
        composition: &Composition,
        mut radiance: Target,
    ) -> Result<Target, GpuError> {
        for (light, lighting) in key.spectral_lights.iter().enumerate() {
            let sum = self.add(key, composition, (light + 1, lighting), |recorder, added, sum| {
                add_light(recorder, key.full_precision, [&radiance.view, added], sum)
            })?;
            self.products.sum = Some(std::mem::replace(&mut radiance, sum));
        }
        if let Some(plate) = self.products.plate.take().filter(|_| key.plate.is_some()) {
            let white = key.before_white().lighting;
            let laid = self.add(key, composition, (0, &white), |recorder, through, laid| {
                let pictures = [&radiance.view, through, &plate.view];
                lay_plate(recorder, (key, &view_uniform(key)), pictures, laid)
            })?;
            self.products.sum = Some(std::mem::replace(&mut radiance, laid));
            self.products.plate = Some(plate);
        }
        Ok(radiance)
    }

    /// Draws the picture in one light, and adds it to others: `add` is given the picture and where the sum goes.
    fn add(
        &mut self,
        key: &DrawKey,
        composition: &Composition,
        light: (usize, &Lighting),
        add: impl FnOnce(&mut Recorder<'_>, &wgpu::TextureView, &wgpu::TextureView) -> Result<(), GpuError>,
    ) -> Result<Target, GpuError> {
        let format = radiance_format(key.full_precision);
        let [added, sum] = [self.products.added.take(), self.products.sum.take()]
            .map(|slot| Target::fit(slot, &self.gpu, "added light", key.size, format));
        self.draw_light(key, composition, light, &added)?;
        let mut recorder = Recorder::new(&self.gpu);
        add(&mut recorder, &added.view, &sum.view)?;
        Self::submit(&self.times, &mut self.counts, recorder);
        self.products.added = Some(added);
        Ok(sum)
    }
}
