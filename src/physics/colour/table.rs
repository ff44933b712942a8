//! The lookup table of film colours in f64: its axes, as `shaders/optics/table.wgsl` has them, and its texels.

use glam::DVec3;
use rayon::prelude::*;

use super::{BT2020, FilmOptics, Walls};
use crate::physics::optics::cos_refracted;

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
    /// The film that a texel's centre stands for: cos θ and thickness in nm.
    #[must_use]
    pub fn film_of_texel(&self, column: usize, row: usize) -> (f64, f64) {
        let t = row as f64 / (self.rows - 1) as f64;
        let cos_theta = (column as f64 / (self.columns - 1) as f64).powi(2);
        let path_nm = self.max_thickness_nm * t * (t + EVEN) / (1.0 + EVEN);
        // Light that grazes a film of index 1 goes along it: the floor only matters there, where nothing is reflected.
        (cos_theta, path_nm / cos_refracted(self.index, cos_theta).max(1e-6))
    }

    /// Where a film lies: columns and rows from the centre of the first texel.
    #[must_use]
    pub fn texel_of_film(&self, cos_theta: f64, thickness_nm: f64) -> [f64; 2] {
        let scaled = (1.0 + EVEN) * thickness_nm * cos_refracted(self.index, cos_theta) / self.max_thickness_nm;
        let t = 2.0 * scaled / (EVEN + (EVEN * EVEN + 4.0 * scaled).sqrt());
        [cos_theta.sqrt() * (self.columns - 1) as f64, t * (self.rows - 1) as f64]
    }

    /// All texels, row by row: the film's colour in white light, linear BT.2020, over the most that a film reflects at the texel's angle.
    #[must_use]
    pub fn texels(&self, optics: &FilmOptics) -> Vec<DVec3> {
        let texel = |k: usize| {
            let (cos_theta, thickness_nm) = self.film_of_texel(k % self.columns, k / self.columns);
            let colour = BT2020.from_xyz() * optics.xyz(cos_theta, Walls::One { thickness_nm });
            // A film of index 1 reflects nothing, and nothing divided by the floor stays nothing.
            colour / optics.film().max_reflectance(cos_theta).max(1e-30)
        };
        (0..self.columns * self.rows).into_par_iter().map(texel).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{colour::Illuminant, optics::FilmIndex};

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
        assert!(texels[..9].iter().all(|texel| *texel == DVec3::ZERO), "no film is black");
        let (cos_theta, thickness_nm) = TABLE.film_of_texel(5, 11);
        let colour = BT2020.from_xyz() * optics.xyz(cos_theta, Walls::One { thickness_nm });
        let expected = colour / optics.film().max_reflectance(cos_theta);
        assert!((texels[11 * 9 + 5] - expected).abs().max_element() < 1e-15);
    }
}
