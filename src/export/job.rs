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
                let moment = painter.moment(*time_s, &format!("{time_s} s"))?;
                let picture = painter.paint(moment, &Progress::new(painter.parts(), observer))?;
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

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicU64, Ordering};

    use super::*;
    use crate::{export::Quality, input::load_scene, output::VideoFormat, physics::colour::Gamut};

    /// Hears how far the work is in hundredths, and has enough at some of them.
    struct Ear {
        enough: u64,
        heard: AtomicU64,
    }

    impl Observer for Ear {
        fn is_watching(&self) -> bool {
            true
        }

        fn hear(&self, done: f64) {
            self.heard.fetch_max((100.0 * done).round() as u64, Ordering::Relaxed);
        }

        fn has_cancelled(&self) -> bool {
            self.heard.load(Ordering::Relaxed) >= self.enough
        }
    }

    /// A video of ten frames that needs no device.
    fn video(path: &Path) -> Job {
        let quality = Some(Quality::Reference);
        let options =
            PictureOptions { size: [16, 8], quality, gamut: Gamut::Srgb, alpha: false, layers: false, samples: 1 };
        let target = SequenceTarget::Video { path: path.to_owned(), format: VideoFormat::Gif };
        Job::Sequence { options, sequence: Sequence { frames: 0..=9, rate: "10".parse().unwrap(), target } }
    }

    fn run(job: &Job, enough: u64) -> (anyhow::Result<()>, u64) {
        let ear = Arc::new(Ear { enough, heard: AtomicU64::new(0) });
        let result = job.run(load_scene("furnace").unwrap(), Box::new(|| unreachable!("no device")), ear.clone());
        (result, ear.heard.load(Ordering::Relaxed))
    }

    #[test]
    fn work_that_is_stopped_ends_early_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gif");
        let job = video(&path);
        job.check().unwrap();
        let (result, heard) = run(&job, 30);
        assert_eq!((result.unwrap_err().to_string(), heard), ("cancelled".to_owned(), 30));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let (result, heard) = run(&job, 101);
        assert!(result.is_ok() && path.exists(), "{result:?}");
        assert_eq!(heard, 100);
    }
}
