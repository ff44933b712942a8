//! The passes that a frame can take, each with all that it reads, and why one runs.

use std::{fmt, ops::Range};

use super::keys::{
    DefocusKey, DrawKey, EnvironmentKey, FieldKey, OpenHoleKey, PlateKey, QuadratureKey, TableKey, TonemapKey,
};

/// One pass, with all that it reads.
#[derive(Clone, Debug, PartialEq)]
pub enum Pass {
    /// Sends the faces and levels of a light's environment.
    UploadEnvironment {
        /// Index of the light.
        light: usize,
        /// The environment.
        key: EnvironmentKey,
    },
    /// Blurs some tiles of a light's environment as it is seen behind the bubbles, and sends them.
    DefocusBackdrop {
        /// Index of the light.
        light: usize,
        /// The environment, how far it is out of focus, and the tiles.
        key: DefocusKey,
        /// Whether there are other tiles of it already, which stay.
        adds: bool,
    },
    /// Sends the photograph behind the bubbles.
    UploadPlate(PlateKey),
    /// Bakes some rows of a lookup table.
    BakeTable {
        /// Index of the light.
        light: usize,
        /// Index of the films' material.
        material: usize,
        /// The table.
        key: TableKey,
        /// Rows to bake.
        rows: Range<u32>,
    },
    /// Fits and uploads the quadrature wavelengths.
    FitQuadrature {
        /// Index of the light.
        light: usize,
        /// Index of the films' material.
        material: usize,
        /// The quadrature.
        key: QuadratureKey,
    },
    /// Sets a film to its initial thickness.
    SeedField {
        /// Index of the film.
        film: usize,
        /// The field at tick 0.
        key: FieldKey,
    },
    /// Makes a checkpoint a film's state again.
    RestoreField {
        /// Index of the film.
        film: usize,
        /// Slot of the checkpoint.
        slot: usize,
        /// The field at the checkpoint's tick.
        key: FieldKey,
    },
    /// Keeps a copy of a film's state.
    SaveField {
        /// Index of the film.
        film: usize,
        /// Slot that the copy goes to; what it holds is lost.
        slot: usize,
        /// The field at the state's tick.
        key: FieldKey,
    },
    /// Moves a film through whole ticks.
    StepField {
        /// Index of the film.
        film: usize,
        /// The field's law; its moment is where the steps end.
        key: FieldKey,
        /// Ticks to take.
        ticks: Range<u64>,
    },
    /// Makes a film's thickness at a moment, which may lie between two ticks, ready to be drawn.
    ShowField {
        /// Index of the film.
        film: usize,
        /// The field at the moment to show.
        key: FieldKey,
    },
    /// Finds the rim of the hole in a film that bursts.
    OpenHole {
        /// Index of the film.
        film: usize,
        /// The hole and its film.
        key: OpenHoleKey,
    },
    /// Draws backdrop and bubbles into the linear picture.
    Draw(DrawKey),
    /// Makes the finished picture from the linear one.
    Tonemap(TonemapKey),
}

impl Pass {
    /// Whether both move films, and by steps of the same ticks: those of passes that stand side by side can be taken together.
    #[must_use]
    pub fn steps_like(&self, other: &Self) -> bool {
        let (Self::StepField { key, ticks, .. }, Self::StepField { key: other, ticks: of_other, .. }) = (self, other)
        else {
            return false;
        };
        ticks == of_other && key.steps_from(ticks.start).eq(other.steps_from(ticks.start))
    }

    /// The pass's name, as reports print it.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::UploadEnvironment { .. } => "upload_environment",
            Self::DefocusBackdrop { .. } => "defocus_backdrop",
            Self::UploadPlate(_) => "upload_plate",
            Self::BakeTable { .. } => "bake_table",
            Self::FitQuadrature { .. } => "fit_quadrature",
            Self::SeedField { .. } => "seed_field",
            Self::RestoreField { .. } => "restore_field",
            Self::SaveField { .. } => "save_field",
            Self::StepField { .. } => "step_field",
            Self::ShowField { .. } => "show_field",
            Self::OpenHole { .. } => "open_hole",
            Self::Draw(_) => "draw",
            Self::Tonemap(_) => "tonemap",
        }
    }
}

/// Why a pass runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its product is not there at all.
    Missing,
    /// What it reads has changed.
    Changed(&'static str),
    /// A part of its product was left for later.
    Unfinished,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str("nothing there yet"),
            Self::Changed(what) => write!(f, "{what} changed"),
            Self::Unfinished => f.write_str("continued from the last frame"),
        }
    }
}
