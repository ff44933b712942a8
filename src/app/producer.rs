//! What the passes of a frame send to the device, computed beside the window, which stays quick meanwhile.

use std::sync::{
    Arc,
    mpsc::{Receiver, Sender, channel},
};

use super::system;
use crate::plan::{Plan, Prepared, Product, Work};

/// The work that goes on.
pub struct Producer {
    wake: Arc<dyn Fn() + Send + Sync>,
    sender: Sender<(Work, Product)>,
    receiver: Receiver<(Work, Product)>,
    /// What has been asked for and is not there yet.
    asked: Vec<Work>,
}

impl Producer {
    /// No work yet. `wake` is called, from other threads, whenever something is done.
    pub fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        let (sender, receiver) = channel();
        Self { wake: Arc::new(wake), sender, receiver, asked: Vec::new() }
    }

    /// Whether all that a plan's passes begin with is there; asks for what is not.
    pub fn prepare(&mut self, plan: &Plan, prepared: &mut Prepared) -> bool {
        for (work, product) in self.receiver.try_iter() {
            self.asked.retain(|asked| *asked != work);
            prepared.add(work, product);
        }
        let missing: Vec<Work> = Work::of_plan(plan).filter(|work| !prepared.has(work)).collect();
        // Work that cannot be done elsewhere is done by its pass.
        missing.into_iter().filter(|work| self.asked.contains(work) || self.ask(work)).count() == 0
    }

    /// Asks for a product; returns whether it will come.
    fn ask(&mut self, work: &Work) -> bool {
        let (wake, sender, known) = (self.wake.clone(), self.sender.clone(), work.clone());
        let answer = move |product| {
            // Nobody listens any more once the window is gone.
            let _ = sender.send((known, product));
            wake();
        };
        let begun = system::compute(work.clone(), answer);
        if let Err(error) = &begun {
            log::warn!("no work can be done beside the window: {error}");
        }
        self.asked.extend(begun.is_ok().then(|| work.clone()));
        begun.is_ok()
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::{
        app::model::Model,
        input::load_scene,
        physics::colour::Gamut,
        plan::{GpuState, Moment, Pace, Shot, plan},
    };

    /// What a busy machine may take for all of the work.
    const LONGEST: Duration = Duration::from_secs(600);

    #[test]
    fn a_plan_is_ready_once_all_its_work_is_done() {
        let (told, arrived) = channel();
        let mut producer = Producer::new(move || told.send(()).unwrap());
        let model = Model::new(load_scene("default").unwrap());
        let shot = Shot {
            size: [64, 64],
            moment: Moment { tick: 0, fraction: 0.0 },
            full_precision: false,
            gamut: Gamut::Srgb,
            pace: Pace::UNMEASURED,
        };
        let plan = plan(&model.scene.request(&model.resources, &shot).unwrap(), &GpuState::default());
        let (count, mut prepared) = (Work::of_plan(&plan).count(), Prepared::default());
        assert!(count >= 2, "a film and its colours");
        assert!(!producer.prepare(&plan, &mut prepared));
        for _ in 0..count {
            arrived.recv_timeout(LONGEST).unwrap();
            producer.prepare(&plan, &mut prepared);
        }
        assert!(producer.prepare(&plan, &mut prepared));
        assert!(arrived.try_recv().is_err(), "nothing is done twice");
    }
}
