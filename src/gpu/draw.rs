//! Draws the linear picture: the backdrop, then each bubble, ring by ring.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec3};

use super::{
    Gpu, GpuError,
    bake_table::{Table, table_constants, table_sampler},
    bands::{Bands, band_constants},
    environment::{Environment, texel_angle},
    film::{NoFilm, Shown},
    open_hole::OpenHole,
    pipelines::RenderKey,
    rings::{Ring, SIDES, disc, rings},
    timing::Recorder,
};
use crate::{
    physics::{film::HOLE_MERIDIANS, transport::Scheme},
    plan::{BLACK_FILM_NM, BackdropKey, BubbleKey, DrawKey, FilmKey, Lighting},
};

/// The camera: see `shaders/camera/view.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ViewUniform {
    /// Line of sight.
    pub forward: [f32; 3],
    /// Height of a pixel on the plane one metre before the eye.
    pub pixel_height: f32,
    /// Right of the picture.
    pub right: [f32; 3],
    /// Picture width in pixels.
    pub width: f32,
    /// Top of the picture.
    pub up: [f32; 3],
    /// Picture height in pixels.
    pub height: f32,
}

/// The light: see `shaders/light/environment.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct LightUniform {
    /// Factor on the environment's radiance.
    pub gain: [f32; 3],
    /// Angle between texels of its finest level.
    pub texel_angle: f32,
    /// Radiance of the backdrop where it is a colour.
    pub backdrop: [f32; 3],
    /// 1 where the backdrop is the environment.
    pub backdrop_is_environment: f32,
    /// Factor that makes daylight's white (1, 1, 1), exposed as the linear picture is.
    pub scale: [f32; 3],
    /// Cosine of the environment's turn.
    pub turn_cos: f32,
    /// Direction that a polariser lets pass.
    pub polariser: [f32; 3],
    /// Sine of the environment's turn.
    pub turn_sin: f32,
    /// From light to what is seen of it, exposed as the linear picture is: columns of a matrix, the fourth number of each is padding.
    pub seen: [[f32; 4]; 3],
}

/// One bubble: see `shaders/pass/bubble.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct BubbleUniform {
    /// From the eye to the centre: the difference of two places in f64, so that a scene looks the same wherever it stands.
    pub to_centre_m: [f32; 3],
    /// Radius.
    pub radius_m: f32,
    /// Inner edge of the ring: cos and sin of the angle to the direction of the centre.
    pub inner: [f32; 2],
    /// Outer edge.
    pub outer: [f32; 2],
    /// Thickness of a uniform film, in nm.
    pub thickness_nm: f32,
    /// Cells along a panel's edge.
    pub cells: u32,
    /// Cells along a panel's edge of its tracer.
    pub tracer_cells: u32,
    /// What has evaporated, in nm.
    pub thinned_nm: f32,
    /// Columns take directions of the world to the film; the fourth number of each is padding.
    pub to_film: [[f32; 4]; 3],
    /// Takes the unit sphere to the bubble's wall, over the radius.
    pub stretch: [[f32; 4]; 3],
    /// The inverse.
    pub unstretch: [[f32; 4]; 3],
    /// Thickness at which evaporation ends, in nm.
    pub black_nm: f32,
    /// What the film's skins add to its thickness, in nm.
    pub extra_nm: f32,
    /// Thickness of both skins, in nm; above 0.
    pub skins_nm: f32,
    /// Cells along a panel's edge of the film's map.
    pub map_cells: u32,
    /// Height of the ring that the film ends at, over the radius.
    pub rim_z: f32,
    pad: [f32; 3],
}

/// What a draw reads that other passes left.
pub struct DrawInputs<'a> {
    /// The environment.
    pub environment: &'a Environment,
    /// The table, where the quality has one.
    pub table: Option<&'a Table>,
    /// The bands, where there is a bubble.
    pub bands: Option<&'a Bands>,
    /// What a film shows, by its index.
    pub film: &'a dyn Fn(usize) -> Option<Shown<'a>>,
    /// The hole in a film that bursts, by the film's index.
    pub hole: &'a dyn Fn(usize) -> Option<&'a OpenHole>,
}

