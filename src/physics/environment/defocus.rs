//! An environment as a lens shows it that is not focused on it: each point becomes a disc.
//!
//! A thin lens of radius r that is focused at the distance f sees a point at infinity, through each place of its aperture, in another direction.
//! All of them together fill a cone of half angle θ = atan(r / f) about the direction of the pixel, so a far background is averaged over that
//! cone. (The lens is flat; its discs are cut by the plane of focus and not by a sphere, so that away from the middle of the picture, by an angle
//! α, they are shorter by cos α in one direction. This is left out.)
//!
//! On a face of a cube map a cone is bounded by a conic, here an ellipse, and meets each row of texels in one interval. With sums along the rows
//! its integral takes two lookups a row, whatever is in it: sun and sky alike, without noise, with their energy.

use glam::{DVec2, DVec3, DVec4};
use serde::{Deserialize, Serialize};

use crate::{parallel, physics::bulk};

use super::{CubeFace, CubeMap, CubeTile, CubeTiles, Repairs, TILES_PER_EDGE, Texel, mip, texel::texels_of};

/// Rows across half a disc that its outline is made of, at least: rows of texels of the source, or parts of them in small discs.
const OUTLINE_ROWS: f64 = 6.0;
/// Texels of the result across half a disc: its edge is an eighth of its radius wide.
const RESULT_TEXELS: f64 = 8.0;
/// Texels along an edge of the result, at most.
const MAX_SIZE: f64 = 1024.0;
/// What the texels along an edge of the result are a multiple of: tiles can then be halved until a texel is as wide as four radii of a disc.
const SIZE_STEP: usize = 32 * TILES_PER_EDGE;

/// What stands behind a scene, out of focus: some tiles of a cube map, as large as shows no texels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Defocused {
    /// Texels along an edge of a face of the largest level.
    pub size: usize,
    /// Number of levels of each tile.
    pub levels: usize,
    /// The tiles that were made, in order.
    pub tiles: Vec<DefocusedTile>,
}

/// One tile.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DefocusedTile {
    /// Which one it is.
    pub tile: CubeTile,
    /// Texels of its levels one after the other, the largest first, each row by row.
    #[serde(with = "bulk")]
    pub texels: Vec<Texel>,
}

impl Defocused {
    /// The map of an environment, without its lamps, averaged over cones of a half angle in radians, from about a texel to 0.5.
    #[must_use]
    pub fn new(map: &CubeMap, half_angle_rad: f64, tiles: CubeTiles) -> Self {
        let size = (2.0 * RESULT_TEXELS / half_angle_rad).clamp(1.0, MAX_SIZE);
        // Discs of less than a texel leave the map nearly as it is.
        let size = if half_angle_rad * (map.size() as f64) < 2.0 { map.size() as f64 } else { size };
        let size = (size as usize).next_multiple_of(SIZE_STEP);
        let edge = size / TILES_PER_EDGE;
        let levels = edge.trailing_zeros() as usize + 1;
        let cones = Cones::new(map, half_angle_rad, tiles);
        let made = |tile| DefocusedTile { tile, texels: cones.tile(tile, edge, levels) };
        Self { size, levels, tiles: tiles.iter().map(made).collect() }
    }
}

/// The means of an environment, without its lamps, over all cones of one half angle.
pub struct Cones {
    cos: f64,
    sin: f64,
    /// The faces that tiles were asked for of.
    faces: [Option<Sums>; 6],
}

impl Cones {
    /// For a half angle in radians, from about a texel to 0.5.
    #[must_use]
    pub fn new(map: &CubeMap, half_angle_rad: f64, tiles: CubeTiles) -> Self {
        let (sin, cos) = half_angle_rad.sin_cos();
        let level = (map.size() as f64 * half_angle_rad / (2.0 * OUTLINE_ROWS)).log2().max(0.0) as usize;
        let level = level.min(map.mips().len() - 1);
        // From the corner of a face cones reach farthest.
        let [_, reach] = ends(DVec3::ONE.normalize(), sin);
        let is_seen = |face: CubeFace| tiles.iter().any(|tile| tile.face == face);
        let faces = CubeFace::ALL.map(|face| is_seen(face).then(|| Sums::new(map, level, face, reach)));
        Self { cos, sin, faces }
    }

