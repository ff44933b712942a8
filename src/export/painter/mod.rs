//! Pictures of one scene: drawn or computed, in parts and layers, with any number of samples per pixel.

mod finished;
mod layers;
mod parts;

use std::collections::BTreeSet;

use anyhow::{Context, bail};

use super::{
    Format, PictureOptions, Quality,
    progress::{Part, Progress},
};
use crate::{
    gpu::{Gpu, GpuError, Renderer},
    input::LoadedScene,
    output::{Metadata, Picture},
    plan::{DrawKey, FrameRequest, LensSample, Moment, Pace, Plan, Shot, Story, plan},
    scene::Lens,
    studio::MAX_TICKS,
    verify::reference::{MovedFilms, moved_film, needs_device},
};
use layers::PICTURES_OF_LAYERS;
use parts::{PICTURES_OF_PASSAGES, tiles};

/// Opens the device that pictures are drawn on.
pub type OpenGpu = Box<dyn FnOnce() -> Result<Gpu, GpuError> + Send>;

/// A picture that is taken.
struct Exposure {
    /// When the shutter opens.
    moment: Moment,
    /// All of it at that moment, through the middle of the lens.
    request: FrameRequest,
}

/// Draws pictures of one scene.
pub struct Painter {
    options: PictureOptions,
    format: Format,
    loaded: LoadedScene,
    /// The loaded scene's story, which all pictures share.
    story: Story,
    /// Called when a device is first needed: the reference may need none.
    open: Option<OpenGpu>,
    renderer: Option<Renderer>,
}

impl Painter {
    /// A painter of a scene into files of a format, on a device that is opened if a picture needs one.
    ///
    /// # Errors
    /// The format cannot hold the pictures.
    pub fn new(
        options: PictureOptions,
        format: Format,
        mut loaded: LoadedScene,
        open: OpenGpu,
    ) -> anyhow::Result<Self> {
        options.check(format)?;
        if let Some(Quality::Gpu(quality)) = options.quality {
            loaded.scene.view.quality = quality;
        }
        let story = Story::new(loaded.scene.clone());
        Ok(Self { options, format, loaded, story, open: Some(open), renderer: None })
    }

    /// What is asked of the pictures.
    pub fn options(&self) -> &PictureOptions {
        &self.options
    }

    /// The film's moment at a time in seconds. `name` is what the time is called in the refusal of one that is too late.
    pub fn moment(&self, time_s: f64, name: &str) -> anyhow::Result<Moment> {
        let moment = Moment::of_time(time_s, self.story.motion.tick_s);
        if moment.tick > MAX_TICKS {
            bail!("{name} is {} ticks of this scene; at most {MAX_TICKS} can be simulated", moment.tick);
        }
        Ok(moment)
    }

    /// Refuses a moment that cannot be drawn, in less time than its request takes.
    ///
    /// # Errors
    /// The camera sees nothing then.
    pub fn check_view(&self, moment: Moment) -> anyhow::Result<()> {
        self.story.check_view(moment).map_err(|fault| self.loaded.source.locate(fault).into())
    }

    /// What a picture of a moment needs.
    pub fn request(&self, moment: Moment) -> anyhow::Result<FrameRequest> {
        let samples = if self.options.is_reference() { 1 } else { self.options.samples };
        // Layers are sharp, as their depth and their normals are; the reference comes to the truth by its samples alone.
        let blurs_bubbles = !self.options.layers && !self.options.is_reference();
        self.request_by(&LensSample { blurs_bubbles, ..LensSample::MIDDLE }, moment, samples)
    }

    /// What one of the pictures needs whose mean is the picture of a moment through the whole lens, while the shutter is open.
    fn request_through(&self, moment: Moment, k: u32, count: u32) -> anyhow::Result<FrameRequest> {
        let Lens { aperture_mm, blades, shutter_s, .. } = self.story.lens;
        // The reference comes to the truth by its samples alone.
        let sample = if self.options.is_reference() { LensSample::point } else { LensSample::disc };
        let lens = sample(k, count, 0.5e-3 * aperture_mm, blades);
        let tick_s = self.story.motion.tick_s;
        let open_s = shutter_s * (f64::from(k) + 0.5) / f64::from(count);
        self.request_by(&lens, Moment::of_time(moment.ticks() * tick_s + open_s, tick_s), 1)
    }

