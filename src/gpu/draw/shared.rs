//! What the bubbles of a picture are drawn with, and their rings.

use super::{
    Colours, DrawInputs, Drawn,
    values::{
        bubble_uniform, lamp_uniforms, light_uniform, list_part, other_bubble, ring_overrides, small_bubbles,
        view_uniform,
    },
};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        environment::Environment,
        formats::{POLARISATION_FORMAT, radiance_format},
        kernel::Drawable,
        passes::{
            backdrop::{LampOverrides, LampUniform, LightUniform, MAX_LAMPS, ViewUniform},
            bake_table::TableOverrides,
            bubble::{Shade, ShadeMirror},
        },
        uniform_buffer::UniformBuffer,
    },
    plan::{DrawKey, Lighting, Rendering},
};

/// What all bubbles of a picture are drawn with.
pub(super) struct Shared<'a> {
    pub key: &'a DrawKey,
    pub lighting: &'a Lighting,
    pub view: UniformBuffer<ViewUniform>,
    pub light: LightBuffers,
    pub environment: &'a Environment,
    pub backdrop: &'a Environment,
    pub behind: &'a wgpu::TextureView,
    pub so_far: &'a wgpu::TextureView,
    others: Others,
    pub films: &'a wgpu::TextureView,
    pub tracks_polarisation: bool,
    pub polarised_behind: &'a wgpu::TextureView,
    /// All small bubbles.
    pub small: wgpu::Buffer,
}

impl<'a> Shared<'a> {
    /// What the bubbles of a key are drawn with in one of its lights.
    pub fn new(gpu: &Gpu, key: &'a DrawKey, lighting: &'a Lighting, inputs: &DrawInputs<'a>) -> Self {
        let [behind, so_far] = inputs.drawn.map(|target| &target.view);
        Self {
            key,
            lighting,
            view: gpu.uniform("view", &view_uniform(key)),
            light: LightBuffers::new(gpu, key, lighting, [inputs.environment, inputs.backdrop]),
            environment: inputs.environment,
            backdrop: inputs.backdrop,
            behind,
            so_far,
            others: Others::new(gpu, key, lighting, inputs),
            films: &inputs.atlas.films.view,
            tracks_polarisation: inputs.composition.tracks_polarisation(key),
            polarised_behind: &inputs.polarised[1].view,
            small: gpu.storage("small bubbles", &small_bubbles(key, lighting, inputs.atlas)),
        }
    }

    /// Where the part of a bubble begins in the lists of others.
    pub fn first_other(&self, place: usize) -> u32 {
        self.others.first[place]
    }

    /// Makes one ring of a bubble ready: as it is, or a mirror in its place.
    pub fn ring(&self, gpu: &Gpu, drawn: &Drawn<'_>) -> Result<Drawable, GpuError> {
        let Self { key, lighting, view, light, environment, backdrop, behind, so_far, others, films, .. } = self;
        let Self { tracks_polarisation, polarised_behind, .. } = self;
        let Drawn { ring, film, hole, colours: Colours { films: film_colours, table, quadrature }, .. } = drawn;
        let bubble = &gpu.uniform("bubble", &bubble_uniform(key, drawn));
        let part = &gpu.storage("part of the lists", &[list_part(drawn)]);
        let coloured = film_colours.table.as_ref().is_some_and(|table| table.coloured);
        let shade = Shade {
            shape: ring_overrides(key, lighting, *tracks_polarisation, drawn),
            table_kind: TableOverrides { COLOURED: coloured, POLARISED: lighting.light.polariser.is_some() },
            summed: quadrature.overrides(),
            lit: light.lit,
            view,
            light: &light.light,
            environment: &environment.view,
            environment_sampler: environment.sampler(film_colours.quadrature.quality),
            backdrop_sampler: backdrop.backdrop_sampler(),
            bubble,
            axes: &table.axes,
            table: &table.view,
            film: &film.film.view,
            quadrature: &quadrature.buffer,
            film_balance: film.balance,
            film_map: film.map,
            film_tracer: film.tracer,
            hole_middle: &hole.middle,
            hole_rim: &hole.rim,
            picture_behind: behind,
            picture_so_far: so_far,
            others: &others.bubbles,
            lists: &others.lists,
            films,
            part,
            backdrop_map: &backdrop.view,
            lamps: &light.lamps,
            polarised_behind,
            point_sampler: gpu.point_sampler(),
        };
        let formats = [radiance_format(key.full_precision), POLARISATION_FORMAT];
        let formats = if *tracks_polarisation { &formats[..] } else { &formats[..1] };
        match (key.rendering == Rendering::Yardstick, ring.edges_rad) {
            (false, Some(_)) => shade.ring(gpu, formats),
            (false, None) => shade.everywhere(gpu, formats),
            (true, Some(_)) => ShadeMirror::in_place_of(&shade).ring(gpu, formats),
            (true, None) => ShadeMirror::in_place_of(&shade).everywhere(gpu, formats),
        }
    }
}

/// A light on the device.
pub(super) struct LightBuffers {
    pub light: UniformBuffer<LightUniform>,
    pub lamps: UniformBuffer<[LampUniform; MAX_LAMPS]>,
    pub lit: LampOverrides,
}

impl LightBuffers {
    fn new(gpu: &Gpu, key: &DrawKey, lighting: &Lighting, maps: [&Environment; 2]) -> Self {
        let count = lighting.environment.0.lamps().len().min(MAX_LAMPS);
        Self {
            light: gpu.uniform("light", &light_uniform(lighting, key.exposed_ev, maps)),
            lamps: gpu.uniform("lamps", &lamp_uniforms(lighting)),
            lit: LampOverrides { LAMPS: count as u32 },
        }
    }
}

/// All bubbles as others show them, and which of them each bubble has to do with.
struct Others {
    bubbles: wgpu::Buffer,
    /// For each bubble the places of others in the list: those of its cluster, then those that it mirrors.
    lists: wgpu::Buffer,
    /// Where the part of each bubble begins.
    first: Vec<u32>,
}

impl Others {
    fn new(gpu: &Gpu, key: &DrawKey, lighting: &Lighting, inputs: &DrawInputs<'_>) -> Self {
        let (mut lists, mut first) = (Vec::new(), Vec::new());
        for placed in &inputs.composition.placed {
            first.push(lists.len() as u32);
            lists.extend(placed.among.iter().chain(&placed.mirrored).map(|place| *place as u32));
        }
        let is_needed = !lists.is_empty();
        // Buffers hold at least one value, read or not.
        lists.push(0);
        let shown = key.bubbles.iter().take(if is_needed { usize::MAX } else { 1 });
        let bubbles: Vec<_> = shown.map(|bubble| other_bubble(key, lighting, bubble, inputs.atlas)).collect();
        Self { bubbles: gpu.storage("others", &bubbles), lists: gpu.storage("lists of others", &lists), first }
    }
}
