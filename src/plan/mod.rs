//! When: what a picture needs, what the GPU already holds, and the passes in between.
//!
//! A *product* is what a pass leaves on the GPU, and its *key* is all that the pass reads. A product is stale exactly where the requested key
//! differs from the present one; there are no dirty flags. [`plan()`] is pure, has no GPU types, and is the only place where work is skipped:
//! a scene that did not change plans nothing, a new exposure plans a tonemap, a film at rest is never stepped, and a film that is far away has
//! fewer cells.

mod bodies;
mod checkpoints;
mod crowd;
mod detail;
mod fields;
mod films;
pub mod keys;
mod laws;
mod lender;
mod light;
mod pass;
mod request;
mod resources;
mod shot;
mod sight;
mod story;
mod turns;
mod work;

use std::fmt;

pub use checkpoints::Checkpoints;
pub use detail::{film_grids, settle_detail};
use fields::StepBudget;
pub use keys::{
    BLACK_FILM_NM, BackdropKey, Body, BodyKind, BubbleKey, CameraKey, DefocusKey, DrawKey, EnvironmentKey, FieldKey,
    FilmBoundary, FilmColours, FilmKey, FlowLaw, FreeFlow, LentFilm, LightKey, Lighting, MAX_RIM_PATCHES, Moment,
    OpenHoleKey, Opening, OpticsKey, PlateKey, QuadratureKey, Rendering, RestingFilm, SmallBubble, TableKey,
    TonemapKey, exposed_ev, range_nm, remaining_nm,
};
pub use lender::film_owners;
pub use pass::{Pass, Reason};
pub use request::{film_index, request};
pub use resources::{Resources, SpectralLight};
pub use shot::{LensSample, Shot};
pub use story::Story;
pub use work::{Prepared, Product, SeedKey, Work};

/// How much work may be done before the next picture must be shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// All work: a file is being made.
    Whole,
    /// The work of one frame, the rest later: a window is waiting. A new table starts coarse, and a film catches up in portions; since people in
    /// windows go back in time, it leaves checkpoints.
    Frame {
        /// Cells of all films together that are stepped while films catch up; each frame takes one step at least.
        cells: u64,
    },
}

impl Pace {
    /// A frame on a device of which nothing is known.
    pub const UNMEASURED: Self = Self::Frame { cells: 800_000 };
}

/// What a picture needs.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameRequest {
    /// The finished picture; the keys of everything before it are inside.
    pub picture: TonemapKey,
    /// For each film, in sight or not, whether it can move: fields of no other films are kept.
    pub has_field: Vec<bool>,
    /// How much work may be done at once.
    pub pace: Pace,
}

/// What is on the GPU: empty at first, and empty again after a lost device.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GpuState {
    /// The products of each light; the scene's own light is the first.
    pub lights: Vec<LightState>,
    /// The field of each film, by the film's index.
    pub fields: Vec<Option<FieldState>>,
    /// The hole in each film that bursts, by the film's index.
    pub holes: Vec<Option<OpenHoleKey>>,
    /// The photograph behind the bubbles.
    pub plate: Option<PlateKey>,
    /// The linear picture.
    pub radiance: Option<DrawKey>,
    /// The finished picture.
    pub picture: Option<TonemapKey>,
}

/// The products of one light on the GPU.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightState {
    /// The colours of films of each material.
    pub films: Vec<FilmColoursState>,
    /// The environment.
    pub environment: Option<EnvironmentKey>,
    /// The environment as it is seen behind the bubbles, where that is out of focus.
    pub defocused: Option<DefocusKey>,
}

/// What there is on the GPU of the colours of films of one material in a light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmColoursState {
    /// The table in use.
    pub table: Option<TableKey>,
    /// A table that is being baked, and how many of its rows are done.
    pub baking: Option<(TableKey, u32)>,
    /// The quadrature.
    pub quadrature: Option<QuadratureKey>,
}

/// A film's field: its state at a tick, the moment that its shown thickness belongs to, and earlier states.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldState {
    /// Seed, law and the tick of the state.
    pub key: FieldKey,
    /// Moment shown, if any was.
    pub shown: Option<Moment>,
    /// Whether the film has come to rest, as the device has found.
    pub rest: Option<RestingFilm>,
    /// States to go back to.
    pub checkpoints: Checkpoints,
}

