//! Films are played: the steps of their histories, in submissions that do not run long, until each rests or is where it shall be.

use std::ops::Range;

use super::{
    company::{Company, Member},
    moving::{LawInForce, MovingFilm},
};
use crate::{
    gpu::{
        device::{Gpu, GpuError},
        timing::Recorder,
    },
    plan::{FieldKey, FlowLaw},
};

impl MovingFilm {
    /// Moves the film through some ticks of its history; what is recorded goes out in submissions of at most `steps_per_submission` steps.
    pub fn play(
        &mut self,
        gpu: &Gpu,
        key: &FieldKey,
        from_tick: u64,
        steps_per_submission: usize,
        submit: impl FnMut(Recorder<'_>) -> Result<(), GpuError>,
    ) -> Result<(), GpuError> {
        play_together(gpu, &mut [(self, key)], &mut Company::default(), (from_tick, steps_per_submission), submit)
    }
}

/// Moves films through some ticks. Their histories have the same steps. A submission takes `steps_per_submission` steps at most.
pub fn play_together(
    gpu: &Gpu,
    members: &mut [Member<'_>],
    company: &mut Company,
    (from_tick, steps_per_submission): (u64, usize),
    mut submit: impl FnMut(Recorder<'_>) -> Result<(), GpuError>,
) -> Result<(), GpuError> {
    let Some(history) = members.first().map(|(_, key)| *key) else { return Ok(()) };
    company.forget();
    let mut laws: Vec<LawInForce> = members.iter().map(|_| LawInForce::default()).collect();
    let mut steps = history.steps_from(from_tick);
    loop {
        let (mut recorder, mut taken, mut asking) = (None, 0, Vec::new());
        while taken < steps_per_submission && asking.is_empty() {
            let Some(step) = steps.next() else { break };
            let moving: Vec<usize> = (0..members.len()).filter(|place| moves(&mut members[*place], &step)).collect();
            if moving.is_empty() {
                continue;
            }
            let recorder = recorder.get_or_insert_with(|| Recorder::new(gpu));
            company.advance(recorder, members, &mut laws, (&moving, &step))?;
            let asked = moving.into_iter().map(|place| (place, members[place].0.asks(members[place].1, &step)));
            asking = asked.filter_map(|(place, rest)| Some((place, rest?))).collect();
            taken += 1;
        }
        let Some(mut recorder) = recorder else { return Ok(()) };
        company.part(&mut recorder, members);
        submit(recorder)?;
        for (place, rest) in asking {
            let (film, key) = &mut members[place];
            if let Some(motion) = &film.motion {
                film.watch.watch(gpu, motion.flow(), rest, key.resting_speed())?;
            }
        }
    }
}

/// Whether a film moves in a step.
fn moves((film, key): &mut Member<'_>, step: &Range<u64>) -> bool {
    key.law(step.start) != FlowLaw::Rest && !film.stays_at_rest(key, step)
}
