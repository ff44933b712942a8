//! Bubbles of generators: which of them are in sight, and the films that they share.

use glam::{DMat3, DVec2};

use super::{
    BubbleKey, CameraKey, LentFilm, Shot, SmallBubble, Story,
    lender::Lender,
    sight::{bounds, is_magnified, thicknesses},
};
use crate::{
    physics::bubble::{Member, reach},
    scene::Quality,
};

/// What is in sight of the bubbles that generators make.
#[derive(Debug, Default)]
pub(super) struct InSight {
    /// Those that are drawn like all others.
    pub bubbles: Vec<BubbleKey>,
    /// Those that are drawn as small ones, the farthest first.
    pub small: Vec<SmallBubble>,
    /// The films that they show.
    pub lent: Vec<LentFilm>,
}

/// Radius in pixels below which a bubble is drawn as a small one, with all others like it at once: where only the outer and the first two
/// inner reflections can be told apart.
fn small_below_pixels(quality: Quality) -> f64 {
    match quality {
        Quality::Fast => 64.0,
        Quality::Standard => 40.0,
        Quality::Spectral => 16.0,
    }
}

/// Distance of the eye from a bubble's center, in radii, below which the bubble is drawn like all others, however few pixels the picture has.
const NEAR_RADII: f64 = 1.5;

/// Radius in pixels below which nothing of a bubble is seen: it covers a ten thousandth of a pixel.
const INVISIBLE_PIXELS: f64 = 0.006;

/// Finds the bubbles of all generators that a shot shows.
pub(super) fn in_sight(story: &Story, camera: &CameraKey, shot: &Shot) -> InSight {
    let mut sight = InSight::default();
    let time_s = shot.moment.ticks() * story.motion.tick_s;
    let mut next_id = story.bubbles.len() as u32 + 1;
    for lender in story.lenders() {
        let first_id = next_id;
        next_id += lender.swarm.count;
        // The place in the list of each of its films, once one is shown.
        let mut places: Vec<Option<usize>> = vec![None; lender.swarm.lending.films as usize];
        for member in lender.swarm.at(time_s) {
            let Some(seen) = Seen::of(lender, &member, camera, shot) else { continue };
            let film = member.film as usize;
            if places[film].is_none() {
                let Some(lent) = lent_film(story, lender, film, shot) else { continue };
                places[film] = Some(sight.lent.len());
                sight.lent.push(lent);
            }
            let Some(place) = places[film] else { continue };
            let id = first_id + member.slot;
            if seen.is_small(&member, camera, story.view.quality) {
                sight.small.push(SmallBubble { id, ..small(&member, place, seen.bounds) });
            } else {
                sight.bubbles.push(BubbleKey { id, ..large(&member, &sight.lent[place], &seen, camera) });
            }
        }
    }
    sight.small = farthest_first(&sight.small, camera);
    sight
}

/// In the order of the power of the eye with respect to each, which is found once for each.
fn farthest_first(small: &[SmallBubble], camera: &CameraKey) -> Vec<SmallBubble> {
    let power = |small: &SmallBubble| camera.power(small.center_m, small.radius_m);
    let mut order: Vec<(f64, usize)> = small.iter().map(power).zip(0..).collect();
    order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    order.into_iter().map(|(_, place)| small[place]).collect()
}

/// What a picture can see of a bubble.
struct Seen {
    stretch: DMat3,
    /// Bounding rectangle in clip coordinates.
    bounds: [DVec2; 2],
    radius_pixels: f64,
}

impl Seen {
    fn of(lender: &Lender, member: &Member, camera: &CameraKey, shot: &Shot) -> Option<Self> {
        let (center_m, radius_m) = (member.center_m, member.radius_m);
        let radius_pixels = radius_m / center_m.distance(camera.eye_m).max(radius_m) / camera.pixel_height_m;
        if radius_pixels < INVISIBLE_PIXELS {
            return None;
        }
        let stretch = lender.swarm.shape(member).stretch();
        let reach = if stretch == DMat3::IDENTITY { 1.0 } else { reach(stretch) };
        Some(Self { stretch, bounds: bounds(camera, shot.size, center_m, radius_m * reach)?, radius_pixels })
    }

    /// Whether it is drawn as a small bubble.
    fn is_small(&self, member: &Member, camera: &CameraKey, quality: Quality) -> bool {
        self.radius_pixels < small_below_pixels(quality)
            && member.center_m.distance(camera.eye_m) > NEAR_RADII * member.radius_m
    }
}

/// One of a generator's films at the moment of a shot.
fn lent_film(story: &Story, lender: &Lender, film: usize, shot: &Shot) -> Option<LentFilm> {
    let index = lender.first_owner + film;
    let age = story.age(index, shot.moment)?;
    let ticks = age.moment.ticks();
    Some(LentFilm {
        index,
        material: 0,
        film: story.film_of_age(index, &age),
        to_film: DMat3::from_quat(story.film_turn(age.life.born as f64 + ticks).inverse()),
        evaporated_nm: age.life.evaporation.nm(ticks),
        max_thickness_factor: 1.0 + lender.swarm.thickness_spread,
    })
}

fn small(member: &Member, lent: usize, bounds: [DVec2; 2]) -> SmallBubble {
    SmallBubble {
        id: 0,
        center_m: member.center_m,
        radius_m: member.radius_m,
        bounds,
        lent,
        turn_rad: member.turn_rad,
        thickness_factor: member.thickness,
    }
}

fn large(member: &Member, lent: &LentFilm, seen: &Seen, camera: &CameraKey) -> BubbleKey {
    let bubble = small(member, 0, seen.bounds).whole(lent, camera);
    let distance_m = member.center_m.distance(camera.eye_m);
    let is_sharp = camera.is_in_focus(member.center_m, member.radius_m);
    BubbleKey {
        stretch: seen.stretch,
        thicknesses: thicknesses(&bubble.film, seen.radius_pixels, is_sharp),
        magnified: is_sharp && is_magnified(&bubble.film, member.radius_m, seen.radius_pixels, distance_m),
        ..bubble
    }
}
