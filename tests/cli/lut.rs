//! The lookup table for other engines: each file is read as strangers read it, each language samples it as its text says, and the result is
//! compared with the spectral sum in f64.
//!
//! WGSL runs as it is. GLSL runs with its combined samplers taken apart, which Vulkan's GLSL has and WebGPU needs; as it is, it is compiled.
//! HLSL runs through glslangValidator's SPIR-V. Metal runs as HLSL and Open Shading Language as GLSL after the few replacements below, because
//! no compiler of theirs is at hand: their arithmetic is tested, their texture calls are only replaced.

use std::sync::LazyLock;

use glam::{DVec3, Vec3};
use soapfilm::{
    gpu::{Gpu, readback::Readback},
    output::read_back::read_exr,
    physics::{
        colour::{BT2020, FilmOptics, FilmTable, Illuminant, bt2020_to_bt709},
        optics::FilmIndex,
    },
};

use super::{Desk, colour::glslang, support};

const ARGUMENTS: &str = "--size 48x512 --range 800 --film 1.4";
const TABLE: FilmTable = FilmTable { columns: 48, rows: 512, max_thickness_nm: 800.0, index: 1.4 };
/// Layers as files order them.
const CHANNELS: [[&str; 3]; 3] = [["R", "G", "B"], ["s.R", "s.G", "s.B"], ["p.R", "p.G", "p.B"]];

static OPTICS: LazyLock<FilmOptics> =
    LazyLock::new(|| FilmOptics::new(FilmIndex::Constant(TABLE.index), &Illuminant::default()));

/// Two hundred films of every angle and thickness.
fn films() -> Vec<(f64, f64)> {
    let mut random = support::Random(7);
    (0..200).map(|_| ((0.0025 + 0.9975 * random.next()).sqrt(), TABLE.max_thickness_nm * random.next())).collect()
}

/// What a layer stands for, linear BT.2020.
fn truth(layer: usize, (cos_theta, thickness_nm): (f64, f64)) -> DVec3 {
    let [s, p] = OPTICS.xyz_of_polarisations(cos_theta, thickness_nm);
    BT2020.from_xyz() * [0.5 * (s + p), s, p][layer]
}

/// Fails unless colours are within the table's resolution of the truth. Differences are parts of the most that a film reflects at the angle.
fn compare(what: &str, layer: usize, found: impl Iterator<Item = DVec3>) {
    let error = |(film, found): ((f64, f64), DVec3)| {
        (found - truth(layer, film)).abs().max_element() / OPTICS.film().max_reflectance(film.0)
    };
    let (mean, max) = support::mean_and_max(films().into_iter().zip(found).map(error));
    eprintln!("measured: {what}, layer {layer}: off by {mean:.5} on average, {max:.4} at most");
    // Measured 0.0005 and 0.004, most of it from 48 columns; a texel beside the right one is off by 0.02 on average.
    assert!(mean < 0.001 && max < 0.01, "{what}, layer {layer}: {mean} {max}");
}

/// The file's layers: for each the texels from the first row on.
fn read_layers(desk: &Desk, file: &str) -> [Vec<Vec3>; 3] {
    let read = read_exr(&desk.path(file)).unwrap();
    assert_eq!((read.width, read.height), (TABLE.columns, TABLE.rows));
    CHANNELS.map(|names| {
        let [r, g, b] = names.map(|name| read.channel(name).unwrap_or_else(|| panic!("no channel {name}")));
        r.iter().zip(g).zip(b).map(|((r, g), b)| Vec3::new(*r, *g, *b)).collect()
    })
}

fn written(ending: &str, options: &str) -> Desk {
    let desk = Desk::new();
    let run = desk.run(&format!("lut -o film.{ending} {ARGUMENTS} {options}"));
    assert!(run.success, "{}", run.err);
    desk
}

/// RGBA of the layers of raw texels: halves, or single floats.
fn decode(bytes: &[u8], single: bool) -> [Vec<Vec3>; 3] {
    let values: Vec<f32> = if single {
        bytemuck::pod_collect_to_vec(bytes)
    } else {
        bytes.chunks_exact(2).map(|pair| half::f16::from_le_bytes([pair[0], pair[1]]).to_f32()).collect()
    };
    assert_eq!(values.len(), 3 * 4 * TABLE.columns * TABLE.rows);
    let texel = |rgba: &[f32]| {
        assert_eq!(rgba[3], 1.0);
        Vec3::new(rgba[0], rgba[1], rgba[2])
    };
    let mut layers =
        values.chunks_exact(4 * TABLE.columns * TABLE.rows).map(|one| one.chunks_exact(4).map(texel).collect());
    [(); 3].map(|()| layers.next().unwrap())
}

