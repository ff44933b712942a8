//! `soapfilm lut`: the lookup table, for other people's engines.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Args;
use glam::{DVec3, Vec3};

use super::{AdapterArguments, PHYSICS_IS_LESS_CERTAIN, parse};
use crate::{
    input::{load_illuminant, load_liquid},
    output::{FilmTableFile, Metadata, TableFormat, TablePrecision, write_text},
    physics::{
        colour::{BT2020, FilmOptics, FilmTable, FilmTexel, Walls, bt2020_to_bt709, m2_delta_e},
        optics::FilmMaterial,
    },
};

/// Write the lookup table of film colours, with code that samples it
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm lut -o water.exr --illuminant A\n  soapfilm lut -o film.ktx2 --film \"glycerol 30%\"\n\nThe command also writes a text on the axes, the accuracy and how to load the table, and files of functions that sample it in\nWGSL, GLSL, HLSL and Metal, and with an EXR file also in Open Shading Language (Blender's Cycles). All are named like the table.\nThe table is computed in f64 on the CPU; no adapter is used."
)]
pub struct Arguments {
    /// The file to write: .exr for programs that load pictures, .ktx2 or .bin (raw texels, described by a .json file) for engines and the web
    #[arg(short, value_name = "FILE.exr|FILE.ktx2|FILE.bin")]
    output: PathBuf,
    /// `water`, `water 25C`, `glycerol 30%`, a refractive index, or a CSV file of wavelength_nm,n
    #[arg(long, value_name = "FILM", default_value = "water")]
    film: String,
    /// Thickness in nm of the layer of soap molecules on each face
    #[arg(long, value_name = "NM", default_value = "0", value_parser = parse::skin_nm)]
    skin: f64,
    #[arg(long, value_name = "LIGHT", default_value = "D65", help = parse::illuminant_help())]
    illuminant: String,
    /// Thickness at the last row for normal incidence, in nm
    #[arg(long, value_name = "NM", default_value = "1500", value_parser = parse::range_nm)]
    range: f64,
    /// Columns and rows
    #[arg(long, value_name = "COLUMNSxROWS", default_value = "64x2048", value_parser = parse::table_size, allow_hyphen_values = true)]
    size: [u32; 2],
    /// Write 32-bit floats instead of 16-bit floats; some GPUs cannot filter them
    #[arg(long)]
    float32: bool,
    #[command(flatten)]
    _adapter: AdapterArguments,
}

/// Functions that sample the table in one language.
struct Snippet {
    language: &'static str,
    /// Ending of its file.
    ending: &'static str,
    /// The functions, with the table's numbers between @ signs.
    text: &'static str,
}

/// Open Shading Language reads EXR files alone.
const OSL: &str = "OSL";

const SNIPPETS: [Snippet; 5] = [
    Snippet { language: "WGSL", ending: "wgsl", text: include_str!("../../assets/lut/sample.wgsl") },
    Snippet { language: "GLSL", ending: "glsl", text: include_str!("../../assets/lut/sample.glsl") },
    Snippet { language: "HLSL", ending: "hlsl", text: include_str!("../../assets/lut/sample.hlsl") },
    Snippet { language: "Metal", ending: "metal", text: include_str!("../../assets/lut/sample.metal") },
    Snippet { language: OSL, ending: "osl", text: include_str!("../../assets/lut/sample.osl") },
];

/// How to load a table, for people.
const LOADING: &str = include_str!("../../assets/lut/loading.txt");

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let format = TableFormat::of(&arguments.output)
        .with_context(|| format!("{}: write to a file that ends in .exr, .ktx2 or .bin", arguments.output.display()))?;
    let (folder, mut notes) = (Path::new(""), Vec::new());
    let film = FilmMaterial { index: load_liquid(&arguments.film, folder, &mut notes)?, skin_nm: arguments.skin };
    let optics = FilmOptics::new(film, &load_illuminant(&arguments.illuminant, folder, &mut notes)?);
    super::tell_notes(&notes);
    let [columns, rows] = arguments.size.map(|size| size as usize);
    let index = optics.film().reference_index();
    let table = FilmTable { columns, rows, max_thickness_nm: arguments.range, index };
    let precision = if arguments.float32 { TablePrecision::Single } else { TablePrecision::Half };
    let texels = table.texels(&optics);
    anyhow::ensure!(
        texels.iter().all(|texel| texel.s.is_finite() && texel.p.is_finite()),
        "this table is not finite; please report it"
    );
    let metadata = metadata(arguments, &table, &Accuracy::measure(&table, &texels, precision, &optics));
    let layers = layers(&texels);
    FilmTableFile { columns, rows, layers: &layers, precision, metadata: &metadata }.save(&arguments.output, format)?;
    write_snippets(arguments, format, &table, &metadata)
}

