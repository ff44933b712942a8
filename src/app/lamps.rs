//! Lamps that are placed in the picture: each is held by its highlight on a bubble, or by itself where the surroundings are seen.

use glam::{DMat3, DQuat, DVec2, DVec3};

use super::tools;
use crate::{
    plan::Story,
    scene::{LampShape, Light, LightLamp},
};

/// How far beside a lamp one may take hold of it, degrees: highlights are small.
const BESIDE_DEG: f64 = 8.0;

/// What of the lamps is under way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lamps {
    /// The lamp that the panel shows.
    pub selected: usize,
    /// What takes the place of the scene's lamps while something is dragged and until it is loaded.
    pub draft: Option<Vec<LightLamp>>,
    /// What was asked for last.
    pub asked: Option<Vec<LightLamp>>,
    /// The lamp that the pointer holds.
    pub grip: Option<Grip>,
}

/// A lamp that the pointer holds in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grip {
    /// Which one.
    pub lamp: usize,
    /// From what is seen under the pointer to the middle of the lamp.
    turn: DQuat,
    /// The place of the pointer in the picture.
    pub at: DVec2,
}

/// The direction of the middle of a lamp, where the environment is not turned.
fn toward(lamp: &LightLamp) -> DVec3 {
    let [azimuth, elevation] = [lamp.azimuth_deg, lamp.elevation_deg].map(f64::to_radians);
    (elevation.cos() * DVec2::from_angle(azimuth)).extend(elevation.sin())
}

/// Half of the larger angle that a lamp spans, degrees.
fn half_size_deg(lamp: &LightLamp) -> f64 {
    0.5 * match lamp.shape {
        LampShape::Disc => lamp.width_deg,
        LampShape::Softbox => lamp.width_deg.max(lamp.height_deg),
        LampShape::Strip => lamp.height_deg,
    }
}

/// What is seen at a place in the picture, as a direction of the environment before it is turned.
fn seen(story: &Story, tick: u64, at: DVec2) -> DVec3 {
    DMat3::from_rotation_z(-story.light.rotation_deg.to_radians()) * tools::mirrored(story, tick, at)
}

/// The lamp that is seen in a direction, or the nearest one beside it.
fn lamp_in(light: &Light, direction: DVec3) -> Option<usize> {
    let beside_deg = |lamp: &LightLamp| direction.angle_between(toward(lamp)).to_degrees() - half_size_deg(lamp);
    let lamps = light.lamps.iter().map(beside_deg).enumerate().filter(|(_, beside_deg)| *beside_deg <= BESIDE_DEG);
    lamps.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(lamp, _)| lamp)
}

impl Grip {
    /// Takes the lamp whose highlight, or which itself, is at a place in the picture.
    #[must_use]
    pub fn new(story: &Story, tick: u64, at: DVec2) -> Option<Self> {
        let seen = seen(story, tick, at);
        let lamp = lamp_in(&story.light, seen)?;
        let turn = DQuat::from_rotation_arc(seen, toward(&story.light.lamps[lamp]));
        Some(Self { lamp, turn, at })
    }

    /// The lamp where the pointer holds it now, to a tenth of a degree.
    #[must_use]
    pub fn moved(&self, story: &Story, tick: u64) -> Option<LightLamp> {
        let lamp = story.light.lamps.get(self.lamp)?;
        let toward = (self.turn * seen(story, tick, self.at)).normalize();
        let rounded = |angle: f64| (10.0 * angle.to_degrees()).round() / 10.0;
        let (azimuth_deg, elevation_deg) =
            (rounded(toward.y.atan2(toward.x)), rounded(toward.z.clamp(-1.0, 1.0).asin()));
        Some(LightLamp { azimuth_deg, elevation_deg, ..lamp.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;

    /// A bubble seen from +x, with a lamp on the left and one above, in an environment that is turned.
    fn story() -> Story {
        let mut scene = Scene::default();
        (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (0.0, 0.0);
        let lamp = |azimuth_deg, elevation_deg| LightLamp {
            azimuth_deg,
            elevation_deg,
            width_deg: 10.0,
            height_deg: 10.0,
            ..LightLamp::default()
        };
        scene.light.lamps = vec![lamp(-90.0 - 30.0, 0.0), lamp(0.0, 70.0)];
        scene.light.rotation_deg = 30.0;
        Story::new(scene)
    }

    /// Where the highlight of a lamp is: the place whose line of sight is mirrored nearest to it.
    fn highlight(story: &Story, lamp: usize) -> DVec2 {
        let places = (-100..=100).flat_map(|x| (-100..=100).map(move |y| 0.004 * DVec2::new(x.into(), y.into())));
        let off = |at: &DVec2| seen(story, 0, *at).distance(toward(&story.light.lamps[lamp]));
        let on_bubble = places.filter(|at| tools::bubble_at(story, 0, *at).is_some());
        on_bubble.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap()
    }

    #[test]
    fn a_lamp_is_taken_by_its_highlight() {
        let story = story();
        let [left, above] = [0, 1].map(|lamp| highlight(&story, lamp));
        assert!(left.x < -0.1 && left.y.abs() < 0.02 && above.y > 0.1, "{left} {above}");
        assert_eq!([left, above].map(|at| Grip::new(&story, 0, at).map(|grip| grip.lamp)), [Some(0), Some(1)]);
        assert_eq!(Grip::new(&story, 0, DVec2::ZERO), None, "the camera is mirrored there");
    }

    #[test]
    fn a_lamp_follows_its_highlight() {
        let story = story();
        let mut grip = Grip::new(&story, 0, highlight(&story, 1)).unwrap();
        let still = grip.moved(&story, 0).unwrap();
        // What was rounded is a twentieth of a degree.
        assert!((still.elevation_deg - 70.0).abs() < 0.1, "{still:?}");
        let to = DVec2::new(0.1, 0.1);
        grip.at = to;
        let mut scene = Scene::clone(&story);
        scene.light.lamps[1] = grip.moved(&story, 0).unwrap();
        assert_eq!(scene.validate(), Ok(()));
        let after = highlight(&Story::new(scene), 1);
        assert!(after.distance(to) < 0.01, "{after}");
    }

    #[test]
    fn a_lamp_is_taken_by_itself_beside_the_bubble() {
        let mut scene = Scene::clone(&story());
        (scene.light.rotation_deg, scene.light.lamps[0].azimuth_deg) = (0.0, 180.0);
        scene.light.lamps[0].width_deg = 20.0;
        let story = Story::new(scene);
        // It stands behind the bubble, and reaches beyond it.
        let beside = DVec2::new(0.44, 0.0);
        assert_eq!(tools::bubble_at(&story, 0, beside), None);
        assert_eq!(Grip::new(&story, 0, beside).map(|grip| grip.lamp), Some(0));
    }
}
