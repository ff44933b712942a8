//! What the shaders of a picture are given, from its keys.

use bytemuck::Zeroable;
use glam::{DMat3, DVec3};

use super::Drawn;
use crate::{
    gpu::{
        environment::Environment,
        film_atlas::FilmAtlas,
        passes::{
            backdrop::{LampUniform, LightUniform, MAX_LAMPS, ViewUniform},
            bubble::{BubbleUniform, ListPart, OtherBubble, RingOverrides},
        },
        quadrature::Quadrature,
    },
    physics::colour::unseen,
    plan::{BLACK_FILM_NM, BackdropKey, BubbleKey, DrawKey, FilmKey, Lighting, SmallBubble},
    scene::Quality,
};

/// The largest half float: the twin of `storable` in `shaders/light/stored.wgsl`.
const MAX_HALF: f64 = 65504.0;

/// Iterations that the loops of one fragment may take in all: llvmpipe ends them after 65,535, without a word.
const MAX_ITERATIONS: u32 = 60_000;

/// Iterations of a sample's loops beside that over the wavelengths: further hits and lookups of the film.
const ITERATIONS_BESIDE_QUADRATURE: u32 = 64;

/// Samples along each side of a pixel for which a fragment's loops run to their end.
fn max_samples(quadrature: &Quadrature) -> u32 {
    (MAX_ITERATIONS / (quadrature.count + ITERATIONS_BESIDE_QUADRATURE)).isqrt()
}

/// Samples that all small bubbles of a picture may take. A hundred times as many would take a twentieth off their error in windows, most of which is
/// that of products of the table's colours.
fn small_samples(quality: Quality) -> f64 {
    match quality {
        Quality::Fast | Quality::Standard => 0.4e6,
        Quality::Spectral => 10e6,
    }
}

/// Samples along each side of a pixel of small bubbles, of which a tile has `most` at most.
pub(super) fn max_small_samples(key: &DrawKey, quality: Quality, most: u32) -> u32 {
    // Bubbles of less than a pixel are sampled as often as those of a pixel.
    let reach = |small: &SmallBubble| {
        small.radius_pixels(&key.camera) + 1.0 + key.camera.confusion_pixels(small.center_m, small.radius_m)
    };
    let area = |small: &SmallBubble| std::f64::consts::PI * reach(small).powi(2);
    let pixels: f64 = key.small.iter().map(area).sum();
    let affordable = |samples: &u32| f64::from(samples.pow(2)) * pixels <= small_samples(quality);
    let ends = |samples: &u32| samples.pow(2).saturating_mul(most) <= MAX_ITERATIONS;
    [4, 2].into_iter().find(|samples| affordable(samples) && ends(samples)).unwrap_or(1)
}

/// The constants of a ring's shaders.
pub(super) fn ring_overrides(
    key: &DrawKey,
    lighting: &Lighting,
    tracks_polarisation: bool,
    Drawn { bubble, placed, ring, colours, .. }: &Drawn<'_>,
) -> RingOverrides {
    RingOverrides {
        UNIFORM_FILM: matches!(bubble.film, FilmKey::Uniform(_)),
        MAGNIFIED: bubble.magnified,
        SAMPLES: ring.samples.min(max_samples(colours.quadrature)),
        IN_LINE: ring.in_line,
        OUT_OF_FOCUS: ring.confusion_pixels > 0.0,
        REFINED_SAMPLES: ring.refined_samples,
        ENVIRONMENT_TAPS: ring.environment_taps,
        OUTLINE: ring.outline,
        THICKNESSES: bubble.thicknesses,
        STRETCHED: bubble.stretch != DMat3::IDENTITY,
        BURST: bubble.hole.is_some(),
        FULL_PRECISION: key.full_precision,
        BACKDROP_IS_ENVIRONMENT: lighting.light.backdrop == BackdropKey::Environment,
        ON_BATH: key.on_bath,
        SKINS: colours.films.quadrature.optics.film.skin_nm > 0.0,
        ON_RING: bubble.cap.is_some() && !key.on_bath,
        INSIDE: ring.edges_rad.is_none(),
        OVER_OTHERS: placed.layer > 0,
        AMONG_OTHERS: !placed.among.is_empty(),
        MIRRORS_OTHERS: placed.mirrors,
        OPPOSITE_WALLS: placed.mirrors && colours.films.quadrature.quality == Quality::Spectral,
        TRACKS_POLARISATION: tracks_polarisation,
        INNER: ring.inner_reflections,
    }
}

