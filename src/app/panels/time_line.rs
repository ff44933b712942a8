//! The time line along the bottom: the clock, the film's whole history with its events, the camera's keyframes, and what lies ahead. Going back moves the film again from a
//! checkpoint: the same history gives the same film.

use egui::{
    DragValue, Event, Panel, Pos2, ProgressBar, Rect, Response, Sense, Slider, SliderClamping, Stroke, Ui, pos2, vec2,
};

use super::rail;
use crate::app::{history, model::Model, time_line::Mark};

/// Height of a strip with marks, points.
const STRIP: f32 = 12.0;
/// How far from a mark a click still means it, points.
const REACH: f32 = 6.0;

/// Shows the time line along the bottom of the window: all of it, or the buttons of the clock alone.
pub fn show(ui: &mut Ui, model: &mut Model, is_whole: bool) {
    model.furthest_tick = model.furthest_tick.max(model.clock.tick);
    Panel::bottom("time line").resizable(false).default_size(64.0).show(ui, |ui| {
        ui.add_space(2.0);
        ui.horizontal_wrapped(|ui| {
            clock(ui, model);
            told(ui, model);
        });
        if !is_whole {
            return;
        }
        let end_tick = end_tick(model);
        let rail = time(ui, model, end_tick);
        let scale = Scale { rail, end_tick };
        let events: Vec<f64> = model.scene.events.iter().map(|event| event.tick as f64).collect();
        strip(ui, model, &scale, "Events", Mark::Event, &events);
        let (tick_s, keyframes) = (model.scene.motion.tick_s, &model.scene.camera.keyframes);
        let keyframes: Vec<f64> = keyframes.iter().map(|keyframe| keyframe.time_s / tick_s).collect();
        if !keyframes.is_empty() {
            strip(ui, model, &scale, "Camera keyframes", Mark::Keyframe, &keyframes);
        }
    });
}

/// The tick where the time line ends.
fn end_tick(model: &Model) -> u64 {
    let length = model.time_line.length_s / model.scene.motion.tick_s;
    model.last_tick().max(length.round() as u64).max(1)
}

fn clock(ui: &mut Ui, model: &mut Model) {
    // Words of the same width: what stands beside must not jump.
    let play = egui::Button::new(if model.clock.running { "Pause" } else { "Play" }).min_size(vec2(52.0, 0.0));
    if ui.add(play).on_hover_text("Play or pause the film (Space)").clicked() {
        model.clock.running = !model.clock.running;
    }
    if ui.button("Step").on_hover_text("Advance by one tick (.)").clicked() {
        model.clock.step();
    }
    if ui.button("Reset").on_hover_text("Return to the beginning (R)").clicked() {
        model.clock.reset();
    }
    ui.toggle_value(&mut model.time_line.loops, "Loop").on_hover_text("Repeat from 0 to this length (L)");
    let length = DragValue::new(&mut model.time_line.length_s).range(0.1..=36_000.0).speed(0.05).suffix(" s");
    let label = ui.label("Length");
    ui.add(length).labelled_by(label.id).on_hover_text("How far the time line reaches, and where a loop begins again");
    ui.toggle_value(&mut model.shows_panels, "Panels").on_hover_text("Show or hide the panels (H)");
    ui.monospace(format!("{:7.2} s", model.shown_tick() as f64 * model.scene.motion.tick_s));
}

/// How the film keeps up, or which event is selected.
fn told(ui: &mut Ui, model: &mut Model) {
    let (behind, jump) = (model.behind_ticks, model.time_line.jump_ticks.max(model.behind_ticks));
    model.time_line.jump_ticks = if behind > 0 { jump } else { 0 };
    if behind > 0 {
        let done = (jump - behind) as f32 / jump as f32;
        let bar = ProgressBar::new(done).desired_width(120.0).text(format!("{behind} ticks to go"));
        ui.add(bar).on_hover_text("The film is on its way to this time");
        if ui.button("Stop").on_hover_text("Stay at the time that the film has reached").clicked() {
            let reached = model.clock.tick.saturating_sub(behind);
            model.clock.seek(reached);
            model.clock.running = false;
        }
        return;
    }
    if let Some(text) = model.time_line.selected.and_then(|mark| described(model, mark)) {
        ui.add(egui::Label::new(egui::RichText::new(text).strong()).truncate());
        if ui.button("Remove").on_hover_text("Remove this event or keyframe (Delete)").clicked() {
            model.remove_selected();
        }
        return;
    }
    let wanted = model.scene.motion.speed;
    if let Some(rate) = model.rate.latest().filter(|rate| model.clock.running && *rate < 0.95 * wanted) {
        let digits = if rate < 0.1 { 2 } else { 1 };
        ui.weak(format!("{rate:.digits$} × real time"))
            .on_hover_text("This machine moves the film more slowly than the scene asks");
    }
}

