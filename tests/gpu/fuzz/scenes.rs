//! Random scenes from the format's page, all of them valid.

use std::collections::BTreeMap;

use glam::DVec3;
use proptest::prelude::*;
use soapfilm::scene::{Boundary, Change, FilmStateName, Flow, Generator, Layout, Motion, Scene};
use toml::{Table, Value};

use super::values::value;
use crate::support::page::documented;

/// Items of each list of a scene, at most.
const MAX_ITEMS: usize = 2;
/// Cells along an edge of a film at most: random patches take a while on grids as fine as scenes may have, which are tested elsewhere.
const MAX_CELLS: u32 = 24;
/// Bubbles and films of a generator at most.
const MAX_MADE: u32 = 60;
const MAX_FILMS: u32 = 2;
/// Keys that decide which pipelines and tables draw a scene, for each of which a software driver works for a second.
const OF_PIPELINES: [&str; 15] = [
    "boundary",
    "state",
    "cells",
    "detail",
    "thickness_nm",
    "index",
    "skin_nm",
    "fov_y_deg",
    "illuminant",
    "constant",
    "radiance",
    "quality",
    "polariser_deg",
    "backdrop",
    "scheme",
];

/// Values by section, number of the item in its list, and key.
type Settings = BTreeMap<(&'static str, usize, &'static str), Value>;

/// What decides which pipelines draw a scene.
#[derive(Clone, Debug)]
pub struct Frame {
    settings: Settings,
    bubbles: usize,
    generators: usize,
    patches: usize,
    /// Sections of the kinds of the events.
    events: Vec<&'static str>,
    /// From the first bubble's center to the eye in radii, where the camera looks at that bubble; else it looks anywhere.
    radii: Option<f64>,
}

/// Random frames.
pub fn frames() -> impl Strategy<Value = Frame> {
    let kinds: Vec<_> =
        documented().iter().map(|row| row.section).filter(|section| section.starts_with("kind")).collect();
    let bubbles = prop_oneof![6 => Just(1), 1 => Just(0), 1 => Just(MAX_ITEMS)];
    let generators = prop_oneof![3 => Just(0), 1 => Just(1)];
    let events = prop::collection::vec(prop::sample::select(kinds), 0..=MAX_ITEMS);
    let patches = prop_oneof![4 => Just(0), 1 => 1..=MAX_ITEMS];
    let radii = prop_oneof![
        5 => Just(Some(4.8)),
        2 => prop::sample::select(vec![0.0, 0.5, 1.0, 1.02, 2.0, 100.0]).prop_map(Some),
        1 => Just(None)
    ];
    (settings(|key| OF_PIPELINES.contains(&key)), bubbles, generators, patches, events, radii).prop_map(
        |(settings, bubbles, generators, patches, events, radii)| Frame {
            settings,
            bubbles,
            generators,
            patches,
            events,
            radii,
        },
    )
}

/// Random valid scenes in a frame.
pub fn scenes(frame: Frame) -> impl Strategy<Value = Scene> {
    settings(|key| !OF_PIPELINES.contains(&key)).prop_map(move |settings| frame.with(settings))
}

/// Random values of keys: for each item that a scene may have.
fn settings(takes: fn(&str) -> bool) -> impl Strategy<Value = Settings> {
    let rows = documented().into_iter().filter(|row| takes(row.key) && !["version", "kind"].contains(&row.key));
    let places = rows.flat_map(|row| (0..MAX_ITEMS).map(move |item| (row, item)));
    let (keys, values): (Vec<_>, Vec<_>) = places.map(|(row, item)| ((row.section, item, row.key), value(row))).unzip();
    values.prop_map(move |values| {
        let pairs = keys.iter().zip(values);
        pairs.filter_map(|(key, value)| Some((*key, value?))).collect()
    })
}

impl Frame {
    fn with(&self, mut settings: Settings) -> Scene {
        settings.extend(self.settings.clone());
        let table = |section: &str, item: usize| -> Table {
            let own = settings.iter().filter(|((of, at, _), _)| (*of, *at) == (section, item));
            own.map(|((.., key), value)| ((*key).to_owned(), value.clone())).collect()
        };
        let mut scene: Table = ["camera", "lens", "light", "view", "motion"]
            .map(|name| (name.to_owned(), Value::Table(table(name, 0))))
            .into_iter()
            .collect();
        scene.insert("version".to_owned(), Value::Integer(1));
        let with_film = |section, item| {
            let mut owner = table(section, item);
            owner.insert("film".to_owned(), Value::Table(table("bubble.film", item)));
            owner
        };
        let event = |(item, kind): (usize, &&str)| {
            let name = kind.split('"').nth(1).unwrap_or_default();
            let mut event: Table = table("event", item).into_iter().chain(table(kind, item)).collect();
            event.insert("kind".to_owned(), name.into());
            event
        };
        scene.insert(
            "bubble".to_owned(),
            (0..self.bubbles).map(|item| with_film("bubble", item)).collect::<Vec<_>>().into(),
        );
        let generators = (0..self.generators).map(|item| with_film("generator", item)).collect::<Vec<_>>();
        scene.insert("generator".to_owned(), generators.into());
        scene.insert("event".to_owned(), self.events.iter().enumerate().map(event).collect::<Vec<_>>().into());
        let patches = (0..self.patches).map(|item| table("light.patch", item)).collect::<Vec<_>>();
        if let Some(light) = scene["light"].as_table_mut() {
            light.insert("patch".to_owned(), patches.into());
        }
        let mut scene = scene.try_into().unwrap_or_else(|error| panic!("a value of the wrong type: {error}"));
        self.aim(&mut scene);
        reconcile(&mut scene);
        scene
    }

