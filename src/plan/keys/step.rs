//! From a film's key to what acts on the film in a step.

use std::ops::Range;

use super::{FieldKey, FlowLaw, FreeFlow};
use crate::physics::{
    film::{
        Nucleus, Patch, Split,
        model::{BlackeningLaw, DROP_RAD, DrainLaw, FilmStep, FreePart, MAX_NUCLEI, latest_ticks},
        nuclei,
        properties::BLACK_FILM_NM,
    },
    flow::FlowForces,
};

impl FieldKey {
    /// What acts on the film in one step of its history, given by its ticks.
    #[must_use]
    pub fn film_step(&self, step: &Range<u64>) -> FilmStep {
        let ticks = u32::try_from(step.end - step.start).unwrap_or(u32::MAX);
        let (law, end) = (self.law(step.start), step.end as f64);
        let from_s = step.start as f64 * self.tick_s;
        let mut found =
            FilmStep { from_s, ticks, tick_s: self.tick_s, law, parts: Vec::new(), drain: None, blackening: None };
        if let FlowLaw::Free(free) = law {
            found.parts = self.parts(&free, step.start as f64, ticks);
            found.drain = self.draining(&free, end);
            found.blackening = self.has_black_film(end).then(|| self.blackening(&free, end));
        }
        found
    }

    /// The steps of a film's own flow in a step from a time in ticks, in order.
    fn parts(&self, free: &FreeFlow, from: f64, ticks: u32) -> Vec<FreePart> {
        let end = from + f64::from(ticks);
        let felt = free.accelerated(self.acceleration_during(from, end));
        let strain = self.strain_until(end);
        let split = Split::new(ticks, self.tick_s, &felt, strain);
        let part = |part: u32| {
            let now = from + f64::from(part) * split.part_ticks;
            let next = now + split.part_ticks;
            let forces = free.accelerated(self.acceleration_during(now, next)).forces;
            FreePart {
                from_s: now * self.tick_s,
                dt_s: split.part_ticks * self.tick_s,
                forces: FlowForces { gravity: split.gravity * forces.gravity, ..forces },
                pushes: self.pushes_during(now, next),
                evaporated_nm: self.evaporated_nm(now + 0.5 * split.part_ticks),
                black_nm: BLACK_FILM_NM,
                strain,
            }
        };
        (0..split.parts).map(part).collect()
    }

    /// How film collapses to black film until a time in ticks.
    fn blackening(&self, free: &FreeFlow, ticks: f64) -> BlackeningLaw {
        // A remap that is due comes with a step's end.
        let window = f64::from(self.remap_ticks) + free.ticks_per_step(self.tick_s) as f64;
        let from = (ticks - window).max(0.0);
        let [from_nm, evaporated_nm] = [from, ticks].map(|ticks| self.evaporated_nm(ticks));
        let ticks_per_nm = (ticks - from) / (evaporated_nm - from_nm);
        let aged = |(nucleus, nm): (Nucleus, f64)| {
            // A spot that is narrower than cells would not be round.
            let radius = nucleus.radius.max(2.0 * self.cell_angle());
            (Nucleus { radius, ..nucleus }, ((evaporated_nm - nm) * ticks_per_nm) as u32)
        };
        let seed = free.seed ^ self.initial.seed();
        BlackeningLaw {
            nuclei: nuclei(seed, from_nm, evaporated_nm).rev().take(MAX_NUCLEI).map(aged).collect(),
            ..BlackeningLaw::new(evaporated_nm, self.tick_s)
        }
    }

    /// How film leaves at its rim until a time in ticks, if it does, and the maximum ticks between two remaps.
    fn draining(&self, free: &FreeFlow, ticks: f64) -> Option<(DrainLaw, u32)> {
        let regeneration = self.regeneration();
        if regeneration.is_none() && free.drainage == 0.0 {
            return None;
        }
        let max_ticks = latest_ticks(regeneration.is_some(), self.remap_ticks, self.tick_s);
        // A remap that is due comes with a step's end.
        let window = max_ticks + free.ticks_per_step(self.tick_s) as f64;
        let patches = self.patches_during(ticks - window, ticks);
        let aged = |patch: Patch| (patch.middle, patch.thickness, (ticks - patch.time_s / self.tick_s).max(0.0) as u32);
        let law = DrainLaw {
            gravity: free.forces.gravity,
            flux: free.drainage * self.tick_s,
            evaporated_nm: self.evaporated_nm(ticks),
            black_nm: BLACK_FILM_NM,
            drop_rad: if self.cap().is_some() { 0.0 } else { self.drop_rad().unwrap_or(DROP_RAD) },
            patch_radius: regeneration.map_or(1.0, |regeneration| regeneration.radius),
            patches: patches.into_iter().map(aged).collect(),
        };
        Some((law, max_ticks as u32))
    }
}
