//! Films that have come to rest: they take no steps until something moves them again.
//!
//! How fast a film flows only the device knows. It is asked every two seconds of the film's time, and the answer is taken two seconds later:
//! it has long arrived then, so that nothing waits for it, and a film rests from the same tick on, however its history is cut into frames.

use crate::{
    gpu::{
        device::{Gpu, GpuError},
        flow::FlowSolver,
        passes::flow_measure::FlowMeasures,
        readback::Readback,
    },
    physics::film::rests,
    plan::RestingFilm,
};

/// What is known of a film's calming down.
#[derive(Default)]
pub(super) struct RestWatch {
    asked: Option<Speed>,
    /// Speed by the answer before, rad/s.
    before: Option<f64>,
    rest: Option<RestingFilm>,
}

/// A speed that was asked for.
enum Speed {
    OnItsWay(Readback),
    /// In rad/s.
    Known(f64),
}

/// A saved copy of the watch.
#[derive(Clone, Copy)]
pub(super) struct KeptRestWatch {
    asked: Option<f64>,
    before: Option<f64>,
    rest: Option<RestingFilm>,
}

impl RestWatch {
    /// Since when and under what law the film rests, if it does.
    pub(super) fn rest(&self) -> Option<RestingFilm> {
        self.rest
    }

    /// Takes the last answer and asks again, when all that was recorded is submitted. The film rests, as it is said, if its speed is below
    /// a limit in rad/s and will not soon grow beyond it.
    pub(super) fn watch(
        &mut self,
        gpu: &Gpu,
        flow: &FlowSolver,
        rest: RestingFilm,
        limit: f64,
    ) -> Result<(), GpuError> {
        if let Some(speed) = self.answer(gpu)? {
            self.rest = rests(speed, self.before, limit).then_some(rest);
            self.before = Some(speed);
        }
        self.asked = Some(Speed::OnItsWay(Readback::of_buffer(gpu, flow.measures(), size_of::<FlowMeasures>() as u64)));
        Ok(())
    }

    /// The speed that was asked for, if one was.
    fn answer(&mut self, gpu: &Gpu) -> Result<Option<f64>, GpuError> {
        Ok(match self.asked.take() {
            None => None,
            Some(Speed::Known(speed)) => Some(speed),
            Some(Speed::OnItsWay(readback)) => arrived(readback, gpu)?
                .map(|bytes| bytemuck::pod_read_unaligned::<FlowMeasures>(&bytes).max_speed.into()),
        })
    }

    /// A copy, for a checkpoint.
    pub(super) fn kept(&mut self, gpu: &Gpu) -> Result<KeptRestWatch, GpuError> {
        let asked = self.answer(gpu)?;
        self.asked = asked.map(Speed::Known);
        Ok(KeptRestWatch { asked, before: self.before, rest: self.rest })
    }
}

impl From<KeptRestWatch> for RestWatch {
    fn from(kept: KeptRestWatch) -> Self {
        Self { asked: kept.asked.map(Speed::Known), before: kept.before, rest: kept.rest }
    }
}

#[cfg(not(target_arch = "wasm32"))]
fn arrived(readback: Readback, gpu: &Gpu) -> Result<Option<Vec<u8>>, GpuError> {
    readback.try_take().unwrap_or_else(|| readback.wait(gpu)).map(Some)
}

/// Nothing may wait in a browser: a film whose speed is not known in time goes on.
#[cfg(target_arch = "wasm32")]
fn arrived(readback: Readback, _: &Gpu) -> Result<Option<Vec<u8>>, GpuError> {
    readback.try_take().transpose()
}
