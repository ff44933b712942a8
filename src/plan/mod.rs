//! When: what a picture needs, what is already there, and the passes in between.
//!
//! A *product* is what a pass leaves on the GPU, and its *key* is all that the pass reads. A product is stale exactly where the wanted key
//! differs from the one that is there; there are no dirty flags. [`plan`] is pure, has no GPU types, and is the only place where work is
//! skipped: a scene that did not change plans nothing, a new exposure plans a tonemap, a film at rest is never stepped, one that is far away
//! has fewer cells.

mod checkpoints;
mod detail;
mod fields;
mod films;
pub mod keys;
mod laws;
mod pass;
mod story;
mod turns;
mod want;

use std::fmt;

pub use checkpoints::Checkpoints;
pub use detail::{film_grids, settle_detail};
use fields::StepBudget;
pub use keys::{
    BLACK_FILM_NM, BackdropKey, BandsKey, BubbleKey, CameraKey, DrawKey, EnvironmentKey, FieldKey, FilmEnd, FilmKey,
    FlowLaw, FreeFlow, LightKey, Lighting, MAX_RIM_PATCHES, Moment, OpenHoleKey, Opening, OpticsKey, RestingFilm,
    TableKey, TonemapKey, exposed_ev, left_nm, range_nm,
};
pub use pass::{Pass, Reason};
pub use story::Story;
pub use want::{Lamp, Resources, Shot, has_one_film, want};

/// How much may be done before the next picture must be out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// All of it: a file is being made.
    Whole,
    /// A frame's worth, the rest later: a window is waiting. A new table starts coarse, and a film catches up in portions; since people in
    /// windows go back in time, it leaves checkpoints.
    Frame,
}

/// What a picture needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Want {
    /// The finished picture; the keys of everything before it are inside.
    pub picture: TonemapKey,
    /// For each bubble of the scene, in sight or not, whether its film can move: fields of no other films are kept.
    pub has_field: Vec<bool>,
    /// How much may be done at once.
    pub pace: Pace,
}

/// What is on the GPU. Nothing at first, and nothing after a lost device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Have {
    /// What belongs to each light, the scene's own first.
    pub lights: Vec<LightHave>,
    /// The field of each film, by the film's index.
    pub fields: Vec<Option<FieldHave>>,
    /// The hole in each film that bursts, by the film's index.
    pub holes: Vec<Option<OpenHoleKey>>,
    /// The linear picture.
    pub radiance: Option<DrawKey>,
    /// The finished picture.
    pub picture: Option<TonemapKey>,
}

/// What is there of one light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightHave {
    /// The table in use.
    pub table: Option<TableKey>,
    /// A table in the making, and how many of its rows are done.
    pub baking: Option<(TableKey, u32)>,
    /// The bands.
    pub bands: Option<BandsKey>,
    /// The environment.
    pub environment: Option<EnvironmentKey>,
}

/// A film's field: its state at a tick, the moment that its shown thickness belongs to, and earlier states.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldHave {
    /// Seed, law and the tick of the state.
    pub state: FieldKey,
    /// Moment shown, if any was.
    pub shown: Option<Moment>,
    /// Whether the film has come to rest, as the device has found.
    pub rest: Option<RestingFilm>,
    /// States to go back to.
    pub checkpoints: Checkpoints,
}

/// The passes to run, in order, and what will be there afterwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Passes, each with its reason.
    pub steps: Vec<(Pass, Reason)>,
    /// What is on the GPU once they have run.
    pub after: Have,
    /// Whether the wanted picture will then be there; else plan again.
    pub complete: bool,
}

