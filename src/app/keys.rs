//! The keyboard: one table that is obeyed and shown as help.

use egui::{Key, KeyboardShortcut, Modifiers};

use super::tools::Tool;

/// What a key does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Plays or pauses the film.
    Pause,
    /// Goes on by one tick.
    Step,
    /// Goes back to tick 0.
    Reset,
    /// Moves the camera so that the bubbles are in the picture.
    Frame,
    /// Blows new films.
    NewSeed,
    /// Shows or hides the panels.
    Panels,
    /// Shows or hides the help.
    Help,
    /// Takes the last step back.
    Undo,
    /// Makes it again.
    Redo,
    /// Adds bubbles like the selected ones.
    Duplicate,
    /// Selects all bubbles.
    SelectAll,
    /// Keeps the picture, to compare others with it.
    Keep,
    /// Opens a scene.
    Open,
    /// Saves the scene to its file.
    Save,
    /// Saves the scene to another file.
    SaveAs,
    /// Opens the dialog for exports.
    #[cfg(not(target_arch = "wasm32"))]
    Export,
    /// Saves the picture as PNG.
    SavePng,
    /// Saves the picture as EXR.
    SaveExr,
    /// Takes a tool in the pointer's hand.
    Take(Tool),
    /// Tilts gravity to the right of the picture.
    TiltRight,
    /// Tilts gravity to its left.
    TiltLeft,
    /// Tilts gravity away from the camera.
    TiltAway,
    /// Tilts gravity towards it.
    TiltBack,
    /// Plays the length of the time line again and again, or once.
    Loop,
    /// Deletes the event or keyframe that is selected on the time line, or the outlined bubbles.
    Delete,
    /// Shows the picture alone on the whole screen, or no longer.
    Present,
    /// Takes messages and help away.
    Dismiss,
    /// Ends the program.
    Quit,
}

/// What actions are about: the help lists their keys together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topic {
    /// The clock and the time line.
    Time,
    /// What the pointer is used for.
    Tools,
    /// The films, and what moves them.
    Films,
    /// What is seen.
    View,
    /// What is selected, and steps that are taken back.
    Edit,
    /// Files, and the end of the program.
    File,
}

impl Topic {
    /// All topics, each with its heading, in the order of the help.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Time, "Time"),
        (Self::Tools, "Tools"),
        (Self::Films, "Films"),
        (Self::View, "View"),
        (Self::Edit, "Edit"),
        (Self::File, "File"),
    ];
}

impl Action {
    /// What it is about.
    #[must_use]
    pub fn topic(self) -> Topic {
        match self {
            Self::Pause | Self::Step | Self::Reset | Self::Loop => Topic::Time,
            Self::Take(_) => Topic::Tools,
            Self::NewSeed | Self::TiltRight | Self::TiltLeft | Self::TiltAway | Self::TiltBack => Topic::Films,
            Self::Frame | Self::Keep | Self::Panels | Self::Present | Self::Help | Self::Dismiss => Topic::View,
            Self::Undo | Self::Redo | Self::Duplicate | Self::SelectAll | Self::Delete => Topic::Edit,
            Self::Open | Self::Save | Self::SaveAs | Self::SavePng | Self::SaveExr | Self::Quit => Topic::File,
            #[cfg(not(target_arch = "wasm32"))]
            Self::Export => Topic::File,
        }
    }
}

/// A key, its action, and its line in the help.
pub struct Binding {
    /// The key with its modifiers.
    pub shortcut: KeyboardShortcut,
    /// What it does.
    pub action: Action,
    /// What it does, for people.
    pub help: &'static str,
}

const fn bare(key: Key, action: Action, help: &'static str) -> Binding {
    Binding { shortcut: KeyboardShortcut::new(Modifiers::NONE, key), action, help }
}

const fn command(key: Key, action: Action, help: &'static str) -> Binding {
    Binding { shortcut: KeyboardShortcut::new(Modifiers::COMMAND, key), action, help }
}

