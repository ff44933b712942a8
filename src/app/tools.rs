//! Tools: what the pointer does to a film becomes events of the scene's history, so that a saved scene replays it.

use glam::{DQuat, DVec2, DVec3};

use super::sight;
use crate::{
    plan::Story,
    scene::{Blow, Boundary, Bubble, Change, Drag, Prick, Scene, Stir},
};

/// What the pointer is used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// It moves the camera.
    #[default]
    Orbit,
    /// It moves the film.
    Stir,
    /// It blows at the film.
    Blow,
    /// It takes the bubble along.
    Drag,
    /// It bursts the bubble.
    Prick,
    /// It measures the film; a drag moves the camera.
    Probe,
    /// It draws a line along which the film is measured.
    Profile,
    /// It moves lamps by their highlights.
    Lamp,
    /// It blows new bubbles.
    Wand,
}

impl Tool {
    /// Whether it acts on films.
    #[must_use]
    pub fn acts(self) -> bool {
        !matches!(self, Self::Orbit | Self::Probe | Self::Profile | Self::Lamp | Self::Wand)
    }
}

impl Tool {
    /// All tools, each with its name and what it does, in the order of the keys 1 to 9.
    pub const ALL: [(Self, &str, &str); 9] = [
        (Self::Orbit, "Orbit", "Drag to turn around the bubble (1)"),
        (Self::Stir, "Stir", "Drag over a film to stir it (2)"),
        (
            Self::Blow,
            "Blow",
            "Hold to blow along the line of sight; near the outline, where the jet is oblique, it moves the film most (3)",
        ),
        (Self::Drag, "Move", "Drag a bubble: its film stays behind (4)"),
        (Self::Prick, "Prick", "Click to burst a bubble there (5)"),
        (Self::Probe, "Probe", "Point at a film to measure it; click to keep the numbers and see plots (6)"),
        (Self::Profile, "Profile", "Draw a line over a film to plot thickness against height along it (7)"),
        (Self::Lamp, "Lamp", "Drag a lamp by its highlight on a bubble, or by itself (8)"),
        (Self::Wand, "Wand", "Press where a new bubble shall be, and drag until it is large enough (9)"),
    ];
}

/// Shortest time between two events of a stir or a jet, s.
const STROKE_S: f64 = 0.1;
/// Shortest time between two events of a drag, s: the bubble must keep up with the pointer.
const PULL_S: f64 = 0.05;
/// Longest duration of a stroke, s: film time that passes while nothing is drawn belongs to none.
const LONGEST_STROKE_S: f64 = 0.5;
/// Size of a stir and of a jet, degrees.
const STIR_DEG: f64 = 10.0;
const JET_DEG: f64 = 15.0;
/// Speed of a jet, m/s: a person's breath through pursed lips, an arm's length away.
const JET_M_S: f64 = 3.0;

/// A pressed pointer: places in the picture, right and up from its middle in heights of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Press {
    /// Where it was pressed, which may be some way back when frames are slow.
    pub from: DVec2,
    /// Where it is now.
    pub at: DVec2,
}

/// The pointer over the picture, between presses and during one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hand {
    /// Nothing is pressed.
    #[default]
    Free,
    /// It is pressed and moves the camera.
    Camera,
    /// It holds a bubble's film.
    Film(Grip),
}

/// A pressed pointer on a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    tool: Tool,
    bubble: usize,
    /// The tick of the last event, or of the press.
    tick: u64,
    /// Where the pointer was then, as a direction in the film.
    at: DVec3,
    /// From the pointer's place on the film to the bubble's center, m.
    to_center_m: DVec3,
    /// How far the place where the pointer took hold is along the line of sight, m.
    depth_m: f64,
    /// Where the pointer is now in the picture.
    place: DVec2,
}

/// A line of sight, and the film that it meets first.
struct Aim {
    bubble: usize,
    /// The line's direction in the world.
    ray: DVec3,
    /// Where it meets the film, m.
    place_m: DVec3,
    /// The bubble's center, m.
    center_m: DVec3,
    /// From the world's directions to the film's.
    to_film: DQuat,
}

impl Aim {
    /// The place as a direction in the film.
    fn at(&self) -> DVec3 {
        self.to_film * (self.place_m - self.center_m).normalize()
    }
}

