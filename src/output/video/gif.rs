//! Animated GIF: 256 colours, chosen for each frame, and dithered.

use std::{
    fs::File,
    io::{self, BufWriter, Write},
};

use color_quant::NeuQuant;
use gif::{Frame, Repeat};
use image::{RgbaImage, imageops};

use super::{Encoder, Video, VideoError};
use crate::{output::FrameRate, physics::colour::Gamut};

/// Of a larger frame's pixels, about as many as this teach the palette.
const LEARNS_FROM: usize = 250_000;
const COLOURS: usize = 256;
/// Viewers show frames that are shorter than 1/50 s for much longer.
const MAX_RATE: u32 = 50;

/// Whether a GIF can hold a video.
pub fn check(video: &Video) -> Result<(), VideoError> {
    let [numerator, denominator] = video.rate.ratio();
    let reason = if video.has_alpha {
        "a GIF has no partial transparency: write an .apng or a .webm"
    } else if video.gamut != Gamut::Srgb {
        "a GIF has the colours of sRGB alone: leave out --gamut, or write an .apng"
    } else if numerator > denominator.saturating_mul(MAX_RATE) {
        "viewers show at most 50 frames of a GIF in a second: use --fps 50 or less, or write an .apng"
    } else if video.size.iter().any(|length| *length > u32::from(u16::MAX)) {
        "a GIF has at most 65535 pixels in width and height"
    } else {
        return Ok(());
    };
    Err(VideoError::Unable(reason.to_owned()))
}

/// An animated GIF that is being written.
pub struct Gif {
    encoder: gif::Encoder<BufWriter<File>>,
    size: [u32; 2],
    rate: FrameRate,
    frames: u64,
}

impl Gif {
    pub fn begin(video: &Video, file: File) -> io::Result<Self> {
        let [width, height] = video.size.map(|length| length as u16);
        let mut encoder = gif::Encoder::new(BufWriter::new(file), width, height, &[]).map_err(io::Error::other)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io::Error::other)?;
        Ok(Self { encoder, size: video.size, rate: video.rate, frames: 0 })
    }
}

impl Encoder for Gif {
    fn add(&mut self, rgba: &[u8]) -> io::Result<()> {
        let [width, height] = self.size;
        let wrong = || io::Error::other("a frame has another size than the video");
        let mut image = RgbaImage::from_raw(width, height, rgba.to_vec()).ok_or_else(wrong)?;
        let one_in = (rgba.len() / 4).div_ceil(LEARNS_FROM).clamp(1, 10);
        let palette = NeuQuant::new(one_in as i32, COLOURS, rgba);
        imageops::dither(&mut image, &palette);
        let indices = imageops::index_colors(&image, &palette).into_raw();
        let mut frame = Frame::from_palette_pixels(width as u16, height as u16, indices, palette.color_map_rgb(), None);
        frame.delay = delay_cs(self.rate, self.frames);
        self.frames += 1;
        self.encoder.write_frame(&frame).map_err(io::Error::other)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        self.encoder.into_inner().map_err(io::Error::other)?.flush()
    }
}

/// How long a frame is shown, in hundredths of a second: such that no error adds up.
fn delay_cs(rate: FrameRate, frame: u64) -> u16 {
    let at = |frame: u64| (100.0 * rate.time_s(frame)).round();
    (at(frame + 1) - at(frame)) as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delays_add_up_to_the_time() {
        for (rate, frames, sum) in [("30", 90, 300), ("24000/1001", 24, 100), ("50", 50, 100), ("0.5", 2, 400)] {
            let rate = rate.parse().unwrap();
            let delays: Vec<_> = (0..frames).map(|frame| delay_cs(rate, frame)).collect();
            assert_eq!(delays.iter().sum::<u16>(), sum);
            assert!(delays.iter().all(|delay| *delay >= 2));
        }
    }
}
