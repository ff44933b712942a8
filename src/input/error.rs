//! What can be wrong with a file or a scene that is to be read.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::{
    physics::{colour::UnknownIlluminant, optics::FilmIndexError, spectra::SpectrumError},
    scene::{Fault, SceneError},
};

/// The widest panorama that is read, pixels: finer than the largest cube map shows.
pub const MAX_ENVIRONMENT_WIDTH: usize = 8192;

/// The highest panorama that is read, pixels.
pub const MAX_ENVIRONMENT_HEIGHT: usize = MAX_ENVIRONMENT_WIDTH / 2;

/// The most pixels along a side of a photograph that is read.
pub const MAX_PLATE_SIDE: usize = 16384;

/// Why a scene cannot be loaded.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// Neither a file nor a preset.
    #[error("no scene file or preset is named `{name}`; {hint}presets: {presets}")]
    NoSuchScene {
        /// The name given.
        name: String,
        /// The preset whose name is the nearest, as a question, if one is near.
        hint: String,
        /// The presets there are.
        presets: String,
    },
    /// The file's text is not a scene, or names what cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A key names what cannot be used.
    #[error(transparent)]
    Key(#[from] Fault),
    /// A file cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// No such light.
    #[error(transparent)]
    Illuminant(#[from] UnknownIlluminant),
    /// No such film.
    #[error(transparent)]
    Film(#[from] FilmIndexError),
    /// A file of a spectrum or an index with a mistake in it.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
}

/// A file could not be used; the message names it and says what to do.
#[derive(Debug, Error)]
pub enum InputError {
    /// There is nothing of that name.
    #[error("file {} does not exist: check its name and folder", path.display())]
    NotFound {
        /// The file asked for.
        path: PathBuf,
    },
    /// A folder was named.
    #[error("{} is a folder: name a file", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
    },
    /// Neither a file nor a folder.
    #[error("{} is {kind}: name an ordinary file", path.display())]
    NotAFile {
        /// What was named.
        path: PathBuf,
        /// What it is, with its article.
        kind: &'static str,
    },
    /// The system would not let it be read.
    #[error("cannot read {} ({reason}): check its permissions and the drive", path.display())]
    Unreadable {
        /// The file asked for.
        path: PathBuf,
        /// The message of the system.
        reason: io::Error,
    },
    /// No bytes in it.
    #[error("{} is empty: save or copy it again", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// Neither OpenEXR nor Radiance.
    #[error("{} is neither an OpenEXR nor a Radiance .hdr picture, whatever its name: convert it to one of them", path.display())]
    UnknownPicture {
        /// The file.
        path: PathBuf,
    },
    /// None of the formats of photographs.
    #[error("{} is no PNG, JPEG, OpenEXR or Radiance .hdr picture, whatever its name: convert it to one of them", path.display())]
    UnknownPlate {
        /// The file.
        path: PathBuf,
    },
    /// A photograph without pixels, or with too many.
    #[error("{} has {width}x{height} pixels: a plate has 1 to {MAX_PLATE_SIDE} along each side", path.display())]
    PlateSize {
        /// The file.
        path: PathBuf,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Cut short, or its parts contradict each other.
    #[error("{} is damaged or cut short ({reason}): export or download it again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What the decoder met.
        reason: String,
    },
    /// Its decoder broke off without a reason.
    #[error("{} cannot be decoded: it is damaged, or stored in a rare way; save it again, an OpenEXR picture with ZIP compression", path.display())]
    DecoderFailed {
        /// The file.
        path: PathBuf,
    },
    /// Valid, but stored in a way that cannot be read here.
    #[error(
        "{} is stored in a way that is not supported ({reason}): save it as a plain RGB OpenEXR picture with ZIP or PIZ compression",
        path.display()
    )]
    Unsupported {
        /// The file.
        path: PathBuf,
        /// What is not supported.
        reason: String,
    },
    /// An OpenEXR file without colours.
    #[error("{} has no layer with R, G and B channels (it has {found}): save it as RGB", path.display())]
    NoColour {
        /// The file.
        path: PathBuf,
        /// The channels that are there.
        found: String,
    },
    /// More pixels than an environment may have.
    #[error(
        "{} has {width}x{height} pixels: scale it down to {MAX_ENVIRONMENT_WIDTH}x{MAX_ENVIRONMENT_HEIGHT} or less",
        path.display()
    )]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Too few pixels to be the whole sphere.
    #[error("{} has only {width}x{height} pixels: an environment needs at least 2x1", path.display())]
    TooSmall {
        /// The file.
        path: PathBuf,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// Not the shape of an equirectangular panorama.
    #[error(
        "{} has {width}x{height} pixels, but an environment is an equirectangular panorama, twice as wide as high: convert or crop it",
        path.display()
    )]
    NotTwoToOne {
        /// The file.
        path: PathBuf,
        /// Pixels in a row.
        width: usize,
        /// Rows.
        height: usize,
    },
    /// More text than any scene or table has.
    #[error("{} is longer than {limit_bytes} bytes: it is hardly the file you meant", path.display())]
    TextTooLong {
        /// The file.
        path: PathBuf,
        /// The most that is read.
        limit_bytes: u64,
    },
    /// Not text.
    #[error("{}:{line}: this is not UTF-8 text (byte {byte} of the file): save it as UTF-8, or name another file", path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// The line of the first byte that is not UTF-8, counted from 1.
        line: usize,
        /// The first byte that is not UTF-8, counted from 0.
        byte: usize,
    },
}

impl InputError {
    /// The message of the system about opening or reading `path`, reworded.
    pub(super) fn from_io(path: &Path, reason: io::Error) -> Self {
        let path = path.to_owned();
        match reason.kind() {
            io::ErrorKind::NotFound => Self::NotFound { path },
            io::ErrorKind::IsADirectory => Self::Folder { path },
            _ => Self::Unreadable { path, reason },
        }
    }
}
