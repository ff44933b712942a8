//! What is in front: the nearest wall of film that each pixel shows, and how much of the pixel it covers.

use std::ops::Range;

use glam::{DMat3, DVec2, DVec3};

use crate::parallel;

use super::{
    PictureCamera,
    walls::{Line, Surface},
};

/// A bubble, as far as it matters what is in front.
pub struct FrontBubble<'a> {
    /// Its number.
    pub id: u32,
    /// Center in metres.
    pub center_m: DVec3,
    /// Radius in metres.
    pub radius_m: f64,
    /// Takes directions from the center to places on the wall, over the radius: symmetric; the identity for a sphere.
    pub stretch: DMat3,
    /// Bounding rectangle in clip coordinates, lower left and upper right.
    pub bounds: [DVec2; 2],
    /// Film thickness in nm in the direction of a unit vector from the center; 0 where there is no film.
    pub thickness_nm: Box<dyn Fn(DVec3) -> f64 + Send + Sync + 'a>,
}

/// Bubbles before a camera.
pub struct FrontScene<'a> {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Where the picture is taken from.
    pub camera: PictureCamera,
    /// The bubbles, in any order.
    pub bubbles: Vec<FrontBubble<'a>>,
    /// Height in metres of the bath that they stand on: nothing below it is in front.
    pub bath_m: Option<f64>,
}

/// The nearest wall on a ray that has film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrontWall {
    /// The bubble's place in [`FrontScene::bubbles`].
    pub bubble: usize,
    /// Where on the bubble: a unit vector from its center, where the bubble is round.
    pub place: DVec3,
    /// Where in the world, in metres.
    pub position_m: DVec3,
    /// Unit vector across the wall, away from the bubble's center.
    pub normal: DVec3,
    /// Cosine of the angle of incidence.
    pub cos_theta: f64,
    /// Distance from the eye along the line of sight, in metres: that of the plane across it, not of the point.
    pub depth_m: f64,
    /// Thickness of the film there, in nm.
    pub thickness_nm: f64,
}

/// What a pixel shows in front.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FrontPixel {
    /// The wall in the pixel's middle; where the bubble that covers most of the pixel does not reach there, its nearest wall to it.
    pub wall: Option<FrontWall>,
    /// The parts of the pixel in which each bubble is in front, the largest first.
    pub shares: Vec<(usize, f64)>,
}

/// Samples along each side of a pixel that an outline crosses.
const OUTLINE_SAMPLES: u32 = 8;
/// Bubbles of fewer pixels across could lie between the samples that tell whether an outline crosses a pixel.
const SMALL_PIXELS: f64 = 4.0;

/// A bubble and the pixels that may show it.
struct Reach {
    bubble: usize,
    columns: Range<f64>,
    rows: Range<f64>,
}

impl FrontScene<'_> {
    /// What each pixel shows, row by row from the top left.
    #[must_use]
    pub fn pixels(&self) -> Vec<FrontPixel> {
        let eye_m = self.camera.eye_m;
        let surface = |bubble: &FrontBubble| Surface::new(bubble.center_m - eye_m, bubble.radius_m, bubble.stretch);
        let surfaces: Vec<Surface> = self.bubbles.iter().map(surface).collect();
        let reaches: Vec<Reach> = (0..self.bubbles.len()).map(|bubble| self.reach(bubble)).collect();
        let touches =
            |range: &Range<f64>, pixel: u32| range.start < f64::from(pixel) + 1.0 && f64::from(pixel) < range.end;
        let row = |y: u32| {
            let near: Vec<&Reach> = reaches.iter().filter(|reach| touches(&reach.rows, y)).collect();
            let pixel = |x: u32| {
                let near: Vec<&Reach> = near.iter().copied().filter(|reach| touches(&reach.columns, x)).collect();
                self.pixel(&surfaces, &near, DVec2::new(f64::from(x), f64::from(y)))
            };
            (0..self.size[0]).map(pixel).collect::<Vec<_>>()
        };
        parallel::map(self.size[1] as usize, |y| row(y as u32)).into_iter().flatten().collect()
    }

    fn reach(&self, bubble: usize) -> Reach {
        let [low, high] = self.bubbles[bubble].bounds;
        let [width, height] = self.size.map(f64::from);
        let pixel = |clip: f64, length: f64| 0.5 * (clip + 1.0) * length;
        // Clip coordinates point up.
        Reach {
            bubble,
            columns: pixel(low.x, width)..pixel(high.x, width),
            rows: pixel(-high.y, height)..pixel(-low.y, height),
        }
    }

    fn pixel(&self, surfaces: &[Surface], near: &[&Reach], corner: DVec2) -> FrontPixel {
        if near.is_empty() {
            return FrontPixel::default();
        }
        let front = |offset: DVec2| self.front(surfaces, near, corner + offset);
        let middle = front(DVec2::splat(0.5));
        let bubble = |wall: Option<FrontWall>| wall.map(|wall| wall.bubble);
        let is_small = |reach: &&Reach| reach.columns.end - reach.columns.start < SMALL_PIXELS;
        let edges = [0.0, 0.5, 1.0];
        let mut around = edges.iter().flat_map(|y| edges.map(|x| DVec2::new(x, *y)));
        if !near.iter().any(is_small) && around.all(|offset| bubble(front(offset)) == bubble(middle)) {
            return FrontPixel {
                wall: middle,
                shares: bubble(middle).map(|bubble| (bubble, 1.0)).into_iter().collect(),
            };
        }
        crossed(front)
    }

    /// The nearest wall with film on the ray through a position in the picture.
    fn front(&self, surfaces: &[Surface], near: &[&Reach], position: DVec2) -> Option<FrontWall> {
        let direction = self.camera.ray(self.size, position);
        let line = Line { origin_m: DVec3::ZERO, direction, from: None };
        let mut walls = Vec::new();
        near.iter().for_each(|reach| surfaces[reach.bubble].add_walls(reach.bubble, &line, &mut walls));
        walls.sort_unstable_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
        walls.into_iter().find_map(|wall| {
            let position_m = self.camera.eye_m + surfaces[wall.bubble].point_m(wall.place);
            let thickness_nm = (self.bubbles[wall.bubble].thickness_nm)(wall.place);
            let is_above = self.bath_m.is_none_or(|height_m| position_m.z >= height_m);
            (is_above && thickness_nm > 0.0).then_some(FrontWall {
                bubble: wall.bubble,
                place: wall.place,
                position_m,
                normal: wall.normal,
                cos_theta: wall.cos_theta,
                depth_m: wall.distance_m * direction.dot(self.camera.forward),
                thickness_nm,
            })
        })
    }
}