/// Lets the pointer, pressed or not, use a tool at a tick; returns what that does to a film.
pub fn touch(hand: &mut Hand, tool: Tool, story: &Story, tick: u64, pressed: Option<Press>) -> Option<Change> {
    match (&mut *hand, pressed) {
        (Hand::Free, Some(press)) => {
            let aim = tool.acts().then(|| aim(story, tick, press.from)).flatten();
            let prick = aim.as_ref().filter(|_| tool == Tool::Prick).map(prick);
            *hand = aim.map_or(Hand::Camera, |aim| Hand::Film(Grip::new(tool, story, tick, &aim, press.at)));
            prick
        }
        (Hand::Film(grip), Some(press)) => {
            grip.place = press.at;
            grip.act(story, tick, false)
        }
        (Hand::Film(grip), None) => {
            let last = grip.act(story, tick, true);
            *hand = Hand::Free;
            last
        }
        (_, None) => {
            *hand = Hand::Free;
            None
        }
        (Hand::Camera, Some(_)) => None,
    }
}

impl Grip {
    fn new(tool: Tool, scene: &Scene, tick: u64, aim: &Aim, place: DVec2) -> Self {
        Self {
            tool,
            bubble: aim.bubble,
            tick,
            at: aim.at(),
            to_center_m: aim.center_m - aim.place_m,
            depth_m: (aim.place_m - scene.camera.eye()).length(),
            place,
        }
    }

    /// The event of the tool for the pointer's path since the last event, if it is due; the last event when the button is released.
    fn act(&mut self, story: &Story, tick: u64, lets_go: bool) -> Option<Change> {
        let tick_s = story.motion.tick_s;
        let shortest_s = match self.tool {
            _ if lets_go => 0.0,
            Tool::Drag => PULL_S,
            _ => STROKE_S,
        };
        // Back in time nothing has been done yet.
        let since = self.tick.min(tick);
        self.tick = since;
        let elapsed_s = (tick - since) as f64 * tick_s;
        if elapsed_s < shortest_s {
            return None;
        }
        self.tick = tick;
        if self.tool == Tool::Drag {
            let held_m = story.camera.eye() + self.depth_m * sight::ray(&story.camera, self.place);
            return Some(drag(story, self.bubble, held_m + self.to_center_m));
        }
        let aim = aim(story, tick, self.place).filter(|aim| aim.bubble == self.bubble && tick > since)?;
        let before = std::mem::replace(&mut self.at, aim.at());
        let radius_m = story.bubbles.get(self.bubble)?.radius_mm * 1e-3;
        let ticks = (elapsed_s.min(LONGEST_STROKE_S) / tick_s).round().max(1.0) as u64;
        match self.tool {
            Tool::Stir => stroke(self.bubble, before, self.at, radius_m / (ticks as f64 * tick_s), ticks),
            Tool::Blow => Some(jet(&aim, ticks)),
            Tool::Orbit | Tool::Drag | Tool::Prick | Tool::Probe | Tool::Profile | Tool::Lamp | Tool::Wand => None,
        }
    }
}

/// A stir from one place to another, where an angle is a speed in m/s; `None` for a pointer at rest.
fn stroke(bubble: usize, before: DVec3, now: DVec3, speed: f64, ticks: u64) -> Option<Change> {
    let middle = (before + now).try_normalize()?;
    let velocity = speed * (now - before);
    let velocity = velocity - velocity.dot(middle) * middle;
    (velocity.length() > 1e-3).then(|| {
        let velocity_m_s = rounded(velocity.clamp_length_max(10.0));
        Change::Stir(Stir { bubble, at: rounded(middle), velocity_m_s, radius_deg: STIR_DEG, ticks })
    })
}

fn jet(aim: &Aim, ticks: u64) -> Change {
    let toward = rounded(aim.to_film * aim.ray);
    let (bubble, at) = (aim.bubble, rounded(aim.at()));
    Change::Blow(Blow { bubble, at, toward, speed_m_s: JET_M_S, radius_deg: JET_DEG, ticks })
}

fn prick(aim: &Aim) -> Change {
    Change::Prick(Prick { bubble: aim.bubble, at: rounded(aim.at()) })
}

/// A bubble on a bath stays on it.
fn drag(scene: &Scene, bubble: usize, to_m: DVec3) -> Change {
    let mut to_m = rounded(to_m.clamp(DVec3::splat(-1000.0), DVec3::splat(1000.0)));
    if let Some(Bubble { boundary: Boundary::Bath, center_m, .. }) = scene.bubbles.get(bubble) {
        to_m[2] = center_m[2];
    }
    Change::Drag(Drag { bubble, to_m })
}

