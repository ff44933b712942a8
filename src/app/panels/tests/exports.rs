//! The dialog for exports.

use super::*;
use crate::{
    app::exports::{Entry, Kind, SequenceFormat, State as Stage},
    export::{Job, Observer},
};

/// A window whose dialog is open, with a folder for its files.
fn dialog() -> (Harness<'static, State>, tempfile::TempDir) {
    let (mut window, folder) = (window(), tempfile::tempdir().unwrap());
    let model = &mut window.state_mut().model;
    model.folder = folder.path().to_owned();
    model.open_export([801, 500]);
    window.run();
    (window, folder)
}

fn write(window: &mut Harness<'static, State>, name: &str, text: &str) {
    let field = window.get_by_role_and_label(Role::TextInput, name);
    field.focus();
    window.run();
    press(window, Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(Role::TextInput, name).type_text(text);
    window.run();
}

fn export(window: &mut Harness<'static, State>) {
    window.get_by_role_and_label(Role::Button, "Export").click();
    window.run();
}

fn waiting(window: &Harness<'static, State>) -> Vec<Job> {
    let entries = window.state().model.exports.entries.iter();
    let job = |entry: &Entry| match &entry.state {
        Stage::Waiting(work) => Some(work.0.clone()),
        Stage::Running(_) => None,
    };
    entries.filter_map(job).collect()
}

#[test]
fn a_key_asks_for_the_dialog_and_escape_closes_it() {
    let mut window = window();
    press(&mut window, Modifiers::COMMAND, Key::E);
    assert_eq!(window.state().model.requests, [Request::Export]);
    let (mut window, _folder) = dialog();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!window.state().model.exports.form.is_open);
}

#[test]
fn a_picture_of_any_size_is_exported() {
    let (mut window, folder) = dialog();
    click(&mut window, "Full HD");
    write(&mut window, "Samples", "4");
    window.get_by_role_and_label(Role::CheckBox, "Alpha").click();
    window.run();
    export(&mut window);
    let model = &window.state().model;
    assert!(!model.exports.form.is_open, "{:?}", model.exports.form.refused);
    let [Job::Picture { options, path, .. }] = &waiting(&window)[..] else { panic!("no picture waits") };
    assert_eq!((options.size, options.samples, options.alpha), ([1920, 1080], 4, true));
    assert_eq!(*path, folder.path().join("furnace.png"));
}

#[test]
fn what_is_wrong_stands_beside_its_field_and_nothing_begins() {
    let (mut window, _folder) = dialog();
    write(&mut window, "Width", "wide");
    window.get_by_label("write a number of pixels");
    export(&mut window);
    assert!(waiting(&window).is_empty());
    write(&mut window, "Width", "640");
    write(&mut window, "File", "/no/such/folder/a.png");
    export(&mut window);
    window.get_by_label_contains("folder /no/such/folder does not exist");
    assert!(waiting(&window).is_empty());
}

#[test]
fn a_video_is_exported_from_a_time_to_another() {
    let (mut window, folder) = dialog();
    click(&mut window, "Video");
    click(&mut window, "GIF");
    write(&mut window, "From", "1");
    write(&mut window, "To", "2.5 s");
    write(&mut window, "Frame rate", "60");
    window.get_by_label("90 frames, 60 to 149");
    export(&mut window);
    window.get_by_label_contains("--fps 50");
    write(&mut window, "Frame rate", "20");
    export(&mut window);
    let [Job::Sequence { sequence, .. }] = &waiting(&window)[..] else { panic!("no video waits") };
    assert_eq!((sequence.frames.clone(), sequence.target.format()), (20..=49, crate::export::Format::Png));
    assert_eq!(waiting(&window)[0].path(), folder.path().join("furnace.gif"));
    let form = &window.state().model.exports.form;
    assert_eq!((form.kind, form.sequence_format), (Kind::Sequence, SequenceFormat::Gif), "the next one begins there");
}

#[test]
fn a_map_is_exported() {
    let (mut window, folder) = dialog();
    click(&mut window, "Film map");
    click(&mut window, "Cube");
    write(&mut window, "Map height", "64");
    export(&mut window);
    let [Job::Map { bubble: 0, map, path, .. }] = &waiting(&window)[..] else { panic!("no map waits") };
    assert_eq!((map.size(), path.clone()), ([64, 384], folder.path().join("furnace.exr")));
}

#[test]
fn exports_show_how_far_they_are_and_can_be_stopped() {
    let (mut window, _folder) = dialog();
    export(&mut window);
    let (_, _, _, watch) = window.state_mut().model.exports.begin_next().unwrap();
    watch.hear(0.25);
    window.run_steps(3);
    window.get_by_label_contains("furnace.png: 25 %");
    // The window asks before they are lost.
    window.state_mut().model.ask_for(Request::Quit);
    window.run_steps(3);
    window.get_by_label("Cancel").click();
    window.run_steps(3);
    assert!(!window.state().model.requests.contains(&Request::Quit));
    window.get_by_label("Stop").click();
    window.run_steps(3);
    assert!(watch.has_cancelled());
    window.get_by_label_contains("stopping");
    window.state_mut().model.ask_for(Request::Quit);
    assert!(window.state().model.requests.contains(&Request::Quit), "what is stopped keeps nobody");
}
