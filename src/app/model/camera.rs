//! The camera: moved by its user, or by its keyframes as time passes.
//!
//! The scene's own camera is always the view that the window shows. Whenever time moves, the numbers that the keyframes give are set to where the
//! keyframes have them. Until then a user may look from elsewhere, and make a keyframe of it.

use glam::DVec2;

use super::Model;
use crate::{
    app::{edit::Edit, orbit},
    scene::{Camera, Ease, Keyframe},
};

/// Angles that differ by less are the same view, degrees.
const SAME_DEG: f64 = 1e-6;

impl Model {
    /// Time of the shown moment, s.
    fn moment_s(&self) -> f64 {
        self.clock.moment(&self.scene.motion).ticks() * self.scene.motion.tick_s
    }

    /// Sets the camera to where its keyframes have it, if time has moved since, or if an undo has gone back to before that. This is no work that
    /// could be lost.
    pub fn follow_keyframes(&mut self) {
        if self.scene.camera.keyframes.is_empty() {
            self.followed = None;
            return;
        }
        let now = (self.clock.moment(&self.scene.motion), self.undo.state());
        if self.followed.is_some_and(|(moment, state)| moment == now.0 && state <= now.1) {
            return;
        }
        let Camera { keyframes, .. } = &self.scene.camera;
        let camera = Camera { keyframes: keyframes.clone(), ..self.scene.camera.at(self.moment_s()) };
        if camera != self.scene.camera {
            self.scene.change(|scene| scene.camera = camera);
        }
        self.followed = Some(now);
    }

    /// Whether the view is not where the keyframes have it.
    #[must_use]
    pub fn is_off_keyframes(&self) -> bool {
        let Some((moment, _)) = self.followed else { return false };
        let camera = &self.scene.camera;
        let kept = camera.at(moment.ticks() * self.scene.motion.tick_s);
        let turned_deg = orbit::wrapped(camera.azimuth_deg - kept.azimuth_deg).abs();
        let rest = Camera { azimuth_deg: kept.azimuth_deg, keyframes: Vec::new(), ..camera.clone() };
        turned_deg > SAME_DEG || rest != kept
    }

    /// Whether the keyframes go on moving the camera as time passes.
    #[must_use]
    pub fn will_move(&self) -> bool {
        self.scene.camera.keyframes.last().is_some_and(|last| self.moment_s() < last.time_s)
    }

    /// Moves the camera in a picture of an aspect, which is its width over its height.
    pub fn move_camera(&mut self, gesture: &orbit::Gesture, aspect: f64) {
        let hides_added = std::mem::take(&mut self.shows_added) && !self.sees_selection(aspect);
        let framed = |model: &Self| {
            let spheres = model.scene.spheres(model.clock.time_s(&model.scene.motion));
            orbit::framed(&model.scene.camera, &spheres, aspect)
        };
        if gesture.frame {
            self.look_from(framed(self));
        } else if hides_added && self.scene.camera.keyframes.is_empty() {
            let camera = framed(self);
            // Adding them is the step that can be taken back.
            self.scene.change(|scene| scene.camera = camera);
        } else if gesture.moves() {
            self.look_from(orbit::moved(&self.scene.camera, &self.scene.bubbles, gesture));
        } else if gesture.follow != DVec2::ZERO && self.scene.camera.keyframes.is_empty() {
            let gesture = orbit::Gesture { turn: gesture.follow, ..orbit::Gesture::default() };
            let camera = orbit::moved(&self.scene.camera, &self.scene.bubbles, &gesture);
            // Looking around is no work that could be lost.
            self.scene.change(|scene| scene.camera = camera);
        }
    }

    /// Looks from another camera. If that leaves the keyframes, the clock stands, for the next moment would take the view back.
    pub fn look_from(&mut self, camera: Camera) {
        if self.edit(Edit::Camera(camera)) && self.is_off_keyframes() {
            self.clock.running = false;
        }
    }

