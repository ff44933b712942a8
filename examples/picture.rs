//! Draws one picture, as the window shows it and as scene radiance.
//!
//!     cargo run --example picture -- windows bubble.png

use std::path::PathBuf;

use soapfilm::{Error, Studio, load_scene};

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let scene = load_scene(arguments.next().unwrap_or_else(|| "windows".to_owned()))?;
    let file = arguments.next().map_or_else(|| std::env::temp_dir().join("bubble.png"), PathBuf::from);

    // The adapter is opened once and draws as many pictures as you like.
    let mut studio = Studio::open()?;
    println!("drawing `{}` on {}", scene.name, studio.adapter_name());
    let size = [320, 180];

    // 8 bits of sRGB, five seconds after the bubble was blown.
    let picture = studio.render(&scene, size, 5.0)?;
    picture.save(&file)?;
    println!("wrote {}", file.display());

    // Radiance in linear BT.709, before exposure and tone curve: numbers to compute with.
    let radiance = studio.radiance(&scene, size, 5.0)?;
    let brightest = radiance.rgb.iter().flatten().copied().fold(0.0, f32::max);
    let file = file.with_extension("exr");
    radiance.save(&file)?;
    println!("wrote {}; its brightest component is {brightest:.3}", file.display());
    Ok(())
}
