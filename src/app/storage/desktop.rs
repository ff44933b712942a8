//! Files of the user.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
};

use etcetera::BaseStrategy;

use super::{Settings, Unsaved};
use crate::output::write_text;

/// The places of this user where such things are kept. Where there are none, nothing is kept.
#[derive(Debug, Default)]
pub struct Storage {
    settings: Option<PathBuf>,
    unsaved: Option<PathBuf>,
    own: Option<Place>,
    /// Where an earlier window kept work that this one has been shown.
    left: Option<Place>,
}

/// A file with work, and the lock that tells other windows that somebody holds it.
#[derive(Debug)]
struct Place {
    path: PathBuf,
    lock: File,
}

impl Place {
    fn remove(self) {
        drop(self.lock);
        for file in [self.path.with_extension("lock"), self.path] {
            // What is gone already is gone.
            let _ = fs::remove_file(file);
        }
    }
}

impl Storage {
    /// Where the system keeps settings and state of programs.
    #[must_use]
    pub fn of_user() -> Self {
        let Ok(places) = etcetera::choose_base_strategy() else { return Self::default() };
        let state = places.state_dir().unwrap_or_else(|| places.data_dir());
        Self::at(&places.config_dir().join("soapfilm"), &state.join("soapfilm"))
    }

    /// Settings in one folder, work that is not saved in another.
    fn at(settings: &Path, state: &Path) -> Self {
        Self {
            settings: Some(settings.join("window.toml")),
            unsaved: Some(state.join("unsaved")),
            own: None,
            left: None,
        }
    }

    /// The settings of the last run; those of a file that cannot be read are the normal ones.
    #[must_use]
    pub fn settings(&self) -> Settings {
        let text = self.settings.as_ref().and_then(|path| fs::read_to_string(path).ok());
        text.and_then(|text| toml::from_str(&text).ok()).unwrap_or_default()
    }

    /// Keeps the settings. Where that fails, the log says so: nothing is lost that a user has made.
    pub fn keep_settings(&self, settings: &Settings) {
        let Some(path) = &self.settings else { return };
        let text = toml::to_string(settings).unwrap_or_default();
        if let Err(error) = written(path, &text) {
            log::warn!("the settings of the window are not kept: {error}");
        }
    }

    /// Keeps work in case the program ends without a question.
    ///
    /// # Errors
    /// The folder or the file cannot be written, in a line.
    pub fn keep(&mut self, work: &Unsaved) -> Result<(), String> {
        let Some(folder) = &self.unsaved else { return Ok(()) };
        if self.own.is_none() {
            self.own = Some(new_place(folder).map_err(|error| format!("{}: {error}", folder.display()))?);
        }
        let Some(Place { path, .. }) = &self.own else { return Ok(()) };
        written(path, &toml::to_string(work).map_err(|error| error.to_string())?)
    }

    /// Removes the kept work, because it is saved or was given up.
    pub fn drop_kept(&mut self) {
        self.own.take().into_iter().for_each(Place::remove);
    }

    /// Work that a window left which is open no longer. No other window is shown it until it is removed or left again.
    pub fn take_left(&mut self) -> Option<Unsaved> {
        let folder = fs::read_dir(self.unsaved.as_ref()?).ok()?;
        let paths = folder.flatten().map(|entry| entry.path()).filter(|path| path.extension() == Some("toml".as_ref()));
        let (work, place) = paths.filter_map(left_at).max_by_key(|(_, place)| changed(&place.path))?;
        self.left = Some(place);
        Some(work)
    }

    /// Removes the work that an earlier window left.
    pub fn drop_left(&mut self) {
        self.left.take().into_iter().for_each(Place::remove);
    }

    /// Leaves it for another time.
    pub fn leave(&mut self) {
        self.left = None;
    }
}

/// Work at a path, if no window holds it.
fn left_at(path: PathBuf) -> Option<(Unsaved, Place)> {
    let lock = File::create(path.with_extension("lock")).ok()?;
    lock.try_lock().ok()?;
    let work = toml::from_str(&fs::read_to_string(&path).ok()?).ok()?;
    Some((work, Place { path, lock }))
}

fn changed(path: &Path) -> Option<std::time::SystemTime> {
    path.metadata().ok()?.modified().ok()
}

/// A place that no other window has.
fn new_place(folder: &Path) -> std::io::Result<Place> {
    fs::create_dir_all(folder)?;
    for number in 0.. {
        let path = folder.join(format!("{}-{number}.toml", std::process::id()));
        // One that is there belongs to an earlier process of the same number.
        if let Ok(lock) = File::create_new(path.with_extension("lock")) {
            lock.lock()?;
            return Ok(Place { path, lock });
        }
        if number == 100 {
            break;
        }
    }
    Err(std::io::Error::other("no file could be made there"))
}

fn written(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    write_text(path, text).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn storage(folder: &Path) -> Storage {
        Storage::at(&folder.join("config"), &folder.join("state"))
    }

    fn work(name: &str) -> Unsaved {
        let (file, folder) = (Some("a/b.toml".into()), "a".into());
        Unsaved { name: name.to_owned(), file, folder, tick: 7, scene: "version = 1\n".to_owned() }
    }

    #[test]
    fn settings_come_back_and_broken_ones_are_normal() {
        let folder = tempfile::tempdir().unwrap();
        let storage = storage(folder.path());
        assert_eq!(storage.settings(), Settings::default());
        let mut settings = Settings { zoom: 1.5, ..Settings::default() };
        ["a.toml", "b.toml", "a.toml"].into_iter().for_each(|path| settings.remember(path));
        assert_eq!(settings.recent, ["a.toml", "b.toml"]);
        storage.keep_settings(&settings);
        assert_eq!(storage.settings(), settings);
        fs::write(storage.settings.as_ref().unwrap(), "zoom = {").unwrap();
        assert_eq!(storage.settings(), Settings::default());
    }

    #[test]
    fn work_is_left_by_windows_that_are_gone_and_by_no_others() {
        let folder = tempfile::tempdir().unwrap();
        let [mut open, mut gone, mut next] = [0; 3].map(|_| storage(folder.path()));
        assert_eq!(next.take_left(), None);
        open.keep(&work("open")).unwrap();
        gone.keep(&work("gone")).unwrap();
        gone.keep(&work("gone later")).unwrap();
        assert_eq!(next.take_left(), None, "both windows are open");
        drop(gone);
        assert_eq!(next.take_left(), Some(work("gone later")));
        assert_eq!(storage(folder.path()).take_left(), None, "it was taken");
        next.leave();
        assert_eq!(next.take_left(), Some(work("gone later")));
        next.drop_left();
        open.drop_kept();
        assert_eq!(fs::read_dir(folder.path().join("state/unsaved")).unwrap().count(), 0);
    }
}
