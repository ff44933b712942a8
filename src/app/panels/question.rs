//! Questions that come before anything else: Enter gives the first answer, Escape the last.

use egui::{Context, Id, Key, Modal, Ui};

use crate::app::{
    model::Model,
    request::{Fate, Question, Request, Target},
};

/// Shows the question that is open.
pub fn show(ctx: &Context, model: &mut Model) {
    let Some(question) = model.question.take() else { return };
    match question {
        Question::Unsaved(request) => unsaved(ctx, model, request),
        Question::Left(name) => left(ctx, model, name),
        Question::Exporting => exporting(ctx, model),
        Question::Path(target, text, wrong) => path(ctx, model, target, text, wrong),
    }
}

fn unsaved(ctx: &Context, model: &mut Model, request: Request) {
    let question = format!("Save changes to {} {}?", model.name, request.danger().unwrap_or_default());
    match ask(ctx, &question, &["Save", "Do not save", "Cancel"], |_| {}) {
        Some(0) => {
            model.once_saved = Some(request);
            model.save();
        }
        Some(1) => model.requests.push(request),
        Some(_) => {}
        None => model.question = Some(Question::Unsaved(request)),
    }
}

#[cfg(target_arch = "wasm32")]
fn exporting(_: &Context, _: &mut Model) {}

#[cfg(not(target_arch = "wasm32"))]
fn exporting(ctx: &Context, model: &mut Model) {
    let answers = ["Quit when they are done", "Stop them and quit", "Cancel"];
    match ask(ctx, "Exports are not finished.", &answers, |_| {}) {
        Some(0) => model.exports.then_quits = true,
        Some(1) => {
            model.exports.cancel_all();
            model.ask_for(Request::Quit);
        }
        Some(_) => {}
        None => model.question = Some(Question::Exporting),
    }
}

fn left(ctx: &Context, model: &mut Model, name: String) {
    let question = format!("The program ended while {name} had changes that were not saved.");
    match ask(ctx, &question, &["Recover", "Delete them", "Later"], |_| {}) {
        Some(0) => model.requests.push(Request::Left(Fate::TakeUp)),
        Some(1) => model.requests.push(Request::Left(Fate::ThrowAway)),
        Some(_) => model.requests.push(Request::Left(Fate::Later)),
        None => model.question = Some(Question::Left(name)),
    }
}

fn path(ctx: &Context, model: &mut Model, target: Target, mut text: String, wrong: Option<String>) {
    let (kind, endings) = target.file_type();
    let question = format!("{kind} (.{}), by its path:", endings.join(", ."));
    let verb = if target.is_read() { "Open" } else { "Save" };
    let answer = ask(ctx, &question, &[verb, "Cancel"], |ui| {
        let field =
            ui.add(egui::TextEdit::singleline(&mut text).desired_width(f32::INFINITY).hint_text("~/scene.toml"));
        field.widget_info(|| egui::WidgetInfo::labeled(egui::Role::TextInput, true, "Path"));
        field.request_focus();
        if let Some(wrong) = &wrong {
            ui.colored_label(ui.visuals().warn_fg_color, wrong);
        }
    });
    // Whoever takes the typed path compares it with what was wrong before.
    model.question = Some(Question::Path(target, text.clone(), wrong));
    match answer {
        Some(0) => model.requests.push(Request::Typed(target, text)),
        Some(_) => (model.question, model.once_saved) = (None, None),
        None => {}
    }
}

/// Shows a question with its answers; returns the number of the one that was given.
fn ask(ctx: &Context, question: &str, answers: &[&str], more: impl FnOnce(&mut Ui)) -> Option<usize> {
    let modal = Modal::new(Id::unique("question")).show(ctx, |ui| {
        ui.set_width((ctx.content_rect().width() - 40.0).clamp(60.0, 420.0));
        ui.add(egui::Label::new(egui::RichText::new(question).strong()).wrap());
        ui.add_space(6.0);
        more(ui);
        ui.add_space(8.0);
        let buttons = |ui: &mut Ui| answers.iter().map(|answer| ui.button(*answer).clicked()).collect::<Vec<_>>();
        ui.horizontal(buttons).inner.into_iter().position(|clicked| clicked)
    });
    let pressed = |key| ctx.input(|input| input.key_pressed(key));
    if pressed(Key::Enter) {
        return modal.inner.or(Some(0));
    }
    modal.inner.or(pressed(Key::Escape).then_some(answers.len() - 1))
}
