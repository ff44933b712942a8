//! `soapfilm render`: one picture.

use std::path::PathBuf;

use anyhow::bail;
use clap::Args;

use super::{measure, parse, picture::PictureArguments, progress::progress};
use crate::{
    export::{Format, Painter},
    output::{Picture, check_target, print},
    plan::Moment,
};

/// Draw one picture into a PNG or EXR file.
#[derive(Args)]
#[command(
    after_help = "Example:\n  soapfilm render windows -o bubble.png --size 1920x1080 --time 5\n\nPNG shows what the window shows. EXR holds linear BT.709 scene radiance as f32, before exposure and tone mapping."
)]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: PathBuf,
    /// The file to write, .png or .exr
    #[arg(short, value_name = "FILE")]
    output: PathBuf,
    /// Time of the film, in seconds from its start
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = parse::time_s)]
    time: f64,
    /// Print the frame plan, and why each pass runs
    #[arg(long)]
    explain: bool,
    /// Draw the frame N more times, each time anew except for baked tables, and measure it
    #[arg(long, value_name = "N", default_value_t = 0)]
    repeat: u32,
    /// Between the repeated frames, draw as many frames of a plain mirror sphere with one environment lookup, and report both
    #[arg(long)]
    yardstick: bool,
    /// Write the cost of the frame to a JSON file
    #[arg(long, value_name = "FILE.json")]
    stats: Option<PathBuf>,
    #[command(flatten)]
    picture: PictureArguments,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let format = Format::of(&arguments.output)?;
    for file in std::iter::once(&arguments.output).chain(&arguments.stats) {
        check_target(file)?;
    }
    let mut painter = arguments.picture.painter(format, &arguments.scene)?;
    let moment = painter.moment(arguments.time, &format!("--time {}", arguments.time))?;
    let picture = draw(arguments, &mut painter, moment)?;
    Ok(picture.save(&arguments.output, &painter.metadata(arguments.time))?)
}

fn draw(arguments: &Arguments, painter: &mut Painter, moment: Moment) -> anyhow::Result<Picture> {
    let measures = arguments.repeat > 0 || arguments.stats.is_some();
    let is_plain = arguments.picture.options().is_plain();
    if !is_plain && (arguments.explain || measures) {
        bail!(
            "--explain, --repeat and --stats report on one frame on the GPU; leave them out with --quality reference, --alpha, --layers and --samples"
        );
    }
    let request = painter.request(moment)?;
    painter.prepare(&request)?;
    let progress = progress("render", painter.parts());
    if !is_plain {
        return painter.paint(moment, &progress);
    }
    let (picture, plan) = painter.draw(&request, &progress)?;
    drop(progress);
    if arguments.explain {
        print(plan)?;
    }
    if measures {
        let renderer = painter.renderer()?;
        let first = measure::passes(renderer);
        let cost = measure::frames(renderer, &request, arguments.repeat, arguments.yardstick)?;
        measure::report(renderer, &first, &cost, arguments.stats.as_deref())?;
    }
    Ok(picture)
}
