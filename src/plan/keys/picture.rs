//! Keys of pictures: what is in sight, in which light, and how it is shown.

use std::sync::Arc;

use glam::{DMat3, DVec3};

use super::{
    BubbleKey, CameraKey, DefocusKey, EnvironmentKey, FilmKey, LentFilm, PlateKey, QuadratureKey, SmallBubble, TableKey,
};
use crate::{
    parallel,
    physics::{
        colour::{Display, Gamut},
        environment::CubeTiles,
        picture::Finish,
    },
};

/// What stands straight behind the bubbles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BackdropKey {
    /// The environment.
    Environment,
    /// A radiance, linear BT.2020.
    Colour(DVec3),
}

/// How the environment lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightKey {
    /// Factor on the environment's radiance, linear BT.2020.
    pub gain: DVec3,
    /// Matrix from the environment's light to its colour under the illuminant: linear BT.2020, where (1, 1, 1) is daylight's white.
    pub seen: DMat3,
    /// Factor that makes daylight's white (1, 1, 1).
    pub scale: DVec3,
    /// Direction in the world along which the electric field passes a polariser before the camera, if there is one.
    pub polariser: Option<DVec3>,
    /// Turn of the environment about the vertical, anticlockwise from above, in radians.
    pub rotation_rad: f64,
    /// The backdrop.
    pub backdrop: BackdropKey,
    /// Half angle of the cone that each point of the backdrop is spread over, out of the lens's focus, in radians; 0: it is sharp.
    pub defocus_rad: f64,
    /// Half angle of the cone that all of the backdrop but its lamps is spread over, in radians: `defocus_rad`, or more where the picture would show the
    /// environment's texels.
    pub blur_rad: f64,
}

/// How bubbles are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rendering {
    /// As accurately as the scene's quality asks for.
    #[default]
    Full,
    /// With the shaders of the middle alone, without what is special near the limb: what a window shows while the other shaders are compiled.
    Preview,
    /// Each is a sphere with one lookup of the environment: the yardstick of a frame's cost.
    Yardstick,
}

/// The linear picture.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawKey {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Whether radiance is kept as f32, for measurements, or as f16, for looking at.
    pub full_precision: bool,
    /// Stops by which the linear picture is exposed already, so that half floats hold what will be seen; see [`exposed_ev`].
    pub exposed_ev: i32,
    /// How the bubbles are drawn.
    pub rendering: Rendering,
    /// The camera.
    pub camera: CameraKey,
    /// The scene's own light.
    pub lighting: Lighting,
    /// Lights of other illuminants. Light adds up: the picture is the sum of the pictures in each light alone.
    pub spectral_lights: Vec<Lighting>,
    /// The bubbles that can be seen, farthest first.
    pub bubbles: Vec<BubbleKey>,
    /// Small bubbles that can be seen, farthest first; shared, for keys are copied and there may be thousands.
    pub small: Arc<[SmallBubble]>,
    /// The films that small bubbles show.
    pub lent: Vec<LentFilm>,
    /// Whether they stand on a bath, which is a mirror of water at the height of their centers.
    pub on_bath: bool,
    /// The photograph behind the bubbles. All light then stands before black, and the photograph is laid behind it.
    pub plate: Option<PlateKey>,
}

/// Light of one illuminant, and what the films' optics in it need.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// How it lights.
    pub light: LightKey,
    /// Where it comes from.
    pub environment: EnvironmentKey,
    /// The colours of films of each material in it, at least of one.
    pub films: Vec<FilmColours>,
}

/// What the colours of films of one material in a light follow from.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmColours {
    /// The table, where the quality has one.
    pub table: Option<TableKey>,
    /// The quadrature.
    pub quadrature: QuadratureKey,
}

/// Stops in which pictures of half floats are exposed. Half floats have sixteen between black and white to spare, so that small changes of the
/// exposure leave the linear picture as it is.
const EXPOSED_STOPS: f64 = 8.0;

