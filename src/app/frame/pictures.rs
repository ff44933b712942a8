//! Pictures that are drawn beside the window: the picture that it shows, and others that are asked for between two of them.

use std::{collections::VecDeque, path::PathBuf, time::Duration};

use web_time::Instant;

use super::{Due, Progress, View};
use crate::{
    app::{
        capture::{self, Capture},
        compare::Want,
        model::Model,
        panels,
        producer::Producer,
        render_thread::Finished,
        step_pace::StepPace,
    },
    output::Metadata,
    physics::colour::Gamut,
    plan::{FilmKey, FrameRequest, GpuState, Pace, Plan, Rendering, Shot, TonemapKey, plan},
};

/// Redraws of the panels alone that come before the first picture: until all of them stand there.
const PANELS_FIRST: u64 = panels::Part::LAST.frames();
/// The redraw of them after which the picture's size is known.
const PICTURE_SIZED: u64 = panels::Part::Header.frames();
/// How long a redraw waits for its picture. Most pictures come sooner; a window that waits longer is felt to stick.
const PATIENCE: Duration = Duration::from_millis(50);
/// Time after which people are told that a picture is being drawn.
const SILENCE: Duration = Duration::from_millis(250);
/// That time while a film runs: a sign that came and went with each picture of it would flicker.
const SILENCE_IN_MOTION: Duration = Duration::from_secs(1);
/// Time between two redraws of panels on which something moves while a picture is drawn: a software rasteriser draws both, and takes a fifth as long
/// for the panels as for the picture.
const MEANWHILE: Duration = Duration::from_millis(400);
/// Time that a picture rests after it failed: nothing is gained by failing at every frame.
const REST: Duration = Duration::from_secs(1);

/// What a picture is drawn for.
pub(super) enum Purpose {
    /// It is shown. It is of this one of the scenes that were opened.
    Show(u64),
    /// It is saved as a file: radiance, or what people see.
    Save {
        /// Whether the file holds radiance.
        radiance: bool,
        /// The file.
        path: PathBuf,
        /// What it says of itself.
        metadata: Metadata,
    },
    /// It is compared with another one.
    Compare(Want),
}

/// A picture that is being drawn.
struct Begun {
    request: FrameRequest,
    purpose: Purpose,
    /// The clock's tick before the redraw that began it.
    first_tick: u64,
    /// The clock's tick that it is of.
    tick: u64,
    /// The tick before which the clock is not taken back, should films not keep up.
    earliest_tick: u64,
    since: Instant,
}

/// The pictures to draw.
pub(super) struct Pictures {
    producer: Producer,
    pace: StepPace,
    /// Redraws so far, as far as the first picture.
    redraws: u64,
    /// Those that are drawn before the next one that is shown.
    asked: VecDeque<(FrameRequest, Purpose)>,
    /// The one that waits for what the producer computes.
    waiting: Option<(FrameRequest, Purpose)>,
    begun: Option<Begun>,
    /// Whether the picture that comes next was asked for by an earlier redraw: the model may be another one since.
    is_late: bool,
    /// Ticks that passed while the picture before came late: films have had no chance to keep up with them.
    late_ticks: u64,
    /// Whether the next picture is drawn although it may be there already.
    forgotten: bool,
    rests_until: Option<Instant>,
}

/// What became of a picture.
enum Drawn {
    /// It is there.
    Yes(Box<(Begun, Finished)>),
    /// Not yet: the window is woken when it is.
    Waits,
    /// It cannot be drawn, and why.
    Failed(Purpose, String),
}

impl Pictures {
    pub fn new(producer: Producer) -> Self {
        Self {
            producer,
            pace: StepPace::default(),
            redraws: 0,
            asked: VecDeque::new(),
            waiting: None,
            begun: None,
            is_late: false,
            late_ticks: 0,
            forgotten: false,
            rests_until: None,
        }
    }

    /// Whether the panels stand there, and the window can be painted.
    pub fn have_panels(&self) -> bool {
        self.redraws == PANELS_FIRST
    }

    /// Draws the next picture anew, because its shaders are others.
    #[cfg(all(debug_assertions, not(target_arch = "wasm32")))]
    pub fn forget(&mut self) {
        self.forgotten = true;
    }
}

