//! What the window shows and what its user has changed: everything that needs neither a window nor a GPU.

mod bubbles;
mod camera;
#[cfg(not(target_arch = "wasm32"))]
mod exports;
mod lesson;
mod light;
mod steps;
mod time;

use std::{collections::BTreeSet, path::PathBuf};

use glam::{DMat3, DVec3};

#[cfg(not(target_arch = "wasm32"))]
use super::exports::Exports;
use super::{
    clock::{Clock, Rate},
    compare::{Compare, Want},
    costs::Costs,
    course::Course,
    edit::Edit,
    gizmo,
    keys::Action,
    lamps::Lamps,
    messages::Messages,
    overlay::Overlay,
    probe::Probe,
    request::{Question, Request, Target},
    spectrum::Editor,
    storage::{Settings, Unsaved},
    time_line::TimeLine,
    tools::{self, Hand, Press, Tool},
    undo::Undo,
    wand::Wand,
};
use crate::{
    input::LoadedScene,
    plan::{Moment, Resources, Story, settle_detail},
    scene::{Change, Motion, MotionChange, preset_toml},
};

/// How far a key tilts gravity, degrees.
const TILT_DEG: f64 = 10.0;

/// The window's state.
pub struct Model {
    /// The scene as edited, with what follows from it.
    pub scene: Story,
    /// What it names.
    pub resources: Resources,
    /// A preset's name or a file's path.
    pub name: String,
    /// Folder that relative paths in the scene start from.
    pub folder: PathBuf,
    /// The file that it is saved to; a preset has none.
    pub file: Option<PathBuf>,
    /// What can be taken back.
    pub undo: Undo,
    /// Film time.
    pub clock: Clock,
    /// How fast it passes.
    pub rate: Rate,
    /// How the time line is used.
    pub time_line: TimeLine,
    /// A kept picture beside the one that is shown.
    pub compare: Compare,
    /// The lesson that is taken.
    pub course: Option<Course>,
    /// What is measured under the pointer.
    pub probe: Probe,
    /// What is laid over the picture.
    pub overlay: Overlay,
    /// How fast the eye goes around its target by itself, degrees per second.
    pub turntable_deg_s: f64,
    /// The moment at which the keyframes last moved the camera, and the state of the scene then; none without keyframes.
    pub followed: Option<(Moment, u64)>,
    /// The moment at which a step was taken back last.
    pub undone_at: Option<Moment>,
    /// Index of the bubble that the film panel shows.
    pub selected: usize,
    /// Indices of bubbles that are selected beside it: edits change them too.
    pub also_selected: BTreeSet<usize>,
    /// Whether they are outlined in the picture, because one was clicked there.
    pub outlines: bool,
    /// Index of the generator that its panel edits.
    pub selected_generator: usize,
    /// The last tick that was ever shown of this history: how far its time line reaches.
    pub furthest_tick: u64,
    /// What a slider of the motion has changed while it is being dragged: it counts once the slider is let go.
    pub motion_draft: Option<MotionChange>,
    /// How the spectrum of the light is edited.
    pub spectrum: Editor,
    /// What the pointer is used for.
    pub tool: Tool,
    /// What the pointer does with it.
    pub hand: Hand,
    /// The bubble that it blows.
    pub wand: Option<Wand>,
    /// The handle of the gizmo that it holds.
    pub gizmo: Option<gizmo::Grip>,
    /// How the lamps of the light are edited.
    pub lamps: Lamps,
    /// Whether the picture stands alone, as in a page that only shows it: without panels, tools and messages.
    pub stands_alone: bool,
    /// Whether the panels are there.
    pub shows_panels: bool,
    /// Whether the picture is alone on the screen.
    pub presents: bool,
    /// Whether the presets are there to choose from.
    pub shows_gallery: bool,
    /// Whether the help is there.
    pub shows_help: bool,
    /// What is being loaded.
    pub loading: Option<String>,
    /// How many scenes were opened.
    pub opened: u64,
    /// Which of them the picture shows, if there is a picture.
    pub pictured: Option<u64>,
    /// The tick that the picture shows: while time passes, the clock is ahead of it.
    pub pictured_tick: u64,
    /// Whether bubbles were added that must be seen.
    pub shows_added: bool,
    /// Whether the picture takes so long to draw that people are told.
    pub drawing: bool,
    /// Ticks that the films are behind the clock.
    pub behind_ticks: u64,
    /// Messages to show.
    pub messages: Messages,
    /// What pictures cost.
    pub costs: Costs,
    /// What has been asked for since the last frame.
    pub requests: Vec<Request>,
    /// What the window keeps from one run to the next.
    pub settings: Settings,
    /// What is exported, and the dialog for it.
    #[cfg(not(target_arch = "wasm32"))]
    pub exports: Exports,
    /// What must be answered first.
    pub question: Option<Question>,
    /// What is asked for once the scene is saved.
    pub once_saved: Option<Request>,
}

