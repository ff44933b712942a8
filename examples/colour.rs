//! Prints the colour that a film reflects at a point. No GPU is needed.
//!
//!     cargo run --example colour -- 320 45

use soapfilm::{
    colour,
    physics::{
        colour::{FilmOptics, Illuminant, Walls},
        optics::FilmMaterial,
    },
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let thickness_nm: f64 = arguments.next().unwrap_or_else(|| "320".to_owned()).parse()?;
    let angle_deg: f64 = arguments.next().unwrap_or_else(|| "45".to_owned()).parse()?;
    let cos_theta = angle_deg.to_radians().cos();

    // One wall of soapy water in daylight.
    let film = colour(thickness_nm, cos_theta)?;
    println!("{thickness_nm} nm of soapy water at {angle_deg} degrees from the normal, in daylight:");
    println!("  XYZ {:.4}, linear BT.709 {:.4}, sRGB at +3.5 stops {:?}", film.xyz, film.bt709(), film.srgb(3.5));

    // Other liquids, lights and walls: glycerol in a warm white LED lamp, front wall and back wall.
    let glycerol = FilmMaterial { index: "glycerol 30%".parse()?, skin_nm: 0.0 };
    let lamp: Illuminant = "LED-B1".parse()?;
    let walls = Walls::Two { front_nm: thickness_nm, back_nm: thickness_nm, exit_nm: thickness_nm };
    let xyz = FilmOptics::resolving(glycerol, &lamp, thickness_nm).xyz(cos_theta, walls);
    println!("both walls of a bubble with 30 % of glycerol, in the light of a warm white LED:\n  XYZ {xyz:.4}");
    Ok(())
}
