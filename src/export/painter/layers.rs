//! `--layers`: what a picture is made of, as channels of one EXR file.
//!
//! In every channel of colour, beauty = transmission × background + reflection.

use anyhow::Context;
use glam::{DVec3, Vec3};

use super::{
    Exposure, Painter,
    finished::{alpha, colour_channels, in_bt709, vector_channels},
    parts::PICTURES_OF_PASSAGES,
};
use crate::{
    export::Progress,
    gpu::Renderer,
    output::Picture,
    parallel,
    physics::{
        colour::bt2020_to_bt709,
        picture::{FrontBubble, FrontPixel, FrontScene, FrontWall},
    },
    plan::{BubbleKey, CameraKey, DrawKey, FilmKey, FrameRequest},
    verify::reference::{MovedFilms, camera, film_thickness, moved_film},
};

/// Pictures that [`Painter::layers`] draws.
pub(super) const PICTURES_OF_LAYERS: u64 = PICTURES_OF_PASSAGES + 2;

/// Depth where there is no bubble, as Blender writes it.
const NO_DEPTH: f32 = 1e10;

type Channels = Vec<(String, Vec<f32>)>;

impl Painter {
    /// The layers of a picture.
    pub(super) fn layers(&mut self, shot: &Exposure, progress: &Progress) -> anyhow::Result<Picture> {
        let request = &shot.request;
        let size = self.options.size;
        let mut channels = self.colours(shot, progress)?;
        let draw = self.at_pixels(&request.picture.draw);
        let films = self.films_in_sight(request, &draw)?;
        channels.extend(data(&draw, &films)?);
        Ok(Picture::Channels { size, channels })
    }

    /// Beauty and what it is made of. What stands behind is left out of all of them with `--alpha`.
    fn colours(&mut self, shot: &Exposure, progress: &Progress) -> anyhow::Result<Channels> {
        let light = self.passages(shot, progress)?;
        let to_bt709 = bt2020_to_bt709();
        let transmission = parallel::map(light.len(), |k| light[k].transmittance(&to_bt709).as_vec3());
        let arrays = |colours: &[Vec3]| colours.iter().map(Vec3::to_array).collect::<Vec<_>>();
        let mut channels = colour_channels("transmission.", &arrays(&transmission));
        if self.options.alpha {
            let added = in_bt709(&light.iter().map(|light| light.added).collect::<Vec<_>>());
            channels.extend(colour_channels("reflection.", &added));
            channels.extend(colour_channels("", &added));
            channels.push(("A".to_owned(), alpha(&light)));
            return Ok(channels);
        }
        drop(light);
        let background = in_bt709(&self.exposed(shot, &DrawKey::without_bubbles, progress)?);
        let beauty = in_bt709(&self.exposed(shot, &DrawKey::clone, progress)?);
        let parts = beauty.iter().zip(&background).zip(&transmission);
        let reflection: Vec<[f32; 3]> = parts
            .map(|((beauty, background), left)| (Vec3::from(*beauty) - *left * Vec3::from(*background)).to_array())
            .collect();
        channels.extend(colour_channels("reflection.", &reflection));
        channels.extend(colour_channels("background.", &background));
        channels.extend(colour_channels("", &beauty));
        channels.push(("A".to_owned(), vec![1.0; beauty.len()]));
        Ok(channels)
    }

    /// A linear picture with one sample per pixel.
    fn at_pixels(&self, draw: &DrawKey) -> DrawKey {
        let samples = f64::from(draw.size[0]) / f64::from(self.options.size[0]);
        let camera = CameraKey { pixel_height_m: draw.camera.pixel_height_m * samples, ..draw.camera };
        DrawKey { size: self.options.size, camera, ..draw.clone() }
    }

