//! `soapfilm film`: the thickness of a bubble's film as numbers, as a map, and as the material of a model.

mod model;

use std::path::{Path, PathBuf};

use clap::Args;

use super::{AdapterArguments, SceneSettings, parse, progress::progress};
use crate::{
    export::map::{FilmMap, Map, Projection},
    input::LoadedScene,
    output::{CsvWriter, Metadata, check_target, print, write_atomically},
    physics::film::{
        Flow,
        properties::{SURFACE_VISCOSITY, VISCOSITY, kinematic_viscosity},
    },
    plan::film_index,
    scene::Scene,
    studio::{FilmCell, Studio, reference_film, reference_film_at},
};
use model::Model;

/// Write the thickness of a bubble's film: as numbers, as a map, or as a glTF model
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm film default --time 0.5 -o film.csv\n  soapfilm film default --time 0.5 -o film.exr --map cube\n  soapfilm film default --time 0.5 -o film.gltf\n  soapfilm film default --time 0.2 --reference --set bubble.0.film.cells=32\n\nA CSV file has a row for each cell of the film's grid: x, y and z of the unit vector from the bubble's center, the cell's solid angle in\nsteradians, and the thickness in nm, which is 0 where there is no film. With --reference the film is moved by the model in f64 on the CPU,\nwithout an adapter: this is slow, and allows at most 64 cells along an edge.\n\nAn EXR file is a map of the thickness in nm. A glTF file is a sphere whose material has KHR_materials_iridescence with the thickness as\nits texture; beside NAME.gltf are written NAME.bin, its mesh, and NAME_thickness.png."
)]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: PathBuf,
    /// Time of the film, in seconds from its start
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = parse::time_s, allow_hyphen_values = true)]
    time: f64,
    /// Index of the bubble in the scene, counted from 0
    #[arg(long, value_name = "INDEX", default_value_t = 0)]
    bubble: usize,
    /// Move the film by the reference model, in f64 on the CPU
    #[arg(long)]
    reference: bool,
    /// Write the cells to a .csv file, a map of the thickness to an .exr file, or a model with such a map to a .gltf file
    #[arg(short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Layout of the map in an EXR file
    #[arg(long, value_name = "LAYOUT", default_value = "equirect")]
    map: Projection,
    /// Height of the map in pixels; of a cube map, the edge of a face
    #[arg(long, value_name = "PIXELS", default_value_t = 512, value_parser = clap::value_parser!(u32).range(1..=4096))]
    map_height: u32,
    #[command(flatten)]
    settings: SceneSettings,
    #[command(flatten)]
    adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments.output.as_deref().map_or(Ok(()), check_target)?;
    let scene = arguments.settings.load(&arguments.scene)?;
    let (ending, map) = (arguments.ending(), Map { projection: arguments.map, height: arguments.map_height });
    match (&arguments.output, ending.as_str()) {
        (Some(path), "exr") => save_map(arguments, &scene, &map, path),
        (Some(path), "gltf") => save_model(arguments, &scene, &Map { projection: Projection::Equirect, ..map }, path),
        _ => save_cells(arguments, &scene),
    }
}

impl Arguments {
    /// The ending of the file to write, which names its format.
    fn ending(&self) -> String {
        let ending = self.output.as_deref().and_then(Path::extension).and_then(|ending| ending.to_str());
        ending.unwrap_or_default().to_ascii_lowercase()
    }

    fn metadata(&self, scene: &LoadedScene) -> Metadata {
        Metadata::of_scene(&scene.name, self.time).with("Bubble", &self.bubble.to_string())
    }
}

fn save_cells(arguments: &Arguments, scene: &LoadedScene) -> anyhow::Result<()> {
    let cells = cells(arguments, scene)?;
    if let Some(path) = &arguments.output {
        save(path, &cells)?;
    }
    Ok(print(format_args!("{}\n{}", summary(&cells), viscosity(&scene.scene, arguments.bubble)))?)
}

fn save_map(arguments: &Arguments, scene: &LoadedScene, map: &Map, path: &Path) -> anyhow::Result<()> {
    let film = FilmMap::new(*map, mapped(arguments, scene, map)?);
    film.save(path, &arguments.metadata(scene))?;
    let [width, height] = map.size();
    Ok(print(format_args!("{width}x{height} pixels: {}\n", range(&film.thickness_nm)))?)
}

