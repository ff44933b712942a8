//! `soapfilm film`: the thickness of a bubble's film as numbers.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{AdapterArguments, SceneSettings, parse, progress::Progress};
use crate::{
    input::LoadedScene,
    output::{CsvWriter, check_target, print, write_atomically},
    physics::film::{
        Flow,
        properties::{SURFACE_VISCOSITY, VISCOSITY, kinematic_viscosity},
    },
    scene::Scene,
    studio::{FilmCell, Studio, reference_film},
};

/// Write the thickness of a bubble's film, cell by cell
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm film default --time 0.5 -o film.csv\n  soapfilm film default --time 0.2 --reference --set bubble.0.film.cells=32\n\nThe file has a row for each cell of the film's grid: x, y and z of the unit vector from the bubble's center, the cell's solid angle in\nsteradians, and the thickness in nm, which is 0 where there is no film. With --reference the film is moved by the model in f64 on the CPU,\nwithout an adapter: this is slow, and allows at most 64 cells along an edge."
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
    /// Write the cells to a CSV file
    #[arg(short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    settings: SceneSettings,
    #[command(flatten)]
    adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    arguments.output.as_deref().map_or(Ok(()), check_target)?;
    let scene = arguments.settings.load(&arguments.scene)?;
    let cells = cells(arguments, &scene)?;
    if let Some(path) = &arguments.output {
        save(path, &cells)?;
    }
    Ok(print(format_args!("{}\n{}", summary(&cells), viscosity(&scene.scene, arguments.bubble)))?)
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
    let progress = Progress::new("film", 1);
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
