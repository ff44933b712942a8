//! The lesson: a step's text, its task, and the way to the next step.

use egui::{Color32, Key, RichText, TextEdit, Ui, text::LayoutJob};

use crate::{
    app::{
        course::{Course, Outcome},
        model::Model,
    },
    scene::lesson::{Kind, Quantity, Task, Verdict},
};

const RIGHT: Color32 = Color32::from_rgb(120, 180, 110);
const WRONG: Color32 = Color32::from_rgb(214, 138, 96);

/// Shows the step of the lesson that is taken.
pub fn show(ui: &mut Ui, model: &mut Model) {
    let Some(course) = &mut model.course else { return };
    let step = course.current().clone();
    ui.label(RichText::new(&step.title).heading());
    paragraphs(ui, &step.text.0);
    if let Some(task) = &step.task {
        ui.separator();
        ui.add(egui::Label::new(RichText::new(&task.ask).strong()).wrap());
        match task.kind {
            Kind::Number => number(ui, course, task, model.probe.pinned.as_ref().map(|pin| &pin.reading)),
            Kind::Pin => drop(ui.weak("Use the tool Probe (6), and click the film.")),
        }
        outcome(ui, course, task);
    }
    ui.separator();
    steps(ui, model);
}

/// Field and button for a number.
fn number(ui: &mut Ui, course: &mut Course, task: &Task, pinned: Option<&crate::app::probe::Reading>) {
    ui.horizontal(|ui| {
        let field = ui.add(TextEdit::singleline(&mut course.typed).desired_width(90.0));
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Answer"));
        let is_entered = field.lost_focus() && ui.input(|input| input.key_pressed(Key::Enter));
        ui.label(task.quantity.unit().trim());
        let check = ui.button("Check").on_hover_text("Check the number (Enter)");
        if check.clicked() || is_entered {
            course.answer(pinned);
        }
    });
}

fn outcome(ui: &mut Ui, course: &Course, task: &Task) {
    let (colour, text) = match &course.outcome {
        None => return,
        Some(Outcome::NotANumber) => (WRONG, "Type a number, as in 103.5.".to_owned()),
        Some(Outcome::PinFirst) => (WRONG, "Pin a point first: tool Probe (6), then click the film.".to_owned()),
        Some(Outcome::Judged(Verdict::Right(answer))) => (RIGHT, format!("Right: {}.", amount(task.quantity, *answer))),
        Some(Outcome::Judged(Verdict::Off(off))) => {
            let way = if *off > 0.0 { "too large" } else { "too small" };
            (WRONG, format!("Off by {}: {way}.", amount(task.quantity, off.abs())))
        }
    };
    ui.add(egui::Label::new(RichText::new(text).color(colour).strong()).wrap());
    if matches!(course.outcome, Some(Outcome::Judged(Verdict::Off(_)))) && !task.hint.is_empty() {
        ui.add(egui::Label::new(RichText::new(format!("Hint: {}", task.hint)).weak()).wrap());
    }
}

/// A number with its unit, to four digits.
fn amount(quantity: Quantity, value: f64) -> String {
    let digits = if value == 0.0 { 0 } else { (3 - value.abs().log10().floor() as i32).clamp(0, 4) as usize };
    let number = format!("{value:.digits$}");
    let number = if number.contains('.') { number.trim_end_matches('0').trim_end_matches('.') } else { &number };
    format!("{number}{}", quantity.unit())
}

/// The way through the lesson, with a mark for each step that is solved.
fn steps(ui: &mut Ui, model: &mut Model) {
    let Some(course) = &model.course else { return };
    let (step, count) = (course.step, course.lesson.steps.len());
    let solved = course.solved.iter().filter(|solved| **solved).count();
    let tasks = course.lesson.steps.iter().filter(|step| step.task.is_some()).count();
    let (mut goes_to, mut ends) = (None, false);
    ui.horizontal(|ui| {
        if ui.add_enabled(step > 0, egui::Button::new("Back")).clicked() {
            goes_to = Some(step - 1);
        }
        if ui.add_enabled(step + 1 < count, egui::Button::new("Next")).clicked() {
            goes_to = Some(step + 1);
        }
        ends = ui.button("End lesson").on_hover_text("Close the lesson; the scene stays").clicked();
        ui.weak(format!("{}/{count}", step + 1)).on_hover_text("The step, and how many there are");
    });
    ui.weak(format!("{solved} of {tasks} tasks solved"));
    goes_to.into_iter().for_each(|step| model.go_to_step(step));
    if ends {
        model.course = None;
    }
}

/// Paragraphs, items, and words that stand out.
fn paragraphs(ui: &mut Ui, text: &str) {
    for paragraph in text.split("\n\n").map(str::trim).filter(|paragraph| !paragraph.is_empty()) {
        for item in paragraph.split("\n- ") {
            let (is_item, words) = match item.strip_prefix("- ") {
                Some(words) => (true, words),
                None => (paragraph.starts_with("- "), item),
            };
            let mark = if is_item { "• " } else { "" };
            ui.add(egui::Label::new(marked(ui, &format!("{mark}{}", words.replace('\n', " ")))).wrap());
        }
        ui.add_space(2.0);
    }
}

/// A paragraph in which `**words**` stand out.
fn marked(ui: &Ui, text: &str) -> LayoutJob {
    let mut job = LayoutJob::default();
    let (plain, strong) = (ui.visuals().text_color(), ui.visuals().strong_text_color());
    let font = egui::TextStyle::Body.resolve(ui.style());
    for (index, part) in text.split("**").enumerate() {
        let colour = if index % 2 == 1 { strong } else { plain };
        job.append(part, 0.0, egui::TextFormat::simple(font.clone(), colour));
    }
    job
}
