//! The dialog as it is filled in: texts, and what they mean or what is wrong with them.

use std::path::{Path, PathBuf};

use crate::{
    export::{
        Format, Job, MAX_SAMPLES, PictureOptions, Quality, Sequence, SequenceTarget, check_size,
        map::{Map, Projection},
    },
    output::{FrameRate, VideoFormat},
    physics::colour::Gamut,
    words::words,
};

words! {
    /// What is exported.
    #[derive(Default)]
    pub enum Kind: "export" {
        #[default]
        Picture = "Picture", "One picture of the moment that the window shows";
        Sequence = "Video", "The film as it moves, as a video or as numbered pictures";
        Map = "Film map", "The thickness of the selected bubble's film in nm, as an EXR map that other programs lay on a sphere";
    }
}

words! {
    /// The file of a sequence.
    #[derive(Default)]
    pub enum SequenceFormat: "format" {
        #[default]
        Mp4 = "MP4", "H.264, which plays everywhere; needs ffmpeg";
        WebM = "WebM", "VP9, for web pages, with alpha if asked for; needs ffmpeg";
        Gif = "GIF", "256 colours per frame, up to 50 frames per second";
        Apng = "APNG", "Animated PNG: every bit of the pictures, with alpha if asked for; large";
        Png = "PNGs", "A folder of numbered PNG files";
        Exr = "EXRs", "A folder of numbered EXR files with scene radiance";
    }
}

impl SequenceFormat {
    /// The video that it is; none for folders of pictures.
    pub fn video(self) -> Option<VideoFormat> {
        match self {
            Self::Mp4 => Some(VideoFormat::Mp4),
            Self::WebM => Some(VideoFormat::WebM),
            Self::Gif => Some(VideoFormat::Gif),
            Self::Apng => Some(VideoFormat::Apng),
            Self::Png | Self::Exr => None,
        }
    }
}

/// What is typed and chosen in the dialog.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    /// Whether the dialog is there.
    pub is_open: bool,
    /// What is exported.
    pub kind: Kind,
    /// The file of a picture.
    pub picture_format: Format,
    /// The file of a sequence.
    pub sequence_format: SequenceFormat,
    /// Width of a picture, pixels.
    pub width: String,
    /// Height of a picture, pixels.
    pub height: String,
    /// Samples along each side of a pixel.
    pub samples: String,
    /// How colours are found; without it as the scene says.
    pub quality: Option<Quality>,
    /// The colours of a PNG.
    pub gamut: Gamut,
    /// Whether what stands behind the bubbles is left out.
    pub alpha: bool,
    /// Whether an EXR holds what the picture is made of.
    pub layers: bool,
    /// When a sequence begins, s.
    pub begin_s: String,
    /// When it ends, s.
    pub end_s: String,
    /// Frames per second.
    pub fps: String,
    /// How a map lays out the sphere.
    pub projection: Projection,
    /// Height of a map, pixels.
    pub map_height: String,
    /// The file or folder.
    pub path: String,
    /// The file beside the scene, without an ending, that was proposed last.
    pub proposed: PathBuf,
    /// Why the last attempt was refused.
    pub refused: Option<String>,
}

impl Default for Form {
    fn default() -> Self {
        Self {
            is_open: false,
            kind: Kind::default(),
            picture_format: Format::Png,
            sequence_format: SequenceFormat::default(),
            width: String::new(),
            height: String::new(),
            samples: "1".to_owned(),
            quality: None,
            gamut: Gamut::Srgb,
            alpha: false,
            layers: false,
            begin_s: "0".to_owned(),
            end_s: String::new(),
            fps: "30".to_owned(),
            projection: Projection::Equirect,
            map_height: "512".to_owned(),
            path: String::new(),
            proposed: PathBuf::new(),
            refused: None,
        }
    }
}

/// A value that a text stands for, or what is wrong with it.
pub type Read<T> = Result<T, String>;

impl Form {
    /// Opens the dialog. What was typed before stays; the rest is filled in: the size of the window's picture, and a file beside the scene.
    pub fn open(&mut self, stem: &Path, size: [u32; 2], end_s: f64) {
        self.is_open = true;
        self.refused = None;
        let fill = |text: &mut String, value: String| {
            if text.is_empty() {
                *text = value;
            }
        };
        // Videos have even sizes.
        let [width, height] = size.map(|length| (length / 2 * 2).max(2));
        fill(&mut self.width, width.to_string());
        fill(&mut self.height, height.to_string());
        fill(&mut self.end_s, format!("{end_s:.2}"));
        // A scene that was saved has another name; a file that was chosen stays.
        let path = Path::new(&self.path);
        if [path, &path.with_extension("")].contains(&self.proposed.as_path()) {
            self.path = stem.display().to_string();
            self.proposed = stem.to_owned();
        }
        self.name_file();
    }

    /// Gives the file the ending of its format, after another format was chosen.
    pub fn name_file(&mut self) {
        let path = Path::new(&self.path);
        let known = path
            .extension()
            .and_then(|ending| ending.to_str())
            .is_some_and(|ending| ["png", "exr"].contains(&ending) || VideoFormat::of_ending(ending).is_some());
        let stem = if known { path.with_extension("") } else { path.to_owned() };
        let mut name = stem.into_os_string();
        if let Some(ending) = self.ending() {
            name.push(".");
            name.push(ending);
        }
        self.path = name.to_string_lossy().into_owned();
    }

