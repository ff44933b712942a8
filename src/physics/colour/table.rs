//! The lookup table of film colours in f64: its axes, as `shaders/optics/table.wgsl` has them, and its texels.

use glam::DVec3;

use super::{BT2020, FilmOptics};
use crate::{parallel, physics::optics::cos_refracted};

/// How much of the rows' spacing is even: part v of the longest path is at part t of the rows with v = t (t + EVEN) / (1 + EVEN).
const EVEN: f64 = 0.5;

/// A table √cosθ × path in the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTable {
    /// Columns, along √cosθ; 2 or more.
    pub columns: usize,
    /// Rows, along thickness times the cosine inside the film; 2 or more.
    pub rows: usize,
    /// Thickness at the last row for normal incidence, in nm.
    pub max_thickness_nm: f64,
    /// Index of the film at the sodium line.
    pub index: f64,
}

impl FilmTable {
    /// The film that a texel's center stands for: cos θ and thickness in nm.
    #[must_use]
    pub fn film_of_texel(&self, column: usize, row: usize) -> (f64, f64) {
        let t = row as f64 / (self.rows - 1) as f64;
        let cos_theta = (column as f64 / (self.columns - 1) as f64).powi(2);
        let path_nm = self.max_thickness_nm * t * (t + EVEN) / (1.0 + EVEN);
        // Light that grazes a film of index 1 goes along it: the floor only matters there, where nothing is reflected.
        (cos_theta, path_nm / cos_refracted(self.index, cos_theta).max(1e-6))
    }

    /// Where a film lies: columns and rows from the center of the first texel.
    #[must_use]
    pub fn texel_of_film(&self, cos_theta: f64, thickness_nm: f64) -> [f64; 2] {
        let scaled = (1.0 + EVEN) * thickness_nm * cos_refracted(self.index, cos_theta) / self.max_thickness_nm;
        let t = 2.0 * scaled / (EVEN + (EVEN * EVEN + 4.0 * scaled).sqrt());
        [cos_theta.sqrt() * (self.columns - 1) as f64, t * (self.rows - 1) as f64]
    }

    /// All texels, row by row: the film's colour in white light, linear BT.2020, over the maximum reflectance of a film for unpolarised light at
    /// the texel's angle. For s light, for p light, and for both together, which is their mean.
    #[must_use]
    pub fn texels(&self, optics: &FilmOptics) -> Vec<FilmTexel> {
        let texel = |k: usize| {
            let (cos_theta, thickness_nm) = self.film_of_texel(k % self.columns, k / self.columns);
            // A film of index 1 reflects nothing, and nothing divided by the floor stays nothing.
            let scale = 1.0 / optics.film().max_reflectance(cos_theta).max(1e-30);
            let [s, p] = optics.xyz_of_polarisations(cos_theta, thickness_nm);
            FilmTexel { s: scale * (BT2020.from_xyz() * s), p: scale * (BT2020.from_xyz() * p) }
        };
        parallel::map(self.columns * self.rows, texel)
    }

    /// What a table's texels, row by row, give for a film by linear filtering that clamps at the ends.
    #[must_use]
    pub fn filtered(&self, texels: &[DVec3], cos_theta: f64, thickness_nm: f64) -> DVec3 {
        let [x, y] = self.texel_of_film(cos_theta, thickness_nm);
        let cell = |place: f64, count: usize| (place.max(0.0) as usize).min(count - 2);
        let (column, row) = (cell(x, self.columns), cell(y, self.rows));
        let [u, v] = [x - column as f64, y - row as f64].map(|part| part.clamp(0.0, 1.0));
        let at = |row: usize| {
            let left = row * self.columns + column;
            texels[left].lerp(texels[left + 1], u)
        };
        at(row).lerp(at(row + 1), v)
    }
}

/// One texel of a table: see [`FilmTable::texels`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmTexel {
    /// Of light whose electric field lies across the plane of incidence.
    pub s: DVec3,
    /// Of light whose electric field lies in it.
    pub p: DVec3,
}

impl FilmTexel {
    /// Of unpolarised light.
    #[must_use]
    pub fn unpolarised(&self) -> DVec3 {
        0.5 * (self.s + self.p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        colour::{Illuminant, Walls},
        optics::FilmIndex,
    };

    const TABLE: FilmTable = FilmTable { columns: 9, rows: 17, max_thickness_nm: 900.0, index: 1.33 };

    #[test]
    fn the_two_ways_are_inverse() {
        for row in 0..17 {
            for column in 0..9 {
                let (cos_theta, thickness_nm) = TABLE.film_of_texel(column, row);
                let [x, y] = TABLE.texel_of_film(cos_theta, thickness_nm);
                assert!((x - column as f64).abs() < 1e-12 && (y - row as f64).abs() < 1e-12, "{column} {row}");
            }
        }
        assert_eq!(TABLE.film_of_texel(8, 16), (1.0, 900.0));
    }

    #[test]
    fn texels_are_the_films_colours() {
        let optics = FilmOptics::new(FilmIndex::Constant(1.33), &Illuminant::default());
        let texels = TABLE.texels(&optics);
        assert!(texels[..9].iter().all(|texel| texel.unpolarised() == DVec3::ZERO), "no film is black");
        let (cos_theta, thickness_nm) = TABLE.film_of_texel(5, 11);
        let colour = BT2020.from_xyz() * optics.xyz(cos_theta, Walls::One { thickness_nm });
        let expected = colour / optics.film().max_reflectance(cos_theta);
        let texel = texels[11 * 9 + 5];
        assert!((texel.unpolarised() - expected).abs().max_element() < 1e-14);
        assert!(texel.s.y > texel.p.y, "s light is reflected more");
        let unpolarised: Vec<DVec3> = texels.iter().map(FilmTexel::unpolarised).collect();
        assert!((TABLE.filtered(&unpolarised, cos_theta, thickness_nm) - expected).abs().max_element() < 1e-12);
    }

    #[test]
    fn filtering_is_linear_and_clamps() {
        let texels: Vec<DVec3> = (0..17 * 9).map(|k| DVec3::new(f64::from(k % 9), f64::from(k / 9), 1.0)).collect();
        for (cos_theta, thickness_nm) in [(0.3, 100.0), (0.9, 850.0), (0.0, 0.0), (1.0, 900.0)] {
            let [x, y] = TABLE.texel_of_film(cos_theta, thickness_nm);
            let found = TABLE.filtered(&texels, cos_theta, thickness_nm);
            assert!((found - DVec3::new(x, y, 1.0)).abs().max_element() < 1e-12, "{found}");
        }
        assert_eq!(TABLE.filtered(&texels, 1.0, 5000.0), DVec3::new(8.0, 16.0, 1.0));
    }
}
