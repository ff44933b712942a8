//! One export, from the moment when it is asked for.

use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::Instant,
};

use crate::{
    export::{Job, Observer},
    input::LoadedScene,
};

/// Whom the worker tells how far it is, and who tells the worker to stop.
#[derive(Default)]
pub struct Watch {
    /// The bits of the part that is done, 0 to 1.
    done: AtomicU64,
    cancelled: AtomicBool,
}

impl Watch {
    /// The part that is done, 0 to 1.
    pub fn done(&self) -> f64 {
        f64::from_bits(self.done.load(Ordering::Relaxed))
    }

    /// The work is no longer wanted.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it is no longer wanted.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed)
    }
}

impl Observer for Watch {
    fn is_watching(&self) -> bool {
        true
    }

    fn hear(&self, done: f64) {
        self.done.store(done.to_bits(), Ordering::Relaxed);
    }

    fn has_cancelled(&self) -> bool {
        self.is_cancelled()
    }
}

/// How far an export is.
pub enum State {
    /// Others come first.
    Waiting(Box<(Job, LoadedScene)>),
    /// It is being done since then.
    Running(Instant),
}

/// One export.
pub struct Entry {
    /// Its number.
    pub id: u64,
    /// The file or folder that it makes.
    pub path: PathBuf,
    /// How far it is.
    pub state: State,
    /// What its worker tells.
    pub watch: Arc<Watch>,
}

impl Entry {
    /// An export that waits.
    pub fn new(id: u64, job: Job, scene: LoadedScene) -> Self {
        let path = job.path().to_owned();
        Self { id, path, state: State::Waiting(Box::new((job, scene))), watch: Arc::default() }
    }

    /// Whether it is being done.
    pub fn is_running(&self) -> bool {
        matches!(self.state, State::Running(_))
    }

    /// Begins it, if it waits.
    pub fn begin(&mut self) -> Option<(u64, Job, LoadedScene, Arc<Watch>)> {
        match std::mem::replace(&mut self.state, State::Running(Instant::now())) {
            State::Waiting(work) => Some((self.id, work.0, work.1, self.watch.clone())),
            State::Running(since) => {
                self.state = State::Running(since);
                None
            }
        }
    }

    /// How far it is, for people.
    pub fn told(&self) -> String {
        let State::Running(since) = &self.state else { return "waiting".to_owned() };
        let (done, passed_s) = (self.watch.done(), since.elapsed().as_secs_f64());
        match done {
            _ if self.watch.is_cancelled() => "stopping".to_owned(),
            // So little says nothing of the rest.
            done if done < 0.005 => "starting".to_owned(),
            done => format!("{:.0} %, {} left", 100.0 * done, duration(passed_s * (1.0 - done) / done)),
        }
    }
}

/// A duration of some seconds as people say it.
fn duration(seconds: f64) -> String {
    match seconds.round() as u64 {
        seconds @ 0..90 => format!("{seconds} s"),
        seconds @ 90..5400 => format!("{} min", (seconds + 30) / 60),
        seconds => format!("{:.1} h", seconds as f64 / 3600.0),
    }
}
