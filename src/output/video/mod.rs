//! Moving pictures: MP4 and WebM through an `ffmpeg` of the system, animated GIF and PNG by the program itself.

mod apng;
mod ffmpeg;
mod gif;

use std::path::Path;

use super::{FrameRate, Metadata, OutputError, UnfinishedFile};
use crate::physics::colour::Gamut;

/// A file of moving pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VideoFormat {
    /// H.264, which plays everywhere.
    Mp4,
    /// VP9, which holds alpha too.
    WebM,
    /// 256 colours per frame.
    Gif,
    /// PNG with frames: every bit of the pictures.
    Apng,
}

impl VideoFormat {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Mp4, Self::WebM, Self::Gif, Self::Apng];

    /// The ending of its files.
    #[must_use]
    pub fn ending(self) -> &'static str {
        match self {
            Self::Mp4 => "mp4",
            Self::WebM => "webm",
            Self::Gif => "gif",
            Self::Apng => "apng",
        }
    }

    /// The format that an ending names.
    #[must_use]
    pub fn of_ending(ending: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.ending().eq_ignore_ascii_case(ending))
    }

    /// Whether it needs an `ffmpeg` on the system.
    #[must_use]
    pub fn needs_ffmpeg(self) -> bool {
        matches!(self, Self::Mp4 | Self::WebM)
    }
}

/// What is known of a video before its first frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Video {
    /// The kind of file.
    pub format: VideoFormat,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Frames per second.
    pub rate: FrameRate,
    /// How many frames there are.
    pub frames: u32,
    /// The colours that the frames are.
    pub gamut: Gamut,
    /// Whether their alpha counts.
    pub has_alpha: bool,
    /// What is noted in the file.
    pub metadata: Metadata,
}

/// A video that its format cannot hold, or that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum VideoError {
    /// Something that the format does not have.
    #[error("{0}")]
    Unable(String),
    /// There is no ffmpeg.
    #[error(
        "no ffmpeg was found, which writes .{0} files: install it (https://ffmpeg.org; apt-get install ffmpeg, brew install ffmpeg, winget install ffmpeg), or write a .gif or .apng, which need none"
    )]
    NoFfmpeg(&'static str),
    /// The file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Video {
    /// What can be found out before anything is written.
    ///
    /// # Errors
    /// The format cannot hold such a video, or there is no ffmpeg that it needs.
    pub fn check(&self) -> Result<(), VideoError> {
        let [width, height] = self.size;
        let unable = |reason: String| Err(VideoError::Unable(reason));
        match self.format {
            VideoFormat::Mp4 | VideoFormat::WebM if width % 2 + height % 2 > 0 => {
                let even = self.size.map(|length| (length / 2 * 2).max(2));
                unable(format!("a video has an even width and height: use {}x{}", even[0], even[1]))
            }
            VideoFormat::Mp4 if self.has_alpha => {
                unable("an .mp4 holds no alpha: write a .webm, .apng or numbered pictures".to_owned())
            }
            VideoFormat::Mp4 | VideoFormat::WebM => ffmpeg::check(self),
            VideoFormat::Gif => gif::check(self),
            VideoFormat::Apng => Ok(()),
        }
    }

    /// Begins the file, which appears at its place once it is whole.
    ///
    /// # Errors
    /// Those of [`Self::check`], and the file cannot be written.
    pub fn begin(&self, path: &Path) -> Result<VideoWriter, VideoError> {
        self.check()?;
        let file = UnfinishedFile::begin(path)?;
        let failed = |reason| file.failed(reason);
        let encoder: Box<dyn Encoder> = match self.format {
            VideoFormat::Mp4 | VideoFormat::WebM => {
                Box::new(ffmpeg::Ffmpeg::begin(self, file.place()).map_err(failed)?)
            }
            VideoFormat::Gif => Box::new(gif::Gif::begin(self, file.writer()?).map_err(failed)?),
            VideoFormat::Apng => Box::new(apng::Apng::begin(self, file.writer()?).map_err(failed)?),
        };
        Ok(VideoWriter { encoder, file })
    }
}

/// What turns frames into a file.
trait Encoder: Send {
    /// Takes the next frame: 4 · width · height bytes of red, green, blue and straight alpha, encoded by sRGB's curve.
    fn add(&mut self, rgba: &[u8]) -> std::io::Result<()>;

    /// Writes what is left.
    fn finish(self: Box<Self>) -> std::io::Result<()>;
}

/// A video that is being written. Dropped before its end, it leaves no file.
pub struct VideoWriter {
    // Before the file: a program that writes to it must end first.
    encoder: Box<dyn Encoder>,
    file: UnfinishedFile,
}

impl VideoWriter {
    /// Adds a frame: 4 · width · height bytes of red, green, blue and straight alpha, encoded by sRGB's curve, row by row from the top left.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn add(&mut self, rgba: &[u8]) -> Result<(), OutputError> {
        self.encoder.add(rgba).map_err(|reason| self.file.failed(reason))
    }

    /// Puts the whole file in its place.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { encoder, file } = self;
        encoder.finish().map_err(|reason| file.failed(reason))?;
        file.finish()
    }
}

#[cfg(test)]
mod tests;