/// Stops by which a picture of half floats is exposed when it is drawn, for an exposure in stops.
#[must_use]
pub fn exposed_ev(exposure_ev: f64) -> i32 {
    (EXPOSED_STOPS * (exposure_ev / EXPOSED_STOPS).round()) as i32
}

impl DrawKey {
    /// What is seen of one of the lights behind the bubbles, where that is an environment out of focus or magnified.
    #[must_use]
    pub fn defocus(&self, Lighting { light, environment, .. }: &Lighting) -> Option<DefocusKey> {
        // Discs narrower than a texel leave the map as it is.
        let is_sharp = light.blur_rad * f64::from(environment.size()) < 1.0;
        if light.backdrop != BackdropKey::Environment || is_sharp {
            return None;
        }
        // Tiles are interpolated across their edges: by less than two pixels, or than the radius of a disc.
        let margin = 2.0 + self.disc_pixels(light.blur_rad);
        let turned = DMat3::from_rotation_z(-light.rotation_rad);
        let corners = self.camera.corners(self.size, margin).map(|corner| turned * corner);
        let seen = CubeTiles::within(&corners);
        let mirrored = || CubeTiles::within(&corners.map(|corner| corner.with_z(-corner.z)));
        let tiles = if self.on_bath { seen.union(mirrored()) } else { seen };
        Some(DefocusKey { environment: environment.clone(), half_angle_rad: light.blur_rad, tiles })
    }

    /// The radius of a disc out of focus in pixels, where the picture shows it largest: in its corners.
    fn disc_pixels(&self, blur_rad: f64) -> f64 {
        let farthest = self.camera.corners(self.size, 0.0).map(DVec3::length_squared).into_iter().fold(1.0, f64::max);
        blur_rad * farthest / self.camera.pixel_height_m
    }

    /// All lights, the scene's own first.
    pub fn lights(&self) -> impl Iterator<Item = &Lighting> {
        std::iter::once(&self.lighting).chain(&self.spectral_lights)
    }

    /// How many pictures are drawn and added: one for each light, and what bubbles leave of a plate.
    #[must_use]
    pub fn pictures(&self) -> u64 {
        self.lights().count() as u64 + u64::from(self.plate.is_some())
    }

    /// All bubbles in sight, the small ones too, each as it would be drawn alone.
    #[must_use]
    pub fn all_bubbles(&self) -> Vec<BubbleKey> {
        let small = self.small.iter().map(|small| small.whole(&self.lent[small.lent], &self.camera));
        self.bubbles.iter().cloned().chain(small).collect()
    }

    /// The films of all bubbles in sight, each with its index; one may be named more than once.
    pub fn films(&self) -> impl Iterator<Item = (usize, &FilmKey)> {
        let bubbles = self.bubbles.iter().map(|bubble| (bubble.index, &bubble.film));
        bubbles.chain(self.lent.iter().map(|lent| (lent.index, &lent.film)))
    }

    /// The films of all bubbles in sight, to be changed: see [`Self::films`].
    pub fn films_mut(&mut self) -> impl Iterator<Item = (usize, &mut FilmKey)> {
        let bubbles = self.bubbles.iter_mut().map(|bubble| (bubble.index, &mut bubble.film));
        bubbles.chain(self.lent.iter_mut().map(|lent| (lent.index, &mut lent.film)))
    }

    /// Whether a bubble in sight has a film of a material.
    #[must_use]
    pub fn shows(&self, material: usize) -> bool {
        self.bubbles.iter().any(|bubble| bubble.material == material)
            || self.lent.iter().any(|lent| lent.material == material)
    }

    /// Whether any light from the environment can reach the picture.
    #[must_use]
    pub fn needs_environment(&self) -> bool {
        !self.bubbles.is_empty() || !self.small.is_empty() || self.lighting.light.backdrop == BackdropKey::Environment
    }

