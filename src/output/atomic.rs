//! Files appear whole or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::{Builder, NamedTempFile};

use super::OutputError;

/// Writes a file so that no reader ever sees half of it: `write` fills a temporary file in the same folder, which then takes the
/// file's place in one step. If anything fails, the temporary file is gone and what stood at `path` is untouched.
///
/// A link is followed: the file it points to is replaced, not the link. A run that was killed may have left its temporary file there;
/// the first file that the program writes to a folder removes those, which are no longer locked.
///
/// # Errors
/// `path` is a folder or no ordinary file, its folder is missing or not writable, or `write` or the system fails on the way.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let mut unfinished = UnfinishedFile::begin(path)?;
    let mut writer = BufWriter::new(unfinished.temporary.file.as_file_mut());
    let written = write(&mut writer).and_then(|()| writer.flush());
    drop(writer);
    written.map_err(|reason| unfinished.failed(reason))?;
    unfinished.finish()
}

/// A file that is written in steps, in a temporary file beside its place, which it takes at the end in one step. Dropped before that, it leaves
/// nothing.
pub struct UnfinishedFile {
    path: PathBuf,
    target: PathBuf,
    temporary: Temporary,
}

impl UnfinishedFile {
    /// An empty file that will stand at `path`.
    ///
    /// # Errors
    /// As [`write_atomically`].
    pub fn begin(path: &Path) -> Result<Self, OutputError> {
        let target = target_of(path)?;
        let temporary = temporary_beside(path, &target)?;
        Ok(Self { path: path.to_owned(), target, temporary })
    }

    /// Another handle to the file, to write to.
    ///
    /// # Errors
    /// The system gives none.
    pub fn writer(&self) -> Result<File, OutputError> {
        self.temporary.file.as_file().try_clone().map_err(|reason| self.failed(reason))
    }

    /// Where the file is for now, for another program that writes to it.
    pub fn place(&self) -> &Path {
        // Locks keep other programs out on Windows, where a file in use cannot be removed anyway.
        #[cfg(windows)]
        let _ = self.temporary.file.as_file().unlock();
        self.temporary.file.path()
    }

    /// Why the file could not be written.
    pub fn failed(&self, reason: io::Error) -> OutputError {
        OutputError::Write { path: self.path.clone(), reason }
    }

    /// Puts the file in its place, whole.
    ///
    /// # Errors
    /// The system refuses.
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { path, target, temporary } = self;
        temporary.put_at(&target).map_err(|reason| OutputError::Write { path, reason })
    }
}

/// Tells before work begins whether its file could be made.
///
/// # Errors
/// As [`write_atomically`]: `path` is a folder or no ordinary file, or its folder is missing.
pub fn check_target(path: &Path) -> Result<(), OutputError> {
    let target = target_of(path)?;
    folder_of(path, &target).map(|_| ())
}

/// Temporary files begin and end so.
const NAME: [&str; 2] = [".soapfilm-", ".part"];

/// The temporary files there are, and the folders without ones that killed runs have left.
static FILES: Mutex<Files> = Mutex::new(Files { unfinished: Vec::new(), cleared: Vec::new() });

struct Files {
    unfinished: Vec<PathBuf>,
    cleared: Vec<PathBuf>,
}

fn files() -> MutexGuard<'static, Files> {
    // Both lists are whole at any time, whatever panicked.
    FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files, and prevents new ones from then on: for the end of the program.
pub fn abandon_files() {
    let files = files();
    for path in &files.unfinished {
        let _ = fs::remove_file(path);
    }
    std::mem::forget(files);
}

/// A temporary file, which is removed with this value unless it is put in its place. It is locked, so that other runs leave it alone.
struct Temporary {
    file: NamedTempFile,
    listed: Listed,
}

/// A path in the list of temporary files.
struct Listed(PathBuf);

impl Drop for Listed {
    fn drop(&mut self) {
        files().unfinished.retain(|path| *path != self.0);
    }
}

impl Temporary {
    fn new(builder: &Builder, folder: &Path) -> io::Result<Self> {
        let mut files = files();
        if !files.cleared.iter().any(|cleared| cleared == folder) {
            clear(folder);
            files.cleared.push(folder.to_owned());
        }
        loop {
            let file = builder.tempfile_in(folder)?;
            // On a file system without locks, no run removes them either.
            let _ = file.as_file().lock();
            // Another run may have cleared it before the lock.
            if file.path().exists() {
                let path = file.path().to_owned();
                files.unfinished.push(path.clone());
                return Ok(Self { file, listed: Listed(path) });
            }
        }
    }

    fn put_at(self, target: &Path) -> io::Result<()> {
        let Self { file, listed } = self;
        let files = files();
        let put = file.persist(target).map(|_| ()).map_err(|error| error.error);
        drop(files);
        drop(listed);
        put
    }
}

/// Removes temporary files of runs that have ended: they are not locked.
fn clear(folder: &Path) {
    for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        let is_ours = name.starts_with(NAME[0]) && name.ends_with(NAME[1]);
        if is_ours && fs::symlink_metadata(&path).is_ok_and(|metadata| metadata.is_file()) {
            let left = OpenOptions::new().read(true).write(true).open(&path);
            if left.is_ok_and(|file| file.try_lock().is_ok()) {
                let _ = fs::remove_file(&path);
            }
        }
    }
}

