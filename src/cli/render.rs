//! `soapfilm render`: one picture.

use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::Args;

use super::{AdapterArguments, measure, parse, progress::Progress, reference};
use crate::{
    gpu::Renderer,
    input::LoadedScene,
    output::{Metadata, Picture},
    physics::{
        colour::Gamut,
        sphere::{HaloTable, PaddedField},
    },
    plan::{Moment, Pace, Shot, Want, want},
    studio::MAX_TICKS,
    verify::{
        self,
        reference::{MovedFilms, needs_device},
    },
};

/// Draw one picture into a PNG or EXR file.
#[derive(Args)]
#[command(
    after_help = "Example:\n  soapfilm render windows -o bubble.png --size 1920x1080 --time 5\n\nPNG shows what the window shows. EXR holds linear BT.709 scene radiance as f32, before exposure and tone mapping."
)]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: String,
    /// The file to write, .png or .exr
    #[arg(short, value_name = "FILE")]
    output: PathBuf,
    /// Width and height in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = parse::size)]
    size: [u32; 2],
    /// Moment of the film, in seconds from its start
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = parse::time_s)]
    time: f64,
    /// `fast`, `standard`, `spectral` (wavelengths in the shader) or `reference` (f64 on the CPU; a GPU is needed for a film that moves by itself) [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = parse::quality)]
    quality: Option<parse::Quality>,
    /// Colours of a PNG: `srgb`, or `p3` for wide displays
    #[arg(long, value_name = "GAMUT", default_value = "srgb", value_parser = parse::gamut)]
    gamut: Gamut,
    /// Print the frame plan, and why each pass runs
    #[arg(long)]
    explain: bool,
    /// Draw the frame so many times more, everything but the bakes anew each time, and measure
    #[arg(long, value_name = "N", default_value_t = 0)]
    repeat: u32,
    /// Between the repeated frames, draw as many with a plain sphere that does one environment lookup, and report both
    #[arg(long)]
    yardstick: bool,
    /// Write what the frame cost to a JSON file
    #[arg(long, value_name = "FILE.json")]
    stats: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let format = Format::of(arguments)?;
    let mut loaded = super::load(&arguments.scene)?;
    if let Some(parse::Quality::Gpu(quality)) = arguments.quality {
        loaded.scene.view.quality = quality;
    }
    let moment = Moment::of_time(arguments.time, loaded.scene.motion.tick_s);
    if moment.tick > MAX_TICKS {
        bail!("--time {} is {} ticks of this scene; at most {MAX_TICKS} can be simulated", arguments.time, moment.tick);
    }
    let shot = Shot {
        size: arguments.size,
        moment,
        full_precision: format == Format::Exr,
        gamut: arguments.gamut,
        yardstick: false,
        pace: Pace::Whole,
    };
    let want = want(&loaded.scene, &loaded.resources, &shot)?;
    let picture = match arguments.quality {
        Some(parse::Quality::Reference) => compute(arguments, &want, format)?,
        Some(parse::Quality::Gpu(_)) | None => draw(arguments, &want, format)?,
    };
    Ok(picture.save(&arguments.output, &metadata(arguments, &loaded))?)
}

/// The kind of file to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

impl Format {
    fn of(arguments: &Arguments) -> anyhow::Result<Self> {
        let ending = arguments.output.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase();
        match ending.as_str() {
            "png" => Ok(Self::Png),
            "exr" => Ok(Self::Exr),
            _ => bail!("{}: write to a file that ends in .png or .exr", arguments.output.display()),
        }
    }
}

fn draw(arguments: &Arguments, want: &Want, format: Format) -> anyhow::Result<Picture> {
    let mut renderer = Renderer::new(arguments.adapter.open()?);
    renderer.gpu.check_picture_size(arguments.size)?;
    let plan = renderer.bring(want)?;
    if arguments.explain {
        print!("{plan}");
    }
    let picture = match format {
        Format::Png => renderer.read_picture(),
        Format::Exr => renderer.read_radiance(),
    };
    let bytes = picture.context("no picture was drawn")?.wait(&renderer.gpu)?;
    let first = measure::passes(&renderer);
    if arguments.repeat > 0 || arguments.stats.is_some() {
        let cost = measure::frames(&mut renderer, want, arguments.repeat, arguments.yardstick)?;
        measure::report(&renderer, &first, &cost, arguments.stats.as_deref())?;
    }
    let picture = match format {
        Format::Png => Picture::Display { size: arguments.size, gamut: arguments.gamut, rgba: bytes },
        Format::Exr => Picture::radiance_from_bt2020(arguments.size, &bytemuck::pod_collect_to_vec(&bytes)),
    };
    Ok(picture)
}

fn compute(arguments: &Arguments, want: &Want, format: Format) -> anyhow::Result<Picture> {
    if arguments.explain || arguments.repeat > 0 || arguments.stats.is_some() {
        bail!("--explain, --repeat and --stats tell of the GPU; leave them out with --quality reference");
    }
    let progress = Progress::new("reference", arguments.size[1] as usize * want.picture.draw.lights().count());
    let films = moved_films(arguments, want)?;
    let radiance = verify::reference::radiance(&want.picture.draw, &films, &|| progress.step())?;
    drop(progress);
    Ok(match format {
        Format::Png => reference::display(&want.picture, &radiance),
        Format::Exr => reference::linear(arguments.size, &radiance),
    })
}

/// The films that only the device can move, at their moment.
fn moved_films(arguments: &Arguments, want: &Want) -> anyhow::Result<MovedFilms> {
    let bubbles = &want.picture.draw.bubbles;
    if !bubbles.iter().any(needs_device) {
        return Ok(MovedFilms::new());
    }
    let mut renderer = Renderer::new(arguments.adapter.open()?);
    renderer.gpu.check_picture_size(arguments.size)?;
    renderer.bring(want)?;
    let films = bubbles.iter().filter(|bubble| needs_device(bubble)).map(|bubble| {
        let (grid, thickness_nm) = renderer.read_film(bubble.index)?.context("the film was not moved")?;
        let cells: Vec<f32> = bytemuck::pod_collect_to_vec(&thickness_nm.wait(&renderer.gpu)?);
        let field = PaddedField::from_cells(grid, &HaloTable::new(grid), |cell| f64::from(cells[cell]));
        Ok((bubble.index, field))
    });
    films.collect()
}

fn metadata(arguments: &Arguments, loaded: &LoadedScene) -> Metadata {
    Metadata::new()
        .with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")))
        .with("Scene", &loaded.name)
        .with("Time", &format!("{} s", arguments.time))
}