impl View {
    /// Draws towards the picture of the model; returns whether the pixels of the shown picture changed.
    pub(super) fn draw_picture(&mut self, model: &mut Model, first_tick: u64, due: &mut Due) -> bool {
        if self.pictures.rests_until.is_some_and(|until| due.now < until) {
            due.at_latest(self.pictures.rests_until);
            return false;
        }
        self.pictures.rests_until = None;
        if self.pictures.redraws < PANELS_FIRST {
            self.pictures.redraws += 1;
            if self.pictures.redraws == PICTURE_SIZED {
                self.prepare_first(model);
            }
            due.after(Duration::ZERO);
            return false;
        }
        loop {
            match self.bring(model, first_tick) {
                Drawn::Yes(drawn) => {
                    let (Begun { request, purpose, tick, earliest_tick, .. }, finished) = *drawn;
                    match purpose {
                        Purpose::Show(scene) => {
                            (model.pictured, model.pictured_tick) = (Some(scene), tick);
                            return self.show(model, request, &finished, [first_tick, earliest_tick], due);
                        }
                        purpose => self.hand_out(&request, purpose, due),
                    }
                }
                Drawn::Waits => {
                    self.wait(model, first_tick, due);
                    return false;
                }
                Drawn::Failed(purpose, text) => {
                    // The message itself is to be shown at once.
                    due.after(Duration::ZERO);
                    model.drawing = false;
                    match purpose {
                        Purpose::Show(_) => {
                            model.messages.problem(&text);
                            self.progress = Progress::Failed(text);
                            self.pictures.rests_until = Some(due.now + REST);
                            return false;
                        }
                        Purpose::Save { .. } => model.messages.problem(format!("the picture is not saved: {text}")),
                        Purpose::Compare(_) => model.messages.problem(text),
                    }
                }
            }
        }
    }

    /// Has what the first picture begins with computed, while the panels come.
    fn prepare_first(&mut self, model: &Model) {
        // What fails here fails again where the picture is drawn, and is told there.
        let request = request(model, self.picture_size, Pace::UNMEASURED);
        if let (Some(renderer), Ok(request)) = (self.stage.drawing.renderer(), request) {
            let plan = plan(&request, renderer.state());
            self.pictures.producer.prepare(&plan, &mut renderer.prepared);
        }
    }

    /// Asks for a picture that is drawn before the next one that is shown.
    pub(super) fn ask_for_picture(&mut self, request: FrameRequest, purpose: Purpose) {
        self.pictures.asked.push_back((request, purpose));
    }

    /// Draws towards what is asked for, or towards the picture that the model shows, or towards the one that has waited for the producer. Of a history
    /// that is edited while the producer works some pictures are thus shown, and the last one.
    fn bring(&mut self, model: &Model, first_tick: u64) -> Drawn {
        let mut patience = Duration::ZERO;
        if let Some(renderer) = self.stage.drawing.renderer() {
            let pictures = &mut self.pictures;
            let (request, purpose) = match (pictures.asked.pop_front(), pictures.waiting.take()) {
                (Some(asked), waiting) => {
                    pictures.waiting = waiting;
                    asked
                }
                (None, Some(waiting)) => waiting,
                (None, None) => match request(model, self.picture_size, pictures.pace.of_frame()) {
                    Ok(request) => (request, Purpose::Show(model.opened)),
                    Err(text) => return Drawn::Failed(Purpose::Show(model.opened), text),
                },
            };
            if std::mem::take(&mut pictures.forgotten) {
                renderer.forget_picture();
            }
            let plan = plan(&request, renderer.state());
            if matches!(purpose, Purpose::Show(_)) && !pictures.producer.prepare(&plan, &mut renderer.prepared) {
                pictures.waiting = Some((request, purpose));
                return Drawn::Waits;
            }
            let earliest_tick = first_tick.saturating_sub(std::mem::take(&mut pictures.late_ticks));
            pictures.begun = Some(Begun {
                request,
                purpose,
                first_tick,
                tick: model.clock.tick,
                earliest_tick,
                since: Instant::now(),
            });
            self.stage.drawing.begin(plan);
            patience = PATIENCE;
        }
        let Some(finished) = self.stage.drawing.finished(patience) else { return Drawn::Waits };
        match (self.pictures.begun.take(), &finished.result) {
            (Some(begun), Ok(())) => Drawn::Yes(Box::new((begun, finished))),
            (Some(begun), Err(error)) => Drawn::Failed(begun.purpose, error.to_string()),
            (None, _) => Drawn::Waits,
        }
    }

    /// The picture is not there yet.
    fn wait(&mut self, model: &mut Model, first_tick: u64, due: &mut Due) {
        if !self.waits_for_the_moment(model) {
            self.progress = Progress::Under;
        }
        self.pictures.is_late = true;
        match &self.pictures.begun {
            // The film's time goes on while a picture of it is drawn.
            Some(begun) if begun.first_tick == first_tick => {}
            // Time stands until its picture is there.
            _ => model.clock.hold(0, first_tick),
        }
        let runs = model.clock.running && model.pictured.is_some();
        let silence = if runs { SILENCE_IN_MOTION } else { SILENCE };
        let told = self.pictures.begun.as_ref().map(|begun| begun.since + silence);
        let is_told = told.is_none_or(|told| due.now >= told);
        if is_told && !std::mem::replace(&mut model.drawing, true) {
            due.after(Duration::ZERO);
        }
        due.at_latest(told.filter(|_| !is_told));
        // The panels ask for more than that while a sign on them moves.
        due.at = due.at.map(|at| at.max(due.now + MEANWHILE));
    }

