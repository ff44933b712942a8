//! The format's page against the code, and reading and writing whole scenes.

use super::*;
use crate::Words;
use page::{Row, documented};

mod orders;
#[path = "../../../tests/support/page.rs"]
mod page;
mod random;
mod refusals;
mod settings;

fn with_version(text: &str) -> String {
    format!("version = 1\n{text}")
}

/// The table of a scene's TOML that a section names; the first item of a list, the event of a kind.
fn section<'a>(scene: &'a toml::Table, path: &str) -> &'a toml::Table {
    if let Some(kind) = kind(path) {
        let events = scene["event"].as_array().expect("a list").iter();
        let mut tables = events.map(|event| event.as_table().expect("a list of tables"));
        return tables.find(|event| event["kind"].as_str() == Some(kind)).expect("an event of each kind");
    }
    path.split('.').filter(|name| !name.is_empty()).fold(scene, |table, name| match &table[name] {
        toml::Value::Array(items) => items[0].as_table().expect("a list of tables"),
        value => value.as_table().expect("a table"),
    })
}

/// The kind of event that a section is about.
fn kind(section: &str) -> Option<&str> {
    section.strip_prefix("kind = \"")?.strip_suffix('"')
}

/// A text that sets one key of one section.
fn setting(section: &str, key: &str, value: &str) -> String {
    match section {
        _ if kind(section) == Some("motion") => setting("event", key, value),
        _ if kind(section).is_some() => with_version(&format!("[[event]]\n{section}\n{key} = {value}\n")),
        "" => format!("{key} = {value}\n"),
        "bubble" => with_version(&format!("[[bubble]]\n{key} = {value}\n")),
        "generator" => with_version(&format!("[[generator]]\n{key} = {value}\n")),
        "bubble.film" => with_version(&format!("[[bubble]]\n[bubble.film]\n{key} = {value}\n")),
        "camera.keyframe" => with_version(&format!("[[camera.keyframe]]\n{key} = {value}\n")),
        "light.lamp" => with_version(&format!("[[light.lamp]]\n{key} = {value}\n")),
        "light.patch" => with_version(&format!("[[light.patch]]\n{key} = {value}\n")),
        "event" => with_version(&format!("[[event]]\nkind = \"motion\"\nseed = 2\n{key} = {value}\n")),
        _ => with_version(&format!("[{section}]\n{key} = {value}\n")),
    }
}

/// The page's tables: the section that each belongs to, and its keys.
fn tables() -> Vec<(&'static str, Vec<Key>)> {
    let version = Key {
        name: "version",
        label: "",
        unit: "",
        range: Range::Within(VERSION.into(), VERSION.into()),
        help: "version of this format; required",
        normal: || None,
    };
    let other = |name, range, help| Key { name, label: "", unit: "", range, help, normal: || None };
    let kind = other("kind", Range::Word(event::Kind::NAMES, event::Kind::HELP), "what happens; required");
    let tick = other("tick", Range::Whole, "when it happens; not before the event above it");
    vec![
        ("", vec![version]),
        ("bubble", Bubble::ALL_KEYS.to_vec()),
        ("bubble.film", Film::ALL_KEYS.to_vec()),
        ("generator", Generator::ALL_KEYS.to_vec()),
        ("camera", Camera::ALL_KEYS.to_vec()),
        ("camera.keyframe", Keyframe::ALL_KEYS.to_vec()),
        ("lens", Lens::ALL_KEYS.to_vec()),
        ("light", Light::ALL_KEYS.to_vec()),
        ("light.spectrum", LightSpectrum::ALL_KEYS.to_vec()),
        ("light.patch", LightPatch::ALL_KEYS.to_vec()),
        ("light.lamp", LightLamp::ALL_KEYS.to_vec()),
        ("view", View::ALL_KEYS.to_vec()),
        ("motion", Motion::ALL_KEYS.to_vec()),
        ("event", vec![kind, tick]),
        ("kind = \"motion\"", MotionChange::ALL_KEYS.to_vec()),
        ("kind = \"stir\"", Stir::ALL_KEYS.to_vec()),
        ("kind = \"blow\"", Blow::ALL_KEYS.to_vec()),
        ("kind = \"drag\"", Drag::ALL_KEYS.to_vec()),
        ("kind = \"prick\"", Prick::ALL_KEYS.to_vec()),
    ]
}

/// A range as the page writes it.
fn written_range(range: Range) -> String {
    match range {
        Range::Within(low, high) => format!("{low} ..= {high}"),
        Range::Finite => "finite".to_owned(),
        Range::Whole => "whole".to_owned(),
        Range::Word(words, _) => words.iter().map(|word| format!("`\"{word}\"`")).collect::<Vec<_>>().join(", "),
        Range::Flag => "`true`, `false`".to_owned(),
        Range::Other(text) => text.to_owned(),
    }
}