/// Pixels that one submission draws at most, so that none runs long.
const PIXELS_A_SUBMISSION: u32 = 2_000_000;

/// Horizontal strips that a picture is cut into.
pub fn strips([width, height]: [u32; 2]) -> impl Iterator<Item = std::ops::Range<u32>> {
    let rows = (PIXELS_A_SUBMISSION / width.max(1)).max(1);
    (0..height).step_by(rows as usize).map(move |top| top..(top + rows).min(height))
}

/// The uniforms and bind groups of one picture, made once and used for each of its strips.
pub struct DrawPass {
    backdrop: (wgpu::RenderPipeline, wgpu::BindGroup),
    rings: Vec<RingDraw>,
    width: u32,
}

/// One ring of a bubble, ready to be drawn.
struct RingDraw {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
    vertices: u32,
}

impl DrawPass {
    /// Makes ready what a key asks for in one of its lights.
    pub fn new(gpu: &Gpu, key: &DrawKey, lighting: &Lighting, inputs: &DrawInputs<'_>) -> Result<Self, GpuError> {
        let view = gpu.uniform("view", &view_uniform(key));
        let light = gpu.uniform("light", &light_uniform(lighting, key.exposed_ev));
        let shared = [
            view.as_entire_binding(),
            light.as_entire_binding(),
            wgpu::BindingResource::TextureView(&inputs.environment.view),
            wgpu::BindingResource::Sampler(&inputs.environment.sampler),
        ];
        let backdrop_key = RenderKey {
            pass: "backdrop",
            vertex: "cover",
            fragment: "backdrop",
            format: radiance_format(key.full_precision),
            constants: vec![("ON_BATH", u32::from(key.on_bath)), ("FULL_PRECISION", u32::from(key.full_precision))],
        };
        let pipeline = gpu.pipelines.render(gpu, &backdrop_key)?;
        let bindings = gpu.bind(&pipeline.get_bind_group_layout(0), &shared);
        let mut pass = Self { backdrop: (pipeline, bindings), rings: Vec::new(), width: key.size[0] };
        let Some(bands) = inputs.bands else { return Ok(pass) };
        let unread = lighting.table.is_none().then(|| Table::unread(gpu, &lighting.bands.optics));
        let Some(table) = unread.as_ref().or(inputs.table) else { return Ok(pass) };
        let sampler = table_sampler(gpu);
        let (no_film, no_hole) = (NoFilm::new(gpu), OpenHole::new(gpu));
        for bubble in &key.bubbles {
            let film = (inputs.film)(bubble.index).unwrap_or_else(|| no_film.shown());
            let hole = (inputs.hole)(bubble.index).unwrap_or(&no_hole);
            for ring in bubble_rings(key, bubble) {
                let pipeline = gpu.pipelines.render(gpu, &ring_pipeline(key, lighting, bubble, &ring, bands))?;
                let uniform = bubble_uniform(key, lighting, bubble, &ring, &film);
                let uniform = gpu.uniform("bubble", &uniform);
                let own = [
                    uniform.as_entire_binding(),
                    table.axes.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&table.view),
                    wgpu::BindingResource::Sampler(&sampler),
                    wgpu::BindingResource::TextureView(film.film),
                    bands.buffer.as_entire_binding(),
                    film.balance.as_entire_binding(),
                    film.map.as_entire_binding(),
                    film.tracer.as_entire_binding(),
                    hole.middle.as_entire_binding(),
                    hole.rim.as_entire_binding(),
                ];
                // The yardstick reads no film: its layout ends with the bubble itself.
                let own = if key.yardstick { &own[..1] } else { &own[..] };
                let resources: Vec<_> = shared.iter().chain(own).cloned().collect();
                let bindings = gpu.bind(&pipeline.get_bind_group_layout(0), &resources);
                let vertices = if ring.edges_rad.is_some() { 2 * (SIDES + 1) } else { 3 };
                pass.rings.push(RingDraw { pipeline, bindings, vertices });
            }
        }
        Ok(pass)
    }

    /// Records some rows of the picture.
    pub fn record(&self, recorder: &mut Recorder<'_>, target: &wgpu::TextureView, rows: std::ops::Range<u32>) {
        recorder.render("draw", target, |pass| {
            pass.set_scissor_rect(0, rows.start, self.width, rows.len() as u32);
            pass.set_pipeline(&self.backdrop.0);
            pass.set_bind_group(0, &self.backdrop.1, &[]);
            pass.draw(0..3, 0..1);
            for ring in &self.rings {
                pass.set_pipeline(&ring.pipeline);
                pass.set_bind_group(0, &ring.bindings, &[]);
                pass.draw(0..ring.vertices, 0..1);
            }
        });
        recorder.counts.draws += 1 + self.rings.len() as u64;
    }
}

