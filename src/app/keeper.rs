//! Keeps settings, and work that is not saved, while the window is open.

use std::time::Duration;

use web_time::Instant;

use super::{
    model::Model,
    request::{Fate, Question},
    storage::{Settings, Storage, Unsaved},
};

/// Time between two looks at what there is to keep.
const PERIOD: Duration = Duration::from_secs(3);

/// What is kept so far.
pub struct Keeper {
    storage: Storage,
    settings: Settings,
    /// The state of the scene that is kept.
    state: Option<u64>,
    /// Work that an earlier window left, until it is known what becomes of it.
    left: Option<Unsaved>,
    next: Instant,
}

impl Keeper {
    /// Gives a new window the settings of the last one, and asks about work that it left.
    pub fn new(mut storage: Storage, model: &mut Model) -> Self {
        let (settings, left) = (storage.settings(), storage.take_left());
        model.settings = settings.clone();
        model.question = left.as_ref().map(|work| Question::Left(work.name.clone()));
        Self { storage, settings, state: None, left, next: Instant::now() + PERIOD }
    }

    /// Keeps what has changed, if it is time; returns when to look again, if there is more to keep.
    pub fn keep(&mut self, model: &mut Model, now: Instant) -> Option<Instant> {
        let state = model.undo.is_dirty().then(|| model.undo.state());
        if self.settings == model.settings && self.state == state {
            return None;
        }
        if now >= self.next {
            self.next = now + PERIOD;
            self.keep_all(model, state);
        }
        Some(self.next)
    }

    /// Keeps settings and work; returns whether the work is safe.
    fn keep_all(&mut self, model: &mut Model, state: Option<u64>) -> bool {
        if self.settings != model.settings {
            self.settings = model.settings.clone();
            self.storage.keep_settings(&self.settings);
        }
        if self.state == state {
            return true;
        }
        self.state = state;
        let Some(work) = model.unsaved() else {
            self.storage.drop_kept();
            return true;
        };
        let kept = self.storage.keep(&work);
        if let Err(error) = &kept {
            model.messages.problem(format!("unsaved work cannot be kept in case of a crash: {error}"));
        }
        kept.is_ok()
    }

    /// What an earlier window left, if it shall go on here.
    pub fn decide(&mut self, fate: Fate) -> Option<Unsaved> {
        let left = self.left.take();
        match fate {
            Fate::TakeUp => return left,
            Fate::ThrowAway => self.storage.drop_left(),
            Fate::Later => self.storage.leave(),
        }
        None
    }

    /// What an earlier window left goes on here: once it is kept as this window's work, it need not be kept twice.
    pub fn taken_up(&mut self, model: &mut Model) {
        if self.keep_all(model, Some(model.undo.state())) {
            self.storage.drop_left();
        }
    }

    /// The window closes; what is not saved is kept if nobody has decided to lose it.
    pub fn close(&mut self, model: &mut Model, is_meant: bool) {
        self.keep_all(model, model.undo.is_dirty().then(|| model.undo.state()));
        if is_meant {
            self.storage.drop_kept();
        }
    }
}
