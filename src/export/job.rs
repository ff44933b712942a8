//! A whole piece of work that ends in a file or a folder.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use super::{
    Format, Observer, Painter, PictureOptions, Progress, Sequence, SequenceTarget,
    map::{FilmMap, Map},
    painter::OpenGpu,
};
use crate::{
    input::LoadedScene,
    output::{Metadata, check_target},
    studio::Studio,
};

/// What is to be made of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Job {
    /// One picture of a time in seconds.
    Picture { options: PictureOptions, format: Format, time_s: f64, path: PathBuf },
    /// A film as it moves.
    Sequence { options: PictureOptions, sequence: Sequence },
    /// A map of the thickness of a bubble's film at a time in seconds.
    Map { bubble: usize, map: Map, time_s: f64, path: PathBuf },
}

impl Job {
    /// The file or folder that it makes.
    pub fn path(&self) -> &Path {
        match self {
            Self::Picture { path, .. } | Self::Map { path, .. } => path,
            Self::Sequence { sequence, .. } => match &sequence.target {
                SequenceTarget::Folder { folder, .. } => folder,
                SequenceTarget::Video { path, .. } => path,
            },
        }
    }

    /// What can be refused before the work begins.
    ///
    /// # Errors
    /// The file cannot hold what is asked for, or cannot be written.
    pub fn check(&self) -> anyhow::Result<()> {
        match self {
            Self::Picture { options, format, .. } => options.check(*format)?,
            Self::Sequence { options, sequence } => sequence.check(options)?,
            Self::Map { .. } => {}
        }
        match self {
            Self::Sequence { sequence: Sequence { target: SequenceTarget::Folder { .. }, .. }, .. } => Ok(()),
            _ => Ok(check_target(self.path())?),
        }
    }

    /// Does all of it on a device that is opened when it is needed.
    ///
    /// # Errors
    /// The scene cannot be drawn, the file cannot be written, or the observer wants no more.
    pub fn run(&self, scene: LoadedScene, open: OpenGpu, observer: Arc<dyn Observer>) -> anyhow::Result<()> {
        match self {
            Self::Picture { options, format, time_s, path } => {
                let mut painter = Painter::new(*options, *format, scene, open)?;
                let request = painter.request(painter.moment(*time_s, &format!("{time_s} s"))?)?;
                let picture = painter.paint(&request, &Progress::new(painter.parts(), observer))?;
                Ok(picture.save(path, &painter.metadata(*time_s))?)
            }
            Self::Sequence { options, sequence } => {
                let mut painter = Painter::new(*options, sequence.target.format(), scene, open)?;
                sequence.prepare(&mut painter)?;
                let progress = Progress::new(sequence.parts(&painter), observer);
                sequence.draw(&mut painter, &progress).map(|_| ())
            }
            Self::Map { bubble, map, time_s, path } => {
                let thickness_nm = Studio::on(open()?).film_at(&scene, *bubble, *time_s, &map.directions())?;
                let metadata = Metadata::of_scene(&scene.name, *time_s).with("Bubble", &bubble.to_string());
                Ok(FilmMap::new(*map, thickness_nm).save(path, &metadata)?)
            }
        }
    }
}