/// All kinds of files hold the same numbers, and those are the film's colours.
#[test]
fn files_of_every_kind_hold_the_same_table() {
    let desk = written("exr", "");
    let layers = read_layers(&desk, "film.exr");
    for (layer, texels) in layers.iter().enumerate() {
        let texels: Vec<DVec3> = texels.iter().map(|texel| texel.as_dvec3()).collect();
        let sampled = films().into_iter().map(|(cos_theta, thickness_nm)| {
            OPTICS.film().max_reflectance(cos_theta) * TABLE.filtered(&texels, cos_theta, thickness_nm)
        });
        compare("film.exr", layer, sampled);
    }
    assert!(layers[0][..TABLE.columns].iter().all(|texel| *texel == Vec3::ZERO), "the first row is no film");

    let desk = written("ktx2", "");
    let bytes = std::fs::read(desk.path("film.ktx2")).unwrap();
    let read = ktx2::Reader::new(&bytes).unwrap();
    let header = read.header();
    assert_eq!(header.format, Some(ktx2::Format::R16G16B16A16_SFLOAT));
    assert_eq!((header.pixel_width as usize, header.pixel_height as usize), (TABLE.columns, TABLE.rows));
    assert_eq!((header.layer_count, header.supercompression_scheme), (3, None));
    assert!(read.key_value_data().any(|entry| entry == ("KTXorientation", b"rd\0")));
    assert_eq!(decode(read.levels().next().unwrap().data, false), layers);
    assert_eq!(desk.files(), ["film.glsl", "film.hlsl", "film.ktx2", "film.metal", "film.txt", "film.wgsl"]);

    let desk = written("bin", "");
    let about = super::json(&desk.path("film.json"));
    assert_eq!(about["format"], "rgba16float");
    assert_eq!(about["layers"], serde_json::json!(["unpolarised", "s", "p"]));
    let counts = ["columns", "rows", "bytes_per_row"].map(|key| about[key].as_u64().unwrap() as usize);
    assert_eq!(counts, [TABLE.columns, TABLE.rows, 8 * TABLE.columns]);
    assert_eq!(decode(&std::fs::read(desk.path("film.bin")).unwrap(), false), layers);
}

/// Full precision changes the numbers by no more than the text says halves do.
#[test]
fn full_precision_can_be_had() {
    let (halves, singles) = (written("exr", ""), written("exr", "--float32"));
    let text = std::fs::read_to_string(halves.path("film.txt")).unwrap();
    let stated =
        text.split("16-bit floats, at most ").nth(1).unwrap().split(' ').next().unwrap().parse::<f32>().unwrap();
    let [half, single] = [&halves, &singles].map(|desk| read_layers(desk, "film.exr"));
    let off = |layer: usize| half[layer].iter().zip(&single[layer]).map(|(a, b)| (*a - *b).abs().max_element());
    let worst = off(0).fold(0.0, f32::max);
    eprintln!("measured: halves are off by {worst:.2e} at most");
    assert!(worst > 1e-4 && worst <= 5e-4 && (worst / stated - 1.0).abs() < 0.06, "{worst} {stated}");
    let desk = written("ktx2", "--float32");
    let bytes = std::fs::read(desk.path("film.ktx2")).unwrap();
    let read = ktx2::Reader::new(&bytes).unwrap();
    assert_eq!(read.header().format, Some(ktx2::Format::R32G32B32A32_SFLOAT));
    assert_eq!(decode(read.levels().next().unwrap().data, true), single);
}

/// A language's functions, and the same after the loader has turned the rows over.
fn functions(desk: &Desk, ending: &str, turned: bool) -> String {
    let text = std::fs::read_to_string(desk.path(&format!("film.{ending}"))).unwrap();
    let section = std::fs::read_to_string(desk.path("film.txt")).unwrap();
    assert!(section.contains(&text), "the text beside the table has the same functions");
    let line = text.lines().find(|line| line.contains("LUT_TURNED") && line.contains("0.0") && !line.starts_with("//"));
    let line = line.unwrap();
    if turned { text.replace(line, &line.replace("0.0", "1.0")) } else { text }
}

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

const GLSL: &str = "#version 450
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D one;
layout(set = 0, binding = 1) uniform texture2DArray layers;
layout(set = 0, binding = 2) uniform sampler filtering;
layout(set = 0, binding = 3) readonly buffer Films { vec4 films[]; };
layout(set = 0, binding = 4) buffer Colours { vec4 colours[]; };
";

const HLSL: &str = "
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

