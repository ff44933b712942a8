//! The lookup table for other engines: each file is read as strangers read it, each language samples it as its text says, and the result is
//! compared with the spectral sum in f64.
//!
//! WGSL runs as it is. GLSL runs with its combined samplers taken apart, which Vulkan's GLSL has and WebGPU needs; as it is, it is compiled.
//! HLSL runs through glslangValidator's SPIR-V. Metal runs as HLSL and Open Shading Language as GLSL after the few replacements below, because
//! no compiler of theirs is at hand: their arithmetic is tested, their texture calls are only replaced.

mod languages;

use std::{path::Path, sync::LazyLock};

use glam::{DVec3, Vec3};
use soapfilm::{
    output::read_back::read_exr,
    physics::{
        colour::{BT2020, FilmOptics, FilmTable, Illuminant, bt2020_to_bt709},
        optics::FilmIndex,
    },
};

use super::{Desk, colour::glslang, support};
use languages::{HLSL, glsl_as_wgsl, hlsl_as_wgsl, metal_as_wgsl, osl_as_wgsl, sample, turned_over, wgsl};

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

/// Mean and maximum of differences, as fractions of the maximum reflectance at the angle.
fn differences(layer: usize, found: impl Iterator<Item = DVec3>) -> (f64, f64) {
    let error = |(film, found): ((f64, f64), DVec3)| {
        (found - truth(layer, film)).abs().max_element() / OPTICS.film().max_reflectance(film.0)
    };
    support::mean_and_max(films().into_iter().zip(found).map(error))
}

/// Fails unless colours are within the table's resolution of the truth.
fn compare(what: &str, layer: usize, found: impl Iterator<Item = DVec3>) {
    let (mean, max) = differences(layer, found);
    eprintln!("measured: {what}, layer {layer}: off by {mean:.5} on average, {max:.4} at most");
    // Measured 0.0007 and 0.0027, most of it from 48 columns: s and p vary faster with the angle than both together.
    assert!(mean < 0.001 && max < 0.004, "{what}, layer {layer}: {mean} {max}");
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
    let sampled = |texels: &[Vec3]| {
        let texels: Vec<DVec3> = texels.iter().map(|texel| texel.as_dvec3()).collect();
        films().into_iter().map(move |(cos_theta, thickness_nm)| {
            OPTICS.film().max_reflectance(cos_theta) * TABLE.filtered(&texels, cos_theta, thickness_nm)
        })
    };
    for (layer, texels) in layers.iter().enumerate() {
        compare("film.exr", layer, sampled(texels));
        // A planted error of half a row, as of coordinates that miss the texels' centers, would be found.
        let half_a_row: Vec<Vec3> = texels.iter().zip(&texels[TABLE.columns..]).map(|(a, b)| 0.5 * (*a + *b)).collect();
        let shifted = [&half_a_row[..], &texels[texels.len() - TABLE.columns..]].concat();
        let (mean, _) = differences(layer, sampled(&shifted));
        eprintln!("measured: half a row aside, layer {layer}: off by {mean:.5} on average");
        assert!(mean > 0.002, "{mean}");
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
    hold("wgsl", |_, functions| Some(wgsl(functions)));
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
        glslang(&desk, file, &text, &["-l"], Path::new(""));
    }
    let hlsl = functions(&desk, "hlsl", false) + HLSL;
    glslang(&desk, "run.hlsl", &hlsl, &["-D", "-S", "comp", "-e", "main"], Path::new("/dev/null"));
}