/// The layers of a file, in its order.
fn layers(texels: &[FilmTexel]) -> [Vec<Vec3>; 3] {
    let parts: [fn(&FilmTexel) -> DVec3; 3] = [FilmTexel::unpolarised, |texel| texel.s, |texel| texel.p];
    parts.map(|part| texels.iter().map(|texel| part(texel).as_vec3()).collect())
}

/// The text and the functions, beside the table.
fn write_snippets(
    arguments: &Arguments,
    format: TableFormat,
    table: &FilmTable,
    metadata: &Metadata,
) -> anyhow::Result<()> {
    let mut text = description(arguments, metadata);
    for snippet in SNIPPETS.iter().filter(|snippet| format == TableFormat::Exr || snippet.language != OSL) {
        let functions = filled(snippet.text, arguments, table);
        text += &format!("\n---- {} ----\n{functions}", snippet.language);
        write_text(&arguments.output.with_extension(snippet.ending), &functions)?;
    }
    Ok(write_text(&arguments.output.with_extension("txt"), &text)?)
}

/// How far a table is from the spectral sum.
struct Accuracy {
    /// CIEDE2000 where filtered, each angle exposed so that its brightest film is white: mean and maximum.
    delta_e: [f64; 2],
    /// What rounding to the file's floats changes at most.
    rounding: f64,
}

/// Films at which a table is compared with the spectral sum.
const FILMS: u32 = 2000;

impl Accuracy {
    fn measure(table: &FilmTable, texels: &[FilmTexel], precision: TablePrecision, optics: &FilmOptics) -> Self {
        let exact: Vec<DVec3> = texels.iter().map(FilmTexel::unpolarised).collect();
        let stored: Vec<DVec3> =
            exact.iter().map(|texel| texel.as_vec3().map(|value| precision.stored(value)).as_dvec3()).collect();
        let (film, white) = (optics.film(), optics.weights().white());
        let error = |(cos_theta, thickness_nm): (f64, f64)| {
            let truth = optics.xyz(cos_theta, Walls::One { thickness_nm });
            let found = film.max_reflectance(cos_theta) * table.filtered(&stored, cos_theta, thickness_nm);
            m2_delta_e(truth, BT2020.to_xyz() * found, film, cos_theta, 1, white)
        };
        let errors: Vec<f64> = films(table.max_thickness_nm).map(error).collect();
        let rounding = exact.iter().zip(&stored).map(|(exact, stored)| (*exact - *stored).abs().max_element());
        Self {
            delta_e: [errors.iter().sum::<f64>() / f64::from(FILMS), errors.iter().copied().fold(0.0, f64::max)],
            rounding: rounding.fold(0.0, f64::max),
        }
    }
}

/// Films of every kind: uniform on the disk that a sphere is seen as, cos θ ≥ 0.05, and in thickness. Roberts' R2 lattice, so the same on
/// every machine.
fn films(max_nm: f64) -> impl Iterator<Item = (f64, f64)> {
    let unit = |k: u32, step: f64| (0.5 + f64::from(k) * step).fract();
    let cos_theta = move |k| (0.0025 + 0.9975 * unit(k, 0.754_877_666_246_692_7)).sqrt();
    (0..FILMS).map(move |k| (cos_theta(k), max_nm * unit(k, 0.569_840_290_998_053_2)))
}

