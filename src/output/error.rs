//! Why a file could not be written.

use std::io;
use std::path::PathBuf;

use thiserror::Error;

/// A file could not be written; what stood there before, if anything, still does.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The path names a folder.
    #[error("cannot write {}: it is a folder; name a file in it", path.display())]
    Folder {
        /// The file asked for.
        path: PathBuf,
    },
    /// The path names a device, a pipe or the like, which cannot be replaced by a file.
    #[error("cannot write {}: it is not an ordinary file; name another", path.display())]
    NotAFile {
        /// The file asked for.
        path: PathBuf,
    },
    /// The folder for the file does not exist.
    #[error("cannot write {}: folder {} does not exist; create it first", path.display(), folder.display())]
    NoFolder {
        /// The file asked for.
        path: PathBuf,
        /// The folder that is missing.
        folder: PathBuf,
    },
    /// The folder lets no file be made in it.
    #[error("cannot write {}: no file can be created in {} ({reason}); choose another folder or change its permissions", path.display(), folder.display())]
    FolderNotWritable {
        /// The file asked for.
        path: PathBuf,
        /// The folder.
        folder: PathBuf,
        /// The message of the system.
        reason: io::Error,
    },
    /// Writing began but failed: a full disk, or content that its format cannot hold.
    #[error("cannot write {}: {reason}", path.display())]
    Write {
        /// The file asked for.
        path: PathBuf,
        /// The message of the system or the encoder.
        reason: io::Error,
    },
}
