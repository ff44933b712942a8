//! What panels and keys ask for that takes more than the model, and the questions that come before it.

use std::path::Path;

use super::{probe::Plot, system};
use crate::scene::Light;

/// What a file is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// A scene to open.
    OpenScene,
    /// An environment to open.
    OpenEnvironment,
    /// A spectrum to open, for the light.
    OpenIlluminant,
    /// A photograph to open, which stands behind the bubbles.
    OpenPlate,
    /// Where the scene goes.
    SaveScene,
    /// Where the picture goes as people see it.
    SavePng,
    /// Where the picture's radiance goes.
    SaveExr,
    /// Where an export goes: a file with this ending, or a folder.
    Export(Option<&'static str>),
    /// Where the numbers of the pinned point and of a plot of it go.
    SaveCsv(Plot),
    /// Where the profile along a line goes.
    SaveProfile,
    /// Where a plot of the pinned point goes as a picture.
    SavePlot(Plot),
    /// Where the plot of the profile along a line goes as a picture.
    SaveProfilePlot,
}

impl Target {
    /// Name of the kind of file, and its endings, the default first.
    #[must_use]
    pub fn file_type(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::OpenScene | Self::SaveScene => ("Scene", &["toml"]),
            Self::OpenEnvironment => ("Environment", &["exr", "hdr"]),
            Self::OpenIlluminant => ("Spectrum", &["csv"]),
            Self::OpenPlate => ("Photograph", &["png", "jpg", "jpeg"]),
            Self::SavePng | Self::SavePlot(_) | Self::SaveProfilePlot => ("PNG picture", &["png"]),
            Self::SaveExr => ("OpenEXR picture", &["exr"]),
            Self::Export(None) => ("Folder", &[]),
            Self::Export(Some(ending)) => {
                let known = EXPORTED.iter().find(|known| known[0] == ending);
                ("Export", known.map_or(&[], |known| known.as_slice()))
            }
            Self::SaveCsv(_) | Self::SaveProfile => ("Table", &["csv"]),
        }
    }

    /// What such a file is called at first in a scene of a name.
    #[must_use]
    pub fn file_name(self, scene: &str) -> String {
        let stem = Path::new(scene).file_stem().and_then(|stem| stem.to_str()).unwrap_or("soapfilm");
        let plot = match self {
            Self::SaveCsv(plot) | Self::SavePlot(plot) => format!("_{}", plot.file_word()),
            Self::SaveProfile | Self::SaveProfilePlot => "_profile".to_owned(),
            _ => String::new(),
        };
        let ending = self.file_type().1.first();
        ending.map_or(stem.to_owned(), |ending| format!("{stem}{plot}.{ending}"))
    }

    /// Whether the file is there already.
    #[must_use]
    pub fn is_read(self) -> bool {
        matches!(self, Self::OpenScene | Self::OpenEnvironment | Self::OpenIlluminant | Self::OpenPlate)
    }
}

/// Endings of files that are exported.
const EXPORTED: [[&str; 1]; 6] = [["png"], ["exr"], ["mp4"], ["webm"], ["gif"], ["apng"]];

/// What a panel or key asks for that takes more than the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// A dialog for a file.
    Ask(Target),
    /// Another scene, by path or preset's name.
    LoadScene(String),
    /// A built-in lesson, by its name.
    BeginLesson(String),
    /// The scene of the lesson's step.
    LoadStep,
    /// Another light, whose environment must be loaded.
    LoadLight(Light),
    /// A link to this page that holds the scene.
    #[cfg(target_arch = "wasm32")]
    CopyLink,
    /// The dialog for exports.
    #[cfg(not(target_arch = "wasm32"))]
    Export,
    /// The scene goes to its file.
    Save,
    /// A file by the path that was typed.
    Typed(Target, String),
    /// What becomes of the work that an earlier window left.
    Left(Fate),
    /// The end.
    Quit,
}

impl Request {
    /// Before what work that is not saved would be lost, as a question says it; `None` if nothing would be.
    #[must_use]
    pub fn danger(&self) -> Option<&'static str> {
        match self {
            Self::LoadScene(_) | Self::BeginLesson(_) => Some("before another scene is opened"),
            Self::Quit => Some("before the window closes"),
            _ => None,
        }
    }
}

/// What becomes of work that an earlier window left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It goes on.
    TakeUp,
    /// It is removed.
    ThrowAway,
    /// The next window asks again.
    Later,
}

/// A question that must be answered before anything else.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// Whether work that is not saved may be lost.
    Unsaved(Request),
    /// Whether work shall be taken up that an earlier window left when it ended; the name of its scene.
    Left(String),
    /// Whether the window closes before its exports are done.
    Exporting,
    /// Which path a file has, where no dialog of the system can ask: what is typed, and what is wrong with it.
    Path(Target, String, Option<String>),
}

impl Question {
    /// Asks for a path in the folder of a scene.
    #[must_use]
    pub fn path(target: Target, scene: &str, folder: &Path) -> Self {
        let name = if target.is_read() { String::new() } else { target.file_name(scene) };
        Self::Path(target, system::whole_path(&folder.join(name)).display().to_string(), None)
    }
}