    /// Lets the camera look at the first bubble.
    fn aim(&self, scene: &mut Scene) {
        if let (Some(radii), Some(bubble)) = (self.radii, scene.bubbles.first()) {
            scene.camera.target_m = bubble.center_m;
            scene.camera.distance_m = (radii * 1e-3 * bubble.radius_mm).min(1000.0);
        }
    }
}

/// Makes values that are right each for itself right together, as the format's page says.
fn reconcile(scene: &mut Scene) {
    scene.generators.iter_mut().for_each(reconcile_generator);
    let Scene { bubbles, generators, camera, motion, events, .. } = scene;
    if let [first, others @ ..] = &mut bubbles[..] {
        for other in others {
            (other.film.index, other.film.skin_nm) = (first.film.index.clone(), first.film.skin_nm);
        }
    }
    if bubbles.iter().any(|bubble| bubble.boundary == Boundary::Bath) {
        let height_m = bubbles[0].center_m[2];
        generators.clear();
        for bubble in bubbles.iter_mut() {
            (bubble.boundary, bubble.center_m[2]) = (Boundary::Bath, height_m);
        }
        for event in events.iter_mut() {
            if let Change::Drag(drag) = &mut event.change {
                drag.to_m[2] = height_m;
            }
        }
        camera.target_m[2] = camera.target_m[2].max(height_m);
        (camera.elevation_deg, camera.distance_m) = (camera.elevation_deg.abs().max(5.0), camera.distance_m.max(1e-3));
    }
    let mut has_rim = false;
    for bubble in bubbles.iter_mut() {
        bubble.film.cells = bubble.film.cells.min(MAX_CELLS);
        has_rim |= bubble.boundary != Boundary::Free;
        if bubble.boundary == Boundary::Ring {
            bubble.rim_deg = bubble.rim_deg.min(150.0);
        }
        bubble.patch_mm = bubble.patch_mm.min(0.25 * bubble.radius_mm);
        if bubble.patch_mm < 0.1 {
            (bubble.patch_mm, bubble.regeneration) = (0.1, 0.0);
        }
        if bubble.film.state != FilmStateName::Uniform {
            bubble.film.thickness_nm = bubble.film.thickness_nm.max(1.0);
        }
    }
    events.retain(|event| event.change.bubble().is_none() || !bubbles.is_empty());
    events.sort_by_key(|event| event.tick);
    for event in events {
        reconcile_change(&mut event.change, bubbles.len(), has_rim);
    }
    if has_rim {
        motion.spin_deg_s = [0.0, 0.0, motion.spin_deg_s[2]];
        motion.flow = rimmed(motion.flow);
    }
}

fn reconcile_generator(generator: &mut Generator) {
    (generator.count, generator.films) = (generator.count.min(MAX_MADE), generator.films.min(MAX_FILMS));
    generator.film.cells = generator.film.cells.min(MAX_CELLS);
    if generator.film.state != FilmStateName::Uniform {
        let thinnest = 1.0 - generator.thickness_spread;
        // A little more than 1 nm, which the product may miss by rounding.
        generator.film.thickness_nm = generator.film.thickness_nm.max((1.0 + 1e-12) / thinnest);
    }
    if generator.layout == Layout::Wand {
        generator.life_s = generator.life_s.max(1e-3);
        if generator.direction == [0.0; 3] {
            generator.direction[2] = 1.0;
        }
    }
}

/// What moves films that have a rim.
fn rimmed(flow: Flow) -> Flow {
    if flow == Flow::Rest { flow } else { Flow::Free }
}

fn reconcile_change(change: &mut Change, bubbles: usize, has_rim: bool) {
    let direct = |vector: &mut [f64; 3]| {
        if DVec3::from(*vector).abs().max_element() < 1e-3 {
            vector[0] = 1.0;
        }
    };
    match change {
        Change::Motion(change) => {
            change.strength.get_or_insert(Motion::default().strength);
            if has_rim {
                change.flow = change.flow.map(rimmed);
                change.spin_deg_s = change.spin_deg_s.map(|[_, _, z]| [0.0, 0.0, z]);
            }
        }
        Change::Stir(stir) => {
            direct(&mut stir.at);
            stir.bubble %= bubbles;
        }
        Change::Blow(blow) => {
            direct(&mut blow.at);
            direct(&mut blow.toward);
            blow.bubble %= bubbles;
        }
        Change::Drag(drag) => drag.bubble %= bubbles,
        Change::Prick(prick) => {
            direct(&mut prick.at);
            prick.bubble %= bubbles;
        }
    }
}
