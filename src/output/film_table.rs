//! The lookup table of film colours as other engines take it.

use std::{
    io::{self, Write},
    path::Path,
};

use exr::prelude::f16;
use glam::Vec3;
use serde_json::json;

use super::{ExrPicture, ExrPrimaries, Metadata, OutputError, ktx2::Ktx2, write_atomically, write_text};

/// Layers of a table, in this order: the film in light of both polarisations, of s alone, of p alone.
pub const TABLE_LAYERS: [&str; 3] = ["unpolarised", "s", "p"];

/// A kind of file that holds a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TableFormat {
    /// OpenEXR: channels `R`, `G`, `B` for unpolarised light, `s.R` … and `p.R` … for the others.
    Exr,
    /// KTX 2.0: an array texture of RGBA, not compressed.
    Ktx2,
    /// Raw texels, RGBA, little-endian, with a JSON file beside them that describes them.
    Bin,
}

impl TableFormat {
    /// The format that a file's ending names.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?.to_str()?.to_ascii_lowercase();
        match ending.as_str() {
            "exr" => Some(Self::Exr),
            "ktx2" => Some(Self::Ktx2),
            "bin" => Some(Self::Bin),
            _ => None,
        }
    }
}

/// How many bits each number of a table takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TablePrecision {
    /// 16: every GPU filters them.
    Half,
    /// 32: some GPUs cannot filter them.
    Single,
}

impl TablePrecision {
    /// The number that a file of this precision holds.
    #[must_use]
    pub fn stored(self, value: f32) -> f32 {
        match self {
            Self::Half => f16::from_f32(value).to_f32(),
            Self::Single => value,
        }
    }

    fn bytes(self) -> u8 {
        match self {
            Self::Half => 2,
            Self::Single => 4,
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Half => "rgba16float",
            Self::Single => "rgba32float",
        }
    }
}

/// A table to be written.
#[derive(Clone, Copy, Debug)]
pub struct FilmTableFile<'a> {
    /// Texels in a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// For each of [`TABLE_LAYERS`] the texels, row by row, linear BT.2020.
    pub layers: &'a [Vec<Vec3>; 3],
    /// Bits of a number.
    pub precision: TablePrecision,
    /// The metadata of the file.
    pub metadata: &'a Metadata,
}

impl FilmTableFile<'_> {
    /// Writes the table, whole or not at all; beside a [`TableFormat::Bin`] its JSON file too.
    ///
    /// # Errors
    /// Those of [`write_atomically`].
    pub fn save(&self, path: &Path, format: TableFormat) -> Result<(), OutputError> {
        match format {
            TableFormat::Exr => self.save_exr(path),
            TableFormat::Ktx2 => write_atomically(path, |writer| writer.write_all(&self.ktx2()?)),
            TableFormat::Bin => {
                write_atomically(path, |writer| writer.write_all(&self.texels()))?;
                write_text(&path.with_extension("json"), &format!("{:#}\n", self.description(path)))
            }
        }
    }

    fn save_exr(&self, path: &Path) -> Result<(), OutputError> {
        let pixel = |k: usize| {
            let [[r, g, b], [sr, sg, sb], [pr, pg, pb]] =
                [0, 1, 2].map(|layer: usize| self.layers[layer][k].to_array());
            [r, g, b, sr, sg, sb, pr, pg, pb]
        };
        let pixels: Vec<[f32; 9]> = (0..self.columns * self.rows).map(pixel).collect();
        let picture = ExrPicture {
            width: self.columns,
            height: self.rows,
            channels: ["R", "G", "B", "s.R", "s.G", "s.B", "p.R", "p.G", "p.B"],
            pixels: &pixels,
            primaries: Some(ExrPrimaries::Bt2020),
            metadata: self.metadata,
        };
        match self.precision {
            TablePrecision::Half => picture.save_halves(path),
            TablePrecision::Single => picture.save(path),
        }
    }

    /// Layer by layer, row by row, R, G, B, A, little-endian.
    fn texels(&self) -> Vec<u8> {
        let channels = self.layers.iter().flatten().flat_map(|texel| texel.extend(1.0).to_array());
        match self.precision {
            TablePrecision::Half => channels.flat_map(|value| f16::from_f32(value).to_le_bytes()).collect(),
            TablePrecision::Single => channels.flat_map(f32::to_le_bytes).collect(),
        }
    }

    fn ktx2(&self) -> io::Result<Vec<u8>> {
        let own = [
            ("KTXorientation", "rd".to_owned()),
            ("KTXwriter", format!("soapfilm {}", env!("CARGO_PKG_VERSION"))),
            ("Layers", TABLE_LAYERS.join(", ")),
        ];
        let own = own.map(|(key, value)| (key.to_owned(), value)).into_iter();
        let said = self.metadata.entries().map(|(key, value)| (key.to_owned(), value.to_owned()));
        Ktx2 {
            size: [self.columns, self.rows, TABLE_LAYERS.len()].map(|count| count as u32),
            channel_bytes: self.precision.bytes(),
            entries: own.chain(said).collect(),
            texels: &self.texels(),
        }
        .to_bytes()
    }

    fn description(&self, path: &Path) -> serde_json::Value {
        let row_bytes = self.columns * 4 * usize::from(self.precision.bytes());
        let said: serde_json::Map<_, _> =
            self.metadata.entries().map(|(key, value)| (key.to_owned(), value.into())).collect();
        json!({
            "file": path.file_name().unwrap_or_default().to_string_lossy(),
            "format": self.precision.name(),
            "byte_order": "little",
            "columns": self.columns,
            "rows": self.rows,
            "layers": TABLE_LAYERS,
            "bytes_per_row": row_bytes,
            "bytes_per_layer": row_bytes * self.rows,
            "about": said,
        })
    }
}