impl Plan {
    /// Whether there is nothing to do.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// The work of the passes that take long: cells stepped and pixels drawn, which take about as long each.
    #[must_use]
    pub fn work(&self) -> u64 {
        let work = |pass: &Pass| match pass {
            Pass::StepField { key, ticks, .. } => key.steps_from(ticks.start).count() as u64 * key.cell_count(),
            Pass::Draw(key) => key.size.map(u64::from).iter().product::<u64>() * key.lights().count() as u64,
            _ => 0,
        };
        self.steps.iter().map(|(pass, _)| work(pass)).sum()
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_empty() {
            return writeln!(f, "nothing to do");
        }
        for (pass, reason) in &self.steps {
            let detail = match pass {
                Pass::BakeTable { key, rows, .. } => {
                    format!("rows {}..{} of {}, {} columns", rows.start, rows.end, key.rows, key.columns)
                }
                Pass::SeedField { film, key } => {
                    let flow_cells = key.flow_cells.min(key.cells);
                    format!("film {film}, 6x{0}x{0} cells, its flow 6x{flow_cells}x{flow_cells}", key.cells)
                }
                Pass::RestoreField { film, key, .. } => format!("film {film} back to {}", key.moment),
                Pass::SaveField { film, key, .. } => format!("film {film} at {}", key.moment),
                Pass::StepField { film, ticks, .. } => format!("film {film}, ticks {}..{}", ticks.start, ticks.end),
                Pass::ShowField { film, key } => format!("film {film} at {}", key.moment),
                Pass::OpenHole { film, key } => format!("film {film}, {:.4} s after it burst", key.hole.seconds),
                Pass::Draw(key) => format!("{}x{}, bubbles: {}", key.size[0], key.size[1], key.bubbles.len()),
                Pass::Tonemap(key) => format!("exposure {} EV", key.exposure_ev),
                Pass::FitBands { key, .. } => {
                    format!("{} wavelengths, {}, films to {} nm", key.count(), key.quality.name(), key.range_nm)
                }
                Pass::UploadEnvironment { key, .. } => format!("6x{0}x{0} texels", key.size()),
            };
            writeln!(f, "{:<18} {detail}: {reason}", pass.name())?;
        }
        Ok(())
    }
}

/// Rows of a table baked a frame while a window waits: on a software rasteriser about 20 ms of 64 columns.
const ROWS_A_FRAME: u32 = 256;
/// Rows baked in one go otherwise, so that no single dispatch runs long enough for a driver to kill it.
const ROWS_A_DISPATCH: u32 = 512;
/// How much coarser than the wanted table the first one is that a waiting window gets.
const COARSE: u32 = 16;
/// The passes that lead from what is there to what is wanted.
#[must_use]
pub fn plan(want: &Want, have: &Have) -> Plan {
    let mut planner = Planner {
        steps: Vec::new(),
        after: have.clone(),
        pace: want.pace,
        budget: StepBudget::of(want.pace),
        complete: true,
    };
    planner.drop_unneeded(want);
    let mut picture = want.picture.clone();
    let draw = &mut picture.draw;
    let (has_bubbles, needs_environment) = (!draw.bubbles.is_empty(), draw.needs_environment());
    planner.after.lights.resize_with(1 + draw.lamps.len(), LightHave::default);
    for (light, lighting) in std::iter::once(&mut draw.lighting).chain(&mut draw.lamps).enumerate() {
        if has_bubbles {
            lighting.table = lighting.table.as_ref().map(|table| planner.table(light, table));
            planner.bands(light, &lighting.bands);
        }
        if needs_environment {
            planner.environment(light, &lighting.environment);
        }
    }
    let mut order: Vec<usize> = (0..draw.bubbles.len()).collect();
    order.sort_by_key(|index| planner.reached_tick(draw.bubbles[*index].index));
    for index in order {
        if let FilmKey::Field(field) = &mut draw.bubbles[index].film {
            *field = planner.field(want.picture.draw.bubbles[index].index, field);
        }
        if let Some(hole) = draw.bubbles[index].open_hole() {
            planner.hole(draw.bubbles[index].index, hole);
        }
    }
    planner.picture(&picture);
    Plan { steps: planner.steps, after: planner.after, complete: planner.complete }
}

struct Planner {
    steps: Vec<(Pass, Reason)>,
    after: Have,
    pace: Pace,
    budget: Option<StepBudget>,
    complete: bool,
}

impl Planner {
    /// Forgets what no picture of the scene can need: lights, films and holes of other scenes. A film out of sight stays, for its past is long.
    fn drop_unneeded(&mut self, want: &Want) {
        let draw = &want.picture.draw;
        self.after.lights.truncate(1 + draw.lamps.len());
        self.after.fields.truncate(want.has_field.len());
        for (field, _) in self.after.fields.iter_mut().zip(&want.has_field).filter(|(_, has_field)| !**has_field) {
            *field = None;
        }
        for (film, hole) in self.after.holes.iter_mut().enumerate() {
            *hole =
                hole.take().filter(|_| draw.bubbles.iter().any(|bubble| bubble.index == film && bubble.hole.is_some()));
        }
    }

