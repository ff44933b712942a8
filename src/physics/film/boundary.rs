//! What a film ends at.

use super::Cap;
use crate::words::words;

words! {
    /// What a film ends at.
    pub enum Boundary: "boundary" {
        Free = "free", "A whole bubble in the air";
        Bath = "bath", "Half a bubble that stands on a bath of liquid";
        Ring = "ring", "A dome of film on a ring, open below";
        Drop = "drop", "A whole bubble with a drop hanging at its bottom";
    }
}

impl Boundary {
    /// Colatitude of the rim, degrees, for one asked for; none for a film without a rim.
    #[must_use]
    pub fn rim_deg(self, asked_deg: f64) -> Option<f64> {
        match self {
            Self::Free => None,
            Self::Bath => Some(90.0),
            Self::Ring | Self::Drop => Some(asked_deg),
        }
    }

    /// Colatitudes in degrees that a rim may have; `None` where it cannot be chosen.
    #[must_use]
    pub fn rims_deg(self) -> Option<[f64; 2]> {
        match self {
            Self::Free | Self::Bath => None,
            // Below, the image of the film beyond its rim is finer than the flow's cells.
            Self::Ring => Some([30.0, 150.0]),
            Self::Drop => Some([30.0, 175.0]),
        }
    }

    /// Where the film ends so that none lies beyond.
    #[must_use]
    pub fn cap(self, asked_deg: f64) -> Option<Cap> {
        match self {
            Self::Free | Self::Drop => None,
            Self::Bath => Some(Cap::HEMISPHERE),
            Self::Ring => Some(Cap::above(asked_deg.to_radians())),
        }
    }

    /// Angular radius in radians of the drop that pins the film at its bottom.
    #[must_use]
    pub fn drop_rad(self, asked_deg: f64) -> Option<f64> {
        (self == Self::Drop).then(|| (180.0 - asked_deg).to_radians())
    }
}