/// Pixels that the picture's draws cover: all of the backdrop, and each bubble's bounding rectangle.
#[must_use]
pub fn pixels_shaded(key: &DrawKey) -> u64 {
    let [width, height] = key.size.map(u64::from);
    let bubble = |bubble: &BubbleKey| {
        let [x, y] =
            [0, 1].map(|axis| pixel_span(bubble, key.size[axis], axis)).map(|[low, high]| u64::from(high - low));
        x * y
    };
    width * height + key.bubbles.iter().map(bubble).sum::<u64>()
}

/// First and last pixel of a bounding rectangle along one axis.
fn pixel_span(bubble: &BubbleKey, size: u32, axis: usize) -> [u32; 2] {
    bubble.bounds.map(|corner| {
        let clip = if axis == 0 { corner.x } else { corner.y };
        ((clip + 1.0) * 0.5 * f64::from(size)).round().clamp(0.0, f64::from(size)) as u32
    })
}

/// Format of the linear picture.
#[must_use]
pub fn radiance_format(full_precision: bool) -> wgpu::TextureFormat {
    if full_precision { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float }
}

fn bubble_rings(key: &DrawKey, bubble: &BubbleKey) -> Vec<Ring> {
    let bands = &key.lighting.bands;
    match key.yardstick {
        true => vec![disc(&key.camera, bubble)],
        false => rings(&key.camera, bubble, bands.quality, &bands.optics.film),
    }
}

/// Iterations that the loops of one fragment may take in all: llvmpipe ends them after 65,535, without a word.
const MAX_ITERATIONS: u32 = 60_000;

/// Iterations of a sample's loops beside that over the bands: further hits and lookups of the film.
const ITERATIONS_BESIDE_BANDS: u32 = 64;

/// Samples along each side of a pixel for which a fragment's loops run to their end.
fn max_samples(bands: &Bands) -> u32 {
    (MAX_ITERATIONS / (bands.count + ITERATIONS_BESIDE_BANDS)).isqrt()
}

