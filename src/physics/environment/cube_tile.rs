//! Squares that the faces of a cube map are cut into, so that only those in sight need be made.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use super::CubeFace;

/// Tiles along the edge of a face.
pub const TILES_PER_EDGE: usize = 4;

const TILES_PER_FACE: usize = TILES_PER_EDGE * TILES_PER_EDGE;

/// One tile of a cube map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CubeTile {
    /// The face that it is a part of.
    pub face: CubeFace,
    /// Tiles before it in the direction of s.
    pub column: usize,
    /// Tiles before it in the direction of t.
    pub row: usize,
}

impl CubeTile {
    /// By its place in the order of all tiles: face by face, and row by row.
    fn at(index: usize) -> Self {
        let (face, place) = (CubeFace::ALL[index / TILES_PER_FACE], index % TILES_PER_FACE);
        Self { face, column: place % TILES_PER_EDGE, row: place / TILES_PER_EDGE }
    }

    /// The corner of least s and t.
    pub fn corner(&self) -> DVec2 {
        DVec2::new(self.column as f64, self.row as f64) * Self::EDGE - 1.0
    }

    /// Its edge's length in s and t.
    pub const EDGE: f64 = 2.0 / TILES_PER_EDGE as f64;

    /// Directions to its corners, in order around it.
    fn corners(&self) -> [DVec3; 4] {
        let (low, high) = (self.corner(), self.corner() + Self::EDGE);
        [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)].map(|corner| self.face.direction(corner))
    }
}

/// Whether the plane through two neighbouring edges of a pyramid has all of another pyramid on its outer side.
fn separates(edges: &[DVec3; 4], others: &[DVec3; 4]) -> bool {
    let inside: DVec3 = edges.iter().sum();
    (0..4).any(|k| {
        let normal = edges[k].cross(edges[(k + 1) % 4]);
        let inwards = normal.dot(inside).signum() * normal;
        others.iter().all(|other| inwards.dot(*other) < 0.0)
    })
}

/// A set of tiles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CubeTiles(u128);

impl CubeTiles {
    /// All tiles.
    #[must_use]
    pub fn all() -> Self {
        Self::filtered(|_| true)
    }

    /// Those within a pyramid of less than half of all directions, whose edges are four directions in order around it; and maybe some that lie just
    /// outside.
    #[must_use]
    pub fn within(edges: &[DVec3; 4]) -> Self {
        Self::filtered(|tile| !separates(edges, &tile.corners()) && !separates(&tile.corners(), edges))
    }

    fn filtered(holds: impl Fn(CubeTile) -> bool) -> Self {
        let tiles = (0..CubeFace::ALL.len() * TILES_PER_FACE).filter(|index| holds(CubeTile::at(*index)));
        Self(tiles.fold(0, |set, index| set | 1 << index))
    }

    /// The tiles in order.
    pub fn iter(self) -> impl Iterator<Item = CubeTile> {
        (0..CubeFace::ALL.len() * TILES_PER_FACE).filter(move |index| self.0 >> index & 1 == 1).map(CubeTile::at)
    }

    /// Those of either set.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those of this set alone.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square pyramid about an axis, for a half angle in radians.
    fn pyramid(axis: DVec3, half_angle: f64) -> [DVec3; 4] {
        let (right, up) = axis.normalize().any_orthonormal_pair();
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| axis.normalize() + half_angle.tan() * (x * right + y * up))
    }

    #[test]
    fn pyramids_have_the_tiles_of_their_directions() {
        for axis in [DVec3::X, DVec3::new(0.6, 0.8, 0.0), DVec3::ONE, DVec3::new(-0.48, 0.6, -0.64)] {
            for half_angle in [0.01, 0.2, 0.7, 1.4] {
                let edges = pyramid(axis, half_angle);
                let tiles = CubeTiles::within(&edges);
                for k in 0..1000 {
                    let (x, y) = (f64::from(k % 25) / 24.0, f64::from(k / 25) / 39.0);
                    let ray = edges[0].lerp(edges[1], x).lerp(edges[3].lerp(edges[2], x), y);
                    let (face, st) = CubeFace::of_direction(ray);
                    let inside = |tile: CubeTile| {
                        let place = st - tile.corner();
                        tile.face == face && place.min_element() >= 0.0 && place.max_element() <= CubeTile::EDGE
                    };
                    assert!(tiles.iter().any(inside), "{axis}, {half_angle}");
                }
            }
        }
    }

    #[test]
    fn narrow_pyramids_have_few_tiles() {
        let within = |axis: DVec3, half_angle| CubeTiles::within(&pyramid(axis, half_angle)).iter().count();
        // The four around the middle of a face; one; those around a corner of the cube; about a face; a half of everything and what is beside it.
        assert_eq!(
            [within(DVec3::X, 0.1), within(DVec3::new(1.0, 0.25, 0.25), 0.01), within(DVec3::ONE, 0.1)],
            [4, 1, 3]
        );
        assert!((16..=36).contains(&within(DVec3::X, 0.784)));
        assert!((48..=64).contains(&within(DVec3::X, 1.57)));
    }

    #[test]
    fn sets_add_and_subtract() {
        let [near, far] = [DVec3::X, DVec3::NEG_X].map(|axis| CubeTiles::within(&pyramid(axis, 0.3)));
        assert_eq!(near.union(far).without(far), near);
        assert_eq!(near.union(near), near);
        assert!(near.without(near).is_empty() && CubeTiles::default().is_empty() && !near.is_empty());
        assert_eq!(CubeTiles::all().iter().count(), 96);
        assert_eq!(CubeTiles::all().without(near).iter().count(), 96 - near.iter().count());
    }
}
