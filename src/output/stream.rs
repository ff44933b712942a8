//! Standard output and standard error, which may be closed, full or read only in part, like any file.

use std::{
    fmt::Display,
    io::{self, Write},
};

/// Standard output does not take what is written to it.
#[derive(Debug, thiserror::Error)]
pub enum StreamError {
    /// Its reader has stopped, as `head` does: the rest is not needed, and nothing is wrong.
    #[error("the reader of the output has stopped")]
    Closed,
    /// It cannot be written: a full disk behind it, say.
    #[error("cannot write to standard output: {0}")]
    Write(io::Error),
}

impl From<io::Error> for StreamError {
    fn from(error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe { Self::Closed } else { Self::Write(error) }
    }
}

/// Writes a text to standard output, at once.
///
/// # Errors
/// Nobody reads it any more, or it cannot be written.
pub fn print(text: impl Display) -> Result<(), StreamError> {
    let mut out = io::stdout().lock();
    // What stays in a buffer until the program ends fails in silence.
    Ok(write!(out, "{text}").and_then(|()| out.flush())?)
}

/// Prints a line on standard error. A line that cannot be written does not stop the work.
pub fn tell(line: impl Display) {
    let _ = io::stderr().write_all(format!("{line}\n").as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_reader_that_stops_is_told_from_a_full_disk() {
        assert!(matches!(StreamError::from(io::Error::from(io::ErrorKind::BrokenPipe)), StreamError::Closed));
        let full = StreamError::from(io::Error::from(io::ErrorKind::StorageFull));
        assert!(
            matches!(full, StreamError::Write(_)) && full.to_string().starts_with("cannot write to standard output")
        );
    }
}