/// What the linear picture holds where one colour is seen and no bubble.
pub(super) fn backdrop_colour(key: &DrawKey, lighting: &Lighting, radiance: DVec3) -> wgpu::Color {
    let seen = f64::from(key.exposed_ev).exp2() * lighting.light.seen * radiance;
    let stored = if key.full_precision { seen } else { seen * (MAX_HALF / seen.max_element().max(1.0)).min(1.0) };
    wgpu::Color { r: stored.x, g: stored.y, b: stored.z, a: 1.0 }
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

/// The camera.
pub fn view_uniform(key: &DrawKey) -> ViewUniform {
    let camera = &key.camera;
    ViewUniform {
        forward: floats(camera.forward),
        pixel_height: camera.pixel_height_m as f32,
        right: floats(camera.right),
        width: key.size[0] as f32,
        up: floats(camera.up),
        height: key.size[1] as f32,
        axis: camera.axis(key.size).as_vec2().to_array(),
        padding: [0.0; 2],
    }
}

/// A light, as a picture exposed by some stops needs it.
pub(super) fn light_uniform(
    lighting: &Lighting,
    exposed_ev: i32,
    [environment, behind]: [&Environment; 2],
) -> LightUniform {
    let light = &lighting.light;
    let exposure = f64::from(exposed_ev).exp2();
    let backdrop = match light.backdrop {
        BackdropKey::Environment => DVec3::ZERO,
        BackdropKey::Colour(colour) => colour,
    };
    LightUniform {
        gain: floats(light.gain),
        texel_angle: environment.texel_angle,
        backdrop: floats(backdrop),
        backdrop_texel_angle: behind.texel_angle,
        scale: floats(exposure * light.scale),
        turn_cos: light.rotation_rad.cos() as f32,
        polariser: floats(light.polariser.unwrap_or(DVec3::ZERO)),
        turn_sin: light.rotation_rad.sin() as f32,
        seen: (exposure * light.seen).into(),
        unseen: unseen(&(exposure * light.seen)).into(),
        defocus: light.defocus_rad.tan() as f32,
        padding: [0.0; 3],
    }
}

/// The lamps before a light's environment; none where there are fewer.
pub(super) fn lamp_uniforms(lighting: &Lighting) -> [LampUniform; MAX_LAMPS] {
    let mut lamps = [LampUniform::zeroed(); MAX_LAMPS];
    for (uniform, lamp) in lamps.iter_mut().zip(lighting.environment.0.lamps()) {
        *uniform = LampUniform {
            towards: floats(lamp.towards),
            edge: lamp.edge as f32,
            right: floats(lamp.right),
            corner: lamp.corner as f32,
            up: floats(lamp.towards.cross(lamp.right)),
            area: lamp.area() as f32,
            radiance: floats(lamp.radiance),
            padding: 0.0,
            half_size: lamp.half_size.as_vec2().to_array(),
            padding_after: [0.0; 2],
        };
    }
    lamps
}

/// A ring of a bubble.
pub(super) fn bubble_uniform(key: &DrawKey, drawn: &Drawn<'_>) -> BubbleUniform {
    let Drawn { bubble, ring, film: shown, .. } = drawn;
    let film = &drawn.colours.films.quadrature.optics.film;
    let [inner, outer] = ring.corners();
    let (thickness_nm, cells) = match &bubble.film {
        FilmKey::Uniform(thickness_nm) => (*thickness_nm as f32, 0),
        FilmKey::Field(field) => (0.0, field.cells),
    };
    BubbleUniform {
        to_center_m: floats(bubble.center_m - key.camera.eye_m),
        radius_m: bubble.radius_m as f32,
        inner,
        outer,
        thickness_nm,
        cells,
        tracer_cells: shown.tracer_cells,
        evaporated_nm: bubble.evaporated_nm as f32,
        to_film: bubble.to_film.into(),
        stretch: bubble.stretch.into(),
        unstretch: bubble.stretch.inverse().into(),
        black_nm: BLACK_FILM_NM as f32,
        extra_nm: film.equivalent_extra_nm() as f32,
        skins_nm: (2.0 * film.skin_nm).max(1e-3) as f32,
        map_cells: shown.map_cells,
        rim_z: bubble.cap.map_or(-2.0, |cap| cap.rim_z as f32),
        thickness_factor: bubble.thickness_factor as f32,
        sides: ring.sides,
        confusion_pixels: ring.confusion_pixels as f32,
    }
}

/// A bubble's part of the lists of others.
pub(super) fn list_part(Drawn { placed, first_other, .. }: &Drawn<'_>) -> ListPart {
    ListPart {
        first_other: *first_other,
        among: placed.among.len() as u32,
        mirrored: (placed.among.len() + placed.mirrored.len()) as u32,
    }
}

/// A bubble as others show it.
pub(super) fn other_bubble(key: &DrawKey, lighting: &Lighting, bubble: &BubbleKey, atlas: &FilmAtlas) -> OtherBubble {
    OtherBubble {
        to_center_m: floats(bubble.center_m - key.camera.eye_m),
        radius_m: bubble.radius_m as f32,
        to_film: bubble.to_film.into(),
        evaporated_nm: bubble.evaporated_nm as f32,
        // What a bath mirrors is as much of the bubble.
        rim_z: bubble.cap.filter(|_| !key.on_bath).map_or(-2.0, |cap| cap.rim_z as f32),
        thickness_factor: bubble.thickness_factor as f32,
        ..film_of_others(lighting, bubble.material, (bubble.index, &bubble.film), atlas)
    }
}

/// All small bubbles, in the order of the key.
pub(super) fn small_bubbles(key: &DrawKey, lighting: &Lighting, atlas: &FilmAtlas) -> Vec<OtherBubble> {
    let lent = key.lent.iter().map(|lent| OtherBubble {
        evaporated_nm: lent.evaporated_nm as f32,
        ..film_of_others(lighting, lent.material, (lent.index, &lent.film), atlas)
    });
    let lent: Vec<OtherBubble> = lent.collect();
    let small = key.small.iter().map(|small| OtherBubble {
        to_center_m: floats(small.center_m - key.camera.eye_m),
        radius_m: small.radius_m as f32,
        to_film: small.to_film(&key.lent[small.lent]).into(),
        thickness_factor: small.thickness_factor as f32,
        confusion_pixels: key.camera.confusion_pixels(small.center_m, small.radius_m) as f32,
        ..lent[small.lent]
    });
    small.collect()
}

/// What others show of a film, on a bubble that has no place yet.
fn film_of_others(
    lighting: &Lighting,
    material: usize,
    (index, film): (usize, &FilmKey),
    atlas: &FilmAtlas,
) -> OtherBubble {
    let (origin, cells, thickness_nm) = match (film, atlas.place(index)) {
        (FilmKey::Uniform(thickness_nm), _) => ([0; 2], 0, *thickness_nm),
        (FilmKey::Field(field), Some(origin)) => (origin, field.cells, 0.0),
        (FilmKey::Field(field), None) => ([0; 2], 0, field.initial.mean_nm()),
    };
    let film = &lighting.films[material].quadrature.optics.film;
    OtherBubble {
        to_center_m: [0.0; 3],
        radius_m: 0.0,
        to_film: DMat3::IDENTITY.into(),
        origin,
        cells,
        thickness_nm: thickness_nm as f32,
        evaporated_nm: 0.0,
        black_nm: BLACK_FILM_NM as f32,
        extra_nm: film.equivalent_extra_nm() as f32,
        skins_nm: (2.0 * film.skin_nm).max(1e-3) as f32,
        rim_z: -2.0,
        thickness_factor: 1.0,
        confusion_pixels: 0.0,
        padding: 0.0,
    }
}