/// What a key means; each word of a choice, too.
fn meaning(key: &Key) -> String {
    let Range::Word(words, help) = key.range else { return key.help.to_owned() };
    let plain = |help: &str| help[..1].to_lowercase() + &help[1..];
    let words = words.iter().zip(help).map(|(word, help)| format!("`{word}`: {}", plain(help)));
    format!("{}. {}", key.help, words.collect::<Vec<_>>().join("; "))
}

/// The scene with an item in each list, every key that has a default at its default.
fn defaults() -> toml::Table {
    let changes = [
        Change::Motion(MotionChange::default()),
        Change::Stir(Stir::default()),
        Change::Blow(Blow::default()),
        Change::Drag(Drag::default()),
        Change::Prick(Prick::default()),
    ];
    let scene = Scene {
        generators: vec![Generator::default()],
        camera: Camera { keyframes: vec![Keyframe::default()], ..Camera::default() },
        light: Light {
            spectrum: Some(LightSpectrum::default()),
            lamps: vec![LightLamp::default()],
            patches: vec![LightPatch::default()],
            ..Light::default()
        },
        events: changes.map(|change| Event { tick: 0, change }).into(),
        ..Scene::default()
    };
    toml::Table::try_from(scene).unwrap()
}

/// A page with its tables as the code has them: each takes the place of the first table below its heading. `defaults` has each key at its default.
fn page_of_the_code(page: &str, tables: &[(&str, Vec<Key>)], defaults: &toml::Table) -> String {
    let (mut lines, mut heading, mut in_table) = (Vec::new(), Some(""), false);
    for line in page.lines() {
        if let Some(header) = line.strip_prefix("## ") {
            heading = Some(page::section_of(header));
        }
        let is_row = line.starts_with('|');
        let keys = heading.and_then(|heading| tables.iter().find(|(section, _)| *section == heading));
        if let (true, Some((path, keys))) = (is_row && !in_table, keys) {
            lines.extend(["| key | default | range | meaning |".to_owned(), "|---|---|---|---|".to_owned()]);
            let default = |key: &Key| {
                section(defaults, path).get(key.name).map_or("absent".to_owned(), |value| format!("`{value}`"))
            };
            let is_change = kind(path) == Some("motion");
            lines.extend(keys.iter().map(|key| {
                let help = if is_change { format!("new `{}`", key.name) } else { meaning(key) };
                format!("| `{}` | {} | {} | {help} |", key.name, default(key), written_range(key.range))
            }));
            heading = None;
            in_table = true;
        } else if !(is_row && in_table) {
            in_table = false;
            lines.push(line.to_owned());
        }
    }
    lines.join("\n") + "\n"
}

/// The formats' pages list every key with its default, range and meaning, in the words of the code. `SOAPFILM_BLESS=1` writes them anew.
#[test]
fn the_pages_list_the_keys_of_the_code() {
    page_lists("assets/scenes/README.md", &tables(), &defaults());
    let lesson = lesson::Lesson { steps: vec![lesson::LessonStep::with_task()], ..lesson::Lesson::default() };
    page_lists("assets/lessons/README.md", &lesson::Lesson::tables(), &toml::Table::try_from(lesson).unwrap());
}

fn page_lists(path: &str, tables: &[(&str, Vec<Key>)], defaults: &toml::Table) {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    let page = std::fs::read_to_string(&path).unwrap();
    let expected = page_of_the_code(&page, tables, defaults);
    if std::env::var("SOAPFILM_BLESS").is_ok_and(|value| value == "1") {
        return std::fs::write(path, &expected).unwrap();
    }
    let wrong: Vec<_> = page.lines().zip(expected.lines()).filter(|(known, coded)| known != coded).collect();
    assert!(page == expected, "SOAPFILM_BLESS=1 writes the page anew: {wrong:#?}");
    let listed = expected.lines().filter(|line| line.starts_with("| `")).count();
    assert_eq!(listed, tables.iter().map(|(_, keys)| keys.len()).sum::<usize>(), "each table has its heading");
}

/// No key is missing in the tables of the code.
#[test]
fn every_key_of_a_scene_is_in_a_section() {
    let every_key = syntax::every_key();
    for (path, keys) in tables() {
        let coded = section(&every_key, path).iter();
        // What all events have stands in a table of its own.
        let of_all = |key: &str| key == "kind" || key == "tick";
        let belongs = |key: &str| path != "event" && kind(path).is_none() || of_all(key) == (path == "event");
        let coded = coded.filter(|(_, value)| !is_section(value)).map(|(key, _)| key.as_str());
        let mut coded: Vec<&str> = coded.filter(|key| belongs(key)).collect();
        let mut listed: Vec<&str> = keys.iter().map(|key| key.name).collect();
        coded.sort_unstable();
        listed.sort_unstable();
        assert_eq!(listed, coded, "[{path}]");
    }
}