    /// Whether the picture that comes is another one than the shown picture by its moment alone, as those of a running film are.
    fn waits_for_the_moment(&self, model: &Model) -> bool {
        let Pictures { begun, waiting, .. } = &self.pictures;
        let request = begun.as_ref().map(|begun| &begun.request).or(waiting.as_ref().map(|(request, _)| request));
        let lights = |shown: &TonemapKey| request.is_some_and(|request| has_lights_of(request, shown));
        model.clock.running && model.is_pictured() && self.shown.as_ref().is_some_and(lights)
    }

    /// A picture is there, and shown with the next paint; returns whether its pixels are others.
    fn show(
        &mut self,
        model: &mut Model,
        request: FrameRequest,
        Finished { plan, ms, .. }: &Finished,
        [first_tick, earliest_tick]: [u64; 2],
        due: &mut Due,
    ) -> bool {
        model.drawing = false;
        let is_late = std::mem::take(&mut self.pictures.is_late);
        let is_done = is_done(&request, plan, model.clock.running);
        if is_late || !plan.complete || !is_done {
            due.after(Duration::ZERO);
        }
        let Some(renderer) = self.stage.drawing.renderer() else { return false };
        hold_clock(model, &request, renderer.state(), earliest_tick);
        if is_late {
            self.pictures.late_ticks = model.clock.tick.saturating_sub(first_tick);
        }
        // Times arrive when the device is polled; one that is lost is found out at the next redraw.
        let _ = renderer.gpu.device.poll(wgpu::PollType::Poll);
        let passes = renderer.times.take();
        self.pictures.pace.add(&passes, renderer.times.take_steps());
        model.costs.add_passes(passes);
        if !plan.is_empty() {
            model.costs.add(*ms, renderer.counts);
        }
        self.progress = if is_done && model.behind_ticks == 0 { Progress::Done } else { Progress::Under };
        self.shown = Some(request.picture);
        !plan.is_empty()
    }

    /// A picture is there that is not shown.
    fn hand_out(&mut self, request: &FrameRequest, purpose: Purpose, due: &mut Due) {
        let Some(renderer) = self.stage.drawing.renderer() else { return };
        let size = request.picture.draw.size;
        match purpose {
            Purpose::Show(_) => {}
            Purpose::Save { radiance, path, metadata } => {
                let readback = if radiance { renderer.read_radiance() } else { renderer.read_picture() };
                self.captures.extend(readback.map(|readback| Capture { readback, size, radiance, path, metadata }));
            }
            Purpose::Compare(want) => {
                self.compared = renderer.read_picture().map(|readback| (want, size, readback));
                due.after(Duration::ZERO);
            }
        }
    }

    /// Starts to save the picture.
    pub fn capture(&mut self, model: &mut Model, radiance: bool, path: PathBuf) {
        model.follow_keyframes();
        match capture::request(model, self.picture_size, radiance) {
            Ok(request) => {
                self.ask_for_picture(request, Purpose::Save { radiance, path, metadata: capture::metadata(model) });
            }
            Err(text) => model.messages.problem(text),
        }
    }
}

/// What the picture of the model needs now. A scene that nothing is seen of yet begins with a preview.
fn request(model: &Model, size: [u32; 2], pace: Pace) -> Result<FrameRequest, String> {
    let shot =
        Shot { size, moment: model.clock.moment(&model.scene.motion), full_precision: false, gamut: Gamut::Srgb, pace };
    let mut request =
        model.scene.request_from(&model.scene.camera, &model.resources, &shot).map_err(|error| error.to_string())?;
    if !model.is_pictured() {
        request.picture = request.picture.preview().unwrap_or(request.picture);
    }
    Ok(request)
}

/// Whether a picture is the requested one after a plan, and no preview of it. Films that cannot keep up with a running clock make it no other
/// picture: it stands still until they have come.
fn is_done(request: &FrameRequest, plan: &Plan, runs: bool) -> bool {
    if request.picture.draw.rendering == Rendering::Preview {
        return false;
    }
    let made = plan.after.picture.as_ref();
    plan.complete || runs && made.is_some_and(|made| has_lights_of(request, made))
}

/// Whether a picture is requested in the lights of another one.
fn has_lights_of(request: &FrameRequest, other: &TonemapKey) -> bool {
    other.draw.lights().eq(request.picture.draw.lights())
}

/// Takes back the ticks of this frame that the films did not reach, and notes how far they are behind an edited history.
fn hold_clock(model: &mut Model, request: &FrameRequest, state: &GpuState, first_tick: u64) {
    let mut reached = 0;
    let mut missing = 0;
    for (index, film) in request.picture.draw.films() {
        if let (FilmKey::Field(film), Some(Some(field))) = (film, state.fields.get(index)) {
            // A film at rest has reached the requested tick, though its picture is of when it came to rest.
            if field.rest.is_some() {
                continue;
            }
            let shown = field.shown.unwrap_or(field.key.moment).tick;
            reached = reached.max(shown);
            missing = missing.max(film.moment.tick.saturating_sub(shown));
        }
    }
    if missing > 0 {
        model.pictured_tick = reached;
        let requested = model.clock.tick;
        model.clock.hold(reached, first_tick);
        missing = missing.saturating_sub(requested - model.clock.tick);
    }
    model.behind_ticks = missing;
}
