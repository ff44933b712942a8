//! Maps of a film's thickness: pictures whose pixels are places on the film.

use std::path::Path;

use glam::{DVec2, DVec3};

use crate::{
    output::{ExrChannels, Metadata, OutputError},
    physics::environment::CubeFace,
};

/// How a map lays out the sphere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Projection {
    /// Twice as wide as high: azimuth to the right, from -180 to 180 degrees, height upwards
    Equirect,
    /// Six squares one below the other: the faces +x, -x, +y, -y, +z, -z as graphics APIs sample cube maps
    Cube,
}

/// A map that is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    pub projection: Projection,
    /// Pixels along the height of an equirectangular map, or along the edge of a cube's face.
    pub height: u32,
}

impl Map {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        match self.projection {
            Projection::Equirect => [2 * self.height, self.height],
            Projection::Cube => [self.height, 6 * self.height],
        }
    }

    /// The direction of each pixel, a unit vector in the film's axes, row by row from the top left.
    pub fn directions(&self) -> Vec<DVec3> {
        let [width, height] = self.size();
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        match self.projection {
            Projection::Equirect => {
                pixels.map(|[x, y]| equirect(DVec2::new(part(x, width), part(y, height)))).collect()
            }
            Projection::Cube => pixels.map(|[x, y]| cube(self.height, x, y)).collect(),
        }
    }

    /// What is written beside it.
    pub fn described(&self, metadata: Metadata) -> Metadata {
        let layout = match self.projection {
            Projection::Equirect => {
                "equirectangular: column x of W is the azimuth (x + 0.5 - W / 2) 360 / W degrees, from +x towards +y; row y of H from the top is the \
                 elevation (H / 2 - y - 0.5) 180 / H degrees; +z is up"
            }
            Projection::Cube => {
                "cube: faces +x, -x, +y, -y, +z, -z from the top, each as Vulkan, WebGPU and OpenGL sample it; +z is up"
            }
        };
        metadata.with("Values", "total thickness of the film in nm; 0 where there is none").with("Layout", layout)
    }
}

/// A map with the thickness of the film at each of its pixels.
pub struct FilmMap {
    map: Map,
    /// Thickness in nm, row by row from the top left.
    pub thickness_nm: Vec<f32>,
}

impl FilmMap {
    /// A map of the thickness in nm at each of its directions.
    pub fn new(map: Map, thickness_nm: Vec<f64>) -> Self {
        Self { map, thickness_nm: thickness_nm.into_iter().map(|nm| nm as f32).collect() }
    }

    /// Writes an EXR file, whole or not at all.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn save(&self, path: &Path, metadata: &Metadata) -> Result<(), OutputError> {
        // Y is what viewers show of a picture without colours.
        let channels = ["thickness_nm", "Y"].map(|name| (name.to_owned(), self.thickness_nm.clone()));
        let metadata = self.map.described(metadata.clone());
        ExrChannels { size: self.map.size(), channels: &channels, metadata: &metadata }.save(path)
    }
}

fn part(pixel: u32, count: u32) -> f64 {
    (f64::from(pixel) + 0.5) / f64::from(count)
}

/// The direction at a place of an equirectangular map, each 0 to 1 from the top left. It is a map like the Earth's, seen from outside; environments
/// are seen from inside.
pub fn equirect(place: DVec2) -> DVec3 {
    let (sin_azimuth, cos_azimuth) = ((place.x - 0.5) * std::f64::consts::TAU).sin_cos();
    let (sin_elevation, cos_elevation) = ((0.5 - place.y) * std::f64::consts::PI).sin_cos();
    DVec3::new(cos_elevation * cos_azimuth, cos_elevation * sin_azimuth, sin_elevation)
}

fn cube(edge: u32, x: u32, y: u32) -> DVec3 {
    let st = DVec2::new(part(x, edge), part(y % edge, edge));
    CubeFace::ALL[(y / edge) as usize].direction(2.0 * st - 1.0).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_look_where_they_say() {
        let map = Map { projection: Projection::Equirect, height: 180 };
        let directions = map.directions();
        assert_eq!((map.size(), directions.len()), ([360, 180], 64800));
        // Column 269 is the azimuth 89.5 degrees, row 89 the elevation 0.5 degrees.
        let expected = DVec3::new(0.5_f64.to_radians().sin(), 1.0, 0.5_f64.to_radians().sin());
        assert!(directions[89 * 360 + 269].abs_diff_eq(expected, 1e-3));
        assert!(directions[0].z > 0.99);
        let cube = Map { projection: Projection::Cube, height: 3 };
        let directions = cube.directions();
        let middles = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z];
        for (face, middle) in middles.into_iter().enumerate() {
            assert!(directions[face * 9 + 4].abs_diff_eq(middle, 1e-12), "{face}");
        }
    }
}
