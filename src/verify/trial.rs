//! A trial of adapters whose drivers may draw wrong pictures and say nothing: one pixel and one colour, before anything else.

use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;
use half::f16;

use super::picture::frame_request;
use crate::{
    gpu::{
        Gpu, GpuError, Renderer,
        passes::probe_colour::{ColourProbe, ProbePoint},
    },
    physics::{
        colour::{BT2020, Walls},
        environment::CubeMap,
    },
    plan::{OpticsKey, Resources},
    scene::{Backdrop, Quality, Scene, View},
};

/// Radiance of the surroundings.
const RADIANCE: f64 = 0.5;
/// Thickness of a film in nm, and the cosine of the angle at which it is seen.
const FILM: (f64, f64) = (300.0, 0.8);
/// What two answers may differ by.
const TOLERANCE: f64 = 0.01;

/// Refuses an OpenGL adapter that computes or draws something wrong. Drivers of other backends report what they
/// cannot do.
///
/// # Errors
/// [`GpuError::NoDevice`] with what was wrong.
pub fn trial(gpu: &Gpu) -> Result<(), GpuError> {
    let info = gpu.adapter.get_info();
    if info.backend != wgpu::Backend::Gl {
        return Ok(());
    }
    let refused = |reason| GpuError::NoDevice { adapter: gpu.adapter_name(), reason };
    let answers = [("draws", pixel(gpu)), ("computes", colour(gpu))];
    for (does, answer) in answers {
        let (right, found) = answer.map_err(|error| refused(error.to_string()))?;
        if !agree(right, found) {
            return Err(refused(format!("it {does} {found:.3} where {right:.3} is right")));
        }
    }
    Ok(())
}

/// Whether an answer is right. NaN never is.
fn agree(right: DVec3, found: DVec3) -> bool {
    (right - found).abs().cmplt(DVec3::splat(TOLERANCE)).all()
}

/// A pixel of surroundings that are the same everywhere: as it must be, and as it is.
fn pixel(gpu: &Gpu) -> Result<(DVec3, DVec3), GpuError> {
    let mut scene = Scene { view: View { backdrop: Backdrop::Environment, ..View::default() }, ..Scene::default() };
    scene.bubbles.clear();
    scene.view.exposure_ev = 0.0;
    scene.light.intensity = 1.0;
    let resources = Resources {
        environment: Arc::new(CubeMap::from_fn(8, 1, |_| DVec3::splat(RADIANCE))),
        illuminant: Arc::default(),
        spectral_lights: Vec::new(),
        liquids: BTreeMap::new(),
        plate: None,
    };
    let mut request = frame_request(&scene, &resources, [1, 1])?;
    request.picture.draw.full_precision = false;
    let mut renderer = Renderer::new(gpu.clone());
    renderer.render(&request)?;
    let Some(picture) = renderer.read_radiance() else { return Err(GpuError::Refused("it has no picture".to_owned())) };
    let pixels: Vec<[f16; 4]> = bytemuck::pod_collect_to_vec(&picture.wait(gpu)?);
    let found = pixels.first().map(|[r, g, b, _]| DVec3::new(r.to_f64(), g.to_f64(), b.to_f64()));
    Ok((DVec3::splat(RADIANCE), found.unwrap_or(DVec3::NAN)))
}

/// The colour of a film by the table.
fn colour(gpu: &Gpu) -> Result<(DVec3, DVec3), GpuError> {
    let (thickness_nm, cos_theta) = FILM;
    let walls = Walls::One { thickness_nm };
    let optics = OpticsKey { film: Default::default(), illuminant: Default::default() };
    let probe = ColourProbe::new(gpu, &optics, Quality::Fast, thickness_nm)?;
    let found = probe.measure(gpu, &[ProbePoint::new(cos_theta, walls)])?;
    let right = BT2020.from_xyz() * optics.spectra().xyz(cos_theta, walls);
    Ok((right, found.first().copied().unwrap_or(DVec3::NAN)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wrong_answers_and_nan_are_noticed() {
        let right = DVec3::splat(RADIANCE);
        assert!(agree(right, right + 0.5 * TOLERANCE));
        for found in [DVec3::splat(-0.0), DVec3::NAN, DVec3::new(RADIANCE, RADIANCE, f64::INFINITY), 1.1 * right] {
            assert!(!agree(right, found), "{found}");
        }
    }
}
