//! A scene's film played on the device, and what is measured of films.

use glam::DVec3;

use crate::{
    gpu::{
        Gpu, GpuError,
        film::{Field, MovingFilm, rules},
        flow::FlowSolver,
        readback::Readback,
        transport_case::values,
    },
    physics::sphere::CubedSphere,
    plan::{FieldKey, FilmKey, Moment, Story},
    scene::Scene,
};

/// The first film of a scene, played on the device tick by tick as pictures have it.
pub struct Played<'a> {
    gpu: &'a Gpu,
    story: Story,
    film: MovingFilm,
    tick: u64,
}

impl<'a> Played<'a> {
    /// The film as it begins. Fails if it is uniform.
    pub fn new(gpu: &'a Gpu, scene: &Scene) -> Result<Self, GpuError> {
        let story = Story::new(scene.clone());
        let key = key(&story, 0)?;
        let sphere = CubedSphere::new(key.cells as usize).map_err(|error| GpuError::Refused(error.to_string()))?;
        let mut field = Field::new(gpu, sphere, rules(&key))?;
        field.seed(gpu, key.initial.profile());
        Ok(Self { gpu, story, film: MovingFilm::new(field), tick: 0 })
    }

    /// Takes the steps that end until a tick.
    pub fn play_to(&mut self, tick: u64) -> Result<(), GpuError> {
        /// Steps in one submission, so that none runs long.
        const STEPS: usize = 8;
        let key = key(&self.story, tick)?;
        let gpu = self.gpu;
        self.film.play(gpu, &key, self.tick, STEPS, |recorder| {
            recorder.submit(&Default::default());
            gpu.wait()
        })?;
        self.tick = key.state_tick();
        Ok(())
    }

    /// The flow, once it has moved.
    pub fn flow(&self) -> Result<&FlowSolver, GpuError> {
        self.film.flow().ok_or_else(|| GpuError::Refused("this film has not moved by itself".to_owned()))
    }

    /// Vorticity in 1/s, in the order of the flow's grid.
    pub fn zeta(&self) -> Result<Vec<f64>, GpuError> {
        let flow = self.flow()?;
        let bytes = Readback::of_buffer(self.gpu, flow.zeta(), flow.zeta().size()).wait(self.gpu)?;
        let padded: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
        Ok(flow.inner(&padded).into_iter().map(f64::from).collect())
    }

    /// Speed in rad/s at each cell of the flow's grid, and the velocity.
    pub fn velocity(&self) -> Result<Vec<DVec3>, GpuError> {
        let flow = self.flow()?;
        let bytes = Readback::of_buffer(self.gpu, flow.velocity(), flow.velocity().size()).wait(self.gpu)?;
        let padded: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
        let parts: [Vec<f32>; 3] = [0, 1, 2].map(|k| flow.inner(&padded.iter().map(|v| v[k]).collect::<Vec<_>>()));
        let [x, y, z] = parts;
        Ok((0..x.len()).map(|cell| DVec3::new(x[cell].into(), y[cell].into(), z[cell].into())).collect())
    }

    /// Thickness in nm, in the order of the film's grid.
    pub fn thickness(&mut self) -> Result<Vec<f64>, GpuError> {
        values(self.gpu, &mut self.film.field)
    }

    /// Grid of the thickness.
    pub fn sphere(&self) -> CubedSphere {
        self.film.field.sphere()
    }

    /// Since when the film rests, if it does, s.
    pub fn rests_since_s(&self) -> Option<f64> {
        self.film.rest().map(|rest| rest.since_tick as f64 * self.story.motion.tick_s)
    }

    /// Kinetic energy of the flow for a unit of mass per steradian: ½ ∫ u², rad²/s².
    pub fn energy(&self) -> Result<f64, GpuError> {
        let (areas, velocity) = (self.flow()?.sphere().areas(), self.velocity()?);
        Ok(areas.iter().zip(velocity).map(|(area, u)| 0.5 * area * u.length_squared()).sum())
    }

    /// The fastest flow, rad/s.
    pub fn fastest(&self) -> Result<f64, GpuError> {
        Ok(largest(self.velocity()?.iter().map(|u| u.length())))
    }
}

pub(super) fn key(story: &Story, tick: u64) -> Result<FieldKey, GpuError> {
    match story.film_key(0, Moment::tick(tick)) {
        Some(FilmKey::Field(key)) => Ok(key),
        _ => Err(GpuError::Refused("a film of one thickness does not move".to_owned())),
    }
}

/// The largest of some numbers; no number if one is none.
pub(super) fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |max: f64, value| if value.is_nan() { f64::NAN } else { max.max(value) })
}

/// How far values left the range of those before, as a part of it (or of their size, if they had none), and the change of their mass over
/// the mass of their absolute values.
pub(super) fn departures(sphere: CubedSphere, before: &[f64], after: &[f64]) -> (f64, f64) {
    let low = before.iter().copied().fold(f64::MAX, f64::min);
    let high = before.iter().copied().fold(f64::MIN, f64::max);
    let size = low.abs().max(high.abs());
    let width = if high > low { high - low } else { size.max(f64::MIN_POSITIVE) };
    let beyond = after.iter().fold(0.0, |worst: f64, value| worst.max(low - value).max(value - high));
    let areas = sphere.areas();
    let mass = |of: &dyn Fn(usize) -> f64| areas.iter().enumerate().map(|(cell, area)| area * of(cell)).sum::<f64>();
    let scale = mass(&|cell| before[cell].abs()).max(f64::MIN_POSITIVE);
    (beyond / width, (mass(&|cell| after[cell] - before[cell]) / scale).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn departures_are_found() {
        let sphere = CubedSphere::new(8).unwrap_or_else(|_| unreachable!());
        let before: Vec<f64> = (0..sphere.cells()).map(|cell| f64::from(u8::from(cell % 2 == 0))).collect();
        assert_eq!(departures(sphere, &before, &before), (0.0, 0.0));
        let mut after = before.clone();
        after[7] = 1.5;
        let (excess, drift) = departures(sphere, &before, &after);
        assert!(excess == 0.5 && drift > 1e-4, "{excess} {drift}");
    }
}
