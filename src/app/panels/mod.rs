//! The panels: each a small function of the model. They touch neither window nor GPU, so tests drive them without either.

mod all_keys;
mod camera;
pub mod compare;
mod costs;
mod dialog;
#[cfg(not(target_arch = "wasm32"))]
mod exports;
mod film;
pub mod gallery;
mod generators;
mod gizmo;
mod header;
mod help;
mod hints;
mod lamps;
mod lesson;
mod light;
mod motion;
mod notices;
pub mod overlay;
mod picture;
pub mod pin_plots;
mod places;
mod plots;
mod probe;
mod question;
mod rail;
mod spectrum;
#[cfg(test)]
mod tests;
pub mod textures;
mod time_line;
mod tools;
mod view;
mod widgets;
mod window;

use egui::{CollapsingHeader, Context, Id, Panel, Rect, ScrollArea, Ui};
use glam::DVec2;

use super::{
    keys::{self, Action},
    model::Model,
    orbit::Gesture,
    overlay::Profile,
    tools::{Press, Tool},
};

/// Width of the panels, points.
const WIDTH: f32 = 308.0;
/// Width of a window, points, below which the panels leave too little of the picture: they are hidden at first there.
const NARROW: f32 = 560.0;
/// Width of a picture, points, below which nothing stands over it: the panels cover all but a strip of it.
const STRIP: f32 = 120.0;

/// What the user interface leaves of the window, and what was done there.
#[derive(Clone, Copy, Debug)]
pub struct Picture {
    /// Where the picture stands, in points.
    pub rect: Rect,
    /// How its camera is to be moved.
    pub gesture: Gesture,
    /// The pointer, if it is pressed there.
    pub pressed: Option<Press>,
    /// Where the pointer is there: right and up from the picture's middle, in heights of the picture.
    pub hovered: Option<DVec2>,
    /// Whether it has clicked there.
    pub clicked: bool,
}

/// Shows everything around the picture, obeys the keys, and returns where the picture stands.
pub fn show(ui: &mut Ui, model: &mut Model) -> Picture {
    // What letting go does belongs to the drag.
    let held = |input: &egui::InputState| input.pointer.any_down() || input.pointer.any_released();
    let (now_s, is_held) = ui.input(|input| (input.time, held(input)));
    model.undo.pass(now_s, is_held);
    // Who is asked a question answers it first.
    let is_asked = model.question.is_some() || model.shows_gallery || is_exporting(model);
    let is_deaf = is_asked || model.stands_alone;
    let actions = if is_deaf { Vec::new() } else { keys::pressed(ui.ctx()) };
    for action in &actions {
        model.act(*action);
    }
    fold(ui, model);
    let has_come = |part: Part| part.has_come(ui.ctx());
    let (has_clock, has_time, has_header) = (has_come(Part::Clock), has_come(Part::Time), has_come(Part::Header));
    if !has_come(Part::LAST) {
        ui.ctx().request_repaint();
    }
    if !model.presents && has_clock {
        time_line::show(ui, model, has_time);
        if model.shows_panels && has_header {
            // A window narrower than the panel is all panel; `H` hides it.
            let width = WIDTH.min(ui.available_width());
            Panel::right("panels").exact_size(width).resizable(false).show(ui, |ui| sections(ui, model));
        }
    }
    let mut picture = picture::show(ui, model);
    picture.gesture.frame |= actions.contains(&Action::Frame);
    if model.hold_lamp(picture.pressed) || model.blow(picture.pressed) || model.touch(picture.pressed) {
        picture.gesture.turn = DVec2::ZERO;
    }
    if let Some(place) = picture.hovered.filter(|_| picture.clicked && model.tool == Tool::Orbit) {
        model.select(place, ui.input(clicked_with_a_key));
    }
    draw_line(model, &mut picture);
    let probes = model.tool == Tool::Probe;
    model.probe.point(picture.hovered.filter(|_| probes), picture.clicked && probes);
    if !model.stands_alone && has_header {
        over_picture(ui.ctx(), picture.rect, model);
    }
    picture
}

/// Hides the panels when the window becomes narrow, and brings them back as they were when it is wide again.
fn fold(ui: &Ui, model: &mut Model) {
    let is_narrow = ui.available_width() < NARROW;
    let id = Id::unique("panels of the wide window");
    let wide: Option<bool> = ui.data(|data| data.get_temp(id));
    match wide {
        None if is_narrow => {
            ui.data_mut(|data| data.insert_temp(id, model.shows_panels));
            model.shows_panels = false;
        }
        Some(shown) if !is_narrow => {
            ui.data_mut(|data| data.remove::<bool>(id));
            model.shows_panels = shown;
        }
        _ => {}
    }
}

