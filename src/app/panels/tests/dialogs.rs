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

/// Everything over the picture, in a window as it begins.
#[test]
fn areas_stay_within_small_windows_and_beside_the_tools() {
    for size in SIZES {
        let screen = Rect::from_min_size(egui::Pos2::ZERO, size).expand(0.5);
        let mut model = model();
        model.clock.running = false;
        model.messages.problem("a problem with a long name that must find its place somewhere");
        let pixels = Pixels { size: [2, 2], rgba: vec![90; 16].into() };
        model.compare.keep(pixels, "furnace at 0.00 s".to_owned());
        let mut window = harness(model, size);
        (0..4).for_each(|_| window.step());
        let picture = window.state().picture.unwrap().rect;
        assert!(picture.width() >= 300.0 && picture.height() >= 100.0, "{size}: {picture}");
        let shown: Vec<Rect> = window.ctx.memory(|memory| {
            let areas = memory.areas().visible_layer_ids();
            areas.into_iter().filter_map(|layer| memory.area_rect(layer.id)).collect()
        });
        assert!(shown.len() >= 3, "{size}: {shown:?}");
        assert!(shown.iter().all(|rect| screen.contains_rect(*rect)), "{size}: {shown:?}");
        let tools = area(&window, "tools");
        assert!(picture.contains_rect(area(&window, "compare")), "{size}");
        assert!(!tools.intersects(area(&window, "compare")), "{size}");
        assert!(picture.height() < 200.0 || !tools.intersects(area(&window, "hints")), "{size}");
        for name in ["Pause", "Loop", "Panels", "Time"] {
            let all = window.query_all_by_label(name).next().or_else(|| window.query_all_by_label("Play").next());
            assert!(screen.contains_rect(all.unwrap().rect()), "{name} in {size}");
        }
    }
}

#[test]
fn panels_of_a_narrow_window_come_when_they_are_wanted() {
    let mut window = quiet(vec2(320.0, 240.0));
    assert!(window.query_by_label("Presets").is_none());
    click(&mut window, "Panels");
    let screen = Rect::from_min_size(egui::Pos2::ZERO, vec2(320.0, 240.0));
    for name in ["Presets", "File", "Picture", "Window", "Undo", "Panels"] {
        let rect = window.get_by_label(name).rect();
        assert!(screen.contains_rect(rect), "{name}: {rect}");
    }
    assert!(window.query_by_label("Orbit").is_none(), "no tools over a strip");
    click(&mut window, "Panels");
    assert!(window.query_by_label("Presets").is_none() && window.query_by_label("Orbit").is_some());
    window.set_size(vec2(1280.0, 800.0));
    window.run();
    window.get_by_label("Presets");
}
