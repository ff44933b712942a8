//! Dialogs: their place from the first frame on, and in small windows.

use egui::{Id, Rect};

use super::*;

/// Sizes of windows in points, the smallest of them a screen of 640 × 480 pixels with letters twice as large.
const SIZES: [egui::Vec2; 4] = [vec2(1280.0, 800.0), vec2(640.0, 480.0), vec2(640.0, 400.0), vec2(320.0, 240.0)];

/// A dialog and what opens it.
type Dialog = (&'static str, fn(&mut Model));

const DIALOGS: [Dialog; 3] = [
    ("help", |model| model.shows_help = true),
    ("gallery", |model| model.shows_gallery = true),
    ("export", |model| model.exports.form.is_open = true),
];

fn quiet(size: egui::Vec2) -> Harness<'static, State> {
    let mut model = model();
    model.clock.running = false;
    let mut window = harness(model, size);
    window.run();
    window
}

fn area(window: &Harness<'static, State>, name: &str) -> Rect {
    window.ctx.memory(|memory| memory.area_rect(Id::unique(name))).unwrap()
}

#[test]
fn dialogs_stay_where_they_are_first_seen() {
    for size in SIZES {
        for (name, open) in DIALOGS {
            let mut window = quiet(size);
            open(&mut window.state_mut().model);
            // The first frame only measures: nothing is seen of it.
            (0..2).for_each(|_| window.step());
            let seen = area(&window, name);
            window.hover_at(egui::pos2(20.0, 20.0));
            (0..3).for_each(|_| window.step());
            let later = area(&window, name);
            // Much less than a widget is high.
            let moved = (later.min - seen.min).abs().max((later.max - seen.max).abs()).max_elem();
            assert!(moved < 4.0, "{name} in {size}: {seen}, then {later}");
        }
    }
}

#[test]
fn dialogs_stay_within_small_windows() {
    for size in SIZES {
        let screen = Rect::from_min_size(egui::Pos2::ZERO, size);
        for (name, open) in DIALOGS {
            let mut window = quiet(size);
            open(&mut window.state_mut().model);
            (0..3).for_each(|_| window.step());
            let rect = area(&window, name);
            assert!(screen.contains_rect(rect), "{name} in {size}: {rect}");
            let close = window.get_by_role_and_label(Role::Button, "Close").rect();
            assert!(rect.contains_rect(close), "{name} in {size}: {close}");
            let heading = match name {
                "help" => "Keys and pointer",
                "gallery" => "Lessons",
                _ => "Export",
            };
            let heading = window.query_all_by_label(heading).next().unwrap().rect();
            assert!(rect.contains_rect(heading), "{name} in {size}: {heading}");
        }
    }
}

#[test]
fn the_help_lists_keys_under_headings() {
    let mut window = quiet(vec2(1280.0, 1600.0));
    window.state_mut().model.shows_help = true;
    window.run();
    let top = |name: &str| window.get_all_by_label(name).map(|node| node.rect().top()).fold(0.0, f32::max);
    let names = ["Play or pause", "Tools", "The pointer stirs a film", "Frame the bubbles", "Undo", "Quit"];
    let tops = names.map(top);
    assert!(tops.windows(2).all(|pair| pair[0] < pair[1]), "{tops:?}");
}
