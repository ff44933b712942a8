//! The picture in f64 on the CPU, from the same keys that the GPU's passes read.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3, Vec3};

#[cfg(not(target_arch = "wasm32"))]
use crate::{
    gpu::{GpuError, Renderer},
    physics::sphere::HaloTable,
};
use crate::{
    physics::{
        colour::{FilmOptics, bt709_to_bt2020, bt2020_to_bt709, transmittance},
        film::Hole,
        picture::{FilmSphere, PictureCamera, PictureScene},
        sphere::{CubedSphere, GridError, PaddedField},
        transport::FlowMap,
    },
    plan::{
        BackdropKey, BubbleKey, CameraKey, DrawKey, FieldKey, FilmKey, FlowLaw, LightKey, Lighting, Moment, Opening,
        QuadratureKey, remaining_nm,
    },
};

/// Thickness in nm of films that the device has moved, by the index of the film.
pub type MovedFilms = BTreeMap<usize, PaddedField<f64>>;

/// A film as the device has it at the moment that it shows, nm: its grid and its thickness, with all that pictures interpolate. None for a film
/// without a field.
///
/// # Errors
/// The device is lost, or refused a command.
#[cfg(not(target_arch = "wasm32"))]
pub fn moved_film(renderer: &Renderer, film: usize) -> Result<Option<(CubedSphere, PaddedField<f64>)>, GpuError> {
    let Some((grid, thickness_nm)) = renderer.read_film(film)? else { return Ok(None) };
    let cells: Vec<f32> = bytemuck::pod_collect_to_vec(&thickness_nm.wait(&renderer.gpu)?);
    let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| f64::from(cells[cell]));
    Ok(Some((grid, field)))
}

/// No picture in f64.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// A film's grid that is too coarse or too fine.
    #[error(transparent)]
    Grid(#[from] GridError),
    /// A film that moves by itself, and that nobody has moved.
    #[error("film {0} moves by itself: its thickness must come from the device")]
    NotMoved(usize),
}

/// Whether a bubble's film must come from the device: the motion of one that moves by itself is not repeated in f64, for small differences
/// grow until nothing could be compared.
#[must_use]
pub fn needs_device(bubble: &BubbleKey) -> bool {
    let FilmKey::Field(field) = &bubble.film else { return false };
    field.moment != Moment::default() && field.flows.iter().any(|(_, law)| matches!(law, FlowLaw::Free(_)))
}

/// Radiance of each pixel, linear BT.2020. `progress` hears of each finished row, once for each light.
///
/// # Errors
/// A film's grid that is too coarse or too fine, or one that [`needs_device`] and is not there.
pub fn radiance(key: &DrawKey, films: &MovedFilms, progress: &(dyn Fn() + Sync)) -> Result<Vec<DVec3>, ReferenceError> {
    let seen = |key: &DrawKey| sum_of_lights(key, films, |scene| scene.radiance(progress));
    match &key.plate {
        None => seen(key),
        Some(plate) => before_plate(key, &plate.pixels(), seen),
    }
}

/// Radiance of some pixels, each a column and a row.
///
/// # Errors
/// As of [`radiance`].
pub fn radiance_of(key: &DrawKey, films: &MovedFilms, pixels: &[[u32; 2]]) -> Result<Vec<DVec3>, ReferenceError> {
    let seen = |key: &DrawKey| sum_of_lights(key, films, |scene| scene.radiance_of(pixels));
    match &key.plate {
        None => seen(key),
        Some(plate) => {
            let all = plate.pixels();
            let shown: Vec<[f32; 3]> = pixels.iter().map(|[x, y]| all[(y * key.size[0] + x) as usize]).collect();
            before_plate(key, &shown, seen)
        }
    }
}

/// What bubbles add to what they leave of a photograph, whose pixels are linear BT.709. `seen` is what is seen of other pictures at the same pixels.
fn before_plate(
    key: &DrawKey,
    plate: &[[f32; 3]],
    seen: impl Fn(&DrawKey) -> Result<Vec<DVec3>, ReferenceError>,
) -> Result<Vec<DVec3>, ReferenceError> {
    let (white, to_bt709) = (key.before_white(), bt2020_to_bt709());
    let through = seen(&white)?.into_iter().zip(seen(&white.without_bubbles())?);
    let left = through.map(|(through, white)| transmittance(to_bt709 * through, to_bt709 * white));
    let pixels = seen(&key.before_black())?.into_iter().zip(left).zip(plate);
    Ok(pixels
        .map(|((added, left), plate)| added + bt709_to_bt2020() * (left * Vec3::from(*plate).as_dvec3()))
        .collect())
}