impl Model {
    /// A window on a scene, its clock running.
    #[must_use]
    pub fn new(mut loaded: LoadedScene) -> Self {
        // The camera moves from now on, which must not restart a film.
        settle_detail(&mut loaded.scene);
        let mut messages = Messages::default();
        warn(&mut messages, &loaded);
        let name = loaded.name;
        Self {
            scene: Story::new(loaded.scene),
            resources: loaded.resources,
            file: file_of(&name),
            name,
            folder: loaded.folder,
            undo: Undo::default(),
            clock: Clock::default(),
            rate: Rate::default(),
            time_line: TimeLine::default(),
            compare: Compare::default(),
            course: None,
            probe: Probe::default(),
            overlay: Overlay::default(),
            turntable_deg_s: 0.0,
            followed: None,
            undone_at: None,
            selected: 0,
            also_selected: BTreeSet::new(),
            outlines: false,
            selected_generator: 0,
            furthest_tick: 0,
            motion_draft: None,
            spectrum: Editor::default(),
            tool: Tool::default(),
            hand: Hand::default(),
            wand: None,
            gizmo: None,
            lamps: Lamps::default(),
            stands_alone: false,
            shows_panels: true,
            presents: false,
            shows_gallery: false,
            shows_help: false,
            loading: None,
            opened: 1,
            pictured: None,
            pictured_tick: 0,
            shows_added: false,
            drawing: false,
            behind_ticks: 0,
            messages,
            costs: Costs::default(),
            requests: Vec::new(),
            settings: Settings::default(),
            #[cfg(not(target_arch = "wasm32"))]
            exports: Exports::default(),
            question: None,
            once_saved: None,
        }
    }

    /// Shows another scene, from its beginning.
    pub fn adopt(&mut self, mut loaded: LoadedScene) {
        settle_detail(&mut loaded.scene);
        warn(&mut self.messages, &loaded);
        self.opened += 1;
        self.scene = Story::new(loaded.scene);
        self.resources = loaded.resources;
        self.file = file_of(&loaded.name);
        self.name = loaded.name;
        self.folder = loaded.folder;
        self.undo = Undo::default();
        self.clock.reset();
        self.furthest_tick = 0;
        self.behind_ticks = 0;
        (self.time_line.selected, self.time_line.dragged) = (None, None);
        self.probe = Probe::default();
        self.overlay.profile = None;
        self.followed = None;
        self.select_one(0);
        (self.outlines, self.selected_generator) = (false, 0);
        self.motion_draft = None;
        (self.spectrum, self.lamps) = (Editor::default(), Lamps::default());
        // What the hand held is gone.
        (self.hand, self.wand, self.gizmo) = (Hand::default(), None, None);
        self.loading = None;
    }

    /// Whether the picture shows the scene, be it as it was a moment ago.
    #[must_use]
    pub fn is_pictured(&self) -> bool {
        self.pictured == Some(self.opened)
    }

    /// Shows a scene that an earlier window left without saving it.
    pub fn take_up(&mut self, loaded: LoadedScene, work: Unsaved) {
        self.adopt(loaded);
        self.file = work.file;
        self.clock.seek(work.tick);
        self.undo.recovered();
    }

    /// What is lost if the program ends now, if anything is.
    #[must_use]
    pub fn unsaved(&self) -> Option<Unsaved> {
        self.undo.is_dirty().then(|| Unsaved {
            name: self.name.clone(),
            file: self.file.clone(),
            folder: self.folder.clone(),
            tick: self.clock.tick,
            scene: self.scene.to_toml(),
        })
    }

    /// The motion that is in force now.
    #[must_use]
    pub fn motion(&self) -> Motion {
        self.scene.motion_in_force(self.clock.tick).clone()
    }

    /// The end of the time line: the last tick that was shown, at which something happens, or that the camera moves until.
    #[must_use]
    pub fn last_tick(&self) -> u64 {
        let last_event = self.scene.events.last().map_or(0, |event| event.tick);
        let last_keyframe = self.scene.camera.keyframes.last().map_or(0.0, |keyframe| keyframe.time_s);
        let last_keyframe = (last_keyframe / self.scene.motion.tick_s).ceil() as u64;
        self.furthest_tick.max(self.clock.tick).max(last_event).max(last_keyframe)
    }

    /// Asks for something, and first what shall become of work that is not saved, if it would be lost.
    pub fn ask_for(&mut self, request: Request) {
        #[cfg(not(target_arch = "wasm32"))]
        if request == Request::Quit && self.exports.are_wanted() {
            self.question = Some(Question::Exporting);
            return;
        }
        if request.danger().is_some() && self.undo.is_dirty() {
            self.question = Some(Question::Unsaved(request));
        } else {
            self.requests.push(request);
        }
    }