fn ring_pipeline(key: &DrawKey, lighting: &Lighting, bubble: &BubbleKey, ring: &Ring, bands: &Bands) -> RenderKey {
    let uniform = matches!(bubble.film, FilmKey::Uniform(_));
    let coloured = lighting.table.as_ref().is_some_and(|table| table.coloured);
    RenderKey {
        pass: "bubble",
        vertex: if ring.edges_rad.is_some() { "ring" } else { "everywhere" },
        fragment: if key.yardstick { "shade_mirror" } else { "shade" },
        format: radiance_format(key.full_precision),
        constants: [
            ("SIDES", SIDES),
            ("UNIFORM_FILM", u32::from(uniform)),
            ("MAGNIFIED", u32::from(bubble.magnified)),
            ("SAMPLES", ring.samples.min(max_samples(bands))),
            ("OUTLINE", u32::from(ring.outline)),
            ("FILTERED", u32::from(bubble.filtered)),
            ("STRETCHED", u32::from(bubble.stretch != DMat3::IDENTITY)),
            ("BURST", u32::from(bubble.hole.is_some())),
            ("FULL_PRECISION", u32::from(key.full_precision)),
            ("ON_BATH", u32::from(key.on_bath)),
            ("ON_RING", u32::from(bubble.cap.is_some() && !key.on_bath)),
            ("HOLE_MERIDIANS", HOLE_MERIDIANS as u32),
            ("INNER", ring.inner_reflections),
            // A film in a scene is moved as a flow map where it is looked up through one, and always limited.
            ("TAPS", Scheme::Map.taps()),
            ("LIMITER", 1),
        ]
        .into_iter()
        .chain(table_constants(coloured, lighting.light.polariser.is_some()))
        .chain(band_constants(bands))
        .collect(),
    }
}

/// A matrix as uniforms and storage buffers hold it: columns of four.
pub(super) fn matrix(matrix: DMat3) -> [[f32; 4]; 3] {
    matrix.as_mat3().to_cols_array_2d().map(|[x, y, z]| [x, y, z, 0.0])
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array()
}

fn view_uniform(key: &DrawKey) -> ViewUniform {
    let camera = &key.camera;
    ViewUniform {
        forward: floats(camera.forward),
        pixel_height: camera.pixel_height_m as f32,
        right: floats(camera.right),
        width: key.size[0] as f32,
        up: floats(camera.up),
        height: key.size[1] as f32,
    }
}

fn light_uniform(lighting: &Lighting, exposed_ev: i32) -> LightUniform {
    let light = &lighting.light;
    let exposure = f64::from(exposed_ev).exp2();
    let (backdrop, is_environment) = match light.backdrop {
        BackdropKey::Environment => (DVec3::ZERO, 1.0),
        BackdropKey::Colour(colour) => (colour, 0.0),
    };
    LightUniform {
        gain: floats(light.gain),
        texel_angle: texel_angle(lighting.environment.size()),
        backdrop: floats(backdrop),
        backdrop_is_environment: is_environment,
        scale: floats(exposure * light.scale),
        turn_cos: light.rotation_rad.cos() as f32,
        polariser: floats(light.polariser.unwrap_or(DVec3::ZERO)),
        turn_sin: light.rotation_rad.sin() as f32,
        seen: matrix(exposure * light.seen),
    }
}

fn bubble_uniform(
    key: &DrawKey,
    lighting: &Lighting,
    bubble: &BubbleKey,
    ring: &Ring,
    shown: &Shown<'_>,
) -> BubbleUniform {
    let film = &lighting.bands.optics.film;
    let [inner, outer] = ring.corners();
    let (thickness_nm, cells) = match &bubble.film {
        FilmKey::Uniform(thickness_nm) => (*thickness_nm as f32, 0),
        FilmKey::Field(field) => (0.0, field.cells),
    };
    let column = |axis: DVec3| (bubble.to_film * axis).extend(0.0).as_vec4().to_array();
    BubbleUniform {
        to_centre_m: floats(bubble.centre_m - key.camera.eye_m),
        radius_m: bubble.radius_m as f32,
        inner,
        outer,
        thickness_nm,
        cells,
        tracer_cells: shown.tracer_cells,
        thinned_nm: bubble.thinned_nm as f32,
        to_film: DVec3::AXES.map(column),
        stretch: matrix(bubble.stretch),
        unstretch: matrix(bubble.stretch.inverse()),
        black_nm: BLACK_FILM_NM as f32,
        extra_nm: film.equivalent_extra_nm() as f32,
        skins_nm: (2.0 * film.skin_nm).max(1e-3) as f32,
        map_cells: shown.map_cells,
        rim_z: bubble.cap.map_or(-2.0, |cap| cap.rim_z as f32),
        pad: [0.0; 3],
    }
}
