//! OpenEXR pictures of any channels: colours with alpha, and layers.

use std::{
    io::{self, Seek, Write},
    path::Path,
};

use ::exr::prelude as openexr;

use super::{ExrPrimaries, Metadata, OutputError, exr::write, write_atomically};

/// Named channels to be written as 32-bit floats, ZIP-compressed. Names with a dot are layers: `normal.X` is channel X of the layer normal.
#[derive(Debug, Clone, Copy)]
pub struct ExrChannels<'a> {
    /// Width and height in pixels, at least 1.
    pub size: [u32; 2],
    /// Each channel's name and its values, rows from the top left; colours are linear BT.709.
    pub channels: &'a [(String, Vec<f32>)],
    /// Metadata, one line `key: value` each in the `comments` attribute.
    pub metadata: &'a Metadata,
}

impl ExrChannels<'_> {
    /// Writes the picture as a file, whole or not at all. Equal pictures give equal bytes.
    ///
    /// # Errors
    /// Those of [`write_atomically`], and content that the format cannot hold: no pixels, a wrong count of them, or channel names that are
    /// empty or equal.
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        write_atomically(path, |writer| self.encode(writer))
    }

    /// Encodes the picture into any writer that can seek.
    ///
    /// # Errors
    /// The writer's, and content that the format cannot hold.
    pub fn encode(&self, writer: impl Write + Seek) -> io::Result<()> {
        let size = self.size.map(|pixels| pixels as usize);
        for (k, (name, values)) in self.channels.iter().enumerate() {
            let is_taken = self.channels[..k].iter().any(|(other, _)| other == name);
            if name.is_empty() || is_taken || values.is_empty() || values.len() != size[0] * size[1] {
                let reason =
                    format!("{} values cannot be channel {name:?} of {}x{} pixels", values.len(), size[0], size[1]);
                return Err(io::Error::new(io::ErrorKind::InvalidInput, reason));
            }
        }
        let channel = |(name, values): &(String, Vec<f32>)| {
            openexr::AnyChannel::new(name.as_str(), openexr::FlatSamples::F32(values.clone()))
        };
        let channels = openexr::AnyChannels::sort(self.channels.iter().map(channel).collect());
        write(size, channels, Some(ExrPrimaries::Bt709), self.metadata, writer)
    }
}

#[cfg(test)]
mod tests {
    use super::{super::read_back::read_exr, *};

    #[test]
    fn layers_come_back_by_their_names() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let channels =
            [("R", 0.5), ("normal.X", -1.0), ("A", 1e10)].map(|(name, value)| (name.to_owned(), vec![value; 6]));
        ExrChannels { size: [3, 2], channels: &channels, metadata: &Metadata::new() }.save(&path).unwrap();
        let read = read_exr(&path).unwrap();
        assert_eq!(read.channels.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["A", "R", "normal.X"]);
        assert_eq!(read.channel("normal.X"), Some(&[-1.0; 6][..]));
    }

    #[test]
    fn channels_that_do_not_fit_are_errors() {
        let channel = |name: &str, count: usize| (name.to_owned(), vec![0.0; count]);
        for channels in
            [[channel("R", 4), channel("R", 4)], [channel("R", 4), channel("", 4)], [channel("R", 4), channel("G", 3)]]
        {
            let picture = ExrChannels { size: [2, 2], channels: &channels, metadata: &Metadata::new() };
            picture.encode(io::Cursor::new(Vec::new())).unwrap_err();
        }
    }
}