    /// The first thing in which two pictures differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> &'static str {
        if self.size != other.size {
            "the picture's size"
        } else if self.exposed_ev != other.exposed_ev {
            "the exposure, by more than half floats have room for"
        } else if self.camera != other.camera {
            "the camera"
        } else if self.lighting != other.lighting {
            self.lighting.difference(&other.lighting)
        } else if self.spectral_lights != other.spectral_lights {
            "a light of another illuminant"
        } else if self.plate != other.plate {
            "the plate"
        } else if self.bubbles != other.bubbles || self.small != other.small || self.lent != other.lent {
            "a bubble or its film"
        } else {
            "the way of drawing"
        }
    }
}

impl Lighting {
    fn difference(&self, other: &Self) -> &'static str {
        if self.light != other.light || self.environment != other.environment {
            "the light"
        } else {
            "the colours of films"
        }
    }
}

/// The finished picture.
#[derive(Clone, Debug, PartialEq)]
pub struct TonemapKey {
    /// The linear picture.
    pub draw: DrawKey,
    /// Exposure in stops.
    pub exposure_ev: f64,
    /// What is done to the linear picture first.
    pub finish: Finish,
    /// From the linear picture to what the display is given, linear BT.2020: white balance.
    pub balance: DMat3,
    /// Colours that the display has.
    pub gamut: Gamut,
    /// Seed of the dither, if there is any.
    pub dither: Option<u32>,
}

impl TonemapKey {
    /// A preview of the picture, half as wide and half as high. It needs a few of the picture's shaders and no other ones, so that it comes much
    /// sooner where shaders are compiled first. There is none of small bubbles and before plates, whose shaders follow from the picture's size.
    #[must_use]
    pub fn preview(&self) -> Option<Self> {
        if !self.draw.small.is_empty() || self.draw.plate.is_some() {
            return None;
        }
        let mut preview = self.clone();
        let draw = &mut preview.draw;
        draw.rendering = Rendering::Preview;
        draw.size = draw.size.map(|pixels| pixels.div_ceil(2));
        let scale = f64::from(self.draw.size[1]) / f64::from(draw.size[1]);
        draw.camera.pixel_height_m *= scale;
        draw.camera.shift /= scale;
        Some(preview)
    }

    /// How a display shows the linear picture, without what a lens does to it.
    #[must_use]
    pub fn display(&self) -> Display {
        Display { exposure_ev: self.exposure_ev, balance: self.balance, gamut: self.gamut, dither: self.dither }
    }

    /// What a display shows of a linear picture of a size, BT.2020, row by row from the top left, with what a lens does to it: RGBA, 8 bits.
    #[must_use]
    pub fn shown(&self, size: [u32; 2], radiance: Vec<DVec3>) -> Vec<u8> {
        let (display, width) = (self.display(), size[0] as usize);
        let finished = self.finish.applied(size, self.exposure_ev.exp2(), radiance);
        let pixel = |k: usize| {
            let [r, g, b] = display.encode(finished[k], [(k % width) as u32, (k / width) as u32]);
            [r, g, b, u8::MAX]
        };
        parallel::map(finished.len(), pixel).into_flattened()
    }

    /// Factor that exposes the linear picture, which is exposed by whole stops already.
    #[must_use]
    pub fn exposure(&self) -> f64 {
        (self.exposure_ev - f64::from(self.draw.exposed_ev)).exp2()
    }

    /// The first thing in which two pictures differ.
    #[must_use]
    pub fn difference(&self, other: &Self) -> &'static str {
        if self.draw != other.draw {
            "the linear picture"
        } else if self.exposure_ev != other.exposure_ev {
            "the exposure"
        } else if self.finish != other.finish {
            "glare, vignetting or grain"
        } else if self.balance != other.balance || self.gamut != other.gamut {
            "the white balance or the gamut"
        } else {
            "the dither"
        }
    }
}