fn is_section(value: &toml::Value) -> bool {
    value.is_table() || value.as_array().is_some_and(|items| items.iter().any(toml::Value::is_table))
}

/// A number as TOML, in the form that its key takes.
fn written(key: &str, default: &str, value: f64) -> String {
    // TOML writes `nan` where Rust writes `NaN`.
    let number = format!("{value:?}").to_lowercase();
    match key {
        "blades" | "cells" | "count" | "films" | "remap_ticks" | "ticks" | "version" => {
            format!("{}", value.round()).to_lowercase()
        }
        _ if default.starts_with('[')
            || ["constant", "radiance", "spin_deg_s", "gravity_m_s2", "target_m"].contains(&key) =>
        {
            format!("[0, {number}, 0]")
        }
        _ => number,
    }
}

#[test]
fn documented_ranges_are_the_enforced_ranges() {
    let mut ranges = 0;
    for Row { section: path, key, default, range, .. } in documented() {
        let accepts = |value| Scene::from_toml(&setting(path, key, &written(key, default, value)), key).is_ok();
        let (low, high) = match range.split_once(" ..= ") {
            Some((low, high)) => (low.parse().unwrap(), high.parse().unwrap()),
            None if range == "finite" => (f64::MIN, f64::MAX),
            None => continue,
        };
        // A millionth beyond the end of a range of numbers, one beyond the end of a range of whole numbers.
        let whole = !written(key, default, 1.0).contains('.');
        let step = |end: f64| if whole { 1.0 } else { 1e-6 * end.abs().max(1.0) };
        assert!(accepts(low) && accepts(high), "{key} in [{path}] must allow {low} and {high}");
        for outside in [low - step(low), high + step(high), f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!((low..=high).contains(&outside) || !accepts(outside), "{key} = {outside} in [{path}]");
        }
        ranges += 1;
    }
    assert!(ranges > 20, "only {ranges} ranges found in the page");
}

#[test]
fn scene_in_memory_is_refused_by_its_key() {
    let mut scene = Scene { bubbles: vec![Bubble::default(); 2], ..Scene::default() };
    scene.bubbles[1].film.index = FilmIndexName::Constant(f64::NAN);
    let message = scene.validate().unwrap_err().to_string();
    assert_eq!(message, "`index` in [bubble.film] number 2 is NaN; it must be within 1 ..= 4");
    let newer = Scene { version: 2, ..Scene::default() };
    assert!(newer.validate().is_err(), "the version must be checked too");
}

#[test]
fn a_scene_without_keys_is_the_preset_tent() {
    assert_eq!(preset("tent"), Some(Scene::default()));
    assert_eq!(preset_names().next(), Some("default"));
    assert_eq!(preset("no such scene"), None);
}

#[test]
fn presets_read_and_round_trip() {
    assert!(preset_names().len() > 5);
    for name in preset_names() {
        let text = preset_toml(name).unwrap();
        let scene = Scene::from_toml(text, name).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(Scene::from_toml(&scene.to_toml(), name).as_ref(), Ok(&scene));
        let sentence = preset_sentence(name).unwrap();
        assert!(text.starts_with(&format!("# {}", &sentence[..20])), "{name} must say what it shows: {sentence}");
        assert!(sentence.ends_with('.') && sentence.len() <= 200, "{name} must say so in one sentence: {sentence}");
    }
}

#[test]
fn presets_are_all_embedded() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let scenes = files.filter(|path| path.extension().is_some_and(|end| end == "toml"));
    let mut found: Vec<String> = scenes.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    let mut embedded: Vec<&str> = preset_names().collect();
    found.sort_unstable();
    embedded.sort_unstable();
    assert_eq!(found, embedded);
}

/// Two films that intersect would need a shared wall, which no preset may pretend to have.
#[test]
fn bubbles_of_presets_do_not_touch() {
    let mut pairs = 0;
    for scene in preset_names().filter_map(preset) {
        for (index, a) in scene.bubbles.iter().enumerate() {
            for b in &scene.bubbles[..index] {
                let distance_m = glam::DVec3::from(a.center_m).distance(b.center_m.into());
                let [apart, inside] =
                    [a.radius_mm + b.radius_mm, (a.radius_mm - b.radius_mm).abs()].map(|mm| 1e-3 * mm);
                assert!(distance_m > apart || distance_m < inside, "{a:?} touches {b:?}");
                pairs += 1;
            }
        }
    }
    assert!(pairs > 0, "no preset has two bubbles");
}