/// To a ten-thousandth, finer than any pointer: numbers that a saved scene shows are short.
fn rounded(vector: DVec3) -> [f64; 3] {
    vector.to_array().map(|number| (number * 1e4).round() / 1e4)
}

/// The bubble that is met first in the line of sight through a place in the picture.
pub fn bubble_at(story: &Story, tick: u64, place: DVec2) -> Option<usize> {
    aim(story, tick, place).map(|aim| aim.bubble)
}

/// The direction that the line of sight through a place in the picture leads to: mirrored at the bubble that is met first, straight on beside all.
pub fn mirrored(story: &Story, tick: u64, place: DVec2) -> DVec3 {
    let normal = |aim: Aim| (aim.ray, (aim.place_m - aim.center_m).normalize());
    let met = aim(story, tick, place).map(normal);
    met.map_or_else(|| sight::ray(&story.camera, place), |(ray, normal)| ray - 2.0 * ray.dot(normal) * normal)
}

/// The outline of a bubble in the picture, right and up from its middle in heights of it: the middle and the radius of a circle. `None` for one
/// behind the eye or around it.
pub fn outline(story: &Story, tick: u64, bubble: usize) -> Option<(DVec2, f64)> {
    let radius_m = 1e-3 * story.bubbles.get(bubble)?.radius_mm;
    sight::outline(&story.camera, story.center_m(bubble, tick as f64 * story.motion.tick_s), radius_m)
}

/// The film that is met first in the line of sight through a place in the picture; from inside a bubble that is its wall.
fn aim(story: &Story, tick: u64, place: DVec2) -> Option<Aim> {
    let (eye, ray) = (story.camera.eye(), sight::ray(&story.camera, place));
    let met = story.bubbles.iter().enumerate().filter_map(|(bubble, sphere)| {
        let center_m = story.center_m(bubble, tick as f64 * story.motion.tick_s);
        let along = hit(eye - center_m, ray, sphere.radius_mm * 1e-3)?;
        Some((along, bubble, center_m))
    });
    let (along, bubble, center_m) = met.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(Aim { bubble, ray, place_m: eye + along * ray, center_m, to_film: story.film_turn(tick as f64).inverse() })
}