    /// About a direction of any length; black on faces of which no tile was asked for.
    #[must_use]
    pub fn mean(&self, direction: DVec3) -> DVec3 {
        let (face, _) = CubeFace::of_direction(direction);
        let Some(sums) = &self.faces[face.layer()] else { return DVec3::ZERO };
        let sum = sums.within(face.local(direction.normalize()), self.cos, self.sin);
        sum.truncate() / sum.w
    }

    /// The texels of a tile, `edge` along its edge, and of smaller levels after them.
    fn tile(&self, tile: CubeTile, edge: usize, levels: usize) -> Vec<Texel> {
        let texel = |k: usize| {
            let place = DVec2::new((k % edge) as f64 + 0.5, (k / edge) as f64 + 0.5) * (CubeTile::EDGE / edge as f64);
            let mut texel = self.mean(tile.face.direction(tile.corner() + place)).as_vec3().to_array();
            // Differences of sums may fall below 0 by their rounding.
            Repairs::repair(&mut texel);
            texel
        };
        let mut level = parallel::map(edge * edge, texel);
        let mut texels = texels_of(&level);
        for smaller in 1..levels {
            level = mip::halve(&level, edge >> (smaller - 1));
            texels.extend(texels_of(&level));
        }
        texels
    }
}

/// Between which rows t of a face's plane, whose points are (s, t, 1), a cone lies: where the plane of the row touches it.
fn ends(axis: DVec3, sin: f64) -> [f64; 2] {
    let square = axis.z * axis.z - sin * sin;
    let half = axis.y * axis.z;
    let root = (half * half - square * (axis.y * axis.y - sin * sin)).max(0.0).sqrt();
    [(half - root) / square, (half + root) / square]
}

/// Sums along the rows of one face, which go on beyond its edges as far as cones do.
struct Sums {
    /// Texels for a unit of the face's plane, and texels from the first to the face's middle.
    per_unit: f64,
    middle: f64,
    /// Texels in a row.
    width: usize,
    /// For each row, and before each of its texels and after the last: radiance times solid angle, and solid angle, from the row's start on.
    sums: Vec<DVec4>,
}

impl Sums {
    fn new(map: &CubeMap, level: usize, face: CubeFace, reach: f64) -> Self {
        let size = map.mips()[level].size;
        let per_unit = 0.5 * size as f64;
        // Whole texels beyond the face's edges.
        let beyond = ((reach - 1.0) * per_unit).ceil() as usize + 1;
        let (width, middle) = (size + 2 * beyond, beyond as f64 + per_unit);
        let place = |texel: usize| (texel as f64 + 0.5 - middle) / per_unit;
        let row = |row: usize| {
            let mut sum = DVec4::ZERO;
            let texels = (0..width).map(move |column| {
                let st = DVec2::new(place(column), place(row));
                let solid_angle = (1.0 + st.length_squared()).powf(-1.5);
                let radiance = map.sample_level(level, face.direction(st));
                solid_angle * radiance.extend(1.0)
            });
            let later = texels.map(|texel| {
                sum += texel;
                sum
            });
            std::iter::once(DVec4::ZERO).chain(later).collect::<Vec<_>>()
        };
        Self { per_unit, middle, width, sums: parallel::map(width, row).concat() }
    }

