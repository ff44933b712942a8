//! Animated PNG: every bit of the pictures, and alpha. All browsers show it.

use std::{fs::File, io};

use super::{Encoder, Video};
use crate::output::png::encoder;

/// An animated PNG that is being written. Without a buffer, for chunks are written whole, and no error is lost at the end.
pub struct Apng(png::Writer<File>);

impl Apng {
    pub fn begin(video: &Video, file: File) -> io::Result<Self> {
        let mut encoder = encoder(file, video.size, video.gamut, &video.metadata)?;
        // For ever.
        encoder.set_animated(video.frames, 0)?;
        let [numerator, denominator] = video.rate.delay(u16::MAX);
        encoder.set_frame_delay(numerator, denominator)?;
        Ok(Self(encoder.write_header()?))
    }
}

impl Encoder for Apng {
    fn add(&mut self, rgba: &[u8]) -> io::Result<()> {
        Ok(self.0.write_image_data(rgba)?)
    }

    fn finish(self: Box<Self>) -> io::Result<()> {
        Ok(self.0.finish()?)
    }
}