#[test]
fn bubbles_too_large_to_be_round_are_warned_of() {
    let scene = |radius_mm: f64| {
        let large = Bubble { radius_mm, ..Bubble::default() };
        Scene { bubbles: vec![Bubble::default(), large], ..Scene::default() }
    };
    assert_eq!(scene(1000.0).warnings(), Vec::<String>::new());
    let warnings = scene(1500.0).warnings();
    assert!(warnings.len() == 1 && warnings[0].contains("number 2") && warnings[0].contains("1500"), "{warnings:?}");
}

/// Real films: of 20 to 2000 mm²/s with their surfaces, up to 3 µm thick, on bubbles from a centimetre to a metre, in gravity no stronger
/// than the Earth's, losing 100 nm per second at most, drawn with patches of millimetres.
#[test]
fn presets_have_constants_of_real_films() {
    for name in preset_names() {
        let scene = preset(name).unwrap();
        let ticks = std::iter::once(0).chain(scene.events.iter().map(|event| event.tick));
        for motion in ticks.map(|tick| scene.motion_at(tick)) {
            assert!((20.0..=2000.0).contains(&motion.viscosity_mm2_s), "{name}");
            assert!(glam::DVec3::from(motion.gravity_m_s2).length() < 9.9, "{name}");
            assert!(
                motion.evaporation_nm_s <= 100.0 && motion.air_drag <= 1.0 && motion.diffusion_mm2_s <= 1.0,
                "{name}"
            );
            assert!(motion.drainage <= 1.0 && motion.drag_1_s <= 20.0, "{name}");
        }
        for bubble in &scene.bubbles {
            assert!((10.0..=1000.0).contains(&bubble.radius_mm), "{name}");
            assert!((0.0..=3000.0).contains(&bubble.film.thickness_nm) && bubble.film.skin_nm <= 3.0, "{name}");
            assert!((1.0..=10.0).contains(&bubble.patch_mm) && bubble.regeneration <= 2.0, "{name}");
        }
    }
}

#[test]
fn no_bubbles_is_not_the_default_bubble() {
    let empty = Scene::from_toml("version = 1\nbubble = []", "s.toml").unwrap();
    assert_eq!(empty.bubbles, []);
    assert_eq!(Scene::from_toml(&empty.to_toml(), "s.toml"), Ok(empty));
    assert_eq!(Scene::from_toml("version = 1", "s.toml"), Ok(Scene::default()));
}

#[test]
fn words_and_values_share_a_key() {
    let read = |text: &str| Scene::from_toml(&with_version(text), "s.toml").unwrap();
    let index = |value: &str| read(&format!("[[bubble]]\nfilm.index = {value}")).bubbles[0].film.index.clone();
    assert_eq!((index("\"water\""), index("2")), (FilmIndexName::Water, FilmIndexName::Constant(2.0)));
    assert_eq!(index("\"glycerol 30%\""), FilmIndexName::Named("glycerol 30%".to_owned()));
    let environment = |value: &str| read(&format!("light.environment = \"{value}\"")).light.environment;
    assert_eq!((environment("tent"), environment("windows")), (Environment::Tent, Environment::Windows));
    assert_eq!((environment("park"), environment("studio")), (Environment::Park, Environment::Studio));
    assert_eq!(environment("sky/Noon.EXR"), Environment::File("sky/Noon.EXR".to_owned()));
    let backdrop = |value: &str| read(&format!("view.backdrop = {value}")).view.backdrop;
    assert_eq!(backdrop("\"environment\""), Backdrop::Environment);
    assert_eq!(backdrop("[0, 0.5, 1]"), Backdrop::Radiance([0.0, 0.5, 1.0]));
}

#[test]
fn the_viscosity_of_a_film_is_given_or_follows_from_its_surfaces() {
    let given = Motion { viscosity_mm2_s: 70.0, ..Motion::default() };
    let surfaces = Motion { surface_viscosity_upa_s_m: 0.03, ..given };
    let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
    assert!(close(given.film_viscosity_m2_s(1e-6), 7e-5));
    assert!(close(surfaces.film_viscosity_m2_s(1e-6), 6.11e-5), "μ/ρ + 2 μ_s / ρh");
    assert!(
        close(surfaces.film_viscosity_m2_s(5e-7), 1.211e-4),
        "twice as much for half of the thickness, but for the liquid"
    );
    let stiff = Motion { surface_viscosity_upa_s_m: 1000.0, ..given };
    for thickness_m in [0.0, 1e-9] {
        assert_eq!(stiff.film_viscosity_m2_s(thickness_m), 1.0, "no more than can be given");
    }
}
