//! Keys of environments: what lights the bubbles, and what is seen behind them.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::physics::environment::{Cones, CubeMap, CubeTiles, Defocused};

/// The light around the bubbles.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EnvironmentKey(pub Arc<CubeMap>);

impl EnvironmentKey {
    /// Texels along a face's edge.
    #[must_use]
    pub fn size(&self) -> u32 {
        self.0.size() as u32
    }
}

impl PartialEq for EnvironmentKey {
    fn eq(&self, other: &Self) -> bool {
        self.0.id() == other.0.id()
    }
}

/// The environment as it is seen behind the bubbles, out of focus.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DefocusKey {
    /// The environment.
    pub environment: EnvironmentKey,
    /// Half angle of the cones that it is averaged over, in radians; above 0.
    pub half_angle_rad: f64,
    /// The tiles of its cube that are in sight.
    pub tiles: CubeTiles,
}

impl DefocusKey {
    /// The tiles.
    #[must_use]
    pub fn made(&self) -> Defocused {
        Defocused::new(&self.environment.0, self.half_angle_rad, self.tiles)
    }

    /// What the tiles hold, for any direction within them.
    #[must_use]
    pub fn cones(&self) -> Cones {
        Cones::new(&self.environment.0, self.half_angle_rad, self.tiles)
    }

    /// Whether another key is of the same map, of whatever tiles.
    #[must_use]
    pub fn is_same_map(&self, other: &Self) -> bool {
        self.environment == other.environment && self.half_angle_rad == other.half_angle_rad
    }
}
