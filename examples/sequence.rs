//! Draws a short film as numbered pictures, which `ffmpeg -i frame_%03d.png film.mp4` joins.
//!
//!     cargo run --example sequence -- frames

use std::path::PathBuf;

use soapfilm::{Studio, load_scene};

const FRAMES: u32 = 5;
const FRAMES_PER_SECOND: f64 = 10.0;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("soapfilm_frames"), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let scene = load_scene("stirred")?;
    let mut studio = Studio::open()?;
    for frame in 0..FRAMES {
        // A picture is a function of its time alone. Rising times are the fastest: the film goes on from where it is.
        let time_s = f64::from(frame) / FRAMES_PER_SECOND;
        studio.render(&scene, [160, 90], time_s)?.save(folder.join(format!("frame_{frame:03}.png")))?;
    }
    println!("wrote {FRAMES} pictures to {}", folder.display());
    Ok(())
}
