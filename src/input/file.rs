//! Files of the system.

use std::fs::File;
use std::path::Path;

use super::InputError;

/// Opens an ordinary file to read. To open a pipe would wait for a writer, perhaps for ever; a device may have no end.
pub(super) fn open(path: &Path) -> Result<File, InputError> {
    let in_words = |reason| InputError::from_io(path, reason);
    let kind = std::fs::metadata(path).map_err(in_words)?.file_type();
    if kind.is_dir() {
        return Err(InputError::Folder { path: path.to_owned() });
    }
    if !kind.is_file() {
        return Err(InputError::NotAFile { path: path.to_owned(), kind: kind_in_words(kind) });
    }
    File::open(path).map_err(in_words)
}

#[cfg(unix)]
fn kind_in_words(kind: std::fs::FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    match kind {
        kind if kind.is_fifo() => "a pipe",
        kind if kind.is_socket() => "a socket",
        _ => "a device",
    }
}

#[cfg(not(unix))]
fn kind_in_words(_: std::fs::FileType) -> &'static str {
    "a pipe or a device"
}