/// The sum of what is seen in each light alone.
fn sum_of_lights(
    key: &DrawKey,
    films: &MovedFilms,
    seen: impl Fn(&PictureScene<'_>) -> Vec<DVec3>,
) -> Result<Vec<DVec3>, ReferenceError> {
    let mut sum = in_light(key, &key.lighting, films, &seen)?;
    for spectral_light in &key.spectral_lights {
        let added = in_light(key, spectral_light, films, &seen)?;
        sum.iter_mut().zip(added).for_each(|(sum, added)| *sum += added);
    }
    Ok(sum)
}

/// What is seen in one light alone.
fn in_light(
    key: &DrawKey,
    lighting: &Lighting,
    films: &MovedFilms,
    seen: impl Fn(&PictureScene<'_>) -> Vec<DVec3>,
) -> Result<Vec<DVec3>, ReferenceError> {
    let light = &lighting.light;
    // Films of all materials on the same wavelengths: as many as the one needs that needs most.
    let keys = || lighting.films.iter().map(|film| &film.quadrature);
    let samples_per_nm =
        keys().map(|key| FilmOptics::samples_per_nm(&key.optics.film, key.range_nm)).max().unwrap_or(1);
    let sampled =
        |key: &QuadratureKey| FilmOptics::sampled(key.optics.film.clone(), &key.optics.illuminant, samples_per_nm);
    let optics: Vec<FilmOptics> = keys().map(sampled).collect();
    let surroundings = |direction: DVec3| light.gain * lighting.environment.0.sample(turned(light, direction));
    let out_of_focus = key.defocus(lighting).map(|key| key.cones());
    let behind = |direction: DVec3| match light.backdrop {
        BackdropKey::Colour(radiance) => radiance,
        BackdropKey::Environment => {
            let (environment, direction) = (&lighting.environment.0, turned(light, direction));
            let far = out_of_focus.as_ref().map_or_else(|| environment.far(direction), |cones| cones.mean(direction));
            light.gain * (environment.lamps_from(direction, light.defocus_rad.tan()) + far)
        }
    };
    let sphere = |bubble: &BubbleKey| {
        let (center_m, radius_m, stretch) = (bubble.center_m, bubble.radius_m, bubble.stretch);
        film_thickness(bubble, key.on_bath, films).map(|thickness_nm| FilmSphere {
            optics: &optics[bubble.material],
            center_m,
            radius_m,
            stretch,
            thickness_nm,
        })
    };
    let bubbles = key.all_bubbles();
    let scene = PictureScene {
        size: key.size,
        camera: camera(&key.camera),
        light: optics[0].weights(),
        spheres: bubbles.iter().map(sphere).collect::<Result<_, _>>()?,
        surroundings: &surroundings,
        backdrop: Some(&behind),
        polariser: light.polariser,
        on_bath: key.on_bath,
        negligible: if bubbles.len() > 1 { NEGLIGIBLE_OF_MANY } else { NEGLIGIBLE_OF_ONE },
        samples: bubbles.iter().map(|bubble| bubble.samples).fold(SAMPLES, u32::max),
    };
    Ok(seen(&scene))
}

/// Samples along each side of a pixel: the environment is looked up in its finest level only, so a pixel must average by itself.
const SAMPLES: u32 = 2;

/// Part of light below which a branch of a ray in one bubble is not split any further.
const NEGLIGIBLE_OF_ONE: f64 = 1e-6;
/// That part with several bubbles, where each branch has branches of its own: a hundred times less would take a dense crowd of forty ten
/// times as long. The light is not lost but taken from the direction that the branch has by then: two bubbles are within 1e-5 of a picture with a
/// hundredth of this, forty within 2e-4, for surroundings of about 1.
const NEGLIGIBLE_OF_MANY: f64 = 1e-4;

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

/// Distance of what a pixel's middle shows from a bubble's center, across the line of sight and over the radius: 1 on a round bubble's outline.
#[must_use]
pub fn distance_from_middle(key: &DrawKey, bubble: &BubbleKey, pixel: [u32; 2]) -> f64 {
    let ray = camera(&key.camera).ray(key.size, DVec2::from_array(pixel.map(|k| f64::from(k) + 0.5)));
    (bubble.center_m - key.camera.eye_m).reject_from_normalized(ray).length() / bubble.radius_m
}

/// A world direction in the frame of the environment, which is turned about the vertical.
fn turned(light: &LightKey, direction: DVec3) -> DVec3 {
    let (sin, cos) = light.rotation_rad.sin_cos();
    DVec3::new(cos * direction.x + sin * direction.y, cos * direction.y - sin * direction.x, direction.z)
}

/// Thickness of a film in nm in the direction of a unit vector from the bubble's center.
pub type FilmThickness<'a> = Box<dyn Fn(DVec3) -> f64 + Send + Sync + 'a>;

/// A film as pictures see it: thinned by evaporation, with its hole, and with nothing beyond its rim.
///
/// # Errors
/// A film's grid that is too coarse or too fine, or one that [`needs_device`] and is not there.
pub fn film_thickness<'a>(
    key: &BubbleKey,
    on_bath: bool,
    films: &'a MovedFilms,
) -> Result<FilmThickness<'a>, ReferenceError> {
    let field: FilmThickness<'a> = match (&key.film, films.get(&key.index)) {
        // As pictures of the device interpolate what it shows.
        (FilmKey::Field(_), Some(film)) => Box::new(|direction| film.bilinear(direction)),
        (FilmKey::Field(_), None) if needs_device(key) => return Err(ReferenceError::NotMoved(key.index)),
        (FilmKey::Uniform(thickness_nm), _) => {
            let thickness_nm = *thickness_nm;
            Box::new(move |_| thickness_nm)
        }
        (FilmKey::Field(field), None) => {
            let film = film(field)?;
            Box::new(move |direction| film.value(direction))
        }
    };
    let BubbleKey { to_film, evaporated_nm, cap, thickness_factor, .. } = *key;
    let film_nm = move |direction: DVec3| {
        let direction = match cap {
            Some(cap) if on_bath => cap.folded(direction),
            Some(cap) if !cap.contains(direction) => return 0.0,
            _ => direction,
        };
        remaining_nm(thickness_factor * field(direction), evaporated_nm)
    };
    Ok(match key.hole {
        None => Box::new(move |direction| film_nm(to_film * direction)),
        Some(Opening { at, seconds }) => {
            let middle = match at {
                Some(at) => at,
                None => thinnest(&key.film, &film_nm)?,
            };
            let hole = Hole::open(&film_nm, middle, seconds, key.radius_m);
            Box::new(move |direction| hole.pierced(to_film * direction, film_nm(to_film * direction)))
        }
    })
}

