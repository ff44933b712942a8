//! A film as it moves: numbered pictures in a folder, or one video. Frame N shows the film N / rate seconds after its start, whatever was drawn
//! before, so that parts of a sequence can be drawn on several machines.

use std::{
    ops::RangeInclusive,
    path::{Path, PathBuf},
};

use anyhow::{Context, bail};

use super::{Format, Painter, PictureOptions, Progress, options::ending};
use crate::{
    output::{FrameRate, Picture, Video, VideoFormat, VideoWriter},
    plan::Moment,
};

/// What a sequence is.
#[derive(Clone, Debug, PartialEq)]
pub struct Sequence {
    /// First and last frame.
    pub frames: RangeInclusive<u64>,
    /// Frames per second of film time.
    pub rate: FrameRate,
    /// Where they go.
    pub target: SequenceTarget,
}

/// Where the frames of a sequence go.
#[derive(Clone, Debug, PartialEq)]
pub enum SequenceTarget {
    /// Numbered pictures in a folder; with `overwrite` those too that are there already.
    Folder { folder: PathBuf, format: Format, overwrite: bool },
    /// A file of moving pictures.
    Video { path: PathBuf, format: VideoFormat },
}

impl SequenceTarget {
    /// The video that a file's ending names, or else a folder. A folder that is there is one whatever it is called.
    ///
    /// # Errors
    /// It is called like one picture.
    pub fn of(path: &Path, format: Format, overwrite: bool) -> anyhow::Result<Self> {
        let is_new = !path.is_dir();
        match VideoFormat::of_ending(&ending(path)).filter(|_| is_new) {
            Some(format) => Ok(Self::Video { path: path.to_owned(), format }),
            None if is_new && Format::of(path).is_ok() => bail!(
                "{}: a sequence is more than one picture: name a folder for its frames, or a video (.mp4, .webm, .gif, .apng)",
                path.display()
            ),
            None => Ok(Self::Folder { folder: path.to_owned(), format, overwrite }),
        }
    }

    /// The format that the frames are drawn in.
    pub fn format(&self) -> Format {
        match self {
            Self::Folder { format, .. } => *format,
            Self::Video { .. } => Format::Png,
        }
    }
}

impl Sequence {
    /// How many frames there are.
    pub fn count(&self) -> u64 {
        self.frames.end() - self.frames.start() + 1
    }

    /// How many parts the work has, as its progress is reported.
    pub fn parts(&self, painter: &Painter) -> u64 {
        self.count().saturating_mul(painter.parts())
    }

    /// What can be refused before a scene is loaded.
    ///
    /// # Errors
    /// The file cannot hold such pictures, or there is no ffmpeg to write it.
    pub fn check(&self, options: &PictureOptions) -> anyhow::Result<()> {
        match &self.target {
            SequenceTarget::Folder { format, .. } => options.check(*format)?,
            SequenceTarget::Video { .. } if options.layers => {
                bail!("--layers needs EXR files, which can hold them: give a folder, and --format exr")
            }
            SequenceTarget::Video { format, .. } => self.video(*format, options)?.check()?,
        }
        Ok(())
    }

    fn video(&self, format: VideoFormat, options: &PictureOptions) -> anyhow::Result<Video> {
        let frames = u32::try_from(self.count()).context("a video has at most 4294967295 frames")?;
        let (size, gamut, has_alpha) = (options.size, options.gamut, options.alpha);
        Ok(Video { format, size, rate: self.rate, frames, gamut, has_alpha, metadata: Default::default() })
    }

    /// Refuses what cannot be drawn before the first frame, not hours later, and opens the device: one moment of a scene can be drawn if all can
    /// whose camera sees something.
    ///
    /// # Errors
    /// The last frame is too late, or the scene cannot be drawn.
    pub fn prepare(&self, painter: &mut Painter) -> anyhow::Result<()> {
        let last = painter.request(self.moment(painter, *self.frames.end())?)?;
        self.frames.clone().try_for_each(|frame| painter.check_view(self.moment(painter, frame)?))?;
        painter.prepare(&last)
    }

    /// Draws all frames; returns how many were there already and were kept.
    ///
    /// # Errors
    /// A frame cannot be drawn or written, or the work was stopped.
    pub fn draw(&self, painter: &mut Painter, progress: &Progress) -> anyhow::Result<u64> {
        match &self.target {
            SequenceTarget::Folder { folder, format, overwrite } => {
                std::fs::create_dir_all(folder)
                    .with_context(|| format!("{}: the folder cannot be created", folder.display()))?;
                let path = |frame: u64| folder.join(format!("frame_{frame:06}.{}", format.ending()));
                self.draw_pictures(painter, progress, &path, *overwrite)
            }
            SequenceTarget::Video { path, format } => {
                let mut video = self.video(*format, painter.options())?;
                video.metadata = painter.metadata(self.rate.time_s(*self.frames.start()));
                self.draw_video(painter, progress, video.begin(path)?)?;
                Ok(0)
            }
        }
    }

    fn draw_pictures(
        &self,
        painter: &mut Painter,
        progress: &Progress,
        path: &dyn Fn(u64) -> PathBuf,
        overwrite: bool,
    ) -> anyhow::Result<u64> {
        let mut kept = 0;
        for frame in self.frames.clone() {
            let path = path(frame);
            // Files are written whole or not at all, so one that is there is complete.
            if path.exists() && !overwrite {
                kept += 1;
                progress.parts(painter.parts(), 1).add(1);
                continue;
            }
            let picture = painter.paint(self.moment(painter, frame)?, progress)?;
            picture.save(&path, &painter.metadata(self.rate.time_s(frame)).of_frame(self.rate, frame))?;
        }
        Ok(kept)
    }

    fn draw_video(&self, painter: &mut Painter, progress: &Progress, mut video: VideoWriter) -> anyhow::Result<()> {
        for frame in self.frames.clone() {
            match painter.paint(self.moment(painter, frame)?, progress)? {
                Picture::Display { rgba, .. } => video.add(&rgba)?,
                Picture::Radiance { .. } | Picture::Channels { .. } => bail!("a video shows what a display shows"),
            }
        }
        Ok(video.finish()?)
    }

    fn moment(&self, painter: &Painter, frame: u64) -> anyhow::Result<Moment> {
        painter.moment(self.rate.time_s(frame), &format!("frame {frame}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_name_videos_and_all_else_is_a_folder() {
        let target = |name: &str| SequenceTarget::of(Path::new(name), Format::Png, false);
        for (name, format) in [("a.mp4", VideoFormat::Mp4), ("b.WebM", VideoFormat::WebM), ("c.gif", VideoFormat::Gif)]
        {
            assert_eq!(target(name).unwrap(), SequenceTarget::Video { path: name.into(), format });
        }
        for name in ["frames", "v1.0"] {
            assert!(matches!(target(name), Ok(SequenceTarget::Folder { .. })), "{name}");
        }
        for name in ["a.png", "b.EXR"] {
            assert!(target(name).unwrap_err().to_string().contains("more than one picture"), "{name}");
        }
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.mp4", "a.png"] {
            let named = folder.path().join(name);
            std::fs::create_dir(&named).unwrap();
            assert!(matches!(target(named.to_str().unwrap()), Ok(SequenceTarget::Folder { .. })));
        }
    }
}