fn save_model(arguments: &Arguments, scene: &LoadedScene, map: &Map, path: &Path) -> anyhow::Result<()> {
    let thickness_nm = mapped(arguments, scene, map)?;
    // The film is there, and so its bubble is.
    let bubble = &scene.scene.bubbles[arguments.bubble];
    let model = Model {
        radius_m: 1e-3 * bubble.radius_mm,
        index: film_index(&bubble.film.index, &scene.resources)?.n(SODIUM_NM),
        size: map.size(),
        thickness_nm: &thickness_nm,
        metadata: &map.described(arguments.metadata(scene)),
    };
    let step_nm = model.save(path)?;
    Ok(print(format_args!("thickness in steps of {step_nm:.1} nm\n"))?)
}

/// Wavelength at which one number stands for the film's index.
const SODIUM_NM: f64 = 589.3;

fn mapped(arguments: &Arguments, scene: &LoadedScene, map: &Map) -> anyhow::Result<Vec<f64>> {
    let directions = map.directions();
    if !arguments.reference {
        let mut studio = Studio::on(arguments.adapter.open()?);
        return Ok(studio.film_at(scene, arguments.bubble, arguments.time, &directions)?);
    }
    let progress = progress("film", 1);
    let part = progress.part((arguments.time / scene.scene.motion.tick_s).ceil() as u64);
    let film = (arguments.bubble, arguments.time);
    Ok(reference_film_at(scene, film, &directions, &|ticks| part.add(ticks))?)
}

fn range(thickness_nm: &[f32]) -> String {
    let fold = |[low, high]: [f32; 2], nm: &f32| [low.min(*nm), high.max(*nm)];
    let [low, high] = thickness_nm.iter().fold([f32::INFINITY, 0.0], fold);
    format!("thickness {low} to {high} nm")
}

/// A line with the viscosity of a film that moves by itself, beside the viscosity of a film of soapy water with mobile surfaces.
fn viscosity(scene: &Scene, bubble: usize) -> String {
    let Some(bubble) = scene.bubbles.get(bubble).filter(|_| scene.motion.flow == Flow::Free) else {
        return String::new();
    };
    let thickness_m = 1e-9 * bubble.film.thickness_nm;
    let here = scene.motion.film_viscosity_m2_s(thickness_m);
    let of_water = kinematic_viscosity(VISCOSITY, SURFACE_VISCOSITY, thickness_m);
    let [here, of_water] = [here, of_water].map(|viscosity_m2_s| 1e6 * viscosity_m2_s);
    format!("viscosity {here:.0} mm²/s; soapy water with mobile surfaces has {of_water:.0} mm²/s\n")
}

fn cells(arguments: &Arguments, scene: &LoadedScene) -> anyhow::Result<Vec<FilmCell>> {
    if !arguments.reference {
        return Ok(Studio::on(arguments.adapter.open()?).film(scene, arguments.bubble, arguments.time)?);
    }
    let progress = progress("film", 1);
    let ticks = (arguments.time / scene.scene.motion.tick_s).ceil() as u64;
    let part = progress.part(ticks);
    Ok(reference_film(scene, arguments.bubble, arguments.time, &|ticks| part.add(ticks))?)
}

/// How much film there is, in a line.
fn summary(cells: &[FilmCell]) -> String {
    let film = || cells.iter().filter(|cell| cell.thickness_nm > 0.0);
    let area: f64 = film().map(|cell| cell.solid_angle_sr).sum();
    let liquid: f64 = film().map(|cell| cell.solid_angle_sr * cell.thickness_nm).sum();
    let range = film()
        .fold([f64::MAX, 0.0], |[low, high]: [f64; 2], cell| [low.min(cell.thickness_nm), high.max(cell.thickness_nm)]);
    if area == 0.0 {
        return format!("{} cells, no film", cells.len());
    }
    format!("{} cells: thickness {} nm on average, {} to {} nm", cells.len(), liquid / area, range[0], range[1])
}

fn save(path: &Path, cells: &[FilmCell]) -> anyhow::Result<()> {
    write_atomically(path, |file| {
        let mut table = CsvWriter::new(file, &["x", "y", "z", "solid_angle_sr", "thickness_nm"])?;
        cells.iter().try_for_each(|cell| {
            let [x, y, z] = cell.direction.to_array();
            table.row(&[x, y, z, cell.solid_angle_sr, cell.thickness_nm])
        })
    })?;
    Ok(())
}
