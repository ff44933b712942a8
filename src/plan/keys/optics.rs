//! Keys of the colours of films in a light: tables and quadrature wavelengths.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use crate::{
    physics::{
        colour::{FilmOptics, Illuminant, QuadratureTask, QuadratureWavelength, fit_quadrature},
        optics::FilmMaterial,
    },
    scene::Quality,
};

/// A film in a light.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct OpticsKey {
    /// What the film is made of.
    pub film: FilmMaterial,
    /// The light.
    pub illuminant: Arc<Illuminant>,
}

impl PartialEq for OpticsKey {
    fn eq(&self, other: &Self) -> bool {
        self.film == other.film
            && (Arc::ptr_eq(&self.illuminant, &other.illuminant) || self.illuminant == other.illuminant)
    }
}

impl OpticsKey {
    /// The film and the light with all their spectra, on the grid of whole nanometres.
    #[must_use]
    pub fn spectra(&self) -> FilmOptics {
        FilmOptics::new(self.film.clone(), &self.illuminant)
    }

    /// These optics, as finely resolved as films up to a thickness need, see [`FilmOptics::resolving`].
    #[must_use]
    pub fn spectra_to(&self, thickest_nm: f64) -> FilmOptics {
        FilmOptics::resolving(self.film.clone(), &self.illuminant, thickest_nm)
    }
}

/// The lookup table of what single walls reflect.
#[derive(Clone, Debug, PartialEq)]
pub struct TableKey {
    /// Film and light.
    pub optics: OpticsKey,
    /// Thickness at the last row, at normal incidence, in nm.
    pub max_thickness_nm: f64,
    /// Columns, along √cosθ.
    pub columns: u32,
    /// Rows, along thickness times the cosine inside the film.
    pub rows: u32,
    /// Whether it holds what is reflected of each of three primaries, or of white light alone.
    pub coloured: bool,
    /// Whether s and p light are apart.
    pub polarised: bool,
}

impl TableKey {
    /// Columns of a full table.
    pub const COLUMNS: u32 = 64;
    /// Minimum thickness range of the table, in nm.
    pub const MIN_RANGE_NM: f64 = 1500.0;
    /// Rows for [`TableKey::MIN_RANGE_NM`]: 0.73 nm per row.
    pub const MIN_ROWS: u32 = 2048;
    /// Rows at most: the smallest limit on textures that adapters have.
    const MAX_ROWS: u32 = 8192;

    /// A full table for films up to a range, see [`range_nm`], for unpolarised white light. The rows grow with the range, so that their
    /// spacing stays.
    #[must_use]
    pub fn full(optics: OpticsKey, max_thickness_nm: f64) -> Self {
        let rows = (f64::from(Self::MIN_ROWS) * max_thickness_nm / Self::MIN_RANGE_NM).ceil() as u32;
        let rows = rows.min(Self::MAX_ROWS);
        Self { optics, max_thickness_nm, columns: Self::COLUMNS, rows, coloured: false, polarised: false }
    }

    /// A table of this range with fewer rows, which a window shows until the full table is baked.
    #[must_use]
    pub fn coarser(&self, factor: u32) -> Self {
        Self { rows: (self.rows / factor).max(2), ..self.clone() }
    }

    /// Layers of the texture: a primary each, first of s and then of p light.
    #[must_use]
    pub fn layers(&self) -> u32 {
        (if self.coloured { 3 } else { 1 }) * (if self.polarised { 2 } else { 1 })
    }
}

/// The range of tables and wavelengths for films up to a thickness, in nm: steps of 250 nm, so that small edits recompute nothing.
#[must_use]
pub fn range_nm(thickest_nm: f64) -> f64 {
    ((thickest_nm / 250.0).ceil() * 250.0).max(TableKey::MIN_RANGE_NM)
}

/// The fitted wavelengths that shaders sum over.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadratureKey {
    /// Film and light.
    pub optics: OpticsKey,
    /// Thickness that they are fitted to, in nm.
    pub range_nm: f64,
    /// Which errors they may leave.
    pub quality: Quality,
    /// Whether there are none, and products of reflectances are products of the table's colours.
    pub from_table: bool,
}