/// The slider; returns the part of it that its values span.
fn time(ui: &mut Ui, model: &mut Model, end_tick: u64) -> Rect {
    let tick_s = model.scene.motion.tick_s;
    let mut time_s = model.shown_tick() as f64 * tick_s;
    ui.spacing_mut().slider_width = ui.available_width();
    let slider = Slider::new(&mut time_s, 0.0..=end_tick as f64 * tick_s);
    let slider = ui.add(slider.show_value(false).clamping(SliderClamping::Always).trailing_fill(true));
    slider.widget_info(|| egui::WidgetInfo::slider(true, time_s, "Time"));
    let presses = rail::presses(ui);
    if slider.changed() {
        let tick = if slider.has_focus() && presses != 0 {
            model.clock.tick.saturating_add_signed(presses.into()).min(end_tick)
        } else {
            (time_s / tick_s).round() as u64
        };
        model.clock.seek(tick);
    }
    let handle = 0.5 * slider.rect.height();
    slider.rect.shrink2(vec2(handle, 0.0))
}

/// What a mark stands for, in a line for people; `None` if there is no such thing.
fn described(model: &Model, mark: Mark) -> Option<String> {
    match mark {
        Mark::Event(index) => {
            let event = model.scene.events.get(index)?;
            Some(history::describe(event, model.scene.motion.tick_s))
        }
        Mark::Keyframe(index) => {
            let keyframe = model.scene.camera.keyframes.get(index)?;
            Some(format!("{:.2} s: camera keyframe, {}", keyframe.time_s, keyframe.ease.name()))
        }
    }
}

/// Where ticks are on the time line.
struct Scale {
    rail: Rect,
    end_tick: u64,
}

impl Scale {
    fn x_of(&self, ticks: f64) -> f32 {
        self.rail.left() + self.rail.width() * (ticks / self.end_tick as f64) as f32
    }

    fn tick_of(&self, x: f32) -> u64 {
        let part = f64::from((x - self.rail.left()) / self.rail.width()).clamp(0.0, 1.0);
        (part * self.end_tick as f64).round() as u64
    }
}

/// Marks under the slider, at times in ticks: a click selects one, a drag moves it.
fn strip(ui: &mut Ui, model: &mut Model, scale: &Scale, name: &str, mark_of: fn(usize) -> Mark, ticks: &[f64]) {
    let (strip, response) = ui.allocate_exact_size(vec2(ui.available_width(), STRIP), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ListBox, true, name));
    point(ui, model, &response, scale, mark_of, ticks);
    for (index, ticks) in ticks.iter().enumerate() {
        let mark = mark_of(index);
        let is_selected = model.time_line.selected == Some(mark);
        let dragged = model.time_line.dragged.filter(|(dragged, _)| *dragged == mark);
        let ticks = dragged.map_or(*ticks, |(_, tick)| tick as f64);
        draw(ui, pos2(scale.x_of(ticks), strip.top()), mark, is_selected);
    }
}

/// Draws a mark: a triangle for an event, a diamond for a keyframe.
fn draw(ui: &Ui, top: Pos2, mark: Mark, is_selected: bool) {
    let visuals = ui.visuals();
    let colour = if is_selected { visuals.strong_text_color() } else { visuals.weak_text_color() };
    let half = if is_selected { 4.0 } else { 3.0 };
    let corners = match mark {
        Mark::Event(_) => vec![top, top + vec2(half, 8.0), top + vec2(-half, 8.0)],
        Mark::Keyframe(_) => {
            let middle = top + vec2(0.0, 5.0);
            [vec2(0.0, -1.0), vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0)].map(|to| middle + half * 1.2 * to).into()
        }
    };
    ui.painter().add(egui::Shape::convex_polygon(corners, colour, Stroke::NONE));
}

/// Lets the pointer select the nearest mark of a strip, and move it.
fn point(ui: &Ui, model: &mut Model, response: &Response, scale: &Scale, mark_of: fn(usize) -> Mark, ticks: &[f64]) {
    let at = response.interact_pointer_pos();
    let is_pressed =
        ui.input(|input| input.events.iter().any(|event| matches!(event, Event::PointerButton { pressed: true, .. })));
    if let Some(at) = at.filter(|_| is_pressed) {
        let nearest = ticks.iter().enumerate().map(|(index, ticks)| ((scale.x_of(*ticks) - at.x).abs(), index));
        let nearest = nearest.filter(|(far, _)| *far <= REACH).min_by(|a, b| a.0.total_cmp(&b.0));
        model.time_line.selected = nearest.map(|(_, index)| mark_of(index));
    }
    let is_own = |mark: Mark| (0..ticks.len()).any(|index| mark_of(index) == mark);
    let Some(mark) = model.time_line.selected.filter(|mark| is_own(*mark)) else { return };
    if let Some(at) = at.filter(|_| response.dragged()) {
        model.time_line.dragged = Some((mark, scale.tick_of(at.x)));
    }
    if let Some((mark, tick)) = model.time_line.dragged.filter(|_| response.drag_stopped()) {
        model.time_line.dragged = None;
        model.move_mark(mark, tick);
    }
}