/// The passes to run, in order, and the state of the GPU afterwards.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Passes, each with its reason.
    pub steps: Vec<(Pass, Reason)>,
    /// What is on the GPU once they have run.
    pub after: GpuState,
    /// Whether the requested picture is then complete; if not, plan again.
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
            Pass::Draw(key) => key.size.map(u64::from).iter().product::<u64>() * key.pictures(),
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
                Pass::Draw(key) => {
                    let [width, height] = key.size;
                    format!("{width}x{height}, bubbles: {}", key.bubbles.len() + key.small.len())
                }
                Pass::Tonemap(key) => format!("exposure {} EV", key.exposure_ev),
                Pass::FitQuadrature { key, .. } => {
                    format!("{} wavelengths, {}, films to {} nm", key.count(), key.quality.name(), key.range_nm)
                }
                Pass::DefocusBackdrop { key, .. } => {
                    let disc_deg = 2.0 * key.half_angle_rad.to_degrees();
                    format!("each point a disc of {disc_deg:.2}°, tiles: {}", key.tiles.iter().count())
                }
                Pass::UploadPlate(key) => {
                    let ([width, height], [of_width, of_height]) = (key.size, key.plate.size());
                    format!("{width}x{height}, from {of_width}x{of_height} pixels")
                }
                Pass::UploadEnvironment { key, .. } => format!("6x{0}x{0} texels", key.size()),
            };
            writeln!(f, "{:<18} {detail}: {reason}", pass.name())?;
        }
        Ok(())
    }
}

/// Rows of a table baked a frame while a window waits: on a software rasteriser about 20 ms of 64 columns.
const ROWS_PER_FRAME: u32 = 256;
/// Rows baked in one go otherwise, so that no single dispatch runs long enough for a driver to kill it.
const ROWS_PER_DISPATCH: u32 = 512;
/// How much coarser than the requested table the first table is that a waiting window gets.
const COARSE: u32 = 16;
/// The passes that lead from the state of the GPU to the requested frame.
#[must_use]
pub fn plan(request: &FrameRequest, state: &GpuState) -> Plan {
    let mut planner = Planner {
        steps: Vec::new(),
        after: state.clone(),
        pace: request.pace,
        budget: StepBudget::of(request.pace),
        complete: true,
    };
    planner.drop_unneeded(request);
    let mut picture = request.picture.clone();
    let draw = &mut picture.draw;
    let needs_environment = draw.needs_environment();
    let defocus: Vec<Option<DefocusKey>> = draw.lights().map(|lighting| draw.defocus(lighting)).collect();
    let shown: Vec<bool> = (0..draw.lighting.films.len()).map(|material| draw.shows(material)).collect();
    planner.after.lights.resize_with(1 + draw.spectral_lights.len(), LightState::default);
    for (light, lighting) in std::iter::once(&mut draw.lighting).chain(&mut draw.spectral_lights).enumerate() {
        planner.after.lights[light].films.resize_with(lighting.films.len(), FilmColoursState::default);
        for (material, colours) in lighting.films.iter_mut().enumerate().filter(|(material, _)| shown[*material]) {
            colours.table = colours.table.as_ref().map(|table| planner.table([light, material], table));
            planner.quadrature([light, material], &colours.quadrature);
        }
        if needs_environment {
            planner.environment(light, &lighting.environment);
        }
    }
    for (light, requested) in defocus.into_iter().enumerate() {
        planner.defocus(light, requested);
    }
    planner.plate(draw.plate.as_ref());
    planner.fields(draw);
    for bubble in &draw.bubbles {
        if let Some(hole) = bubble.open_hole() {
            planner.hole(bubble.index, hole);
        }
    }
    planner.picture(&picture);
    Plan { steps: planner.steps, after: planner.after, complete: planner.complete }
}

struct Planner {
    steps: Vec<(Pass, Reason)>,
    after: GpuState,
    pace: Pace,
    budget: Option<StepBudget>,
    complete: bool,
}