/// Whether Shift or Ctrl was held at a click. By the time of a slow frame it may be let go.
fn clicked_with_a_key(input: &egui::InputState) -> bool {
    input.events.iter().any(|event| {
        let egui::Event::PointerButton { pressed: false, modifiers, .. } = event else { return false };
        modifiers.shift || modifiers.command
    })
}

/// Whether the dialog for exports is open.
#[cfg_attr(target_arch = "wasm32", allow(unused_variables, reason = "there is none in a browser"))]
fn is_exporting(model: &Model) -> bool {
    #[cfg(not(target_arch = "wasm32"))]
    return model.exports.form.is_open;
    #[cfg(target_arch = "wasm32")]
    false
}

/// Draws the line of a profile, while the pointer is pressed with that tool.
fn draw_line(model: &mut Model, picture: &mut Picture) {
    if model.tool != Tool::Profile {
        return;
    }
    picture.gesture.turn = DVec2::ZERO;
    let line = picture.pressed.filter(|Press { from, at }| from.distance(*at) > SHORTEST_LINE);
    let is_new = |ends: &[DVec2; 2]| model.overlay.profile.as_ref().is_none_or(|known| known.ends != *ends);
    // A line that is held still keeps what was read along it.
    if let Some(ends) = line.map(|Press { from, at }| [from, at]).filter(is_new) {
        model.overlay.profile = Some(Profile::new(ends));
    }
}

/// Length of a line that is meant, in heights of the picture.
const SHORTEST_LINE: f64 = 0.02;

/// What stands over the picture, and the questions over everything.
fn over_picture(ctx: &Context, picture: Rect, model: &mut Model) {
    let has_room = picture.width() >= STRIP;
    if !model.presents && has_room {
        picture::outline(ctx, picture, model);
        lamps::held(ctx, picture, model);
        picture::blown(ctx, picture, model);
        tools::show(ctx, picture, model);
        hints::show(ctx, picture, model);
    }
    if has_room {
        overlay::show(ctx, picture, model);
        compare::show(ctx, picture, model);
        probe::show(ctx, picture, model);
    }
    notices::show(ctx, picture, model);
    help::show(ctx, &mut model.shows_help);
    gallery::show(ctx, model);
    #[cfg(not(target_arch = "wasm32"))]
    exports::show(ctx, picture, model);
    question::show(ctx, model);
    window::show(ctx, model);
}

/// What comes one after the other when a window opens, a frame of egui each. A browser compiles code when it first runs, and all of it at once would
/// hold its page for a fifth of a second.
#[derive(Clone, Copy, Debug)]
pub enum Part {
    /// The picture alone.
    Picture,
    /// The buttons of the clock.
    Clock,
    /// The rest of the time line.
    Time,
    /// The head of the panels, which take their place beside the picture, and what stands over that.
    Header,
    /// A lesson, the film and generators.
    Film,
    /// Motion and light.
    Motion,
    /// All that is below.
    View,
}

impl Part {
    /// With it everything stands there.
    pub const LAST: Self = Self::View;

    /// Frames of egui until it stands there.
    pub const fn frames(self) -> u64 {
        self as u64 + 1
    }

    /// Whether it is there in this frame.
    fn has_come(self, ctx: &Context) -> bool {
        ctx.cumulative_frame_nr() + 1 >= self.frames()
    }
}

fn sections(ui: &mut Ui, model: &mut Model) {
    header::show(ui, model);
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        if Part::Film.has_come(ui.ctx()) {
            if let Some(course) = &model.course {
                let title = format!("Lesson: {}", course.lesson.title);
                section(ui, &title, true, |ui| lesson::show(ui, model));
            }
            section(ui, "Film", true, |ui| film::show(ui, model));
            section(ui, "Generators", !model.scene.generators.is_empty(), |ui| generators::show(ui, model));
        }
        if Part::Motion.has_come(ui.ctx()) {
            section(ui, "Motion", true, |ui| motion::show(ui, model));
            section(ui, "Light", true, |ui| light::show(ui, model));
        }
        if Part::View.has_come(ui.ctx()) {
            section(ui, "View", true, |ui| view::show(ui, model));
            section(ui, "Measure", true, |ui| overlay::choices(ui, &mut model.overlay));
            section(ui, "All keys", false, |ui| all_keys::show(ui, model));
            section(ui, "Costs", false, |ui| costs::show(ui, model));
        }
        widgets::follow_focus(ui);
    });
}

fn section(ui: &mut Ui, title: &str, open: bool, content: impl FnOnce(&mut Ui)) {
    let title = egui::RichText::new(title).strong();
    CollapsingHeader::new(title).default_open(open).show_unindented(ui, |ui| {
        content(ui);
        ui.add_space(6.0);
    });
}
