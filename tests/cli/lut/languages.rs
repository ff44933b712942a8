//! Functions in each language as one that the adapter runs, and the texture that they sample.

use glam::{DVec3, Vec3};
use soapfilm::gpu::{Gpu, readback::Readback};

use super::{Desk, TABLE, films, glslang};

/// Runs functions in WGSL: each answer for the films in turn.
const WGSL: &str = "
@group(0) @binding(0) var one: texture_2d<f32>;
@group(0) @binding(1) var layers: texture_2d_array<f32>;
@group(0) @binding(2) var filtering: sampler;
@group(0) @binding(3) var<storage, read> films: array<vec4f>;
@group(0) @binding(4) var<storage, read_write> colours: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&films)) { return; }
    let film = films[id.x];
    colours[2 * id.x] = vec4f(film_reflection(one, filtering, film.x, film.y), 1.0);
    colours[2 * id.x + 1] = vec4f(film_reflection_of_layer(layers, filtering, i32(film.z), film.x, film.y), 1.0);
}
";

/// What functions in GLSL find before them.
const GLSL: &str = "#version 450
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D one;
layout(set = 0, binding = 1) uniform texture2DArray layers;
layout(set = 0, binding = 2) uniform sampler filtering;
layout(set = 0, binding = 3) readonly buffer Films { vec4 films[]; };
layout(set = 0, binding = 4) buffer Colours { vec4 colours[]; };
";

/// Runs functions in HLSL.
pub const HLSL: &str = "
Texture2D<float4> one : register(t0);
Texture2DArray<float4> layers : register(t1);
SamplerState filtering : register(s2);
StructuredBuffer<float4> films : register(t3);
RWStructuredBuffer<float4> colours : register(u4);
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {
    uint count, stride;
    films.GetDimensions(count, stride);
    if (id.x >= count) { return; }
    float4 film = films[id.x];
    colours[2 * id.x] = float4(film_reflection(one, filtering, film.x, film.y), 1.0);
    colours[2 * id.x + 1] = float4(film_reflection_of_layer(layers, filtering, int(film.z), film.x, film.y), 1.0);
}
";

/// `main` in GLSL with an expression for each of the two answers.
fn glsl_main(one: &str, layer: &str) -> String {
    format!(
        "void main() {{
            uint k = gl_GlobalInvocationID.x;
            if (k >= uint(films.length())) {{ return; }}
            vec4 film = films[k];
            colours[2u * k] = vec4({one}, 1.0);
            colours[2u * k + 1u] = vec4({layer}, 1.0);
        }}\n"
    )
}

/// Replaces each text, which must be there.
fn replaced(text: &str, pairs: &[(&str, &str)]) -> String {
    pairs.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "`{from}` is not in {text}");
        text.replace(from, to)
    })
}

pub fn wgsl(functions: &str) -> String {
    format!("{functions}{WGSL}")
}

pub fn glsl_as_wgsl(functions: &str) -> String {
    let functions = replaced(
        functions,
        &[
            ("sampler2D lut", "texture2D lut"),
            ("sampler2DArray lut", "texture2DArray lut"),
            ("textureLod(lut, film_uv", "textureLod(sampler2D(lut, filtering), film_uv"),
            ("textureLod(lut, vec3", "textureLod(sampler2DArray(lut, filtering), vec3"),
        ],
    );
    let main = glsl_main(
        "film_reflection(one, film.x, film.y)",
        "film_reflection_of_layer(layers, int(film.z), film.x, film.y)",
    );
    wgsl_of_glsl(&format!("{GLSL}{functions}{main}"))
}

/// The second answer is in BT.709.
pub fn osl_as_wgsl(functions: &str) -> String {
    let functions = replaced(
        functions.split("shader soap_film").next().unwrap(),
        &[
            ("string lut, ", ""),
            (
                "texture(lut, s, t, \"wrap\", \"clamp\", \"interp\", \"linear\", \"width\", 0.0, \"firstchannel\", first)",
                "channels(s, t, first)",
            ),
        ],
    );
    // Channels as OpenImageIO orders them: first the layer without a name, then p, then s.
    let texture = "#define color vec3\nvec3 channels(float s, float t, int first) {\n\
                   int layer = (first == 0) ? 0 : (first == 3) ? 2 : 1;\n\
                   return textureLod(sampler2DArray(layers, filtering), vec3(s, t, float(layer)), 0.0).rgb;\n}\n";
    // The texture of one layer has no part in it, but a place in the bindings.
    let reflection = "film_reflection(int(film.z), film.x, film.y) + 0.0 * textureLod(sampler2D(one, filtering), vec2(0.5), 0.0).rgb";
    wgsl_of_glsl(&format!(
        "{GLSL}{texture}{functions}{}",
        glsl_main(reflection, &format!("film_to_bt709({reflection})"))
    ))
}