    /// Makes a keyframe of the view at the shown moment, in the place of one within half a tick.
    pub fn add_keyframe(&mut self) {
        let (mut camera, time_s) = (self.scene.camera.clone(), self.moment_s());
        // The window's views are within half a turn; the way from the other keyframes is the short one.
        let way_deg = camera.at(time_s).azimuth_deg;
        camera.azimuth_deg = way_deg + orbit::wrapped(camera.azimuth_deg - way_deg);
        let before = self.keyframe_near(time_s).map(|index| camera.keyframes[index].ease);
        let keyframe = Keyframe { ease: before.unwrap_or_default(), ..camera.keyframe(time_s) };
        self.put(&mut camera.keyframes, keyframe);
        self.change_keyframes(if before.is_some() { "Replace keyframe" } else { "Add keyframe" }, camera);
    }

    /// The keyframe within half a tick of a time in s.
    fn keyframe_near(&self, time_s: f64) -> Option<usize> {
        let near = |keyframe: &Keyframe| (keyframe.time_s - time_s).abs() < 0.5 * self.scene.motion.tick_s;
        self.scene.camera.keyframes.iter().position(near)
    }

    /// Puts a keyframe among others, in the place of those within half a tick; returns its index.
    fn put(&self, keyframes: &mut Vec<Keyframe>, keyframe: Keyframe) -> usize {
        keyframes.retain(|other| (other.time_s - keyframe.time_s).abs() >= 0.5 * self.scene.motion.tick_s);
        let index = keyframes.partition_point(|other| other.time_s < keyframe.time_s);
        keyframes.insert(index, keyframe);
        index
    }

    /// Deletes a keyframe. Without the last one the view stays as it is.
    pub fn delete_keyframe(&mut self, index: usize) {
        let mut camera = self.scene.camera.clone();
        if index < camera.keyframes.len() {
            camera.keyframes.remove(index);
            self.change_keyframes("Delete keyframe", camera);
        }
    }

    /// Moves a keyframe to a tick, where it takes the place of another; returns its new index.
    pub fn move_keyframe(&mut self, index: usize, tick: u64) -> Option<usize> {
        let mut camera = self.scene.camera.clone();
        let time_s = tick as f64 * self.scene.motion.tick_s;
        camera.keyframes.get(index).filter(|keyframe| keyframe.time_s != time_s)?;
        let keyframe = Keyframe { time_s, ..camera.keyframes.remove(index) };
        let index = self.put(&mut camera.keyframes, keyframe);
        self.change_keyframes("Move keyframe", camera).then_some(index)
    }

    /// Sets how the camera goes on from a keyframe.
    pub fn ease_keyframe(&mut self, index: usize, ease: Ease) {
        let mut camera = self.scene.camera.clone();
        let Some(keyframe) = camera.keyframes.get_mut(index).filter(|keyframe| keyframe.ease != ease) else { return };
        keyframe.ease = ease;
        self.change_keyframes("Ease", camera);
    }

    /// Goes to the tick of a keyframe.
    pub fn go_to_keyframe(&mut self, index: usize) {
        if let Some(Keyframe { time_s, .. }) = self.scene.camera.keyframes.get(index) {
            self.clock.seek((time_s / self.scene.motion.tick_s).round() as u64);
        }
    }

    /// Lets the camera turn once around its target over the length of the time line, through where it is now. The end looks like the beginning, so
    /// that a loop has no jump.
    pub fn add_turntable(&mut self) {
        let (camera, length_s) = (&self.scene.camera, self.time_line.length_s);
        let key = |time_s: f64, azimuth_deg: f64| Keyframe {
            time_s,
            azimuth_deg: Some(azimuth_deg),
            ease: Ease::Linear,
            ..Keyframe::default()
        };
        let past = (self.moment_s() / length_s).min(1.0);
        let from_deg = orbit::wrapped(camera.azimuth_deg) - 360.0 * past;
        let keyframes = vec![key(0.0, from_deg), key(length_s, from_deg + 360.0)];
        self.change_keyframes("Turntable", Camera { keyframes, ..camera.clone() });
    }

