//! The time line along the bottom: the clock, the film's whole history with its events, and what lies ahead. Going back moves the film again from a
//! checkpoint: the same history gives the same film.

use egui::{
    Color32, DragValue, Event, Panel, ProgressBar, Rect, Response, Sense, Slider, SliderClamping, Stroke, Ui, pos2,
    vec2,
};

use crate::app::{history, model::Model};

/// Height of the strip with the marks of events, points.
const STRIP: f32 = 12.0;
/// How far from a mark a click still means it, points.
const REACH: f32 = 6.0;

/// Shows the time line along the bottom of the window.
pub fn show(ui: &mut Ui, model: &mut Model) {
    model.furthest_tick = model.furthest_tick.max(model.clock.tick);
    Panel::bottom("time line").resizable(false).default_size(64.0).show(ui, |ui| {
        ui.add_space(2.0);
        ui.horizontal_wrapped(|ui| {
            clock(ui, model);
            told(ui, model);
        });
        let end_tick = end_tick(model);
        let rail = time(ui, model, end_tick);
        events(ui, model, rail, end_tick);
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
    ui.monospace(format!("{:7.2} s", model.clock.time_s(&model.scene.motion)));
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
    let tick_s = model.scene.motion.tick_s;
    let selected = model.time_line.selected.and_then(|index| model.scene.events.get(index));
    if let Some(event) = selected {
        let text = history::describe(event, tick_s);
        ui.add(egui::Label::new(egui::RichText::new(text).strong()).truncate());
        if ui.button("Remove").on_hover_text("Remove this event (Delete)").clicked() {
            model.remove_event();
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
    let mut time_s = model.clock.time_s(&model.scene.motion);
    ui.spacing_mut().slider_width = ui.available_width();
    let slider = Slider::new(&mut time_s, 0.0..=end_tick as f64 * tick_s);
    let slider = ui.add(slider.show_value(false).clamping(SliderClamping::Always).trailing_fill(true));
    slider.widget_info(|| egui::WidgetInfo::slider(true, time_s, "Time"));
    if slider.changed() {
        model.clock.seek((time_s / tick_s).round() as u64);
    }
    let handle = 0.5 * slider.rect.height();
    slider.rect.shrink2(vec2(handle, 0.0))
}

/// The events as marks under the slider: a click selects one, a drag moves it.
fn events(ui: &mut Ui, model: &mut Model, rail: Rect, end_tick: u64) {
    let (strip, response) = ui.allocate_exact_size(vec2(ui.available_width(), STRIP), Sense::click_and_drag());
    response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::ListBox, true, "Events"));
    let x_of = |tick: u64| rail.left() + rail.width() * (tick as f64 / end_tick as f64) as f32;
    let tick_of =
        |x: f32| ((f64::from((x - rail.left()) / rail.width())).clamp(0.0, 1.0) * end_tick as f64).round() as u64;
    point(ui, model, &response, &x_of, &tick_of);
    for (index, event) in model.scene.events.iter().enumerate() {
        let is_selected = model.time_line.selected == Some(index);
        let tick =
            model.time_line.dragged.filter(|(dragged, _)| *dragged == index).map_or(event.tick, |(_, tick)| tick);
        let colour = if is_selected { ui.visuals().strong_text_color() } else { ui.visuals().weak_text_color() };
        mark(ui, pos2(x_of(tick), strip.top()), colour, is_selected);
    }
}

fn mark(ui: &Ui, top: egui::Pos2, colour: Color32, is_selected: bool) {
    let half = if is_selected { 4.0 } else { 3.0 };
    let corners = vec![top, top + vec2(half, 8.0), top + vec2(-half, 8.0)];
    ui.painter().add(egui::Shape::convex_polygon(corners, colour, Stroke::NONE));
}

fn point(ui: &Ui, model: &mut Model, response: &Response, x_of: &impl Fn(u64) -> f32, tick_of: &impl Fn(f32) -> u64) {
    let at = response.interact_pointer_pos();
    let is_pressed =
        ui.input(|input| input.events.iter().any(|event| matches!(event, Event::PointerButton { pressed: true, .. })));
    if let Some(at) = at.filter(|_| is_pressed) {
        let distance = |tick: u64| (x_of(tick) - at.x).abs();
        let nearest = model.scene.events.iter().enumerate().map(|(index, event)| (distance(event.tick), index));
        model.time_line.selected =
            nearest.filter(|(far, _)| *far <= REACH).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index)| index);
    }
    let Some(index) = model.time_line.selected else { return };
    if let Some(at) = at.filter(|_| response.dragged()) {
        model.time_line.dragged = Some((index, tick_of(at.x)));
    }
    if let Some((index, tick)) = model.time_line.dragged.filter(|_| response.drag_stopped()) {
        model.time_line.dragged = None;
        model.move_event(index, tick);
    }
}
