//! Time: how it passes, and events that are moved in it.

use super::Model;
use crate::app::{edit::Edit, time_line::Mark};

/// The time that one frame of a turntable lasts at most, s.
const LONGEST_TURN_S: f64 = 0.1;

impl Model {
    /// Lets wall time pass, unless the films are behind the clock. It begins with the first picture: nobody misses the beginning, and shaders that
    /// move films can wait until then.
    pub fn advance(&mut self, wall_s: f64) {
        self.turn_table(wall_s);
        let motion = &self.scene.motion;
        if self.behind_ticks == 0 && self.is_pictured() {
            self.clock.advance(wall_s, motion);
        }
        let (time_s, shown_s) = (self.clock.time_s(motion), self.shown_tick() as f64 * motion.tick_s);
        if !self.clock.running || self.behind_ticks > 0 {
            self.rate.restart(shown_s);
        } else if self.time_line.loops && time_s >= self.time_line.length_s {
            self.clock.reset();
            self.rate.restart(0.0);
        } else {
            self.rate.note(wall_s, shown_s);
        }
        self.follow_keyframes();
    }

    /// The tick that people see: while time passes that of the picture, which the clock is ahead of, and else that of the clock.
    #[must_use]
    pub fn shown_tick(&self) -> u64 {
        let follows = self.clock.running && self.behind_ticks == 0;
        if follows { self.pictured_tick.min(self.clock.tick) } else { self.clock.tick }
    }

    /// Turns a camera without keyframes about the vertical. Looking around is no work that could be lost.
    fn turn_table(&mut self, wall_s: f64) {
        // A frame that took long turns no further than one can follow.
        let turn_deg = self.turntable_deg_s * wall_s.min(LONGEST_TURN_S);
        if turn_deg != 0.0 && self.scene.camera.keyframes.is_empty() {
            self.scene.change(|scene| scene.camera.azimuth_deg = (scene.camera.azimuth_deg + turn_deg) % 360.0);
        }
    }

    /// Moves what a mark of the time line stands for to another tick.
    pub fn move_mark(&mut self, mark: Mark, tick: u64) {
        match mark {
            Mark::Event(index) => self.move_event(index, tick),
            Mark::Keyframe(index) => {
                if let Some(index) = self.move_keyframe(index, tick) {
                    self.time_line.selected = Some(Mark::Keyframe(index));
                }
            }
        }
    }

    /// Moves an event to another tick.
    fn move_event(&mut self, index: usize, tick: u64) {
        let mut events = self.scene.events.clone();
        let Some(event) = events.get_mut(index).filter(|event| event.tick != tick) else { return };
        event.tick = tick;
        let moved = event.clone();
        // Events stand in the order of their ticks; those of one tick keep theirs.
        events.sort_by_key(|event| event.tick);
        let place = events.iter().position(|event| *event == moved);
        if self.edit(Edit::History(self.scene.motion.clone().into(), events)) {
            self.time_line.selected = place.map(Mark::Event);
        }
    }
}