/// The axes, as the header holds them.
fn metadata(arguments: &Arguments, table: &FilmTable, accuracy: &Accuracy) -> Metadata {
    let FilmTable { columns, rows, max_thickness_nm, index } = table;
    let [mean, max] = accuracy.delta_e;
    Metadata::new()
        .with("Film", &arguments.film)
        .with("Skin", &format!("{} nm", arguments.skin))
        .with("Illuminant", &arguments.illuminant)
        .with("Columns", &format!("{columns}, texel center x = 0 .. {}: cos_theta = (x / {})^2", columns - 1, columns - 1))
        .with("Rows", &format!("{rows}, texel center y = 0 .. {}: thickness_nm = {max_thickness_nm} t (t + 0.5) / 1.5 / cos_t, t = y / {}", rows - 1, rows - 1))
        .with("CosT", &format!("sqrt(1 - (1 - cos_theta^2) / {index}^2), the cosine inside the film"))
        .with("FirstRow", "y = 0, no film, is the first row of the file and the top of the picture")
        .with("Values", "linear BT.2020 colour of reflected white light (perfect mirror: Y = 1) / Rmax(cos_theta)")
        .with("Rmax", "mean over s and p of (2 r / (1 + r^2))^2 with Fresnel's r_s and r_p at the index above")
        .with("Polarisation", "the layers s and p are divided by the same Rmax; their mean is the layer for unpolarised light")
        .with("Precision", &format!(
            "{}-bit floats, at most {:.1e} from the computed values",
            if arguments.float32 { 32 } else { 16 }, accuracy.rounding
        ))
        .with("Accuracy", &format!("CIEDE2000 {mean:.3} on average, {max:.2} at most, against the spectral sum at {FILMS} films with cos_theta >= 0.05, filtered linearly, each angle exposed so that its brightest film is white"))
}

fn description(arguments: &Arguments, metadata: &Metadata) -> String {
    let matrix = bt2020_to_bt709();
    let rows = ["R", "G", "B"].into_iter().zip(0..);
    let to_bt709 = rows.map(|(name, row)| format!("  {name} = {}\n", weighted(matrix.row(row), ["r", "g", "b"])));
    format!(
        "{}: the colour that a film of {} reflects under {}\n\n{}\n{LOADING}\nFrom linear BT.2020 r, g, b to linear BT.709 (sRGB primaries):\n{}\n{PHYSICS_IS_LESS_CERTAIN}\n",
        arguments.output.file_name().unwrap_or_default().to_string_lossy(),
        arguments.film,
        arguments.illuminant,
        metadata.to_lines(),
        to_bt709.collect::<String>()
    )
}

/// A sum of three products, as all languages write it.
fn weighted(weights: DVec3, names: [&str; 3]) -> String {
    let [x, y, z] = weights.to_array();
    let term =
        |weight: f64, name: &str| format!("{} {:.10} * {name}", if weight < 0.0 { '-' } else { '+' }, weight.abs());
    format!("{x:.10} * {} {} {}", names[0], term(y, names[1]), term(z, names[2]))
}

/// A snippet with a table's numbers and name.
fn filled(snippet: &str, arguments: &Arguments, table: &FilmTable) -> String {
    let matrix = bt2020_to_bt709();
    let row = |k: usize| weighted(matrix.row(k), ["c[0]", "c[1]", "c[2]"]);
    snippet
        .replace("@COLUMNS@", &table.columns.to_string())
        .replace("@ROWS@", &table.rows.to_string())
        .replace("@MAX_NM@", &format!("{:?}", table.max_thickness_nm))
        .replace("@INDEX@", &format!("{:?}", table.index))
        .replace("@RED@", &row(0))
        .replace("@GREEN@", &row(1))
        .replace("@BLUE@", &row(2))
        .replace("@FILE@", &arguments.output.file_name().unwrap_or_default().to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{colour::Illuminant, optics::FilmIndex};

    #[test]
    fn accuracy_is_measured() {
        let optics = FilmOptics::new(FilmIndex::Water, &Illuminant::default());
        let index = optics.film().reference_index();
        let measured = |rows, precision| {
            let table = FilmTable { columns: 32, rows, max_thickness_nm: 500.0, index };
            Accuracy::measure(&table, &table.texels(&optics), precision, &optics)
        };
        let (coarse, fine) = (measured(16, TablePrecision::Single), measured(256, TablePrecision::Single));
        assert!(coarse.delta_e[0] > 5.0 * fine.delta_e[0], "{:?} {:?}", coarse.delta_e, fine.delta_e);
        assert!(fine.rounding > 0.0 && fine.rounding < 1e-7, "{}", fine.rounding);
        let half = measured(256, TablePrecision::Half);
        // Values are at most about 1, where halves lie 2^-11 apart below and 2^-10 above.
        assert!(half.rounding > 1e-4 && half.rounding <= 0.5 / 1024.0, "{}", half.rounding);
        assert!((half.delta_e[0] - fine.delta_e[0]).abs() < 0.1, "{:?} {:?}", half.delta_e, fine.delta_e);
    }

    #[test]
    fn sums_are_written_as_shaders_read_them() {
        let text = weighted(DVec3::new(1.5, -0.5, 0.25), ["r", "g", "b"]);
        assert_eq!(text, "1.5000000000 * r - 0.5000000000 * g + 0.2500000000 * b");
    }
}
