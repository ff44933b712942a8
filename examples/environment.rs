//! Lights a bubble by an environment that a closure computes: a blue sky with a sun over a dark floor.
//!
//!     cargo run --example environment -- sky.png

use std::path::PathBuf;

use soapfilm::{CubeMap, Error, Studio, glam::DVec3, load_scene};

/// Radiance from a direction, linear BT.2020. The direction need not be of length 1; +z is up.
fn sky(direction: DVec3) -> DVec3 {
    let direction = direction.normalize();
    let sun = DVec3::new(0.4, -0.7, 0.6).normalize();
    if direction.dot(sun) > 3_f64.to_radians().cos() {
        return DVec3::new(300.0, 280.0, 240.0);
    }
    if direction.z < 0.0 {
        return DVec3::splat(0.05);
    }
    DVec3::new(0.8, 0.9, 1.0).lerp(DVec3::new(0.15, 0.3, 0.9), direction.z)
}

fn main() -> Result<(), Error> {
    let file = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("sky.png"), PathBuf::from);
    // Six faces of 256 by 256 texels, each the mean of 2 by 2 samples.
    let scene = load_scene("default")?.with_environment(CubeMap::from_fn(256, 2, sky))?;
    Studio::open()?.render(&scene, [320, 180], 0.5)?.save(&file)?;
    println!("wrote {}, a bubble under a sky of three colours", file.display());
    Ok(())
}