fn glsl_as_wgsl(functions: &str) -> String {
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
fn osl_as_wgsl(functions: &str) -> String {
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
    // Channels as OpenImageIO orders them: those of the layer without a name, then of p, then of s.
    let texture = "#define color vec3\nvec3 channels(float s, float t, int first) {\n\
                   int layer = (first == 0) ? 0 : (first == 3) ? 2 : 1;\n\
                   return textureLod(sampler2DArray(layers, filtering), vec3(s, t, float(layer)), 0.0).rgb;\n}\n";
    let reflection = "film_reflection(int(film.z), film.x, film.y)";
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
fn hlsl_as_wgsl(desk: &Desk, functions: &str) -> Option<String> {
    let (file, spirv) = ("run.hlsl", desk.path("run.spv"));
    let options = ["-D", "-S", "comp", "-e", "main"];
    if !glslang(desk, file, &format!("{functions}{HLSL}"), &options, &spirv) {
        return None;
    }
    let words = std::fs::read(spirv).unwrap();
    Some(wgsl_of(&naga::front::spv::parse_u8_slice(&words, &Default::default()).unwrap()))
}

fn metal_as_wgsl(desk: &Desk, functions: &str) -> Option<String> {
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
fn turned_over(layers: &[Vec<Vec3>; 3]) -> [Vec<Vec3>; 3] {
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
fn sample(gpu: &Gpu, shader: &str, layers: &[Vec<Vec3>; 3], layer: usize) -> Vec<[DVec3; 2]> {
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
    let sampler = soapfilm::gpu::bake_table::table_sampler(gpu);
    // A shader that leaves out a binding has none in its layout.
    let all = [
        wgpu::BindingResource::TextureView(&views[0]),
        wgpu::BindingResource::TextureView(&views[1]),
        wgpu::BindingResource::Sampler(&sampler),
        films.as_entire_binding(),
        colours.as_entire_binding(),
    ];
    let used = (0..).zip(all).filter(|(place, _)| *place != 0 || shader.contains("texture_2d<f32>"));
    let bindings = gpu.bind_at(&pipeline.get_bind_group_layout(0), &used.collect::<Vec<_>>());
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

/// All layers of the file through a language's functions, with rows as the file has them and turned over.
fn hold(ending: &str, as_wgsl: impl Fn(&Desk, &str) -> Option<String>) {
    let Some(gpu) = support::gpu() else { return };
    let desk = written("exr", "");
    let layers = read_layers(&desk, "film.exr");
    for turned in [false, true] {
        let Some(shader) = as_wgsl(&desk, &functions(&desk, ending, turned)) else { return };
        let layers = if turned { turned_over(&layers) } else { layers.clone() };
        for layer in 0..3 {
            let found = sample(&gpu, &shader, &layers, layer);
            let second =
                |pair: &[DVec3; 2]| if ending == "osl" { bt2020_to_bt709().inverse() * pair[1] } else { pair[1] };
            compare(&format!("{ending}, turned: {turned}"), layer, found.iter().map(|pair| pair[0]));
            compare(&format!("{ending}, turned: {turned}, second"), layer, found.iter().map(second));
        }
    }
}

#[test]
fn wgsl_gives_the_films_colours() {
    hold("wgsl", |_, functions| Some(format!("{functions}{WGSL}")));
}

#[test]
fn glsl_gives_the_films_colours() {
    hold("glsl", |_, functions| Some(glsl_as_wgsl(functions)));
}

#[test]
fn hlsl_gives_the_films_colours() {
    hold("hlsl", hlsl_as_wgsl);
}

#[test]
fn metals_arithmetic_gives_the_films_colours() {
    hold("metal", metal_as_wgsl);
}

#[test]
fn open_shading_languages_arithmetic_gives_the_films_colours() {
    hold("osl", |_, functions| Some(osl_as_wgsl(functions)));
}

/// The functions as they are, in desktop GLSL, in GLSL ES and in HLSL.
#[test]
fn functions_compile_as_they_are() {
    let desk = written("exr", "");
    let glsl = functions(&desk, "glsl", false);
    let uniforms = "uniform sampler2D one;\nuniform sampler2DArray layers;\n";
    let main = "out vec4 colour;\nvoid main() { colour = vec4(film_reflection(one, 0.5, 300.0) + film_reflection_of_layer(layers, 1, 0.5, 300.0), 1.0); }\n";
    for (file, version) in [("es.frag", "#version 300 es\n"), ("desktop.frag", "#version 330\n")] {
        let text = format!("{version}{glsl}{uniforms}{main}");
        glslang(&desk, file, &text, &["-l"], std::path::Path::new(""));
    }
    let hlsl = functions(&desk, "hlsl", false) + HLSL;
    glslang(&desk, "run.hlsl", &hlsl, &["-D", "-S", "comp", "-e", "main"], std::path::Path::new("/dev/null"));
}
