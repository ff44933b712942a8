//! `soapfilm sequence`: numbered pictures of a film as it moves.

use std::{
    ops::RangeInclusive,
    path::{Path, PathBuf},
};

use anyhow::Context;
use clap::Args;

use super::{
    picture::{Format, Painter, PictureArguments},
    progress::Progress,
};
use crate::{
    output::{FrameRate, tell},
    plan::FrameRequest,
};

/// Draw numbered pictures into a folder; frame N shows the film N / fps seconds after its start
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm sequence default -o frames --frames 0..299 --fps 30\n  soapfilm sequence life -o film --frames 0..479 --fps 24000/1001 --format exr\n\nEXR files hold the frame rate and the time code (framesPerSecond, timeCode)."
)]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: PathBuf,
    /// The folder to write to, created if it does not exist
    #[arg(short, value_name = "DIR")]
    output: PathBuf,
    /// First and last frame
    #[arg(long, value_name = "A..B", value_parser = frames, allow_hyphen_values = true)]
    frames: Frames,
    /// Frames per second of film time: a number, or a ratio like 24000/1001
    #[arg(long, value_name = "FPS", default_value = "30")]
    fps: FrameRate,
    /// Format of the files: `png`, as the window shows it, or `exr` with scene radiance
    #[arg(long, value_name = "png|exr", default_value = "png")]
    format: Format,
    /// Draw frames again that already exist
    #[arg(long)]
    overwrite: bool,
    #[command(flatten)]
    picture: PictureArguments,
}

#[derive(Clone, Debug, PartialEq)]
struct Frames(RangeInclusive<u64>);

fn frames(text: &str) -> Result<Frames, String> {
    let numbers = text.split_once("..").and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    match numbers {
        Some((first, last)) if first <= last => Ok(Frames(first..=last)),
        Some((first, last)) => {
            Err(format!("the first frame, {first}, comes after the last, {last}; write A..B, like {last}..{first}"))
        }
        _ => Err("write the first and the last frame as A..B, like 0..299".to_owned()),
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let mut painter = Painter::new(&arguments.picture, arguments.format, &arguments.scene)?;
    let Frames(frames) = arguments.frames.clone();
    let last = painter.moment(arguments.fps.time_s(*frames.end()), &format!("frame {}", frames.end()))?;
    // What cannot be drawn is refused before the first frame, not hours later: one moment of a scene can be drawn if all can.
    let last = painter.request(last)?;
    let folder = &arguments.output;
    painter.prepare(&last)?;
    std::fs::create_dir_all(folder).with_context(|| format!("{}: the folder cannot be created", folder.display()))?;
    let progress = Progress::new("sequence", frames.clone().count() as u64 * painter.parts());
    let mut skipped = 0;
    for frame in frames {
        let path = folder.join(format!("frame_{frame:06}.{}", arguments.format.ending()));
        // Files are written whole or not at all, so one that is there is complete.
        if path.exists() && !arguments.overwrite {
            skipped += 1;
            progress.parts(painter.parts(), 1).add(1);
        } else {
            draw(arguments, &mut painter, frame, &path, &progress)?;
        }
    }
    drop(progress);
    if skipped > 0 {
        tell(format_args!("frames that already existed and were kept: {skipped} (draw them again with --overwrite)"));
    }
    Ok(())
}

fn draw(
    arguments: &Arguments,
    painter: &mut Painter<'_>,
    frame: u64,
    path: &Path,
    progress: &Progress,
) -> anyhow::Result<()> {
    let time_s = arguments.fps.time_s(frame);
    let request = request(arguments, painter, frame)?;
    let picture = painter.paint(&request, progress)?;
    Ok(picture.save(path, &painter.metadata(time_s).of_frame(arguments.fps, frame))?)
}

fn request(arguments: &Arguments, painter: &Painter<'_>, frame: u64) -> anyhow::Result<FrameRequest> {
    painter.request(painter.moment(arguments.fps.time_s(frame), &format!("frame {frame}"))?)
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