const COMMAND_SHIFT: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// All keys. Those with more modifiers stand first, for a shortcut also matches with more held than it asks for.
pub const BINDINGS: &[Binding] = &[
    Binding {
        shortcut: KeyboardShortcut::new(COMMAND_SHIFT, Key::P),
        action: Action::SaveExr,
        help: "Save the picture's radiance as EXR",
    },
    Binding {
        shortcut: KeyboardShortcut::new(COMMAND_SHIFT, Key::S),
        action: Action::SaveAs,
        help: "Save the scene to another file",
    },
    Binding { shortcut: KeyboardShortcut::new(COMMAND_SHIFT, Key::Z), action: Action::Redo, help: "Redo" },
    command(Key::Z, Action::Undo, "Undo"),
    command(Key::Y, Action::Redo, "Redo"),
    command(Key::D, Action::Duplicate, "Add bubbles like the selected ones"),
    command(Key::A, Action::SelectAll, "Select all bubbles"),
    command(Key::P, Action::SavePng, "Save the picture as PNG"),
    #[cfg(not(target_arch = "wasm32"))]
    command(Key::E, Action::Export, "Export a picture of any size, a video or a map of the film"),
    command(Key::O, Action::Open, "Open a scene"),
    command(Key::S, Action::Save, "Save the scene with its history"),
    command(Key::Q, Action::Quit, "Quit"),
    bare(Key::Space, Action::Pause, "Play or pause"),
    bare(Key::Period, Action::Step, "Advance by one tick"),
    bare(Key::R, Action::Reset, "Return to the beginning"),
    bare(Key::N, Action::NewSeed, "New random seeds for film and flow"),
    bare(Key::F, Action::Frame, "Frame the bubbles"),
    bare(Key::Num1, Action::Take(Tool::Orbit), "The pointer turns the view"),
    bare(Key::Num2, Action::Take(Tool::Stir), "The pointer stirs a film"),
    bare(Key::Num3, Action::Take(Tool::Blow), "The pointer blows at a film"),
    bare(Key::Num4, Action::Take(Tool::Drag), "The pointer moves a bubble"),
    bare(Key::Num5, Action::Take(Tool::Prick), "The pointer bursts a bubble"),
    bare(Key::Num6, Action::Take(Tool::Probe), "The pointer measures a film"),
    bare(Key::Num7, Action::Take(Tool::Profile), "The pointer draws a line to measure along"),
    bare(Key::Num8, Action::Take(Tool::Lamp), "The pointer moves a lamp by its highlight"),
    bare(Key::Num9, Action::Take(Tool::Wand), "The pointer blows a new bubble"),
    bare(Key::K, Action::Keep, "Keep this picture, to compare others with it"),
    bare(Key::L, Action::Loop, "Play in a loop"),
    bare(
        Key::Delete,
        Action::Delete,
        "Delete the event or keyframe that is selected on the time line, or the outlined bubbles",
    ),
    bare(Key::F11, Action::Present, "The picture alone, on the whole screen"),
    bare(Key::ArrowRight, Action::TiltRight, "Tilt gravity to the right"),
    bare(Key::ArrowLeft, Action::TiltLeft, "Tilt gravity to the left"),
    bare(Key::ArrowUp, Action::TiltAway, "Tilt gravity away from the camera"),
    bare(Key::ArrowDown, Action::TiltBack, "Tilt gravity towards the camera"),
    bare(Key::H, Action::Panels, "Show or hide the panels"),
    bare(Key::F1, Action::Help, "This help"),
    bare(Key::Questionmark, Action::Help, "This help"),
    bare(Key::Escape, Action::Dismiss, "Leave full screen; close help, messages, the probe and a comparison"),
];

/// What the pointer does, for the help.
pub const POINTER: [(&str, &str); 7] = [
    ("Drag", "Turn around the bubble"),
    ("Click", "Select a bubble; with Shift or Ctrl, also others"),
    ("Arrows, ring", "Move the selected bubbles along an axis, or across the view"),
    ("Drag with a tool", "Stir, blow at or move a bubble; beside it, turn the view"),
    ("Right, Shift or two-finger drag", "Shift the view"),
    ("Wheel, pinch", "Zoom, also into the bubble"),
    ("Double click", "Frame the bubbles"),
];

/// The keys of a topic. Of two keys with the same action, one is listed.
pub fn listed(topic: Topic) -> impl Iterator<Item = &'static Binding> {
    let is_first = |(index, binding): &(usize, &Binding)| {
        !BINDINGS[..*index].iter().any(|earlier| earlier.action == binding.action)
    };
    let bindings = BINDINGS.iter().enumerate().filter(is_first).map(|(_, binding)| binding);
    bindings.filter(move |binding| binding.action.topic() == topic)
}

/// The actions of the keys pressed since the last frame. A widget that has the keyboard keeps its bare keys.
#[must_use]
pub fn pressed(ctx: &egui::Context) -> Vec<Action> {
    let taken = ctx.egui_wants_keyboard_input();
    // Escape closes an open menu, and nothing else.
    let has_menu = egui::Popup::is_any_open(ctx);
    // Ctrl+A also selects a text that is typed.
    let is_free = |binding: &&Binding| {
        let is_command = binding.shortcut.modifiers.command && binding.action != Action::SelectAll;
        (!taken || is_command) && !(has_menu && binding.action == Action::Dismiss)
    };
    ctx.input_mut(|input| {
        let hit = |binding: &&Binding| input.consume_shortcut(&binding.shortcut);
        BINDINGS.iter().filter(is_free).filter(hit).map(|binding| binding.action).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn press(modifiers: Modifiers, key: Key) -> Vec<Action> {
        let ctx = egui::Context::default();
        let pressed_key = egui::Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
        let input = egui::RawInput { events: vec![pressed_key], ..Default::default() };
        let mut actions = Vec::new();
        ctx.run_ui(input, |ui| actions = pressed(ui.ctx())).drop_without_applying_deltas();
        actions
    }

    #[test]
    fn every_binding_does_what_it_says() {
        for binding in BINDINGS {
            let KeyboardShortcut { modifiers, logical_key } = binding.shortcut;
            // A keyboard reports the command key as ctrl too, as egui's winit layer does.
            let modifiers = Modifiers { ctrl: modifiers.command, ..modifiers };
            assert_eq!(press(modifiers, logical_key), [binding.action], "{}", binding.help);
        }
    }

    #[test]
    fn every_action_is_listed_once() {
        let listed: Vec<_> = Topic::ALL.iter().flat_map(|(topic, _)| listed(*topic)).collect();
        for binding in BINDINGS {
            let same = listed.iter().filter(|other| other.action == binding.action);
            assert_eq!(same.count(), 1, "{}", binding.help);
        }
    }

    #[test]
    fn other_keys_do_nothing() {
        assert_eq!(press(Modifiers::NONE, Key::Z), []);
    }
}
