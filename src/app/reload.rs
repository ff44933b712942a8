//! Debug builds only: shaders are read again when their files change, while the source folder is there.

use std::{
    path::{Path, PathBuf},
    time::{Duration, Instant, SystemTime},
};

/// Time between two looks at the files.
const PERIOD: Duration = Duration::from_millis(500);

/// Watches the folder of the shaders.
pub struct ShaderWatch {
    folder: PathBuf,
    newest: Option<SystemTime>,
    next: Instant,
}

impl ShaderWatch {
    /// Watches the folder that this program was built from, if it is still there.
    pub fn of_source() -> Option<Self> {
        Self::new(Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"))
    }

    fn new(folder: PathBuf) -> Option<Self> {
        let newest = newest(&folder)?;
        Some(Self { folder, newest: Some(newest), next: Instant::now() + PERIOD })
    }

    /// When to look next.
    pub fn next(&self) -> Instant {
        self.next
    }

    /// The folder, if it is time to look and a file there is newer than before.
    pub fn changed(&mut self, now: Instant) -> Option<&Path> {
        if now < self.next {
            return None;
        }
        self.next = now + PERIOD;
        let newest = newest(&self.folder);
        (newest.is_some() && std::mem::replace(&mut self.newest, newest) != newest).then_some(&self.folder)
    }
}

/// The latest change of any file in the folder's folders.
fn newest(folder: &Path) -> Option<SystemTime> {
    let folders = std::fs::read_dir(folder).ok()?.flatten();
    let files = folders.filter_map(|folder| std::fs::read_dir(folder.path()).ok()).flat_map(Iterator::flatten);
    files.filter_map(|file| file.metadata().ok()?.modified().ok()).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_file_is_noticed_once() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("pass")).unwrap();
        let file = std::fs::File::create(folder.path().join("pass/a.wgsl")).unwrap();
        let mut watch = ShaderWatch::new(folder.path().to_owned()).unwrap();
        let later = |periods: u32| Instant::now() + periods * 2 * PERIOD;
        assert_eq!(watch.changed(later(1)), None);
        file.set_modified(SystemTime::now() + Duration::from_secs(5)).unwrap();
        assert_eq!(watch.changed(Instant::now()), None, "it is not time to look yet");
        assert_eq!(watch.changed(later(2)), Some(folder.path()));
        assert_eq!(watch.changed(later(3)), None);
    }

    #[test]
    fn without_a_folder_nothing_is_watched() {
        assert!(ShaderWatch::new(PathBuf::from("/no/such/folder")).is_none());
    }
}
