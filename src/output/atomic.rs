//! Files appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, NamedTempFile};

use super::OutputError;

/// Writes a file so that nobody ever sees half of it: `write` fills a temporary file in the same folder, which then takes the
/// file's place in one step. If anything fails, the temporary file is gone and what stood at `path` is untouched.
///
/// A link is followed: the file it points to is replaced, not the link.
///
/// # Errors
/// `path` is a folder or no ordinary file, its folder is missing or not writable, or `write` or the system fails on the way.
pub fn write_atomically(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let target = target_of(path)?;
    let failed = |reason| OutputError::Write { path: path.to_owned(), reason };
    let mut temporary = temporary_beside(path, &target)?;
    let mut writer = BufWriter::new(temporary.as_file_mut());
    write(&mut writer).and_then(|()| writer.flush()).map_err(failed)?;
    drop(writer);
    temporary.persist(&target).map_err(|error| failed(error.error))?;
    Ok(())
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

fn temporary_beside(path: &Path, target: &Path) -> Result<NamedTempFile, OutputError> {
    let named = target.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = named.unwrap_or(Path::new(".")).to_owned();
    let path = path.to_owned();
    if !folder.is_dir() {
        return Err(OutputError::NoFolder { path, folder });
    }
    let mut builder = Builder::new();
    builder.prefix(".soapfilm-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Temporary files are private by default; a picture gets the rights of any new file (the umask still takes its share).
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(&folder).map_err(|reason| OutputError::FolderNotWritable { path, folder, reason })
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
