//! `soapfilm sequence`: a film as it moves, as numbered pictures or as a video.

use std::{ops::RangeInclusive, path::PathBuf};

use anyhow::bail;
use clap::Args;

use super::{picture::PictureArguments, progress::progress};
use crate::{
    export::{Format, Sequence, SequenceTarget},
    output::{FrameRate, check_target, tell},
};

/// Draw a film as it moves, as numbered pictures or as a video; frame N shows the film N / fps seconds after its start
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm sequence default -o frames --frames 0..299 --fps 30\n  soapfilm sequence life -o life.mp4 --frames 0..479 --fps 24 --size 1920x1080\n  soapfilm sequence tent -o tent.gif --frames 0..59 --fps 20 --size 480x300 --set motion.speed=2\n  soapfilm sequence life -o film --frames 0..479 --fps 24000/1001 --format exr\n\n.mp4 (H.264) and .webm (VP9, with --alpha too) take an ffmpeg that is installed on the system; .gif and .apng need none.\nA video that is there already is replaced; a folder keeps the frames that it has.\nEXR files hold the frame rate and the time code (framesPerSecond, timeCode)."
)]
pub struct Arguments {
    /// A scene file, or the name of a preset
    scene: PathBuf,
    /// The folder to write numbered pictures to, created if it does not exist, or a video: a file that ends in .mp4, .webm, .gif or .apng
    #[arg(short, value_name = "DIR|FILE")]
    output: PathBuf,
    /// First and last frame
    #[arg(long, value_name = "A..B", value_parser = frames, allow_hyphen_values = true)]
    frames: Frames,
    /// Frames per second of film time: a number, or a ratio like 24000/1001
    #[arg(long, value_name = "FPS", default_value = "30")]
    fps: FrameRate,
    /// Format of numbered pictures: `png`, as the window shows it, or `exr` with scene radiance
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
    // Render farms write A-B.
    let ends = text.split_once("..").or_else(|| text.split_once('-'));
    let numbers = ends.and_then(|(first, last)| Some((first.parse().ok()?, last.parse().ok()?)));
    match numbers {
        Some((first, last)) if first <= last => Ok(Frames(first..=last)),
        Some((first, last)) => {
            Err(format!("the first frame, {first}, comes after the last, {last}; write A..B, like {last}..{first}"))
        }
        _ => Err("write the first and the last frame as A..B, like 0..299".to_owned()),
    }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let Frames(frames) = arguments.frames.clone();
    let target = SequenceTarget::of(&arguments.output, arguments.format, arguments.overwrite)?;
    if let SequenceTarget::Video { path, format } = &target {
        check_target(path)?;
        if arguments.format == Format::Exr {
            bail!("a .{} file is no folder for EXR files: give a folder, or leave out --format exr", format.ending());
        }
    }
    let sequence = Sequence { frames, rate: arguments.fps, target };
    sequence.check(&arguments.picture.options())?;
    let mut painter = arguments.picture.painter(sequence.target.format(), &arguments.scene)?;
    sequence.prepare(&mut painter)?;
    let progress = progress("sequence", sequence.parts(&painter));
    let kept = sequence.draw(&mut painter, &progress)?;
    drop(progress);
    if kept > 0 {
        tell(format_args!("frames that already existed and were kept: {kept} (draw them again with --overwrite)"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_a_range_that_holds_both_ends() {
        assert_eq!(frames("3..3"), Ok(Frames(3..=3)));
        assert_eq!([frames("0..299"), frames("0-299")], [Ok(Frames(0..=299)), Ok(Frames(0..=299))]);
        for wrong in ["5", "5..4", "-1..2", "a..b", "1..=2", "", "-", "1--2", "1-2-3"] {
            assert!(frames(wrong).unwrap_err().contains("A..B"), "{wrong}");
        }
    }
}