/// How far along a ray it meets a sphere around the origin for the first time.
fn hit(from: DVec3, ray: DVec3, radius: f64) -> Option<f64> {
    let nearest = -from.dot(ray);
    let half_chord = (radius * radius - (from + nearest * ray).length_squared()).max(-1.0);
    let half_chord = (half_chord > 0.0).then(|| half_chord.sqrt())?;
    [nearest - half_chord, nearest + half_chord].into_iter().find(|along| *along > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{app::history, scene::Event};

    const MIDDLE: DVec2 = DVec2::ZERO;

    /// Presses at places, one each `ticks` ticks, and lets go.
    fn gesture(tool: Tool, scene: &mut Scene, places: &[DVec2], ticks: u64) {
        let mut hand = Hand::default();
        let pressed = places.iter().map(|place| Some(Press { from: places[0], at: *place }));
        for (k, pressed) in (0..).zip(pressed.chain([None])) {
            if let Some(change) = touch(&mut hand, tool, &Story::new(scene.clone()), ticks * k, pressed) {
                history::insert(scene, Event { tick: ticks * k, change });
            }
        }
        assert_eq!(hand, Hand::Free);
    }

    fn seen_from_x() -> Scene {
        let mut scene = Scene::default();
        (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (0.0, 0.0);
        scene
    }

    #[test]
    fn a_stroke_to_the_right_moves_the_near_side_to_the_right() {
        let mut scene = seen_from_x();
        let places: Vec<DVec2> = (0..61).map(|k| DVec2::new(0.002 * f64::from(k), 0.0)).collect();
        gesture(Tool::Stir, &mut scene, &places, 1);
        // A second at ten strokes a second.
        assert_eq!(scene.events.len(), 10);
        assert_eq!(scene.validate(), Ok(()));
        let Change::Stir(first) = &scene.events[0].change else { panic!("a stir") };
        // The camera at +x sees +y on its right. A tenth of a second moves the pointer by 0.012 heights, and the film by as much.
        let across_m = 0.012 * 2.0 * 15f64.to_radians().tan() * (0.24 - 0.05);
        assert!((first.velocity_m_s[1] - across_m / 0.1).abs() < 0.02 * across_m / 0.1, "{first:?}");
        assert!(first.at[0] > 0.99 && first.ticks == 6, "{first:?}");
    }

    #[test]
    fn an_outline_is_where_the_bubble_is_met() {
        let mut scene = seen_from_x();
        scene.bubbles[0].center_m = [0.01, 0.02, 0.01];
        let story = Story::new(scene);
        let (middle, radius) = outline(&story, 0, 0).unwrap();
        assert!(middle.x > 0.05 && middle.y > 0.02, "{middle}");
        let at = |part: f64| bubble_at(&story, 0, middle - DVec2::new(part * radius, 0.0));
        assert_eq!([at(0.0), at(0.97), at(1.05)], [Some(0), Some(0), None]);
    }

    #[test]
    fn a_turned_film_is_met_where_it_is() {
        let mut scene = seen_from_x();
        scene.motion.spin_deg_s = [0.0, 0.0, 90.0];
        let aim = aim(&Story::new(scene), 60, MIDDLE).unwrap();
        // After a quarter turn the film's -y is where +x was.
        assert!(aim.at().distance(DVec3::NEG_Y) < 1e-12, "{}", aim.at());
    }

    #[test]
    fn a_bubble_is_taken_along_and_met_where_it_went() {
        let mut scene = seen_from_x();
        gesture(Tool::Drag, &mut scene, &[DVec2::new(0.05, 0.05), DVec2::new(0.25, 0.05)], 6);
        let Change::Drag(last) = &scene.events.last().unwrap().change else { panic!("a drag") };
        let way = 0.2 * 2.0 * 15f64.to_radians().tan() * 0.19;
        assert!((last.to_m[1] - way).abs() < 0.05 * way && last.to_m[2].abs() < 1e-3, "{last:?}");
        let there = aim(&Story::new(scene.clone()), 600, MIDDLE).unwrap();
        assert!(there.center_m.distance(last.to_m.into()) < 1e-9);
    }

    #[test]
    fn a_jet_lasts_while_it_is_held_and_a_prick_is_one() {
        let mut scene = seen_from_x();
        gesture(Tool::Blow, &mut scene, &[DVec2::new(0.2, 0.1); 31], 1);
        // Each tenth of a second, and what is left when it is let go.
        assert_eq!(scene.events.len(), 6);
        let Change::Blow(blow) = &scene.events[0].change else { panic!("a jet") };
        assert!(blow.toward[0] < -0.9, "away from the camera: {blow:?}");
        gesture(Tool::Prick, &mut scene, &[MIDDLE; 31], 1);
        let pricks = scene.events.iter().filter(|event| matches!(event.change, Change::Prick(_)));
        assert_eq!((pricks.count(), scene.validate()), (1, Ok(())));
    }

    #[test]
    fn beside_the_bubbles_and_without_a_tool_the_camera_moves() {
        for (tool, place) in [(Tool::Stir, DVec2::new(0.6, 0.0)), (Tool::Orbit, MIDDLE)] {
            let (mut hand, story) = (Hand::default(), Story::new(seen_from_x()));
            for tick in [0, 60] {
                let press = Some(Press { from: place, at: MIDDLE });
                assert_eq!(touch(&mut hand, tool, &story, tick, press), None);
            }
            assert_eq!(hand, Hand::Camera);
        }
    }

    #[test]
    fn while_time_stands_nothing_happens() {
        let (mut hand, story) = (Hand::default(), Story::new(seen_from_x()));
        for k in 0..100 {
            let at = DVec2::new(0.003 * f64::from(k), 0.0);
            assert_eq!(touch(&mut hand, Tool::Stir, &story, 7, Some(Press { from: MIDDLE, at })), None);
        }
    }

    #[test]
    fn rays_meet_spheres_from_outside_and_inside() {
        assert_eq!(hit(DVec3::new(-3.0, 0.0, 0.0), DVec3::X, 1.0), Some(2.0));
        assert_eq!(hit(DVec3::ZERO, DVec3::X, 1.0), Some(1.0));
        assert_eq!(hit(DVec3::new(3.0, 0.0, 0.0), DVec3::X, 1.0), None);
        assert_eq!(hit(DVec3::new(-3.0, 2.0, 0.0), DVec3::X, 1.0), None);
    }
}
