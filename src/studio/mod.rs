//! The library's front door: a picture, a film or a colour in a few lines.
//!
//! ```no_run
//! let scene = soapfilm::load_scene("windows")?;
//! let mut studio = soapfilm::Studio::open()?;
//! studio.render(&scene, [1280, 720], 5.0)?.save("bubble.png")?;
//! # Ok::<(), soapfilm::Error>(())
//! ```
//!
//! It only calls what the other modules offer. Whoever needs more, such as frames in a loop, a window or passes one by one, finds there
//! [`plan::request`](crate::plan::request()) and [`gpu::Renderer`](crate::gpu::Renderer).

mod colour;
mod difference;
mod error;
mod film;
mod picture;
mod sight;
#[cfg(test)]
mod tests;

pub use colour::{Colour, colour};
pub use difference::{Difference, difference};
pub use error::Error;
pub use film::{FilmCell, reference_film, reference_film_at};
pub use picture::{Picture, Radiance};
pub use sight::{FilmInFront, FilmView, FilmsRead, WallInSight, thickness_at, walls_in_sight};

use glam::DVec3;

use crate::{
    gpu::{AdapterChoice, Gpu, Renderer, readback::Readback},
    input::LoadedScene,
    output::Metadata,
    physics::colour::Gamut,
    plan::{FrameRequest, Moment, Pace, Shot},
    scene::Scene,
    verify::trial,
};

/// Ticks that one picture may need: a day at 60 per second takes hours; more is a mistake in the input.
pub const MAX_TICKS: u64 = 10_000_000;

/// The thickest film that has a colour here, nm.
pub const MAX_THICKNESS_NM: f64 = 30_000.0;

/// A graphics adapter, and what it has made so far: the next picture of the same scene reuses tables and films.
///
/// A picture is a function of the scene, the size and the time alone. Times may come in any order; rising ones are the fastest, because a film
/// then goes on from where it is.
pub struct Studio {
    renderer: Renderer,
}

impl Studio {
    /// Opens the adapter that the environment variables `WGPU_ADAPTER_NAME` and `WGPU_BACKEND` name, else the best one there is.
    ///
    /// # Errors
    /// [`Error::Gpu`] if there is no adapter, or none that can draw films.
    pub fn open() -> Result<Self, Error> {
        Self::open_on(&AdapterChoice::default().or_env())
    }

    /// Opens the chosen adapter.
    ///
    /// # Errors
    /// As [`Studio::open`]; the message lists the adapters that were found.
    pub fn open_on(choice: &AdapterChoice) -> Result<Self, Error> {
        let gpu = pollster::block_on(Gpu::headless(choice))?;
        trial(&gpu)?;
        Ok(Self::on(gpu))
    }

    /// Takes an adapter that is open already.
    #[must_use]
    pub fn on(gpu: Gpu) -> Self {
        Self { renderer: Renderer::new(gpu) }
    }

    /// Name of the adapter in use, with its backend.
    #[must_use]
    pub fn adapter_name(&self) -> String {
        self.renderer.gpu.adapter_name()
    }

    /// Draws the scene as the window shows it: 8 bits, sRGB, with the scene's exposure. `size` is width and height in pixels, `time_s` the film's
    /// time in seconds from its start, 0 or more.
    ///
    /// # Errors
    /// [`Error::Size`] and [`Error::Gpu`] for a size that no picture has or that the adapter cannot hold, [`Error::Time`] and [`Error::TooLate`]
    /// for a time that the film cannot reach, [`Error::Shot`] for a scene that cannot be drawn.
    pub fn render(&mut self, scene: &LoadedScene, size: [u32; 2], time_s: f64) -> Result<Picture, Error> {
        self.draw(scene, size, time_s, false)?;
        let rgba = self.wait(self.renderer.read_picture())?;
        Ok(Picture { size, rgba, metadata: metadata(scene, time_s) })
    }

    /// Draws the scene's radiance in linear BT.709 as f32, before exposure and tone curve. Units are as in the environment: white light of
    /// radiance 1 is (1, 1, 1). The arguments are as in [`Studio::render`].
    ///
    /// # Errors
    /// As [`Studio::render`], and [`Error::Gpu`] on adapters without pictures in full precision.
    pub fn radiance(&mut self, scene: &LoadedScene, size: [u32; 2], time_s: f64) -> Result<Radiance, Error> {
        self.draw(scene, size, time_s, true)?;
        let bt2020: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&self.wait(self.renderer.read_radiance())?);
        Ok(Radiance::from_bt2020(size, &bt2020, metadata(scene, time_s)))
    }

    /// Thickness of each cell of a bubble's film. `bubble` counts the scene's bubbles from 0, `time_s` is as in [`Studio::render`]. The bubble
    /// need not be in sight of the scene's camera.
    ///
    /// # Errors
    /// [`Error::NoBubble`] and [`Error::NoFilm`] if there is no such bubble, or none at that time, and the errors of [`Studio::render`].
    pub fn film(&mut self, scene: &LoadedScene, bubble: usize, time_s: f64) -> Result<Vec<FilmCell>, Error> {
        film::read(self, scene, bubble, time_s)
    }

    /// Thickness of a bubble's film in nm in some directions, unit vectors in axes that turn with the film: where it does not turn as a whole, the
    /// world's. It is 0 where there is no film. The other arguments are as in [`Studio::film`].
    ///
    /// # Errors
    /// As [`Studio::film`].
    pub fn film_at(
        &mut self,
        scene: &LoadedScene,
        bubble: usize,
        time_s: f64,
        directions: &[DVec3],
    ) -> Result<Vec<f64>, Error> {
        film::read_at(self, scene, (bubble, time_s), directions)
    }

    /// Renders a picture of a scene on the device.
    fn draw(&mut self, loaded: &LoadedScene, size: [u32; 2], time_s: f64, full_precision: bool) -> Result<(), Error> {
        if size.contains(&0) {
            return Err(Error::Size(size));
        }
        self.renderer.gpu.check_picture_size(size)?;
        self.renderer.render(&shot(loaded, size, moment(&loaded.scene, time_s)?, full_precision)?)?;
        Ok(())
    }

    /// Waits for what was asked of the device.
    fn wait(&self, readback: Option<Readback>) -> Result<Vec<u8>, Error> {
        Ok(readback.ok_or(Error::NothingDrawn)?.wait(&self.renderer.gpu)?)
    }
}

/// What a picture of a scene needs.
fn shot(loaded: &LoadedScene, size: [u32; 2], moment: Moment, full_precision: bool) -> Result<FrameRequest, Error> {
    let shot = Shot { size, moment, full_precision, gamut: Gamut::Srgb, pace: Pace::Whole };
    Ok(loaded.request(&shot)?)
}

/// The film's moment at a time in seconds, if it can be reached.
fn moment(scene: &Scene, time_s: f64) -> Result<Moment, Error> {
    if !time_s.is_finite() || time_s < 0.0 {
        return Err(Error::Time(time_s));
    }
    let moment = Moment::of_time(time_s, scene.motion.tick_s);
    if moment.tick > MAX_TICKS { Err(Error::TooLate { time_s, ticks: moment.tick }) } else { Ok(moment) }
}

fn metadata(scene: &LoadedScene, time_s: f64) -> Metadata {
    Metadata::of_scene(&scene.name, time_s)
}
