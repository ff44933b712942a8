//! Linear pictures that are finished on the CPU: what a file holds of radiance in linear BT.2020.

use glam::{DMat3, DVec3, Vec3};

use crate::{
    output::Picture,
    parallel,
    physics::colour::{bt2020_to_bt709, transmittance},
    plan::TonemapKey,
};

/// Light along the ray of a pixel, or the mean over the pixel, linear BT.2020: what bubbles add, what they leave of white light from behind, and
/// that white light.
#[derive(Clone, Copy, Debug)]
pub struct Passage {
    /// What bubbles add.
    pub added: Vec3,
    /// What arrives of the white light.
    pub through: Vec3,
    /// What would arrive without bubbles.
    pub white: Vec3,
}

impl Passage {
    /// The part of light from behind that remains in each channel of the RGB that a matrix leads to from linear BT.2020.
    pub fn transmittance(&self, to_rgb: &DMat3) -> DVec3 {
        transmittance(*to_rgb * self.through.as_dvec3(), *to_rgb * self.white.as_dvec3())
    }
}

/// What a display shows of a picture, with what the lens does to it.
pub fn display(key: &TonemapKey, size: [u32; 2], radiance: &[Vec3]) -> Picture {
    let radiance = radiance.iter().map(|radiance| radiance.as_dvec3()).collect();
    Picture::Display { size, gamut: key.gamut, rgba: key.shown(size, radiance) }
}

/// What a display shows of bubbles alone, with straight alpha.
pub fn display_alone(key: &TonemapKey, size: [u32; 2], light: &[Passage]) -> Picture {
    let (display, width) = (key.display(), size[0] as usize);
    let to_display = key.gamut.from_bt2020() * key.balance;
    let pixel = |k: usize| {
        let place = [(k % width) as u32, (k / width) as u32];
        display.encode_alone(light[k].added.as_dvec3(), light[k].transmittance(&to_display), place)
    };
    let rgba = parallel::map(light.len(), pixel);
    Picture::Display { size, gamut: key.gamut, rgba: rgba.into_flattened() }
}

/// The radiance itself, as pictures are written.
pub fn linear(size: [u32; 2], radiance: &[Vec3]) -> Picture {
    Picture::Radiance { size, rgb: in_bt709(radiance) }
}

/// Radiance of bubbles alone with premultiplied alpha, as channels.
pub fn linear_alone(size: [u32; 2], light: &[Passage]) -> Picture {
    let added: Vec<Vec3> = light.iter().map(|light| light.added).collect();
    let mut channels = colour_channels("", &in_bt709(&added));
    channels.push(("A".to_owned(), alpha(light)));
    Picture::Channels { size, channels }
}

/// How much each pixel covers: 1 minus the mean of the three transmittances, linear BT.709. Of all single numbers this one is nearest to the
/// three, by least squares.
pub fn alpha(light: &[Passage]) -> Vec<f32> {
    let to_bt709 = bt2020_to_bt709();
    parallel::map(light.len(), |k| (1.0 - light[k].transmittance(&to_bt709).element_sum() / 3.0) as f32)
}

/// Linear BT.709 of linear BT.2020.
pub fn in_bt709(radiance: &[Vec3]) -> Vec<[f32; 3]> {
    let to_bt709 = bt2020_to_bt709();
    parallel::map(radiance.len(), |k| (to_bt709 * radiance[k].as_dvec3()).as_vec3().to_array())
}

/// Channels of a layer, `R`, `G` and `B` after its prefix.
pub fn colour_channels(prefix: &str, rgb: &[[f32; 3]]) -> Vec<(String, Vec<f32>)> {
    vector_channels(prefix, ["R", "G", "B"], rgb)
}

/// Channels of a layer with three values per pixel.
pub fn vector_channels(prefix: &str, names: [&str; 3], values: &[[f32; 3]]) -> Vec<(String, Vec<f32>)> {
    let channel = |k: usize| (format!("{prefix}{}", names[k]), values.iter().map(|value| value[k]).collect());
    (0..3).map(channel).collect()
}