/// The file that is to be replaced or made, with links followed.
fn target_of(path: &Path) -> Result<PathBuf, OutputError> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(OutputError::Folder { path: path.to_owned() }),
        // A rename onto /dev/null would put a file in its place.
        Ok(metadata) if !metadata.is_file() => Err(OutputError::NotAFile { path: path.to_owned() }),
        Ok(_) => Ok(fs::canonicalize(path).unwrap_or_else(|_| path.to_owned())),
        Err(_) if path.file_name().is_none() => Err(OutputError::Folder { path: path.to_owned() }),
        Err(_) => Ok(path.to_owned()),
    }
}

/// The folder of a target, which must be there.
fn folder_of(path: &Path, target: &Path) -> Result<PathBuf, OutputError> {
    let named = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = named.unwrap_or(Path::new(".")).to_owned();
    if folder.is_dir() { Ok(folder) } else { Err(OutputError::NoFolder { path: path.to_owned(), folder }) }
}

fn temporary_beside(path: &Path, target: &Path) -> Result<Temporary, OutputError> {
    let folder = folder_of(path, target)?;
    let mut builder = Builder::new();
    builder.prefix(NAME[0]).suffix(NAME[1]);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Temporary files are private by default; a picture gets the rights of any new file (the umask still takes its share).
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    Temporary::new(&builder, &folder).map_err(|reason| OutputError::FolderNotWritable {
        path: path.to_owned(),
        folder,
        reason,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn writes_and_replaces() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for content in ["first", "second, longer", "3"] {
            write_atomically(&path, |writer| writer.write_all(content.as_bytes())).unwrap();
            assert_eq!(fs::read_to_string(&path).unwrap(), content);
        }
        assert_eq!(names_in(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failing_writer_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let failing = |writer: &mut BufWriter<&mut File>| {
            writer.write_all(&[7; 100_000])?;
            Err(io::Error::other("the disk is full"))
        };
        let error = write_atomically(&path, failing).unwrap_err();
        assert_eq!(error.to_string(), format!("cannot write {}: the disk is full", path.display()));
        assert!(names_in(folder.path()).is_empty());

        fs::write(&path, "kept").unwrap();
        write_atomically(&path, failing).unwrap_err();
        assert_eq!(fs::read_to_string(&path).unwrap(), "kept");
        assert_eq!(names_in(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_panicking_writer_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let panicking = std::panic::AssertUnwindSafe(|| write_atomically(&path, |_| panic!("planted by a test")));
        std::panic::catch_unwind(panicking).unwrap_err();
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn temporary_files_of_killed_runs_are_removed_and_those_in_use_are_kept() {
        let folder = tempfile::tempdir().unwrap();
        let [left, locked] = [".soapfilm-left.part", ".soapfilm-locked.part"].map(|name| folder.path().join(name));
        fs::write(&left, "half").unwrap();
        let other = File::create(&locked).unwrap();
        other.lock().unwrap();
        write_atomically(&folder.path().join("a.txt"), |_| Ok(())).unwrap();
        let mut names = names_in(folder.path());
        names.sort();
        assert_eq!(names, [".soapfilm-locked.part", "a.txt"]);
    }

    #[test]
    fn folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for path in [folder.path(), Path::new("/"), Path::new("nowhere/..")] {
            let error = write_atomically(path, |_| Ok(())).unwrap_err();
            assert!(matches!(error, OutputError::Folder { .. }), "{}: {error}", path.display());
        }
    }

    #[test]
    fn a_missing_folder_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("no").join("such");
        let error = write_atomically(&missing.join("a.png"), |_| Ok(())).unwrap_err();
        assert!(matches!(&error, OutputError::NoFolder { folder, .. } if *folder == missing), "{error}");
    }

    #[test]
    fn a_name_alone_goes_to_the_current_folder() {
        let error =
            write_atomically(Path::new("soapfilm-test-never-written"), |_| Err(io::Error::other("stop"))).unwrap_err();
        assert!(matches!(error, OutputError::Write { .. }), "{error}");
    }

    #[cfg(unix)]
    mod unix {
        use std::os::unix::fs::{PermissionsExt, symlink};

        use super::*;

        #[test]
        fn devices_are_left_alone() {
            let error = write_atomically(Path::new("/dev/null"), |_| Ok(())).unwrap_err();
            assert!(matches!(error, OutputError::NotAFile { .. }), "{error}");
        }

        #[test]
        fn links_are_followed() {
            let folder = tempfile::tempdir().unwrap();
            let (file, link) = (folder.path().join("file"), folder.path().join("link"));
            fs::write(&file, "old").unwrap();
            symlink(&file, &link).unwrap();
            write_atomically(&link, |writer| writer.write_all(b"new")).unwrap();
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
            assert_eq!(fs::read_to_string(&file).unwrap(), "new");
        }

        #[test]
        fn files_get_the_rights_of_any_new_file() {
            let folder = tempfile::tempdir().unwrap();
            let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
            write_atomically(&ours, |_| Ok(())).unwrap();
            File::create(&plain).unwrap();
            let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
            assert_eq!(mode(&ours), mode(&plain));
        }

        #[test]
        fn a_folder_that_cannot_be_written_is_named() {
            let folder = tempfile::tempdir().unwrap();
            fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
            // The superuser may write everywhere; /proc takes no files from anyone.
            let refused =
                if File::create(folder.path().join("probe")).is_ok() { Path::new("/proc") } else { folder.path() };
            let error = write_atomically(&refused.join("a.png"), |_| Ok(())).unwrap_err();
            assert!(matches!(error, OutputError::FolderNotWritable { .. }), "{error}");
        }
    }
}