/// Direction of the thinnest cell of a film; the top of one that is as thin everywhere.
fn thinnest(film: &FilmKey, thickness_nm: impl Fn(DVec3) -> f64) -> Result<DVec3, GridError> {
    let FilmKey::Field(field) = film else { return Ok(DVec3::Z) };
    let grid = CubedSphere::new(field.cells as usize)?;
    let cells = (0..grid.cells()).map(|cell| grid.cell_direction(cell));
    let thinnest = cells.map(|x| (thickness_nm(x), x)).min_by(|a, b| a.0.total_cmp(&b.0));
    Ok(thinnest.map_or(DVec3::Z, |(_, direction)| direction))
}

/// A film at its moment: the scheme of the GPU in f64 by the same steps, remapped when the maximum number of ticks has passed.
pub fn film(key: &FieldKey) -> Result<FlowMap, GridError> {
    let mut film = FlowMap::new(CubedSphere::new(key.cells as usize)?, key.scheme, key.initial.profile())?;
    let mut since_remap = 0;
    for step in key.steps_from(0) {
        let ticks = step.end - step.start;
        advance(&mut film, key, step.start, ticks as f64);
        since_remap += ticks;
        if since_remap >= u64::from(key.remap_ticks) || !key.scheme.keeps_map() {
            film.remap();
            since_remap = 0;
        }
    }
    let state = key.state_tick();
    let ahead = (key.moment.tick - state) as f64 + key.moment.fraction;
    if ahead > 0.0 {
        advance(&mut film, key, state, ahead);
    }
    Ok(film)
}

/// Moves a film by a number of ticks.
fn advance(film: &mut FlowMap, key: &FieldKey, tick: u64, ticks: f64) {
    let law = key.law(tick);
    if law != FlowLaw::Rest {
        let flow = law.prescribed();
        film.step(key.tick_s * tick as f64, key.tick_s * ticks, |x, t| flow.velocity(x, t));
    }
}