    /// How many pictures the picture of a moment is the mean of: more than one where a lens or a shutter needs them.
    fn lens_samples(&self) -> u32 {
        let Lens { aperture_mm, shutter_s, .. } = self.story.lens;
        let is_sharp = aperture_mm == 0.0 && shutter_s == 0.0;
        if is_sharp || self.options.layers { 1 } else { self.options.samples.pow(2) }
    }

    fn request_by(&self, lens: &LensSample, moment: Moment, samples: u32) -> anyhow::Result<FrameRequest> {
        let shot = Shot {
            size: self.options.size.map(|pixels| samples * pixels),
            moment,
            full_precision: self.format == Format::Exr || !self.options.is_plain(),
            gamut: self.options.gamut,
            pace: Pace::Whole,
        };
        let request = self.story.request_through(lens, &self.loaded.resources, &shot);
        let mut request = request.map_err(|fault| self.loaded.source.locate(fault))?;
        if self.options.is_reference() {
            let bubbles = request.picture.draw.bubbles.iter_mut();
            bubbles.for_each(|bubble| bubble.samples = bubble.samples.max(self.options.samples));
        }
        Ok(request)
    }

    /// The metadata of the file.
    pub fn metadata(&self, time_s: f64) -> Metadata {
        Metadata::of_scene(&self.loaded.name, time_s)
    }

    /// Opens the device if a picture needs one. Called before a bar is shown, so that the adapter's name does not run into it.
    pub fn prepare(&mut self, request: &FrameRequest) -> anyhow::Result<()> {
        if !self.options.is_reference() || request.picture.draw.all_bubbles().iter().any(needs_device) {
            self.renderer()?;
        }
        Ok(())
    }

    /// The renderer, on an adapter that can hold the picture.
    pub fn renderer(&mut self) -> anyhow::Result<&mut Renderer> {
        if let Some(open) = self.open.take() {
            let renderer = Renderer::new(open()?);
            renderer.gpu.check_picture_size(self.options.size)?;
            self.renderer = Some(renderer);
        }
        self.renderer.as_mut().context("no adapter was opened")
    }

    /// How many parts the work of a picture has, as its progress is reported.
    pub fn parts(&self) -> u64 {
        let tiles = match self.lens_samples() {
            1 if self.options.is_reference() => 1,
            1 => tiles(self.options.size, self.options.samples).len(),
            count => count as usize,
        };
        let pictures = match (self.options.layers, self.options.alpha) {
            (true, false) => PICTURES_OF_LAYERS,
            (_, true) => PICTURES_OF_PASSAGES,
            (false, false) => 1,
        };
        tiles as u64 * pictures
    }

    /// Draws or computes the picture of a moment, which is the next [`Self::parts`] of the work.
    pub fn paint(&mut self, moment: Moment, progress: &Progress) -> anyhow::Result<Picture> {
        let shot = Exposure { moment, request: self.request(moment)? };
        let (size, format, key) = (self.options.size, self.format, &shot.request.picture);
        if self.options.is_plain() {
            return Ok(self.draw(&shot.request, progress)?.0);
        }
        if self.options.layers {
            return self.layers(&shot, progress);
        }
        if self.options.alpha {
            let light = self.passages(&shot, progress)?;
            return Ok(match format {
                Format::Png => finished::display_alone(key, size, &light),
                Format::Exr => finished::linear_alone(size, &light),
            });
        }
        let radiance = self.exposed(&shot, &DrawKey::clone, progress)?;
        Ok(match format {
            Format::Png => finished::display(key, size, &radiance),
            Format::Exr => finished::linear(size, &radiance),
        })
    }

    /// Draws a picture on the device; also gives the plan that was carried out.
    pub fn draw(&mut self, request: &FrameRequest, progress: &Progress) -> anyhow::Result<(Picture, Plan)> {
        let (format, size, gamut) = (self.format, self.options.size, self.options.gamut);
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
fn carry_out(renderer: &mut Renderer, request: &FrameRequest, progress: &Progress) -> anyhow::Result<Plan> {
    progress.check()?;
    let plan = plan(request, renderer.state());
    let part: Part = progress.part(plan.work());
    let watcher = move |work| {
        part.add(work);
        part.is_wanted()
    };
    renderer.watcher = progress.is_watched().then(|| Box::new(watcher) as _);
    let done = renderer.execute(&plan);
    renderer.watcher = None;
    done?;
    Ok(plan)
}