impl QuadratureKey {
    /// Maximum number of wavelengths, which the smallest uniform buffers have room for.
    pub const MAX: usize = 256;
    /// Maximum number of wavelengths without a table: with more of them, a table and fewer wavelengths are as good and cheaper.
    const MAX_ALONE: usize = 120;
    /// The largest index of films whose colours are factors on colours: denser ones reflect so much that products of spectra differ too much
    /// from products of colours.
    pub const MAX_FACTOR_INDEX: f64 = 1.45;
    /// Thickness of the thickest films, in nm, whose colours are factors on colours: thicker ones have finer fringes, and colours know less of them.
    const MAX_FACTOR_NM: f64 = 2000.0;
    /// Part of a light's strongest primary that its others must have at least, for colours to be factors on them.
    const MIN_PRIMARY: f64 = 0.25;

    /// What a quality needs under a light, of which a mirror shows `seen` of white light, linear BT.2020. `is_plain`: all of it is white and none of it
    /// polarised, so that a table has a colour for each film.
    #[must_use]
    pub fn new(optics: OpticsKey, range_nm: f64, quality: Quality, seen: &DMat3, is_plain: bool) -> Self {
        let white = *seen * DVec3::ONE;
        let from_table = quality == Quality::Fast
            && is_plain
            && range_nm <= Self::MAX_FACTOR_NM
            && optics.illuminant.lines().is_empty()
            && white.min_element() >= Self::MIN_PRIMARY * white.max_element()
            && optics.film.reference_index() <= Self::MAX_FACTOR_INDEX;
        Self { optics, range_nm, quality, from_table }
    }

    /// The wavelengths themselves.
    #[must_use]
    pub fn wavelengths(&self) -> Vec<QuadratureWavelength> {
        fit_quadrature(&self.optics.spectra_to(self.fitted_nm()), self.task(), self.count(), self.fitted_nm())
    }

    /// Thickness that they resolve, in nm.
    #[must_use]
    pub fn fitted_nm(&self) -> f64 {
        self.resolved_nm().min(self.range_nm)
    }

    /// The task of the sum.
    #[must_use]
    pub fn task(&self) -> QuadratureTask {
        if self.needs_table() { QuadratureTask::CrossTerms } else { QuadratureTask::Everything }
    }

    /// Whether single walls come from a table.
    #[must_use]
    pub fn needs_table(&self) -> bool {
        self.quality != Quality::Spectral || self.needed(self.measured()) > Self::MAX_ALONE
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        if self.from_table {
            return 0;
        }
        let alone = self.needed(self.measured()).min(Self::MAX_ALONE);
        alone.max(self.needed(self.measured_beside_table()).min(Self::MAX))
    }

    /// Thickness, in nm, up to which the maximum number of wavelengths resolves the fringes of the products.
    #[must_use]
    pub fn resolved_nm(&self) -> f64 {
        let measured = if self.needs_table() { self.measured_beside_table() } else { self.measured() };
        // A fiftieth less than measured is no less good, and makes it 30 µm.
        1.02 * Self::MAX as f64 / (measured * self.wavelengths_over_water()) * TableKey::MIN_RANGE_NM
    }

    /// Wavelengths needed, given the number that is enough for 1500 nm of water: it grows with the number of fringes.
    fn needed(&self, measured: f64) -> usize {
        (measured * self.wavelengths_over_water() * self.range_nm / TableKey::MIN_RANGE_NM).ceil() as usize
    }

    /// Ratio of the wavelengths that a film needs to the wavelengths for water of the same thickness. A denser liquid has more fringes, and as its
    /// faces reflect more they are sharper: measured from index 2 to 4, so that `fast` and `standard` err in the mean no more than for water. Up to
    /// 1.4, water's do.
    fn wavelengths_over_water(&self) -> f64 {
        1.0 + 4.3 * (self.optics.film.reference_index() - 1.4).max(0.0)
    }

    /// How many do for 1500 nm where single walls come from a table: more than standard's are of little use.
    fn measured_beside_table(&self) -> f64 {
        self.measured().min(13.0)
    }

    /// How many do for 1500 nm.
    fn measured(&self) -> f64 {
        match self.quality {
            Quality::Fast => 6.0,
            Quality::Standard => 13.0,
            Quality::Spectral => 36.0,
        }
    }
}
