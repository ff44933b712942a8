//! Parts of a picture: rectangles of it, and what light is made of along each ray.
//!
//! Light along a ray is an affine function of the light B that stands straight behind the bubbles: L = T B + E, where T is what all walls
//! before it leave of B, and E is what the walls reflect into the ray. Each part is a picture like any other, in other light.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::picture::{BackdropKey, DrawKey, Lighting};

impl DrawKey {
    /// What bubbles add: the picture before black.
    #[must_use]
    pub fn before_black(&self) -> Self {
        let mut key = Self { plate: None, ..self.clone() };
        key.each_light(|lighting| lighting.light.backdrop = BackdropKey::Colour(DVec3::ZERO));
        key
    }

    /// What bubbles leave of white light from straight behind, where nothing else shines.
    #[must_use]
    pub fn before_white(&self) -> Self {
        let mut key = self.before_black();
        key.each_light(|lighting| lighting.light.gain = DVec3::ZERO);
        key.lighting.light.backdrop = BackdropKey::Colour(DVec3::ONE);
        key
    }

    /// What stands behind: the picture without bubbles.
    #[must_use]
    pub fn without_bubbles(&self) -> Self {
        Self { bubbles: Vec::new(), small: [].into(), lent: Vec::new(), ..self.clone() }
    }

    fn each_light(&mut self, change: impl Fn(&mut Lighting)) {
        std::iter::once(&mut self.lighting).chain(&mut self.spectral_lights).for_each(change);
    }

    /// A rectangle of the picture, in pixels from the top left, as a picture of its own. It may hold no pixel of some of the bubbles.
    #[must_use]
    pub fn cut(&self, columns: &Range<u32>, rows: &Range<u32>) -> Self {
        let mut key = self.clone();
        key.size = [columns.len() as u32, rows.len() as u32];
        let whole = DVec2::from(self.size.map(f64::from));
        let part = DVec2::from(key.size.map(f64::from));
        let corner = DVec2::new(f64::from(columns.start), f64::from(rows.start));
        if let Some(plate) = &mut key.plate {
            plate.corner = [plate.corner[0] + columns.start, plate.corner[1] + rows.start];
            plate.size = key.size;
        }
        // From the middle of the rectangle to the middle of the picture, in pixels.
        let to_middle = 0.5 * whole - (corner + 0.5 * part);
        key.camera.shift += to_middle;
        // Clip coordinates point up.
        let moved = DVec2::new(to_middle.x, -to_middle.y);
        let within = |bounds: [DVec2; 2]| bounds.map(|clip| (clip * whole + 2.0 * moved) / part);
        key.bubbles.iter_mut().for_each(|bubble| bubble.bounds = within(bubble.bounds));
        let small = self.small.iter().map(|small| super::SmallBubble { bounds: within(small.bounds), ..*small });
        key.small = small.collect();
        key
    }
}
