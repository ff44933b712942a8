//! The dialog's texts, and the queue.

use std::path::Path;

use super::*;
use crate::{
    app::model::tests::model,
    export::{Format, Observer, Sequence, SequenceTarget},
    output::VideoFormat,
};

fn opened() -> Form {
    let mut form = Form::default();
    form.open(Path::new("a/life"), [641, 401], 10.0);
    form
}

#[test]
fn a_dialog_opens_with_what_the_window_shows() {
    let mut form = opened();
    assert_eq!((form.path.as_str(), form.width(), form.height()), ("a/life.png", Ok(640), Ok(400)));
    let Ok(Job::Picture { options, format: Format::Png, time_s, .. }) = form.job(2.5, 0) else { panic!("no picture") };
    assert_eq!((options.size, options.samples, time_s), ([640, 400], 1, 2.5));
    form.width = "1920 px".to_owned();
    form.open(Path::new("b/saved"), [10, 10], 1.0);
    assert_eq!((form.width(), form.path.as_str()), (Ok(1920), "b/saved.png"), "what was typed stays");
    form.path = "c/own.png".to_owned();
    form.open(Path::new("b/other"), [10, 10], 1.0);
    assert_eq!(form.path, "c/own.png");
}

#[test]
fn a_video_has_the_frames_from_its_beginning_to_its_end() {
    let mut form = Form { kind: Kind::Sequence, ..opened() };
    form.name_file();
    assert_eq!(form.path, "a/life.mp4");
    for (from, to, fps, frames) in [
        ("0", "10", "30", 0..=299),
        ("1", "1.5 s", "30", 30..=44),
        ("0", "1001", "24000/1001", 0..=23999),
        ("0.01", "0.02", "30", 1..=1),
    ] {
        (form.begin_s, form.end_s, form.fps) = (from.to_owned(), to.to_owned(), fps.to_owned());
        assert_eq!(form.frames(), Ok(frames), "{from} to {to} at {fps}");
    }
    let Ok(Job::Sequence { sequence: Sequence { target, .. }, .. }) = form.job(0.0, 0) else { panic!("no video") };
    assert_eq!(target, SequenceTarget::Video { path: "a/life.mp4".into(), format: VideoFormat::Mp4 });
    form.sequence_format = SequenceFormat::Exr;
    form.name_file();
    assert_eq!((form.path.as_str(), form.is_radiance()), ("a/life", true));
}

#[test]
fn what_cannot_be_read_is_told_at_its_field() {
    let wrong = |change: &dyn Fn(&mut Form)| {
        let mut form = Form { kind: Kind::Sequence, ..opened() };
        form.name_file();
        change(&mut form);
        form.job(0.0, 0).unwrap_err()
    };
    assert!(wrong(&|form| form.width = "-3".to_owned()).contains("pixels"));
    assert!(wrong(&|form| (form.width, form.height) = ("100000".into(), "100000".into())).contains("8192x8192"));
    assert!(wrong(&|form| form.samples = "0".to_owned()).contains("1 to 64"));
    assert!(wrong(&|form| form.end_s = "0".to_owned()).contains("before it begins"));
    assert!(wrong(&|form| form.begin_s = "nan".to_owned()).contains("seconds"));
    assert!(wrong(&|form| form.fps = "fast".to_owned()).contains("24000/1001"));
    assert!(wrong(&|form| form.path = "a/life.png".to_owned()).contains("end it in .mp4"));
    assert!(wrong(&|form| form.path.clear()).contains("name a file"));
}

#[test]
fn exports_are_done_one_by_one_and_can_be_stopped() {
    let model = model();
    let mut exports = Exports { form: opened(), ..Exports::default() };
    let job = exports.form.job(0.0, 0).unwrap();
    (0..3).for_each(|_| exports.add(job.clone(), model.snapshot()));
    let (first, .., watch) = exports.begin_next().unwrap();
    assert!(exports.begin_next().is_none(), "one at a time");
    assert_eq!([0, 1].map(|k: usize| exports.entries[k].told()), ["starting", "waiting"]);
    watch.hear(0.5);
    assert!(exports.entries[0].told().starts_with("50 %, "));

    exports.cancel(first);
    assert!(watch.has_cancelled() && exports.entries.len() == 3, "it ends when its worker does");
    assert_eq!(exports.entries[0].told(), "stopping");
    exports.cancel(2);
    assert_eq!(exports.entries.len(), 2, "one that waits goes at once");
    assert_eq!(exports.end(first, Err("cancelled".to_owned())), None);
    let (third, ..) = exports.begin_next().unwrap();
    assert_eq!(exports.end(third, Err("no room".to_owned())), Some(Err("no room".to_owned())));
    exports.add(job, model.snapshot());
    let (fourth, ..) = exports.begin_next().unwrap();
    assert_eq!(exports.end(fourth, Ok(())), Some(Ok("Exported a/life.png".to_owned())));
    assert!(exports.entries.is_empty());
}