    /// The thickness of all films in sight at their moment.
    fn films_in_sight(&mut self, request: &FrameRequest, draw: &DrawKey) -> anyhow::Result<MovedFilms> {
        if self.options.is_reference() {
            return self.moved_films(request);
        }
        let renderer: &Renderer = self.renderer()?;
        let mut films = MovedFilms::new();
        for (index, film) in draw.films() {
            if matches!(film, FilmKey::Field(_)) && !films.contains_key(&index) {
                let (_, field) = moved_film(renderer, index)?.context("the film was not moved")?;
                films.insert(index, field);
            }
        }
        Ok(films)
    }
}

/// What each pixel shows in front: numbers of the nearest wall of film, not antialiased.
fn data(draw: &DrawKey, films: &MovedFilms) -> anyhow::Result<Channels> {
    let bubbles = draw.all_bubbles();
    let front = |bubble: &BubbleKey| {
        Ok(FrontBubble {
            id: bubble.id,
            center_m: bubble.center_m,
            radius_m: bubble.radius_m,
            stretch: bubble.stretch,
            bounds: bubble.bounds,
            thickness_nm: film_thickness(bubble, draw.on_bath, films)?,
        })
    };
    let scene = FrontScene {
        size: draw.size,
        camera: camera(&draw.camera),
        bubbles: bubbles.iter().map(front).collect::<anyhow::Result<_>>()?,
        bath_m: bubbles.first().filter(|_| draw.on_bath).map(|bubble| bubble.center_m.z),
    };
    let pixels = scene.pixels();
    let number = |name: &str, none: f32, value: &(dyn Fn(&FrontWall) -> f64 + Sync)| {
        let value = |pixel: &FrontPixel| pixel.wall.as_ref().map_or(none, |wall| value(wall) as f32);
        (name.to_owned(), pixels.iter().map(value).collect::<Vec<f32>>())
    };
    let vector = |value: &dyn Fn(&FrontWall) -> DVec3| -> Vec<[f32; 3]> {
        let value = |pixel: &FrontPixel| pixel.wall.as_ref().map_or([0.0; 3], |wall| value(wall).as_vec3().to_array());
        pixels.iter().map(value).collect()
    };
    let uv = |wall: &FrontWall| film_uv(bubbles[wall.bubble].to_film * wall.place);
    let mut channels = vec![
        number("thickness_nm", 0.0, &|wall| wall.thickness_nm),
        number("cos_theta", 0.0, &|wall| wall.cos_theta),
        number("depth", NO_DEPTH, &|wall| wall.depth_m),
        number("Z", NO_DEPTH, &|wall| wall.depth_m),
        number("uv.U", 0.0, &|wall| uv(wall)[0]),
        number("uv.V", 0.0, &|wall| uv(wall)[1]),
        number("id.X", 0.0, &|wall| f64::from(scene.bubbles[wall.bubble].id)),
    ];
    let coverage = |pixel: &FrontPixel| pixel.shares.first().map_or(0.0, |share| share.1 as f32);
    channels.push(("id.A".to_owned(), pixels.iter().map(coverage).collect()));
    channels.extend(vector_channels("normal.", ["X", "Y", "Z"], &vector(&|wall| wall.normal)));
    channels.extend(vector_channels("position.", ["X", "Y", "Z"], &vector(&|wall| wall.position_m)));
    Ok(channels)
}

/// Where a direction of a film is on its map, each 0 to 1: U grows with the azimuth, which is 0 in the middle, and V with the height.
fn film_uv(direction: DVec3) -> [f64; 2] {
    let azimuth = direction.y.atan2(direction.x);
    [0.5 + azimuth / std::f64::consts::TAU, 0.5 + direction.z.clamp(-1.0, 1.0).asin() / std::f64::consts::PI]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn films_are_mapped_as_the_earth_is() {
        let at = |x, y, z| film_uv(DVec3::new(x, y, z));
        assert_eq!(at(1.0, 0.0, 0.0), [0.5, 0.5]);
        assert_eq!(at(0.0, 1.0, 0.0), [0.75, 0.5]);
        assert_eq!(at(0.0, 0.0, 1.0)[1], 1.0);
        assert_eq!(at(0.0, 0.0, -1.0)[1], 0.0);
    }
}