    fn push(&mut self, pass: Pass, reason: Reason) {
        self.steps.push((pass, reason));
    }

    /// Plans a light's table and returns the one that will be there to draw with.
    fn table(&mut self, light: usize, wanted: &TableKey) -> TableKey {
        let have = &mut self.after.lights[light];
        if have.table.as_ref() == Some(wanted) {
            have.baking = None;
            return wanted.clone();
        }
        let coarse = wanted.coarser(COARSE);
        let reason = if have.table.is_none() { Reason::Missing } else { Reason::Changed("film or light") };
        if self.pace == Pace::Frame && have.table.as_ref() != Some(&coarse) {
            have.table = Some(coarse.clone());
            have.baking = None;
            self.push(Pass::BakeTable { light, key: coarse.clone(), rows: 0..coarse.rows }, reason);
            self.complete = false;
            return coarse;
        }
        self.bake(light, wanted, reason);
        self.after.lights[light].table.clone().unwrap_or(coarse)
    }

    fn bake(&mut self, light: usize, wanted: &TableKey, reason: Reason) {
        let mut done = match &self.after.lights[light].baking {
            Some((key, rows)) if key == wanted => *rows,
            _ => 0,
        };
        let (portion, portions) = match self.pace {
            Pace::Frame => (ROWS_A_FRAME, 1),
            Pace::Whole => (ROWS_A_DISPATCH, u32::MAX),
        };
        for _ in 0..portions {
            let rows = done..(done + portion).min(wanted.rows);
            done = rows.end;
            let reason = if rows.start == 0 { reason } else { Reason::Unfinished };
            self.push(Pass::BakeTable { light, key: wanted.clone(), rows }, reason);
            if done == wanted.rows {
                let have = &mut self.after.lights[light];
                (have.table, have.baking) = (Some(wanted.clone()), None);
                return;
            }
        }
        self.after.lights[light].baking = Some((wanted.clone(), done));
        self.complete = false;
    }

    fn bands(&mut self, light: usize, wanted: &BandsKey) {
        let have = &mut self.after.lights[light].bands;
        if let Some(reason) = changed(have.as_ref(), wanted, |_, _| "film, light or quality") {
            *have = Some(wanted.clone());
            self.push(Pass::FitBands { light, key: wanted.clone() }, reason);
        }
    }

    fn environment(&mut self, light: usize, wanted: &EnvironmentKey) {
        let have = &mut self.after.lights[light].environment;
        if let Some(reason) = changed(have.as_ref(), wanted, |_, _| "environment") {
            *have = Some(wanted.clone());
            self.push(Pass::UploadEnvironment { light, key: wanted.clone() }, reason);
        }
    }

    fn hole(&mut self, film: usize, wanted: OpenHoleKey) {
        if self.after.holes.len() <= film {
            self.after.holes.resize(film + 1, None);
        }
        let have = &mut self.after.holes[film];
        if let Some(reason) = changed(have.as_ref(), &wanted, |_, _| "the moment") {
            *have = Some(wanted.clone());
            self.push(Pass::OpenHole { film, key: wanted }, reason);
        }
    }

    fn picture(&mut self, wanted: &TonemapKey) {
        if let Some(reason) = changed(self.after.radiance.as_ref(), &wanted.draw, DrawKey::difference) {
            self.push(Pass::Draw(wanted.draw.clone()), reason);
            self.after.radiance = Some(wanted.draw.clone());
        }
        if let Some(reason) = changed(self.after.picture.as_ref(), wanted, TonemapKey::difference) {
            self.push(Pass::Tonemap(wanted.clone()), reason);
            self.after.picture = Some(wanted.clone());
        }
    }
}

/// Why a product must be made anew, if it must.
fn changed<K: PartialEq>(have: Option<&K>, want: &K, difference: impl Fn(&K, &K) -> &'static str) -> Option<Reason> {
    match have {
        None => Some(Reason::Missing),
        Some(have) if have == want => None,
        Some(have) => Some(Reason::Changed(difference(have, want))),
    }
}

#[cfg(test)]
mod tests;