/// A pixel that an outline crosses, from what is in front at each offset from its corner.
fn crossed(front: impl Fn(DVec2) -> Option<FrontWall>) -> FrontPixel {
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(OUTLINE_SAMPLES);
    let offsets =
        (0..OUTLINE_SAMPLES.pow(2)).map(|k| DVec2::new(place(k % OUTLINE_SAMPLES), place(k / OUTLINE_SAMPLES)));
    let walls: Vec<(FrontWall, f64)> =
        offsets.filter_map(|offset| Some((front(offset)?, offset.distance_squared(DVec2::splat(0.5))))).collect();
    let mut shares: Vec<(usize, f64)> = Vec::new();
    for (wall, _) in &walls {
        match shares.iter_mut().find(|(bubble, _)| *bubble == wall.bubble) {
            Some((_, share)) => *share += 1.0,
            None => shares.push((wall.bubble, 1.0)),
        }
    }
    shares.iter_mut().for_each(|(_, share)| *share /= f64::from(OUTLINE_SAMPLES.pow(2)));
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    let of_first = |(wall, _): &&(FrontWall, f64)| shares.first().is_some_and(|(bubble, _)| *bubble == wall.bubble);
    let nearest = walls.iter().filter(of_first).min_by(|a, b| a.1.total_cmp(&b.1));
    FrontPixel { wall: nearest.map(|(wall, _)| *wall), shares }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bubble<'a>(id: u32, center_m: DVec3, radius_m: f64) -> FrontBubble<'a> {
        FrontBubble {
            id,
            center_m,
            radius_m,
            stretch: DMat3::IDENTITY,
            bounds: [DVec2::NEG_ONE, DVec2::ONE],
            thickness_nm: Box::new(|place| if place.z > 0.95 { 0.0 } else { 300.0 }),
        }
    }

    /// Two bubbles of radius 1 on the axis, 4 and 8 m away, and one beside that covers a quarter of a pixel.
    fn scene<'a>() -> FrontScene<'a> {
        let camera = PictureCamera {
            eye_m: 10.0 * DVec3::X,
            forward: DVec3::NEG_X,
            right: DVec3::Y,
            up: DVec3::Z,
            pixel_height_m: 0.02,
        };
        let beside = bubble(3, DVec3::new(0.0, 3.1, 0.1), 0.05);
        let bubbles = vec![bubble(1, 6.0 * DVec3::X, 1.0), bubble(2, 2.0 * DVec3::X, 1.0), beside];
        FrontScene { size: [64, 64], camera, bubbles, bath_m: None }
    }

    #[test]
    fn the_nearest_film_is_in_front() {
        let pixels = scene().pixels();
        let wall = pixels[32 * 64 + 32].wall.unwrap();
        assert_eq!((wall.bubble, wall.thickness_nm), (0, 300.0));
        // The pixel's middle is half a pixel beside the axis along both sides: 4 m away that is 0.057 of the radius.
        assert!((wall.depth_m - 3.0).abs() < 2e-3 && (wall.cos_theta - 1.0).abs() < 2e-3);
        assert!(wall.normal.abs_diff_eq(DVec3::X, 0.05) && wall.position_m.abs_diff_eq(7.0 * DVec3::X, 0.05));
        // Through the hole at the top the far bubble's wall, or the near one's back, is seen; the corner sees nothing.
        assert_eq!(pixels[0], FrontPixel::default());
    }

    #[test]
    fn shares_are_the_areas() {
        let pixels = scene().pixels();
        let area = |bubble: usize| {
            pixels
                .iter()
                .flat_map(|pixel| &pixel.shares)
                .filter(|share| share.0 == bubble)
                .map(|share| share.1)
                .sum::<f64>()
        };
        // The outline of the near one has the angle asin(1 / 4), and pixels are 0.02 on the plane one metre before the eye; its hole takes a little.
        let radius = (0.25_f64.asin()).tan() / 0.02;
        let disc = std::f64::consts::PI * radius * radius;
        assert!((area(0) + area(1) - disc).abs() < 0.02 * disc, "{} {} of {disc}", area(0), area(1));
        let small = std::f64::consts::PI * (0.05_f64 / 10.0 / 0.02).powi(2);
        assert!((area(2) - small).abs() < 0.2 * small, "{} of {small}", area(2));
        let is_edge = |pixel: &FrontPixel| pixel.shares.iter().any(|share| share.1 < 1.0);
        assert!(pixels.iter().filter(|pixel| is_edge(pixel)).all(|pixel| pixel.wall.is_some()));
    }
}
