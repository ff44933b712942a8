//! The picture in f64 on the CPU, from the same keys that the GPU's passes read.

use glam::DVec3;

use crate::{
    physics::{
        picture::{FilmSphere, PictureCamera, PictureScene},
        sphere::{CubedSphere, GridError, HaloTable, PaddedField},
        transport::FlowMap,
    },
    plan::{BackdropKey, BubbleKey, CameraKey, DrawKey, FieldKey, FilmKey, LightKey},
};

/// Radiance of each pixel, linear BT.2020. `progress` hears of each finished row.
///
/// # Errors
/// A film's grid that is too coarse or too fine.
pub fn radiance(key: &DrawKey, progress: &(dyn Fn() + Sync)) -> Result<Vec<DVec3>, GridError> {
    let optics = key.bands.optics.spectra();
    let surroundings = |direction: DVec3| key.light.gain * key.environment.0.sample(turned(&key.light, direction));
    let scene = PictureScene {
        size: key.size,
        camera: camera(&key.camera),
        optics: &optics,
        spheres: key.bubbles.iter().map(sphere).collect::<Result<_, _>>()?,
        surroundings: &surroundings,
        backdrop: match key.light.backdrop {
            BackdropKey::Environment => None,
            BackdropKey::Colour(radiance) => Some(radiance),
        },
        polariser: key.light.polariser,
        samples: key.bubbles.iter().map(|bubble| bubble.samples).fold(SAMPLES, u32::max),
    };
    Ok(scene.radiance(progress))
}

/// Samples along each side of a pixel: the environment is looked up in its finest level only, so a pixel must average by itself.
const SAMPLES: u32 = 2;

/// The camera of a key.
#[must_use]
pub fn camera(key: &CameraKey) -> PictureCamera {
    PictureCamera {
        eye_m: key.eye_m,
        forward: key.forward,
        right: key.right,
        up: key.up,
        pixel_height_m: key.pixel_height_m,
    }
}

/// A world direction in the frame of the environment, which is turned about the vertical.
fn turned(light: &LightKey, direction: DVec3) -> DVec3 {
    let (sin, cos) = light.rotation_rad.sin_cos();
    DVec3::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x, direction.z)
}

fn sphere(key: &BubbleKey) -> Result<FilmSphere<'static>, GridError> {
    let thickness_nm: Box<dyn Fn(DVec3) -> f64 + Send + Sync> = match &key.film {
        FilmKey::Uniform(thickness_nm) => {
            let thickness_nm = *thickness_nm;
            Box::new(move |_| thickness_nm)
        }
        FilmKey::Field(field) => {
            let field = thickness_field(field)?;
            Box::new(move |direction| field.bicubic(direction))
        }
    };
    Ok(FilmSphere { centre_m: key.centre_m, radius_m: key.radius_m, thickness_nm })
}

/// A film's thickness at its moment, in nm: the scheme of the GPU in f64, remapped at the same ticks, with the flow followed through each
/// tick instead of frozen at its middle.
pub fn thickness_field(key: &FieldKey) -> Result<PaddedField<f64>, GridError> {
    let grid = CubedSphere::new(key.cells as usize)?;
    let initial = key.initial.sample(grid);
    let halo = HaloTable::new(grid);
    let start = PaddedField::from_cells(grid, &halo, |cell| f64::from(initial[cell]));
    let mut film = FlowMap::from_field(start);
    for tick in 0..key.moment.tick {
        advance(&mut film, key, tick, 1.0);
        if (tick + 1) % u64::from(key.remap_ticks) == 0 {
            film.remap();
        }
    }
    if key.moment.fraction > 0.0 {
        advance(&mut film, key, key.moment.tick, key.moment.fraction);
    }
    let values = film.values();
    Ok(PaddedField::from_cells(grid, &halo, |cell| values[cell]))
}

/// Moves a film by a part of a tick, from its start.
fn advance(film: &mut FlowMap, key: &FieldKey, tick: u64, fraction: f64) {
    let flow = key.law(tick).prescribed();
    film.step(key.tick_s * tick as f64, key.tick_s * fraction, |x, t| flow.velocity(x, t));
}
