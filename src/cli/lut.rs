//! `soapfilm lut`: the lookup table, for other people's engines.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{AdapterArguments, PHYSICS_IS_LESS_CERTAIN, parse};
use crate::{
    input::{load_illuminant, load_liquid},
    output::{ExrPicture, ExrPrimaries, Metadata, write_text},
    physics::{
        colour::{FilmOptics, FilmTable},
        optics::FilmMaterial,
    },
};

/// Write the lookup table of film colours, and how to sample it
#[derive(Args)]
#[command(
    after_help = "Example:\n  soapfilm lut -o water.exr --illuminant A\n\nBeside the EXR file a text with its axes and shader functions in WGSL, GLSL and HLSL is written. The table is computed in f64 on the CPU;\nno adapter is used."
)]
pub struct Arguments {
    /// The file to write; the text goes beside it, with the ending .txt
    #[arg(short, value_name = "FILE.exr")]
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
    #[arg(long, value_name = "COLUMNSxROWS", default_value = "64x2048", value_parser = parse::table_size)]
    size: [u32; 2],
    #[command(flatten)]
    _adapter: AdapterArguments,
}

/// Shader functions that sample the table, by language; the table's numbers stand between @ signs.
const SNIPPETS: [(&str, &str); 3] = [
    ("WGSL", include_str!("../../assets/lut/sample.wgsl")),
    ("GLSL", include_str!("../../assets/lut/sample.glsl")),
    ("HLSL", include_str!("../../assets/lut/sample.hlsl")),
];

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let ending = arguments.output.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    anyhow::ensure!(
        ending.as_deref() == Some("exr"),
        "{}: write to a file that ends in .exr",
        arguments.output.display()
    );
    let (folder, mut notes) = (Path::new(""), Vec::new());
    let film = FilmMaterial { index: load_liquid(&arguments.film, folder, &mut notes)?, skin_nm: arguments.skin };
    let optics = FilmOptics::new(film, &load_illuminant(&arguments.illuminant, folder, &mut notes)?);
    super::tell(&notes);
    let [columns, rows] = arguments.size.map(|size| size as usize);
    let index = optics.film().reference_index();
    let table = FilmTable { columns, rows, max_thickness_nm: arguments.range, index };
    let texels = table.texels(&optics);
    let pixels: Vec<[f32; 3]> = texels.iter().map(|texel| texel.as_vec3().to_array()).collect();
    let metadata = metadata(arguments, &table);
    let picture = ExrPicture {
        width: columns,
        height: rows,
        channels: ["R", "G", "B"],
        pixels: &pixels,
        primaries: Some(ExrPrimaries::Bt2020),
        metadata: &metadata,
    };
    picture.save(&arguments.output)?;
    Ok(write_text(&arguments.output.with_extension("txt"), &description(arguments, &table))?)
}

/// The axes, as the header holds them.
fn metadata(arguments: &Arguments, table: &FilmTable) -> Metadata {
    let FilmTable { columns, rows, max_thickness_nm, index } = table;
    Metadata::new()
        .with("Film", &arguments.film)
        .with("Skin", &format!("{} nm", arguments.skin))
        .with("Illuminant", &arguments.illuminant)
        .with("Columns", &format!("{columns}, texel centre x = 0 .. {}: cos_theta = (x / {})^2", columns - 1, columns - 1))
        .with("Rows", &format!("{rows}, texel centre y = 0 .. {}: thickness_nm = {max_thickness_nm} t (t + 0.5) / 1.5 / cos_t, t = y / {}", rows - 1, rows - 1))
        .with("CosT", &format!("sqrt(1 - (1 - cos_theta^2) / {index}^2), the cosine inside the film"))
        .with("Values", "linear BT.2020 colour of reflected white light (perfect mirror: Y = 1) / Rmax(cos_theta)")
        .with("Rmax", "mean over s and p of (2 r / (1 + r^2))^2 with Fresnel's r_s and r_p at the index above")
}

fn description(arguments: &Arguments, table: &FilmTable) -> String {
    let mut text = format!(
        "{}: what a film of {} reflects under {}\n\n{}\n",
        arguments.output.file_name().unwrap_or_default().to_string_lossy(),
        arguments.film,
        arguments.illuminant,
        metadata(arguments, table).to_lines()
    );
    text += &format!("{PHYSICS_IS_LESS_CERTAIN}\n");
    for (language, snippet) in SNIPPETS {
        text += &format!("\n---- {language} ----\n{}", filled(snippet, table));
    }
    text
}

/// A snippet with a table's numbers.
fn filled(snippet: &str, table: &FilmTable) -> String {
    snippet
        .replace("@COLUMNS@", &table.columns.to_string())
        .replace("@ROWS@", &table.rows.to_string())
        .replace("@MAX_NM@", &format!("{:?}", table.max_thickness_nm))
        .replace("@INDEX@", &format!("{:?}", table.index))
}
