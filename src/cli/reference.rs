//! `--quality reference`: the f64 picture as files hold it.

use glam::DVec3;

use crate::{
    output::Picture,
    physics::colour::{Display, bt2020_to_bt709},
    plan::TonemapKey,
};

/// What a display shows of it.
pub fn display(key: &TonemapKey, radiance: &[DVec3]) -> Picture {
    let [width, _] = key.draw.size;
    let display = Display { exposure_ev: key.exposure_ev, balance: key.balance, gamut: key.gamut, dither: key.dither };
    let pixels = radiance.iter().zip(0..);
    let rgba = pixels.flat_map(|(radiance, k): (_, u32)| {
        let [r, g, b] = display.encode(*radiance, [k % width, k / width]);
        [r, g, b, u8::MAX]
    });
    Picture::Display { size: key.draw.size, gamut: key.gamut, rgba: rgba.collect() }
}

/// The radiance itself, as pictures are written.
pub fn linear(size: [u32; 2], radiance: &[DVec3]) -> Picture {
    let to_bt709 = bt2020_to_bt709();
    Picture::Radiance { size, rgb: radiance.iter().map(|pixel| (to_bt709 * *pixel).as_vec3().to_array()).collect() }
}
