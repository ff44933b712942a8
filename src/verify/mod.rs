//! Whether this machine's GPU tells the truth: each part measures what the program computes against an independent reference, and holds it
//! to a limit.

mod antialiasing;
mod crowd;
mod extremes;
mod flow;
mod free_film;
mod hard_light;
pub mod interaction;
mod optics;
mod phenomena;
mod picture;
pub mod played;
mod random;
pub mod reference;
pub mod reference_film;
mod rims;
pub mod sorting;
mod stability;
mod transport;
mod trial;

pub use trial::trial;

use std::time::Instant;

use crate::{
    gpu::{Gpu, GpuError},
    plan::Resources,
    scene::Scene,
};

/// One measurement and its limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What was measured, and one of [`Check::UNITS`] where it has a unit.
    pub name: String,
    /// The measured value.
    pub measured: f64,
    /// The largest value that is right.
    pub limit: f64,
}

impl Check {
    /// A value that must not exceed a limit.
    #[must_use]
    pub fn at_most(name: impl Into<String>, measured: f64, limit: f64) -> Self {
        Self { name: name.into(), measured, limit }
    }

    /// Units that names end in, after a comma; other values have none, but for colour differences.
    pub const UNITS: [&str; 3] = ["nm", "rad/s", "sr"];

    /// The unit of both values, which the name states; empty for plain numbers.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        let last = self.name.rsplit(", ").next().unwrap_or("");
        let stated = Self::UNITS.into_iter().find(|unit| *unit == last);
        stated.or(self.name.contains("dE2000").then_some("dE2000")).unwrap_or("")
    }

    /// Whether the value is within the limit. NaN is not.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.measured <= self.limit
    }
}

/// What can be verified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Colours of films, against the spectral sum in f64.
    Optics,
    /// Whole pictures in coloured light and in hard light, against the f64 picture; pictures of one sample per pixel, against those of many.
    Picture,
    /// Bubbles seen through and in one another, against the f64 picture.
    Crowd,
    /// Tracers moved by published winds, against exact answers.
    Transport,
    /// The flow solver, against exact flows.
    Flow,
    /// Films that end at a bath, a ring or a drop, against theory.
    Rims,
    /// What breaks solvers.
    Stability,
}

impl Part {
    /// All parts, in the order in which they run.
    pub const ALL: &'static [Self] =
        &[Self::Optics, Self::Picture, Self::Crowd, Self::Transport, Self::Flow, Self::Rims, Self::Stability];

    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Optics => "optics",
            Self::Picture => "picture",
            Self::Crowd => "crowd",
            Self::Transport => "transport",
            Self::Flow => "flow",
            Self::Rims => "rims",
            Self::Stability => "stability",
        }
    }

    /// About how many checks it makes, for a display of progress; more with the long ones.
    #[must_use]
    pub fn checks(self) -> u64 {
        self.effort().0
    }

    /// About how many seconds it takes on a software rasteriser with two cores, for a display of progress.
    #[must_use]
    pub fn seconds(self) -> u64 {
        self.effort().1
    }

    fn effort(self) -> (u64, u64) {
        match self {
            Self::Optics => (85, 130),
            Self::Picture => (44, 400),
            Self::Crowd => (32, 200),
            Self::Transport => (45, 60),
            Self::Flow => (35, 160),
            Self::Rims => (27, 90),
            Self::Stability => (125, 700),
        }
    }
}

/// How much to verify.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Extent {
    /// Each kind of check, with few cases and steps: what a developer waits for.
    Short,
    /// All that ends within minutes.
    Full,
    /// What takes longer, too.
    Long,
}

/// How much to verify, and who hears of each check as it is done.
pub struct Run<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// How much to verify.
    pub extent: Extent,
    /// Gives a preset, with all that it names, by its name: files are not read here.
    pub preset: &'a dyn Fn(&str) -> Option<(Scene, Resources)>,
    /// Hears of each check.
    pub report: &'a mut dyn FnMut(Check),
}

impl Run<'_> {
    /// Measures a part.
    pub fn part(&mut self, part: Part) -> Result<(), GpuError> {
        let started = Instant::now();
        match part {
            Part::Optics => optics::run(self),
            Part::Picture => {
                antialiasing::run(self).and_then(|()| picture::run(self)).and_then(|()| hard_light::run(self))
            }
            Part::Crowd => crowd::run(self),
            Part::Transport => transport::run(self),
            Part::Flow => flow::run(self),
            Part::Rims => rims::run(self),
            Part::Stability => stability::run(self),
        }?;
        log::info!("{} verified in {:.0} s", part.name(), started.elapsed().as_secs_f64());
        Ok(())
    }

    /// The short form of something, or the full one.
    fn short_or_full<T>(&self, short: T, full: T) -> T {
        if self.extent >= Extent::Full { full } else { short }
    }

    fn is_long(&self) -> bool {
        self.extent >= Extent::Long
    }

    fn at_most(&mut self, name: impl Into<String>, measured: f64, limit: f64) {
        (self.report)(Check::at_most(name, measured, limit));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_check_can_fail() {
        assert!(Check::at_most("at the limit", 1.0, 1.0).passed());
        assert!(!Check::at_most("beyond", 1.1, 1.0).passed());
        assert!(!Check::at_most("no number", f64::NAN, 1.0).passed());
    }

    #[test]
    fn names_state_units() {
        let unit = |name: &str| Check::at_most(name, 0.0, 1.0).unit();
        assert_eq!(unit("water, D65, one wall to 1500 nm, fast: dE2000 mean"), "dE2000");
        assert_eq!(unit("stirred: fastest flow, rad/s"), "rad/s");
        assert_eq!(unit("thickness that is not even, nm"), "nm");
        assert_eq!(unit("films to 3 nm: drift of mass"), "");
    }
}
