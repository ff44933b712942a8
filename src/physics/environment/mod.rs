//! The light around the bubbles: radiance from every direction, as pictures, as formulas, and as the cube map that shaders
//! sample.
//!
//! Radiance is linear BT.2020 relative to the scene's illuminant: (1, 1, 1) is a white surface in full light, whatever the
//! illuminant. Directions are in the world: right-handed, +z up.

mod cube_face;
mod cube_map;
mod cube_tile;
mod defocus;
mod equirect;
mod lamp;
mod mip;
mod patch;
mod procedural;
mod repair;
mod shape;
mod texel;

pub use cube_face::CubeFace;
pub use cube_map::{CubeLevel, CubeMap};
pub use cube_tile::{CubeTile, CubeTiles, TILES_PER_EDGE};
pub use defocus::{Cones, Defocused, DefocusedTile};
pub use equirect::{Equirect, WrongPixelCount, direction_of_uv, uv_of_direction};
pub use lamp::Lamp;
pub use patch::Patch;
pub use procedural::Procedural;
pub use repair::{MAX_RADIANCE, Repairs};
pub use texel::Texel;