    /// Saves the scene to its file, or asks for one.
    pub fn save(&mut self) {
        self.requests.push(if self.file.is_some() { Request::Save } else { Request::Ask(Target::SaveScene) });
    }

    /// A state of the scene is in a file now.
    pub fn saved(&mut self, path: PathBuf, state: u64) {
        self.messages.note(format!("Saved {}", path.display()));
        self.name = path.display().to_string();
        self.settings.remember(&self.name);
        self.file = Some(path);
        self.undo.saved(state);
        // What was changed while the file was written must not be lost with what follows.
        self.once_saved.take().into_iter().for_each(|request| self.ask_for(request));
    }

    /// The title of the window.
    #[must_use]
    pub fn title(&self) -> String {
        let edited = if self.undo.is_dirty() { " (edited)" } else { "" };
        format!("soapfilm – {}{edited}", self.name)
    }

    /// Lets the pointer, pressed or not, use its tool. Tells whether the camera shall stand.
    pub fn touch(&mut self, pressed: Option<Press>) -> bool {
        if let Some(change) = tools::touch(&mut self.hand, self.tool, &self.scene, self.clock.tick, pressed) {
            if let Change::Drag(drag) = &change {
                self.drag_along(drag);
            }
            self.edit(Edit::Happens(change));
        }
        matches!(self.hand, Hand::Film(_))
    }

    /// Tilts gravity from now on, by angles in degrees to the right of the picture and away from the camera.
    fn tilt(&mut self, right_deg: f64, away_deg: f64) {
        let camera = &self.scene.camera;
        let turn = DMat3::from_axis_angle(camera.forward(), -right_deg.to_radians())
            * DMat3::from_axis_angle(camera.right(), away_deg.to_radians());
        let gravity = turn * DVec3::from(self.motion().gravity_m_s2);
        let gravity_m_s2 = gravity.to_array().map(|part| (part * 1e3).round() / 1e3);
        self.edit(Edit::Motion(Motion { gravity_m_s2, ..self.motion() }.into()));
    }

    /// Does what a key asks for; framing is a gesture on the picture, whose shape only that knows.
    pub fn act(&mut self, action: Action) {
        match action {
            Action::Pause => self.clock.running = !self.clock.running,
            Action::Step => self.clock.step(),
            Action::Reset => self.clock.reset(),
            Action::NewSeed => self.new_seeds(),
            Action::Loop => self.time_line.loops = !self.time_line.loops,
            Action::Delete if self.time_line.selected.is_none() && self.outlines => self.delete_bubbles(),
            Action::Delete => self.remove_selected(),
            Action::Present => self.presents = !self.presents,
            Action::Panels => self.shows_panels = !self.shows_panels,
            Action::Help => self.shows_help = !self.shows_help,
            Action::Dismiss => {
                (self.shows_help, self.presents) = (false, false);
                (self.probe.pinned, self.overlay.profile) = (None, None);
                self.time_line.selected = None;
                self.compare.close();
                self.messages.clear();
            }
            Action::Duplicate => self.duplicate(),
            Action::SelectAll => self.select_all(),
            Action::Keep => self.compare.wants = Some(Want::Keep),
            Action::Undo => self.undo(),
            Action::Redo => self.redo(),
            Action::Open => self.requests.push(Request::Ask(Target::OpenScene)),
            Action::Save => self.save(),
            Action::SaveAs => self.requests.push(Request::Ask(Target::SaveScene)),
            Action::SavePng => self.requests.push(Request::Ask(Target::SavePng)),
            Action::SaveExr => self.requests.push(Request::Ask(Target::SaveExr)),
            #[cfg(not(target_arch = "wasm32"))]
            Action::Export => self.requests.push(Request::Export),
            Action::Quit => self.ask_for(Request::Quit),
            Action::Take(tool) => self.tool = tool,
            Action::TiltRight => self.tilt(TILT_DEG, 0.0),
            Action::TiltLeft => self.tilt(-TILT_DEG, 0.0),
            Action::TiltAway => self.tilt(0.0, TILT_DEG),
            Action::TiltBack => self.tilt(0.0, -TILT_DEG),
            Action::Frame => {}
        }
    }
}

/// The file that a scene of this name is saved to.
fn file_of(name: &str) -> Option<PathBuf> {
    preset_toml(name).is_none().then(|| PathBuf::from(name))
}

/// Says what of a scene no real bubble does, and how its files were read where that is in doubt.
fn warn(messages: &mut Messages, loaded: &LoadedScene) {
    loaded.scene.warnings().into_iter().for_each(|warning| messages.problem(warning));
    loaded.notes.iter().for_each(|note| messages.remark(note));
}

#[cfg(test)]
pub(super) mod tests;
