//! The faces of a GPU's cube map: which direction each texel looks in.

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// One face of a cube map, in the order of its array layers on the GPU.
///
/// The orientation follows the Vulkan specification, "Cube Map Face Selection" (WebGPU, Metal and Direct3D agree): with
/// `s` to the right and `t` down, both in [−1, 1], the face and its coordinates follow from the direction's components alone.
/// The picture on a face is therefore mirrored in a right-handed world, but a shader that samples the cube passes world
/// directions unchanged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum CubeFace {
    /// Layer 0: +x.
    PositiveX,
    /// Layer 1: −x.
    NegativeX,
    /// Layer 2: +y.
    PositiveY,
    /// Layer 3: −y.
    NegativeY,
    /// Layer 4: +z.
    PositiveZ,
    /// Layer 5: −z.
    NegativeZ,
}

impl CubeFace {
    /// All faces in the order of the GPU's layers.
    pub const ALL: [Self; 6] =
        [Self::PositiveX, Self::NegativeX, Self::PositiveY, Self::NegativeY, Self::PositiveZ, Self::NegativeZ];

    /// The face's array layer on the GPU, 0 to 5.
    pub fn layer(self) -> usize {
        self as usize
    }

    /// The direction, not normalised, towards the point (s, t) of this face; beyond [−1, 1] it lies on the face's plane
    /// outside the cube.
    pub fn direction(self, st: DVec2) -> DVec3 {
        let DVec2 { x: s, y: t } = st;
        match self {
            Self::PositiveX => DVec3::new(1.0, -t, -s),
            Self::NegativeX => DVec3::new(-1.0, -t, s),
            Self::PositiveY => DVec3::new(s, 1.0, t),
            Self::NegativeY => DVec3::new(s, -1.0, -t),
            Self::PositiveZ => DVec3::new(s, -t, 1.0),
            Self::NegativeZ => DVec3::new(-s, -t, -1.0),
        }
    }

    /// A direction in the face's own axes: s, t and the depth of its plane, with which [`Self::direction`] of (s, t) has depth 1.
    pub fn local(self, direction: DVec3) -> DVec3 {
        let DVec3 { x, y, z } = direction;
        match self {
            Self::PositiveX => DVec3::new(-z, -y, x),
            Self::NegativeX => DVec3::new(z, -y, -x),
            Self::PositiveY => DVec3::new(x, z, y),
            Self::NegativeY => DVec3::new(x, -z, -y),
            Self::PositiveZ => DVec3::new(x, -y, z),
            Self::NegativeZ => DVec3::new(-x, -y, -z),
        }
    }

    /// The face that `direction` (of any length but zero) meets, and where on it: (s, t) in [−1, 1]. On an edge z wins over y
    /// over x.
    pub fn of_direction(direction: DVec3) -> (Self, DVec2) {
        let DVec3 { x, y, z } = direction;
        let size = direction.abs();
        let (face, sc, tc, ma) = if size.z >= size.x && size.z >= size.y {
            if z > 0.0 { (Self::PositiveZ, x, -y, size.z) } else { (Self::NegativeZ, -x, -y, size.z) }
        } else if size.y >= size.x {
            if y > 0.0 { (Self::PositiveY, x, z, size.y) } else { (Self::NegativeY, x, -z, size.y) }
        } else if x > 0.0 {
            (Self::PositiveX, -z, -y, size.x)
        } else {
            (Self::NegativeX, z, -y, size.x)
        };
        (face, DVec2::new(sc, tc) / ma)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_count_up_in_gpu_order() {
        let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        for (layer, (face, axis)) in CubeFace::ALL.into_iter().zip(axes).enumerate() {
            assert_eq!(face.layer(), layer);
            assert_eq!(CubeFace::of_direction(axis), (face, DVec2::ZERO));
        }
    }

    /// The table of the Vulkan specification, "Cube Map Face Selection", typed independently: major axis, then the axes of s and t.
    #[test]
    fn orientation_is_that_of_the_vulkan_table() {
        let table = [
            (DVec3::X, DVec3::NEG_Z, DVec3::NEG_Y),
            (DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y),
            (DVec3::Y, DVec3::X, DVec3::Z),
            (DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z),
            (DVec3::Z, DVec3::X, DVec3::NEG_Y),
            (DVec3::NEG_Z, DVec3::NEG_X, DVec3::NEG_Y),
        ];
        for (face, (major, right, down)) in CubeFace::ALL.into_iter().zip(table) {
            assert_eq!(face.direction(DVec2::new(0.25, 0.5)), major + 0.25 * right + 0.5 * down, "{face:?}");
        }
    }

    #[test]
    fn direction_and_face_are_inverse() {
        for face in CubeFace::ALL {
            for (s, t) in [(0.0, 0.0), (0.9, -0.3), (-0.7, 0.8), (-0.1, -0.95)] {
                let (found, st) = CubeFace::of_direction(5.0 * face.direction(DVec2::new(s, t)));
                assert_eq!(found, face);
                assert!(st.distance(DVec2::new(s, t)) < 1e-15);
                assert_eq!(face.local(face.direction(DVec2::new(s, t))), DVec3::new(s, t, 1.0));
            }
        }
    }
}
