//! Texts: scenes and tables.

use std::io::Read;
use std::path::Path;

use super::{InputError, file::open};

/// The longest text that is read, bytes: far more than a scene or a table of points has, far less than memory.
pub const MAX_TEXT_BYTES: u64 = 64 << 20;

/// The whole text of a file, without a leading byte order mark. An empty file is an empty text.
///
/// # Errors
/// The file is missing, a folder, unreadable, longer than [`MAX_TEXT_BYTES`] or not UTF-8.
pub fn read_text(path: &Path) -> Result<String, InputError> {
    read_text_up_to(path, MAX_TEXT_BYTES)
}

/// The whole text of a table of numbers, in whatever encoding spreadsheets write: UTF-8, UTF-16 with a byte order mark, or else
/// Latin-1, in which a heading may be garbled but no number is.
///
/// # Errors
/// The file is missing, a folder, unreadable, longer than [`MAX_TEXT_BYTES`] or no text at all.
pub fn read_table_text(path: &Path) -> Result<String, InputError> {
    let bytes = read_bytes_up_to(path, MAX_TEXT_BYTES)?;
    let utf16 = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units = bytes.chunks_exact(2).map(|pair| unit([pair[0], pair[1]]));
        char::decode_utf16(units).map(|character| character.unwrap_or(char::REPLACEMENT_CHARACTER)).collect()
    };
    match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => Ok(utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Ok(utf16(rest, u16::from_be_bytes)),
        bytes => match (std::str::from_utf8(bytes), bytes.iter().position(|byte| *byte == 0)) {
            (_, Some(byte)) => Err(not_text(path, bytes, byte)),
            (Ok(text), None) => Ok(text.to_owned()),
            (Err(_), None) => Ok(bytes.iter().copied().map(char::from).collect()),
        },
    }
}

fn read_text_up_to(path: &Path, limit_bytes: u64) -> Result<String, InputError> {
    let bytes = read_bytes_up_to(path, limit_bytes)?;
    let text =
        String::from_utf8(bytes).map_err(|error| not_text(path, error.as_bytes(), error.utf8_error().valid_up_to()))?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

fn not_text(path: &Path, bytes: &[u8], byte: usize) -> InputError {
    let line = 1 + bytes[..byte].iter().filter(|byte| **byte == b'\n').count();
    InputError::NotText { path: path.to_owned(), line, byte }
}

fn read_bytes_up_to(path: &Path, limit_bytes: u64) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    // One byte more than the limit tells a long file, and a pipe without end, from one that just fits.
    let file = open(path)?;
    file.take(limit_bytes + 1).read_to_end(&mut bytes).map_err(|reason| InputError::from_io(path, reason))?;
    if bytes.len() as u64 > limit_bytes {
        return Err(InputError::TextTooLong { path: path.to_owned(), limit_bytes });
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(bytes: &[u8], limit_bytes: u64) -> Result<String, InputError> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        read_text_up_to(file.path(), limit_bytes)
    }

    #[test]
    fn reads_text_with_and_without_byte_order_mark() {
        assert_eq!(read("Seifenblase µ\n".as_bytes(), 100).unwrap(), "Seifenblase µ\n");
        assert_eq!(read(b"\xef\xbb\xbfversion = 1", 100).unwrap(), "version = 1");
        assert_eq!(read(b"", 100).unwrap(), "");
    }

    #[test]
    fn tables_come_in_the_encodings_of_spreadsheets() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let table = |bytes: &[u8]| {
            std::fs::write(file.path(), bytes).unwrap();
            read_table_text(file.path()).unwrap()
        };
        let utf16 = |mark: u16, bytes: fn(u16) -> [u8; 2]| {
            let units = [mark].into_iter().chain("λ;n\n300;1,3\n".encode_utf16());
            units.flat_map(bytes).collect::<Vec<u8>>()
        };
        assert_eq!(table(&utf16(0xfeff, u16::to_le_bytes)), "λ;n\n300;1,3\n");
        assert_eq!(table(&utf16(0xfeff, u16::to_be_bytes)), "λ;n\n300;1,3\n");
        assert_eq!(table("λ;n\n300;1,3\n".as_bytes()), "λ;n\n300;1,3\n");
        std::fs::write(file.path(), b"PK\x03\x04\x00\xff").unwrap();
        assert!(matches!(read_table_text(file.path()), Err(InputError::NotText { byte: 4, .. })));
        assert_eq!(table(b"Wellenl\xe4nge;n\n300;1,3\n"), "Wellenlänge;n\n300;1,3\n");
    }

    #[test]
    fn reads_up_to_the_limit_and_no_further() {
        assert_eq!(read(b"12345", 5).unwrap(), "12345");
        let error = read(b"123456", 5).unwrap_err();
        assert!(error.to_string().ends_with("is longer than 5 bytes: it is hardly the file you meant"), "{error}");
    }

    #[test]
    fn names_the_byte_that_is_not_text() {
        let error = read(b"ok\n \xff\xfe", 100).unwrap_err();
        assert!(matches!(error, InputError::NotText { line: 2, byte: 4, .. }), "{error}");
    }

    #[test]
    #[cfg(unix)]
    fn pipes_sockets_and_devices_are_refused_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let [pipe, socket] = ["pipe", "socket"].map(|name| folder.path().join(name));
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let _listener = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        for (path, kind) in [(pipe.as_path(), "pipe"), (&socket, "socket"), (Path::new("/dev/zero"), "device")] {
            let error = read_text(path).unwrap_err().to_string();
            assert_eq!(error, format!("{} is a {kind}: name an ordinary file", path.display()));
        }
    }

    #[test]
    fn missing_files_and_folders_are_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("none.toml");
        let error = read_text(&missing).unwrap_err();
        assert_eq!(error.to_string(), format!("file {} does not exist: check its name and folder", missing.display()));
        assert!(matches!(read_text(folder.path()), Err(InputError::Folder { .. })));
    }
}
