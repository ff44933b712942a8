//! The light of a picture: the scene's own and those of other illuminants, what stands behind the bubbles, and what films make of it.

use glam::DVec3;

use super::{
    BackdropKey, CameraKey, EnvironmentKey, FilmColours, LightKey, Lighting, OpticsKey, QuadratureKey, TableKey,
    resources::{Resources, SpectralLight},
};
use crate::{
    physics::{
        colour::{bt709_to_bt2020, daylight_scale, seen_light},
        optics::FilmMaterial,
    },
    scene::{Backdrop, Quality, Scene},
};

/// Texels of the environment over the height of a picture below which they would be seen as squares.
const FEW_TEXELS: f64 = 160.0;
/// Radius of the discs that each point is spread over then, in texels.
const SMOOTHING_TEXELS: f64 = 1.25;
/// Largest radius of these discs, in radians, however few texels the environment has.
const MAX_SMOOTHING_RAD: f64 = 0.5;

/// Half angle of the cones that an environment is averaged over behind the bubbles so that no texels are seen, in radians; 0 where they are small
/// enough. `size` is the number of texels along a face's edge, and `height_m` the picture's height on the plane one metre before the eye: more pixels
/// do not change it.
fn smoothing_rad(size: usize, height_m: f64) -> f64 {
    let texel_rad = 2.0 / size as f64;
    // One texel per face has no neighbour on it to tell apart.
    let shows_texels = size > 1 && height_m < FEW_TEXELS * texel_rad;
    if shows_texels { (SMOOTHING_TEXELS * texel_rad).min(MAX_SMOOTHING_RAD) } else { 0.0 }
}

/// The scene's own light, for a picture of `height` pixels that a camera takes.
pub(super) fn light(
    scene: &Scene,
    resources: &Resources,
    (camera, height): (&CameraKey, u32),
    defocus_rad: f64,
) -> LightKey {
    let height_m = f64::from(height) * camera.pixel_height_m;
    // A constant environment is a white cube times this factor: exact, where texels of a cube would round.
    let constant = scene.light.constant.filter(|_| scene.light.lamps.is_empty());
    let constant = constant.map_or(DVec3::ONE, |rgb| bt709_to_bt2020() * DVec3::from(rgb));
    let backdrop = match scene.view.backdrop {
        // A photograph is laid behind the finished picture.
        _ if scene.view.plate.is_some() => BackdropKey::Colour(DVec3::ZERO),
        Backdrop::Environment => BackdropKey::Environment,
        Backdrop::Radiance(rgb) => BackdropKey::Colour(bt709_to_bt2020() * DVec3::from(rgb)),
    };
    let polariser = scene.view.polariser_deg.map(|angle| {
        let (sin, cos) = angle.to_radians().sin_cos();
        cos * camera.right + sin * camera.up
    });
    LightKey {
        gain: scene.light.intensity * constant,
        seen: seen_light(&resources.illuminant),
        scale: daylight_scale(),
        polariser,
        rotation_rad: scene.light.rotation_deg.to_radians(),
        backdrop,
        defocus_rad,
        blur_rad: defocus_rad.max(smoothing_rad(resources.environment.size(), height_m)),
    }
}

/// The light of another illuminant, given the scene's own light.
pub(super) fn light_of(scene: &Scene, source: &SpectralLight, own: LightKey) -> LightKey {
    let backdrop = match own.backdrop {
        BackdropKey::Environment => BackdropKey::Environment,
        // A colour behind the bubbles is seen by the scene's own light.
        BackdropKey::Colour(_) => BackdropKey::Colour(DVec3::ZERO),
    };
    LightKey { gain: DVec3::splat(scene.light.intensity), seen: seen_light(&source.illuminant), backdrop, ..own }
}

/// A light with what films of some materials make of it. `are_many`: bubbles show one another.
pub(super) fn lighting(
    scene: &Scene,
    source: &SpectralLight,
    light: LightKey,
    films: &[(FilmMaterial, f64)],
    are_many: bool,
) -> Lighting {
    let colours = |(film, range_nm): &(FilmMaterial, f64)| {
        let optics = OpticsKey { film: film.clone(), illuminant: source.illuminant.clone() };
        let table = table(scene, source, &light, TableKey::full(optics.clone(), *range_nm));
        let is_plain = !table.coloured && !table.polarised;
        let quadrature = QuadratureKey::new(optics, *range_nm, scene.view.quality, &light.seen, is_plain);
        // What bubbles show of one another comes from a table.
        FilmColours { table: (quadrature.needs_table() || are_many).then_some(table), quadrature }
    };
    let films = films.iter().map(colours).collect();
    Lighting { light, environment: EnvironmentKey(source.environment.clone()), films }
}

/// How much the primaries of a backdrop may differ that `fast` takes for grey, as a part of the light's gain.
const FAINT: f64 = 1e-3;

fn table(scene: &Scene, source: &SpectralLight, light: &LightKey, full: TableKey) -> TableKey {
    let is_grey = |rgb: DVec3| rgb.max_element() - rgb.min_element() <= 1e-12 * rgb.max_element();
    // The colour of a backdrop that is almost black is not worth two more layers of the table.
    let is_faint = |rgb: DVec3| rgb.max_element() - rgb.min_element() <= FAINT * light.gain.max_element();
    let backdrop = match light.backdrop {
        BackdropKey::Colour(rgb) => is_grey(rgb) || scene.view.quality == Quality::Fast && is_faint(rgb),
        BackdropKey::Environment => true,
    };
    let neutral = source.environment.is_neutral() && is_grey(light.gain) && backdrop;
    TableKey { coloured: !neutral, polarised: scene.view.polariser_deg.is_some(), ..full }
}