fn wgsl_of_glsl(text: &str) -> String {
    let options = naga::front::glsl::Options::from(naga::ShaderStage::Compute);
    let parsed = naga::front::glsl::Frontend::default().parse(&options, text);
    wgsl_of(&parsed.unwrap_or_else(|error| panic!("{}", error.emit_to_string(text))))
}

/// Nothing where glslangValidator is not installed.
pub fn hlsl_as_wgsl(desk: &Desk, functions: &str) -> Option<String> {
    let (file, spirv) = ("run.hlsl", desk.path("run.spv"));
    let options = ["-D", "-S", "comp", "-e", "main"];
    if !glslang(desk, file, &format!("{functions}{HLSL}"), &options, &spirv) {
        return None;
    }
    let words = std::fs::read(spirv).unwrap();
    Some(wgsl_of(&naga::front::spv::parse_u8_slice(&words, &Default::default()).unwrap()))
}

pub fn metal_as_wgsl(desk: &Desk, functions: &str) -> Option<String> {
    let functions = replaced(
        functions,
        &[
            ("#include <metal_stdlib>\nusing namespace metal;\n", ""),
            ("constant ", "static const "),
            ("mix(", "lerp("),
            ("texture2d<float> lut, sampler", "Texture2D<float4> lut, SamplerState"),
            ("texture2d_array<float> lut, sampler", "Texture2DArray<float4> lut, SamplerState"),
            (
                "lut.sample(lut_sampler, film_uv(cos_theta, thickness_nm), level(0.0))",
                "lut.SampleLevel(lut_sampler, film_uv(cos_theta, thickness_nm), 0.0)",
            ),
            (
                "lut.sample(lut_sampler, film_uv(cos_theta, thickness_nm), layer, level(0.0))",
                "lut.SampleLevel(lut_sampler, float3(film_uv(cos_theta, thickness_nm), float(layer)), 0.0)",
            ),
        ],
    );
    hlsl_as_wgsl(desk, &functions)
}

fn wgsl_of(module: &naga::Module) -> String {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let info = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module).unwrap();
    naga::back::wgsl::write_string(module, &info, naga::back::wgsl::WriterFlags::empty()).unwrap()
}

/// Rows of layers, the last one first.
pub fn turned_over(layers: &[Vec<Vec3>; 3]) -> [Vec<Vec3>; 3] {
    layers.clone().map(|layer| layer.chunks_exact(TABLE.columns).rev().flatten().copied().collect())
}

/// A texture of half floats on the device.
fn texture(gpu: &Gpu, layers: &[Vec<Vec3>]) -> wgpu::Texture {
    let bytes: Vec<u8> = layers
        .iter()
        .flatten()
        .flat_map(|texel| texel.extend(1.0).to_array())
        .flat_map(|value| half::f16::from_f32(value).to_le_bytes())
        .collect();
    let size = wgpu::Extent3d {
        width: TABLE.columns as u32,
        height: TABLE.rows as u32,
        depth_or_array_layers: layers.len() as u32,
    };
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("table"),
        size,
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba16Float,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let layout = wgpu::TexelCopyBufferLayout {
        offset: 0,
        bytes_per_row: Some(8 * TABLE.columns as u32),
        rows_per_image: Some(TABLE.rows as u32),
    };
    gpu.queue.write_texture(texture.as_image_copy(), &bytes, layout, size);
    texture
}

/// The two answers of a shader for each film.
pub fn sample(gpu: &Gpu, shader: &str, layers: &[Vec<Vec3>; 3], layer: usize) -> Vec<[DVec3; 2]> {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("functions for other engines"),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    });
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    let films: Vec<[f32; 4]> = films().iter().map(|(cos, nm)| [*cos as f32, *nm as f32, layer as f32, 0.0]).collect();
    let size = 2 * 16 * films.len() as u64;
    let colours = gpu.buffer("colours", size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let films = gpu.storage("films", &films);
    let (one, array) = (texture(gpu, &layers[layer..=layer]), texture(gpu, layers));
    let views = [(&one, wgpu::TextureViewDimension::D2), (&array, wgpu::TextureViewDimension::D2Array)].map(
        |(texture, dimension)| {
            texture.create_view(&wgpu::TextureViewDescriptor { dimension: Some(dimension), ..Default::default() })
        },
    );
    // As the texts say: linear, and no wrapping at the ends.
    let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let resources = [
        (0, wgpu::BindingResource::TextureView(&views[0])),
        (1, wgpu::BindingResource::TextureView(&views[1])),
        (2, wgpu::BindingResource::Sampler(&sampler)),
        (3, films.as_entire_binding()),
        (4, colours.as_entire_binding()),
    ]
    .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource });
    let bindings = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &resources,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bindings, &[]);
    pass.dispatch_workgroups(films.size().div_ceil(16 * 64) as u32, 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    let found: Vec<[[f32; 4]; 2]> =
        bytemuck::pod_collect_to_vec(&Readback::of_buffer(gpu, &colours, size).wait(gpu).unwrap());
    found.into_iter().map(|pair| pair.map(|[r, g, b, _]| Vec3::new(r, g, b).as_dvec3())).collect()
}
