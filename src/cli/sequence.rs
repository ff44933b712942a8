//! `soapfilm sequence`: numbered pictures of a film as it moves.

use std::{
    ops::RangeInclusive,
    path::{Path, PathBuf},
};

use anyhow::{Context, bail};
use clap::{Args, ValueEnum};

use super::{AdapterArguments, parse, progress::Progress};
use crate::{
    gpu::Renderer,
    input::LoadedScene,
    output::{Metadata, Picture},
    physics::colour::Gamut,
    plan::{Moment, Pace, Shot, want},
    studio::MAX_TICKS,
};

/// Draw numbered pictures into a folder; frame N shows the film N / fps seconds after its start
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm sequence default -o frames --frames 0..299 --fps 30")]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: String,
    /// The folder to write to, made if it is not there
    #[arg(short, value_name = "DIR")]
    output: PathBuf,
    /// First and last frame
    #[arg(long, value_name = "A..B", value_parser = frames)]
    frames: Frames,
    /// Frames in a second of film time
    #[arg(long, value_name = "FPS", default_value = "30", value_parser = fps)]
    fps: f64,
    /// Kind of files: `png` as the window shows it, or `exr` of scene radiance
    #[arg(long, value_name = "png|exr", default_value = "png")]
    format: Format,
    /// Width and height in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = parse::size)]
    size: [u32; 2],
    /// Draw frames anew that are already there
    #[arg(long)]
    overwrite: bool,
    #[command(flatten)]
    adapter: AdapterArguments,
}

#[derive(Clone, Debug, PartialEq)]
struct Frames(RangeInclusive<u64>);

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    Png,
    Exr,
}

impl Format {
    fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }
}

fn frames(text: &str) -> Result<Frames, String> {
    let numbers = text.split_once("..").and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    match numbers {
        Some((first, last)) if first <= last => Ok(Frames(first..=last)),
        _ => Err("write the first and the last frame as A..B, like 0..299".to_owned()),
    }
}

fn fps(text: &str) -> Result<f64, String> {
    let value = parse::finite(text)?;
    if (1e-3..=1e4).contains(&value) { Ok(value) } else { Err("a second has 0.001 to 10000 frames".to_owned()) }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let loaded = super::load(&arguments.scene)?;
    let Frames(frames) = arguments.frames.clone();
    let last = Moment::of_time(*frames.end() as f64 / arguments.fps, loaded.scene.motion.tick_s);
    if last.tick > MAX_TICKS {
        bail!("frame {} is {} ticks of this scene; at most {MAX_TICKS} can be simulated", frames.end(), last.tick);
    }
    let folder = &arguments.output;
    std::fs::create_dir_all(folder).with_context(|| format!("{}: the folder cannot be made", folder.display()))?;
    let mut renderer = Renderer::new(arguments.adapter.open()?);
    renderer.gpu.check_picture_size(arguments.size)?;
    let progress = Progress::new("sequence", frames.clone().count());
    let mut skipped = 0;
    for frame in frames {
        let path = folder.join(format!("frame_{frame:06}.{}", arguments.format.ending()));
        // Files are written whole or not at all, so one that is there is complete.
        if path.exists() && !arguments.overwrite {
            skipped += 1;
        } else {
            draw(arguments, &loaded, &mut renderer, frame, &path)?;
        }
        progress.step();
    }
    drop(progress);
    if skipped > 0 {
        eprintln!("frames that were already there and stayed: {skipped} (draw them anew with --overwrite)");
    }
    Ok(())
}

fn draw(
    arguments: &Arguments,
    loaded: &LoadedScene,
    renderer: &mut Renderer,
    frame: u64,
    path: &Path,
) -> anyhow::Result<()> {
    let time_s = frame as f64 / arguments.fps;
    let shot = Shot {
        size: arguments.size,
        moment: Moment::of_time(time_s, loaded.scene.motion.tick_s),
        full_precision: arguments.format == Format::Exr,
        gamut: Gamut::Srgb,
        yardstick: false,
        pace: Pace::Whole,
    };
    renderer.bring(&want(&loaded.scene, &loaded.resources, &shot)?)?;
    let readback = match arguments.format {
        Format::Png => renderer.read_picture(),
        Format::Exr => renderer.read_radiance(),
    };
    let bytes = readback.context("no picture was drawn")?.wait(&renderer.gpu)?;
    let picture = match arguments.format {
        Format::Png => Picture::Display { size: arguments.size, gamut: Gamut::Srgb, rgba: bytes },
        Format::Exr => Picture::radiance_from_bt2020(arguments.size, &bytemuck::pod_collect_to_vec(&bytes)),
    };
    let metadata = Metadata::new()
        .with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")))
        .with("Scene", &loaded.name)
        .with("Time", &format!("{time_s} s"));
    Ok(picture.save(path, &metadata)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_a_range_that_holds_both_ends() {
        assert_eq!(frames("3..3"), Ok(Frames(3..=3)));
        assert_eq!(frames("0..299"), Ok(Frames(0..=299)));
        for wrong in ["5", "5..4", "-1..2", "a..b", "1..=2", ""] {
            assert!(frames(wrong).unwrap_err().contains("A..B"), "{wrong}");
        }
    }
}