    /// Radiance times solid angle, and solid angle, within a cone about a unit vector (s, t and depth of the face's plane).
    fn within(&self, axis: DVec3, cos: f64, sin: f64) -> DVec4 {
        let [top, bottom] = ends(axis, sin).map(|t| t * self.per_unit + self.middle);
        let last = self.width as f64;
        let (top, bottom) = (top.clamp(0.0, last), bottom.clamp(0.0, last));
        // The interval at a height t in texels, (s, t, 1) · axis = cos |(s, t, 1)|, solved for s.
        let square = cos * cos - axis.x * axis.x;
        let per_square = self.per_unit / square;
        let interval = |t: f64| {
            let t = (t - self.middle) / self.per_unit;
            let across = t * axis.y + axis.z;
            let half = axis.x * across;
            let root = (half * half - square * (cos * cos * (t * t + 1.0) - across * across)).max(0.0).sqrt();
            [half - root, half + root].map(|s| s * per_square + self.middle)
        };
        let step = (bottom - top) / (2.0 * OUTLINE_ROWS);
        let mut sum = DVec4::ZERO;
        for row in top as usize..(bottom.ceil() as usize).min(self.width) {
            let (start, end) = (top.max(row as f64), bottom.min((row + 1) as f64));
            let parts = ((end - start) / step).ceil().max(1.0);
            let height = (end - start) / parts;
            for part in 0..parts as usize {
                let [left, right] = interval(start + (part as f64 + 0.5) * height);
                sum += height * (self.until(row, right) - self.until(row, left));
            }
        }
        sum
    }