    /// The ending of the file; folders have none.
    pub fn ending(&self) -> Option<&'static str> {
        match self.kind {
            Kind::Picture => Some(self.picture_format.ending()),
            Kind::Sequence => self.sequence_format.video().map(VideoFormat::ending),
            Kind::Map => Some("exr"),
        }
    }

    /// Whether the pictures are radiance, in EXR files.
    pub fn is_radiance(&self) -> bool {
        match self.kind {
            Kind::Picture => self.picture_format == Format::Exr,
            Kind::Sequence => self.sequence_format == SequenceFormat::Exr,
            Kind::Map => true,
        }
    }

    /// Width of a picture, pixels.
    pub fn width(&self) -> Read<u32> {
        pixels(&self.width)
    }

    /// Height of a picture, pixels.
    pub fn height(&self) -> Read<u32> {
        let height = pixels(&self.height)?;
        // Both together are too large, or neither is.
        self.width()
            .map_or(Ok(height), |width| check_size([width, height]).map(|_| height).map_err(|error| error.to_string()))
    }

    /// Samples along each side of a pixel.
    pub fn samples(&self) -> Read<u32> {
        let samples = self.samples.trim().parse().ok().filter(|samples| (1..=MAX_SAMPLES).contains(samples));
        samples.ok_or_else(|| format!("write 1 to {MAX_SAMPLES}"))
    }

    /// When a sequence begins, s.
    pub fn begin_s(&self) -> Read<f64> {
        seconds(&self.begin_s)
    }

    /// When it ends, s.
    pub fn end_s(&self) -> Read<f64> {
        let end_s = seconds(&self.end_s)?;
        if self.begin_s().is_ok_and(|begin_s| begin_s >= end_s) {
            Err("ends before it begins".to_owned())
        } else {
            Ok(end_s)
        }
    }

    /// Frames per second.
    pub fn rate(&self) -> Read<FrameRate> {
        self.fps.parse().map_err(|_| "write 30 or 24000/1001".to_owned())
    }

    /// First and last frame: those whose times lie from the beginning to the end, without the end.
    pub fn frames(&self) -> Read<std::ops::RangeInclusive<u64>> {
        let ([begin_s, end_s], rate) = ([self.begin_s()?, self.end_s()?], self.rate()?);
        // A time that is a frame's own, but for rounding, is that frame's.
        let after = |time_s: f64| (time_s / rate.time_s(1) - 1e-6).ceil().max(0.0) as u64;
        let first = after(begin_s);
        Ok(first..=after(end_s).saturating_sub(1).max(first))
    }

    /// Height of a map, pixels.
    pub fn map_height(&self) -> Read<u32> {
        let height = self.map_height.trim().parse().ok().filter(|height| (1..=4096).contains(height));
        height.ok_or_else(|| "write 1 to 4096".to_owned())
    }

    /// The file or folder, where `~` stands for the user's home.
    pub fn path(&self) -> Read<PathBuf> {
        let text = self.path.trim();
        if text.is_empty() {
            return Err("name a file".to_owned());
        }
        let in_home = text.strip_prefix("~/").and_then(|rest| Some(std::env::home_dir()?.join(rest)));
        let path = in_home.unwrap_or_else(|| PathBuf::from(text));
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("");
        match self.ending() {
            Some(wanted) if !ending.eq_ignore_ascii_case(wanted) => Err(format!("end it in .{wanted}")),
            None if VideoFormat::of_ending(ending).is_some() => Err("name a folder, without an ending".to_owned()),
            _ => Ok(path),
        }
    }

    /// The options of a picture.
    fn options(&self) -> Read<PictureOptions> {
        Ok(PictureOptions {
            size: [self.width()?, self.height()?],
            quality: self.quality,
            gamut: if self.is_radiance() { Gamut::Srgb } else { self.gamut },
            alpha: self.alpha,
            layers: self.layers && self.is_radiance(),
            samples: self.samples()?,
        })
    }

    /// What is to be done at a time in seconds, with the bubble that is selected.
    pub fn job(&self, time_s: f64, bubble: usize) -> Read<Job> {
        let path = self.path()?;
        Ok(match self.kind {
            Kind::Picture => Job::Picture { options: self.options()?, format: self.picture_format, time_s, path },
            Kind::Sequence => {
                let target = match self.sequence_format.video() {
                    Some(format) => SequenceTarget::Video { path, format },
                    None if self.is_radiance() => {
                        SequenceTarget::Folder { folder: path, format: Format::Exr, overwrite: true }
                    }
                    None => SequenceTarget::Folder { folder: path, format: Format::Png, overwrite: true },
                };
                Job::Sequence {
                    options: self.options()?,
                    sequence: Sequence { frames: self.frames()?, rate: self.rate()?, target },
                }
            }
            Kind::Map => {
                Job::Map { bubble, map: Map { projection: self.projection, height: self.map_height()? }, time_s, path }
            }
        })
    }
}

fn pixels(text: &str) -> Read<u32> {
    let pixels = text.trim().trim_end_matches("px").trim_end().parse().ok().filter(|pixels| *pixels > 0);
    pixels.ok_or_else(|| "write a number of pixels".to_owned())
}

fn seconds(text: &str) -> Read<f64> {
    let seconds = text.trim().trim_end_matches('s').trim_end().parse().ok();
    seconds
        .filter(|seconds: &f64| seconds.is_finite() && *seconds >= 0.0)
        .ok_or_else(|| "write seconds, 0 or more".to_owned())
}