impl Planner {
    /// Forgets what no picture of the scene can need: lights, films and holes of other scenes. A film out of sight stays, for its past is long.
    fn drop_unneeded(&mut self, request: &FrameRequest) {
        let draw = &request.picture.draw;
        self.after.lights.truncate(1 + draw.spectral_lights.len());
        self.after.fields.truncate(request.has_field.len());
        for (field, _) in self.after.fields.iter_mut().zip(&request.has_field).filter(|(_, has_field)| !**has_field) {
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

    /// Plans the table of a light and a material, and returns the table that the frame is drawn with.
    fn table(&mut self, [light, material]: [usize; 2], requested: &TableKey) -> TableKey {
        let state = &mut self.after.lights[light].films[material];
        if state.table.as_ref() == Some(requested) {
            state.baking = None;
            return requested.clone();
        }
        let coarse = requested.coarser(COARSE);
        let reason = if state.table.is_none() { Reason::Missing } else { Reason::Changed("film or light") };
        if self.pace != Pace::Whole && state.table.as_ref() != Some(&coarse) {
            state.table = Some(coarse.clone());
            state.baking = None;
            self.push(Pass::BakeTable { light, material, key: coarse.clone(), rows: 0..coarse.rows }, reason);
            self.complete = false;
            return coarse;
        }
        self.bake([light, material], requested, reason);
        self.after.lights[light].films[material].table.clone().unwrap_or(coarse)
    }

    fn bake(&mut self, [light, material]: [usize; 2], requested: &TableKey, reason: Reason) {
        let mut done = match &self.after.lights[light].films[material].baking {
            Some((key, rows)) if key == requested => *rows,
            _ => 0,
        };
        let (portion, portions) = match self.pace {
            Pace::Frame { .. } => (ROWS_PER_FRAME, 1),
            Pace::Whole => (ROWS_PER_DISPATCH, u32::MAX),
        };
        for _ in 0..portions {
            let rows = done..(done + portion).min(requested.rows);
            done = rows.end;
            let reason = if rows.start == 0 { reason } else { Reason::Unfinished };
            self.push(Pass::BakeTable { light, material, key: requested.clone(), rows }, reason);
            if done == requested.rows {
                let state = &mut self.after.lights[light].films[material];
                (state.table, state.baking) = (Some(requested.clone()), None);
                return;
            }
        }
        self.after.lights[light].films[material].baking = Some((requested.clone(), done));
        self.complete = false;
    }

    fn quadrature(&mut self, [light, material]: [usize; 2], requested: &QuadratureKey) {
        let current = &mut self.after.lights[light].films[material].quadrature;
        if let Some(reason) = changed(current.as_ref(), requested, |_, _| "film, light or quality") {
            *current = Some(requested.clone());
            self.push(Pass::FitQuadrature { light, material, key: requested.clone() }, reason);
        }
    }

    fn environment(&mut self, light: usize, requested: &EnvironmentKey) {
        let current = &mut self.after.lights[light].environment;
        if let Some(reason) = changed(current.as_ref(), requested, |_, _| "environment") {
            *current = Some(requested.clone());
            self.push(Pass::UploadEnvironment { light, key: requested.clone() }, reason);
        }
    }

    fn defocus(&mut self, light: usize, requested: Option<DefocusKey>) {
        let present = self.after.lights[light].defocused.take();
        let Some(requested) = requested else { return };
        let reason =
            present.as_ref().map_or(Reason::Missing, |_| Reason::Changed("environment, lens or what is in sight"));
        let had = present.filter(|present| present.is_same_map(&requested)).map(|present| present.tiles);
        let had = had.unwrap_or_default();
        let missing = DefocusKey { tiles: requested.tiles.without(had), ..requested.clone() };
        self.after.lights[light].defocused = Some(DefocusKey { tiles: requested.tiles.union(had), ..requested });
        if !missing.tiles.is_empty() {
            self.push(Pass::DefocusBackdrop { light, key: missing, adds: !had.is_empty() }, reason);
        }
    }

    fn plate(&mut self, requested: Option<&PlateKey>) {
        let current = &mut self.after.plate;
        let Some(requested) = requested else {
            *current = None;
            return;
        };
        if let Some(reason) = changed(current.as_ref(), requested, |_, _| "the photograph or the picture's size") {
            *current = Some(requested.clone());
            self.push(Pass::UploadPlate(requested.clone()), reason);
        }
    }

    fn hole(&mut self, film: usize, requested: OpenHoleKey) {
        if self.after.holes.len() <= film {
            self.after.holes.resize(film + 1, None);
        }
        let current = &mut self.after.holes[film];
        if let Some(reason) = changed(current.as_ref(), &requested, |_, _| "the moment") {
            *current = Some(requested.clone());
            self.push(Pass::OpenHole { film, key: requested }, reason);
        }
    }

    fn picture(&mut self, requested: &TonemapKey) {
        if let Some(reason) = changed(self.after.radiance.as_ref(), &requested.draw, DrawKey::difference) {
            self.push(Pass::Draw(requested.draw.clone()), reason);
            self.after.radiance = Some(requested.draw.clone());
        }
        if let Some(reason) = changed(self.after.picture.as_ref(), requested, TonemapKey::difference) {
            self.push(Pass::Tonemap(requested.clone()), reason);
            self.after.picture = Some(requested.clone());
        }
    }
}

/// Why a product must be made again, or `None` if it is up to date.
fn changed<K: PartialEq>(
    current: Option<&K>,
    requested: &K,
    difference: impl Fn(&K, &K) -> &'static str,
) -> Option<Reason> {
    match current {
        None => Some(Reason::Missing),
        Some(current) if current == requested => None,
        Some(current) => Some(Reason::Changed(difference(current, requested))),
    }
}

#[cfg(test)]
mod tests;