    /// The sum of a row from its start to a place, in texels.
    #[inline]
    fn until(&self, row: usize, place: f64) -> DVec4 {
        let place = place.clamp(0.0, self.width as f64);
        let texel = (place as usize).min(self.width - 1);
        let first = row * (self.width + 1) + texel;
        self.sums[first].lerp(self.sums[first + 1], place - texel as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Green light from a few lamps of a few degrees over a slope.
    fn lamps(direction: DVec3) -> DVec3 {
        let lamp = |towards: DVec3| (40.0 * (direction.normalize().dot(towards.normalize()) - 1.0) / 0.004).exp();
        let sum = lamp(DVec3::new(1.0, 0.2, 0.1)) + lamp(DVec3::new(1.0, 1.0, 0.9)) + lamp(DVec3::new(-0.3, 0.2, -1.0));
        DVec3::new(0.1, 0.2 + 0.1 * direction.normalize().z + 50.0 * sum, 0.1)
    }

    /// The mean over a cone by its definition: by places that fill a disc evenly, as of a sunflower's seeds.
    fn by_brute_force(map: &CubeMap, axis: DVec3, half_angle: f64) -> DVec3 {
        const SEEDS: u32 = 20_000;
        let axis = axis.normalize();
        let (right, up) = axis.any_orthonormal_pair();
        let sum: DVec3 = (0..SEEDS)
            .map(|seed| {
                // Even in solid angle: in the cosine.
                let cos = 1.0 - (1.0 - half_angle.cos()) * (f64::from(seed) + 0.5) / f64::from(SEEDS);
                let turn = DVec2::from_angle(f64::from(seed) * 2.399_963_229_728_653);
                let sin = (1.0 - cos * cos).sqrt();
                map.sample(cos * axis + sin * (turn.x * right + turn.y * up))
            })
            .sum();
        sum / f64::from(SEEDS)
    }

    #[test]
    fn cones_are_those_of_brute_force() {
        let map = CubeMap::from_fn(256, 1, lamps);
        for half_angle in [0.02, 0.07, 0.3, 0.5] {
            let cones = Cones::new(&map, half_angle, CubeTiles::all());
            let (mut worst, mut brightest, mut square) = (0.0f64, 0.0f64, 0.0);
            for k in 0..400 {
                let z = 1.0 - (f64::from(k) + 0.5) / 200.0;
                let level = (1.0 - z * z).sqrt() * DVec2::from_angle(f64::from(k) * 2.399_963_229_728_653);
                let axis = level.extend(z);
                let (found, truth) = (cones.mean(axis).y, by_brute_force(&map, axis, half_angle).y);
                worst = worst.max((found - truth).abs());
                brightest = brightest.max(truth);
                square += (found - truth).powi(2) / 400.0;
            }
            eprintln!(
                "measured: cones of {half_angle}: rms {:.4}, worst {:.4} of the brightest",
                square.sqrt() / brightest,
                worst / brightest
            );
            // Of the brightest disc, at whose edge a row of texels, a sixth of its radius wide at most, is in or out with parts of a lamp.
            assert!(
                worst < 0.08 * brightest && square.sqrt() < 0.01 * brightest,
                "{half_angle}: {worst} of {brightest}"
            );
        }
    }

    #[test]
    fn a_lamp_becomes_a_disc_with_its_energy() {
        let lamp = |direction: DVec3| DVec3::splat(f64::from(direction.normalize().dot(DVec3::X) > 0.999_95) * 1000.0);
        let map = CubeMap::from_fn(512, 2, lamp);
        let half_angle = 0.08;
        let cones = Cones::new(&map, half_angle, CubeTiles::all());
        let blurred = CubeMap::from_fn(208, 1, |direction| cones.mean(direction));
        let (before, after) = (map.mean_radiance().y, blurred.mean_radiance().y);
        assert!((after / before - 1.0).abs() < 0.005, "{before} becomes {after}");
        // Evenly bright within, dark beyond, whatever the direction.
        let part = before * 2.0 / (1.0 - half_angle.cos());
        for k in 0..24 {
            let around = DVec2::from_angle(f64::from(k) * std::f64::consts::TAU / 24.0);
            let at = |angle: f64| cones.mean(DVec3::new(angle.cos(), angle.sin() * around.x, angle.sin() * around.y)).y;
            assert!((at(0.0) / part - 1.0).abs() < 0.03 && (at(0.6 * half_angle) / part - 1.0).abs() < 0.05, "{k}");
            assert!(at(1.4 * half_angle) < 1e-3 * part, "{k}");
        }
    }

    #[test]
    fn an_even_sky_stays_as_it_is() {
        for half_angle in [1e-4, 0.01, 0.5] {
            let sky = CubeMap::from_fn(64, 1, |_| DVec3::new(0.5, 0.25, 2.0));
            let cones = Cones::new(&sky, half_angle, CubeTiles::all());
            for direction in [DVec3::X, DVec3::ONE, DVec3::new(-1.0, 0.99, 0.2)] {
                assert!((cones.mean(direction) - DVec3::new(0.5, 0.25, 2.0)).abs().max_element() < 1e-3);
            }
        }
    }

    #[test]
    fn tiles_hold_means_of_cones_and_halve_down_to_wide_texels() {
        let map = CubeMap::from_fn(64, 1, lamps);
        let half_angle = 0.1;
        let tiles =
            CubeTiles::within(&[DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y].map(|aside| DVec3::ONE + 0.05 * aside));
        let made = Defocused::new(&map, half_angle, tiles);
        assert_eq!((made.size, made.levels, made.tiles.len()), (256, 7, 3));
        let cones = Cones::new(&map, half_angle, tiles);
        for DefocusedTile { tile, texels } in &made.tiles {
            assert_eq!(texels.len(), (0..7).map(|level| (64 * 64) >> (2 * level)).sum::<usize>());
            // Column 5 of row 9.
            let place = tile.corner() + DVec2::new(5.5, 9.5) * CubeTile::EDGE / 64.0;
            let truth = cones.mean(tile.face.direction(place)).as_vec3();
            assert_eq!(texels[9 * 64 + 5], Texel::of(truth.to_array()), "{tile:?}: {truth}");
            let mean = texels[..64 * 64].iter().map(|texel| texel.radiance().y).sum::<f64>() / 4096.0;
            assert!((texels[texels.len() - 1].radiance().y / mean - 1.0).abs() < 2e-3, "{tile:?}");
        }
    }

    #[test]
    fn a_thin_lens_keeps_the_size_of_the_map() {
        let map = CubeMap::from_fn(200, 1, |_| DVec3::ONE);
        let tiles = CubeTiles::default();
        assert_eq!([0.006, 0.02, 0.4].map(|angle| Defocused::new(&map, angle, tiles).size), [256, 896, 128]);
    }
}
