//! What `render` and `sequence` share: the options of a picture, and the picture that they ask for.

mod layers;
mod parts;

use layers::PICTURES_OF_LAYERS;
use parts::{PICTURES_OF_PASSAGES, tiles};
use std::{collections::BTreeSet, path::Path};

use anyhow::{Context, bail};
use clap::Args;

use super::{
    AdapterArguments, SceneSettings, finished, parse,
    progress::{Part, Progress},
};
use crate::{
    gpu::{GpuError, Renderer},
    input::LoadedScene,
    output::{Metadata, Picture},
    physics::colour::Gamut,
    plan::{FrameRequest, Moment, Pace, Plan, Shot, Story, plan},
    studio::MAX_TICKS,
    verify::reference::{MovedFilms, moved_film, needs_device},
};

/// The options of a picture; a new one belongs here, so that every command that draws pictures has it.
#[derive(Args, Clone, Debug)]
pub struct PictureArguments {
    #[command(flatten)]
    settings: SceneSettings,
    /// Width and height in pixels
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = parse::size, allow_hyphen_values = true)]
    size: [u32; 2],
    /// `fast`, `standard`, `spectral` (wavelengths in the shader) or `reference` (f64 on the CPU; only a film that moves by itself needs a GPU)
    /// [default: the scene's]
    #[arg(long, value_name = "QUALITY", value_parser = parse::quality)]
    quality: Option<parse::Quality>,
    /// Colour space of a PNG: `srgb`, or `p3` for wide-gamut displays
    #[arg(long, value_name = "GAMUT", default_value = "srgb", value_parser = parse::gamut)]
    gamut: Gamut,
    /// Leave out what stands behind the bubbles: PNG with straight alpha, EXR with colours premultiplied by alpha, which is 1 minus the mean
    /// transmittance
    #[arg(long)]
    alpha: bool,
    /// Write what the picture is made of as layers of one EXR file: beauty, reflection, transmission, background, and of the nearest wall of film
    /// its thickness, normal, position, depth, angle, place on the film and number of its bubble
    #[arg(long)]
    layers: bool,
    /// Take N x N samples per pixel
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=MAX_SAMPLES))]
    samples: u32,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// The largest number of samples along each side of a pixel.
const MAX_SAMPLES: i64 = 64;

impl PictureArguments {
    /// Whether the picture is computed in f64.
    pub fn is_reference(&self) -> bool {
        self.quality == Some(parse::Quality::Reference)
    }

    /// Whether the picture is one frame as the window would draw it.
    pub fn is_plain(&self) -> bool {
        !self.is_reference() && !self.alpha && !self.layers && self.samples == 1
    }
}

/// The kind of file to write: what the window shows, or scene radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    Png,
    Exr,
}

impl Format {
    /// The ending of its files.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// The format that a file's ending names.
    pub fn of(path: &Path) -> anyhow::Result<Self> {
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("").to_ascii_lowercase();
        let known = [Self::Png, Self::Exr].into_iter().find(|format| format.ending() == ending);
        known.with_context(|| format!("{}: write to a file that ends in .png or .exr", path.display()))
    }
}

/// Draws pictures of one scene.
pub struct Painter<'a> {
    arguments: &'a PictureArguments,
    format: Format,
    loaded: LoadedScene,
    /// The loaded scene's story, which all pictures share.
    story: Story,
    /// Opened when it is first needed: the reference may need none.
    renderer: Option<Renderer>,
}

impl<'a> Painter<'a> {
    /// A painter of a scene file or a preset.
    pub fn new(arguments: &'a PictureArguments, format: Format, scene: &Path) -> anyhow::Result<Self> {
        if arguments.layers && format != Format::Exr {
            bail!("--layers needs an EXR file, which can hold them");
        }
        let mut loaded = arguments.settings.load(scene)?;
        if let Some(parse::Quality::Gpu(quality)) = arguments.quality {
            loaded.scene.view.quality = quality;
        }
        let story = Story::new(loaded.scene.clone());
        Ok(Self { arguments, format, loaded, story, renderer: None })
    }

    /// The film's moment at a time in seconds. `name` is what the time is called in the refusal of one that is too late.
    pub fn moment(&self, time_s: f64, name: &str) -> anyhow::Result<Moment> {
        let moment = Moment::of_time(time_s, self.story.motion.tick_s);
        if moment.tick > MAX_TICKS {
            bail!("{name} is {} ticks of this scene; at most {MAX_TICKS} can be simulated", moment.tick);
        }
        Ok(moment)
    }

    /// What a picture of a moment needs.
    pub fn request(&self, moment: Moment) -> anyhow::Result<FrameRequest> {
        let samples = if self.arguments.is_reference() { 1 } else { self.arguments.samples };
        let shot = Shot {
            size: self.arguments.size.map(|pixels| samples * pixels),
            moment,
            full_precision: self.format == Format::Exr || !self.arguments.is_plain(),
            gamut: self.arguments.gamut,
            yardstick: false,
            pace: Pace::Whole,
        };
        let request = self.story.request(&self.loaded.resources, &shot);
        let mut request = request.map_err(|fault| self.loaded.source.locate(fault))?;
        if self.arguments.is_reference() {
            let bubbles = request.picture.draw.bubbles.iter_mut();
            bubbles.for_each(|bubble| bubble.samples = bubble.samples.max(self.arguments.samples));
        }
        Ok(request)
    }