    /// Changes the keyframes, as a step of its own; returns whether it was made.
    fn change_keyframes(&mut self, name: &str, camera: Camera) -> bool {
        let back = self.apply(Edit::Camera(camera));
        let is_made = back.is_some();
        back.into_iter().for_each(|back| self.undo.record_whole(name, vec![back], None));
        // The way through the shown moment may be another one.
        self.followed = self.followed.filter(|_| !self.is_off_keyframes());
        is_made
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::{app::model::tests::model, plan::Moment, scene::Scene};

    /// A window whose clock stands, with keyframes a second apart that turn the camera by 90 degrees each.
    fn moved() -> Model {
        let mut model = model();
        model.clock.running = false;
        let key = |time_s: f64| Keyframe {
            time_s,
            azimuth_deg: Some(90.0 * time_s),
            ease: Ease::Linear,
            ..Keyframe::default()
        };
        model.scene.change(|scene| scene.camera.keyframes = (0..5).map(|k| key(f64::from(k))).collect());
        model.advance(0.0);
        model
    }

    fn turn(model: &mut Model, right: f64) {
        let turn = DVec2::new(right, 0.0);
        model.move_camera(&orbit::Gesture { turn, ..orbit::Gesture::default() }, 1.5);
        model.advance(0.0);
    }

    fn seek(model: &mut Model, tick: u64) {
        model.clock.seek(tick);
        model.advance(0.0);
    }

    fn azimuth_deg(model: &Model) -> f64 {
        model.scene.camera.azimuth_deg
    }

    #[test]
    fn the_view_follows_the_keyframes_as_time_moves() {
        let mut model = moved();
        assert_eq!(azimuth_deg(&model), 0.0);
        for (tick, expected) in [(30, 45.0), (240, 360.0), (600, 360.0), (60, 90.0)] {
            seek(&mut model, tick);
            assert!((azimuth_deg(&model) - expected).abs() < 1e-9, "{} at tick {tick}", azimuth_deg(&model));
        }
        assert!(!model.undo.is_dirty() && !model.is_off_keyframes());
        // In slow motion the camera moves between ticks too.
        model.scene.change(|scene| scene.motion.speed = 0.1);
        model.clock.running = true;
        model.advance(0.05);
        let Moment { tick, fraction } = model.clock.moment(&model.scene.motion);
        assert!(tick == 60 && fraction > 0.2 && (azimuth_deg(&model) - 90.0 - 1.5 * fraction).abs() < 1e-9);
    }

    #[test]
    fn a_view_off_the_keyframes_pauses_and_lasts_until_time_moves() {
        let mut model = moved();
        seek(&mut model, 60);
        model.clock.running = true;
        turn(&mut model, -0.1);
        assert!(!model.clock.running && model.is_off_keyframes());
        assert!((azimuth_deg(&model) - 108.0).abs() < 1e-9, "{}", azimuth_deg(&model));
        turn(&mut model, -0.1);
        assert!((azimuth_deg(&model) - 126.0).abs() < 1e-9, "from where it was left");
        model.undo();
        model.advance(0.0);
        assert!(!model.is_off_keyframes() && (azimuth_deg(&model) - 90.0).abs() < 1e-9, "two moves at once are a step");
        model.redo();
        model.advance(0.0);
        assert!((azimuth_deg(&model) - 126.0).abs() < 1e-9, "{}", azimuth_deg(&model));
        model.clock.step();
        model.advance(0.0);
        assert!(!model.is_off_keyframes() && (azimuth_deg(&model) - 91.5).abs() < 1e-9);
        // What is taken back, or made again, at another moment leaves the view where the keyframes have it.
        for change in [Model::undo, Model::redo] {
            change(&mut model);
            model.advance(0.0);
            assert!((azimuth_deg(&model) - 91.5).abs() < 1e-9, "{}", azimuth_deg(&model));
            model.clock.step();
            model.clock.seek(61);
            model.advance(0.0);
        }
    }

    #[test]
    fn what_no_keyframe_gives_is_changed_as_ever_while_the_clock_runs() {
        let mut model = moved();
        seek(&mut model, 150);
        model.clock.running = true;
        let before_m = model.scene.camera.distance_m;
        model.move_camera(&orbit::Gesture { zoom: 0.5, ..orbit::Gesture::default() }, 1.5);
        assert!(model.clock.running && model.scene.camera.distance_m < 0.7 * before_m);
        let zoomed_m = model.scene.camera.distance_m;
        seek(&mut model, 200);
        assert_eq!(model.scene.camera.distance_m, zoomed_m);
        assert!((azimuth_deg(&model) - 300.0).abs() < 1e-9);
    }

    #[test]
    fn a_keyframe_is_added_replaced_moved_and_deleted_in_steps_of_their_own() {
        let mut model = moved();
        let before = Scene::clone(&model.scene);
        seek(&mut model, 210);
        turn(&mut model, 0.1);
        let off_deg = azimuth_deg(&model);
        model.add_keyframe();
        model.advance(0.0);
        assert_eq!(model.undo.last_name(), Some("Add keyframe"));
        // The view is wrapped to -63°, and the way there from 270° is the short one.
        let added = &model.scene.camera.keyframes[4];
        assert!((added.azimuth_deg.unwrap() - 297.0).abs() < 1e-9 && added.time_s == 3.5, "{added:?}");
        assert_eq!((model.scene.camera.keyframes.len(), model.is_off_keyframes()), (6, false));
        assert_eq!(Scene::from_toml(&model.scene.to_toml(), "saved").as_ref(), Ok(&*model.scene));
        model.undo();
        model.advance(0.0);
        assert!(model.is_off_keyframes() && azimuth_deg(&model) == off_deg, "the view that it was made of");
        model.redo();
        model.add_keyframe();
        assert_eq!((model.undo.last_name(), model.scene.camera.keyframes.len()), (Some("Replace keyframe"), 6));

        assert_eq!(model.move_keyframe(0, 90), Some(1));
        assert_eq!(model.undo.last_name(), Some("Move keyframe"));
        assert_eq!(model.move_keyframe(1, 120), Some(1), "it takes the place of another");
        let times = |model: &Model| model.scene.camera.keyframes.iter().map(|key| key.time_s).collect::<Vec<_>>();
        assert_eq!(times(&model), [1.0, 2.0, 3.0, 3.5, 4.0]);
        model.ease_keyframe(1, Ease::Hold);
        model.delete_keyframe(0);
        assert_eq!(times(&model), [2.0, 3.0, 3.5, 4.0]);
        (0..7).for_each(|_| model.undo());
        assert_eq!(model.scene.camera.keyframes, before.camera.keyframes);
        assert_eq!(model.scene.validate(), Ok(()));
    }

    #[test]
    fn without_its_last_keyframe_the_view_stays() {
        let mut model = moved();
        seek(&mut model, 120);
        for _ in 0..5 {
            model.delete_keyframe(0);
            model.advance(0.0);
        }
        seek(&mut model, 0);
        assert!((azimuth_deg(&model) - 360.0).abs() < 1e-9 && model.followed.is_none(), "{}", azimuth_deg(&model));
    }

    #[test]
    fn a_turntable_turns_once_over_the_time_line_and_shows_the_same_view_now() {
        let mut model = model();
        model.clock.running = false;
        seek(&mut model, 150);
        let before_deg = azimuth_deg(&model);
        model.add_turntable();
        model.advance(0.0);
        assert!((azimuth_deg(&model) - before_deg).abs() < 1e-9 && !model.is_off_keyframes());
        let [from, to] = &model.scene.camera.keyframes[..] else { panic!("two keyframes") };
        assert_eq!((from.time_s, to.time_s, from.ease), (0.0, 10.0, Ease::Linear));
        assert_eq!(to.azimuth_deg.unwrap() - from.azimuth_deg.unwrap(), 360.0);
        assert_eq!((from.distance_m, model.undo.last_name()), (None, Some("Turntable")));
        model.undo();
        model.advance(0.0);
        assert_eq!((&model.scene.camera.keyframes[..], azimuth_deg(&model)), (&[][..], before_deg));
    }

    #[cfg(not(target_arch = "wasm32"))]
    #[test]
    fn a_picture_is_exported_as_it_is_seen() {
        let mut model = moved();
        seek(&mut model, 60);
        turn(&mut model, -0.1);
        let camera = model.view_snapshot().scene.camera;
        assert!(camera.keyframes.is_empty() && (camera.azimuth_deg - 108.0).abs() < 1e-9);
        assert_eq!(model.snapshot().scene.camera.keyframes.len(), 5, "a video follows the keyframes");
    }
}