    /// The metadata of the file.
    pub fn metadata(&self, time_s: f64) -> Metadata {
        Metadata::new()
            .with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")))
            .with("Scene", &self.loaded.name)
            .with("Time", &format!("{time_s} s"))
    }

    /// Opens the adapter if a picture needs one. Called before a bar is shown, so that the adapter's name does not run into it.
    pub fn prepare(&mut self, request: &FrameRequest) -> anyhow::Result<()> {
        if !self.arguments.is_reference() || request.picture.draw.all_bubbles().iter().any(needs_device) {
            self.renderer()?;
        }
        Ok(())
    }

    /// The renderer, on an adapter that can hold the picture.
    pub fn renderer(&mut self) -> anyhow::Result<&mut Renderer> {
        if self.renderer.is_none() {
            let renderer = Renderer::new(self.arguments.adapter.open()?);
            renderer.gpu.check_picture_size(self.arguments.size)?;
            self.renderer = Some(renderer);
        }
        self.renderer.as_mut().context("no adapter was opened")
    }

    /// How many parts the work of a picture has, as its progress is reported.
    pub fn parts(&self) -> u64 {
        let tiles =
            if self.arguments.is_reference() { 1 } else { tiles(self.arguments.size, self.arguments.samples).len() };
        let pictures = match (self.arguments.layers, self.arguments.alpha) {
            (true, false) => PICTURES_OF_LAYERS,
            (_, true) => PICTURES_OF_PASSAGES,
            (false, false) => 1,
        };
        tiles as u64 * pictures
    }

    /// Draws or computes a picture, which is the next [`Self::parts`] of the work.
    pub fn paint(&mut self, request: &FrameRequest, progress: &Progress) -> anyhow::Result<Picture> {
        let (size, format, key) = (self.arguments.size, self.format, &request.picture);
        if self.arguments.is_plain() {
            return Ok(self.draw(request, progress)?.0);
        }
        if self.arguments.layers {
            return self.layers(request, progress);
        }
        if self.arguments.alpha {
            let light = self.passages(request, progress)?;
            return Ok(match format {
                Format::Png => finished::display_alone(key, size, &light),
                Format::Exr => finished::linear_alone(size, &light),
            });
        }
        let radiance = self.radiance(request, key.draw.clone(), progress)?;
        Ok(match format {
            Format::Png => finished::display(key, size, &radiance),
            Format::Exr => finished::linear(size, &radiance),
        })
    }

    /// Draws a picture on the device; also gives the plan that was carried out.
    pub fn draw(&mut self, request: &FrameRequest, progress: &Progress) -> anyhow::Result<(Picture, Plan)> {
        let (format, size, gamut) = (self.format, self.arguments.size, self.arguments.gamut);
        let renderer = self.renderer()?;
        let plan = carry_out(renderer, request, progress)?;
        let readback = match format {
            Format::Png => renderer.read_picture(),
            Format::Exr => renderer.read_radiance(),
        };
        let bytes = readback.context("no picture was drawn")?.wait(&renderer.gpu)?;
        let picture = match format {
            Format::Png => Picture::Display { size, gamut, rgba: bytes },
            Format::Exr => Picture::radiance_from_bt2020(size, &bytemuck::pod_collect_to_vec(&bytes)),
        };
        Ok((picture, plan))
    }

    /// The films that only the device can move, at their moment.
    fn moved_films(&mut self, request: &FrameRequest) -> anyhow::Result<MovedFilms> {
        let bubbles = request.picture.draw.all_bubbles();
        let moved: BTreeSet<usize> =
            bubbles.iter().filter(|bubble| needs_device(bubble)).map(|bubble| bubble.index).collect();
        if moved.is_empty() {
            return Ok(MovedFilms::new());
        }
        let renderer = self.renderer()?;
        renderer.render(request)?;
        let films = moved.into_iter().map(|film| {
            let (_, field) = moved_film(renderer, film)?.context("the film was not moved")?;
            Ok((film, field))
        });
        films.collect()
    }
}

/// Renders the requested picture, and reports each piece of work to the progress display once the device has done it.
fn carry_out(renderer: &mut Renderer, request: &FrameRequest, progress: &Progress) -> Result<Plan, GpuError> {
    let plan = plan(request, renderer.state());
    let part: Part = progress.part(plan.work());
    renderer.watcher = progress.is_shown().then(|| Box::new(move |work| part.add(work)) as _);
    let done = renderer.execute(&plan);
    renderer.watcher = None;
    done.map(|()| plan)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn endings_name_formats() {
        assert_eq!(Format::of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(Format::of(Path::new("b.exr")).unwrap(), Format::Exr);
        for wrong in ["b", "b.jpg", "png", ".png"] {
            assert!(Format::of(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
