use std::{collections::BTreeMap, sync::Arc};

use glam::DVec3;

use super::*;
use crate::{
    physics::{
        colour::{Gamut, Illuminant},
        environment::CubeMap,
    },
    plan::{Moment, Pace, Resources, Shot, request},
    scene::{Boundary, Bubble, Camera, Film, FilmStateName, Scene, View},
};

/// A bubble of 40 mm at a place.
fn bubble(center_m: [f64; 3]) -> Bubble {
    let film = Film { state: FilmStateName::Uniform, ..Film::default() };
    Bubble { center_m, radius_mm: 40.0, film, ..Bubble::default() }
}

/// Bubbles at places before an eye at (0.6, 0, 0) m that looks along -x, by the place in the scene of each.
fn placed(centers_m: &[[f64; 3]], quality: Quality) -> Vec<Placed> {
    placed_bubbles(centers_m.iter().copied().map(bubble).collect(), quality)
}

fn placed_bubbles(bubbles: Vec<Bubble>, quality: Quality) -> Vec<Placed> {
    let key = draw_key(bubbles, quality);
    let composition = composition(&key).placed;
    let mut placed: Vec<(usize, Placed)> = key.bubbles.iter().map(|bubble| bubble.index).zip(composition).collect();
    placed.sort_by_key(|(index, _)| *index);
    placed.into_iter().map(|(_, placed)| placed).collect()
}

fn draw_key(bubbles: Vec<Bubble>, quality: Quality) -> DrawKey {
    let scene = Scene {
        bubbles,
        camera: Camera { azimuth_deg: 0.0, elevation_deg: 0.0, distance_m: 0.6, ..Camera::default() },
        view: View { quality, ..View::default() },
        ..Scene::default()
    };
    let resources = Resources {
        environment: Arc::new(CubeMap::constant(DVec3::ONE)),
        illuminant: Arc::new(Illuminant::default()),
        spectral_lights: Vec::new(),
        liquids: BTreeMap::new(),
        plate: None,
    };
    let shot = Shot {
        size: [1280, 720],
        moment: Moment::default(),
        full_precision: false,
        gamut: Gamut::Srgb,
        pace: Pace::Whole,
    };
    request(&scene, &resources, &shot).unwrap().picture.draw
}

fn layers(centers_m: &[[f64; 3]]) -> Vec<usize> {
    placed(centers_m, Quality::Standard).iter().map(|placed| placed.layer).collect()
}

#[test]
fn bubbles_side_by_side_are_drawn_at_once() {
    assert_eq!(layers(&[[0.0; 3]]), [0]);
    assert_eq!(layers(&[[0.0, -0.1, 0.0], [0.0, 0.0, 0.0], [0.0, 0.1, 0.0]]), [0, 0, 0]);
}

#[test]
fn the_nearer_bubble_is_drawn_later_whatever_the_order_in_the_file() {
    let [near, middle, far] = [[0.1, 0.0, 0.0], [0.0, 0.01, 0.0], [-0.1, 0.0, 0.01]];
    assert_eq!(layers(&[near, middle, far]), [3, 2, 1]);
    assert_eq!(layers(&[far, near, middle]), [1, 3, 2]);
    assert_eq!(layers(&[near, [0.0, 0.15, 0.0], far]), [2, 1, 1], "one of them is beside the others");
}

#[test]
fn bubbles_that_intersect_are_a_cluster_over_what_is_behind_all_of_them() {
    let placed = placed(&[[0.1, 0.0, 0.0], [0.05, 0.02, 0.0], [-0.15, 0.0, 0.0], [0.1, 0.1, 0.0]], Quality::Fast);
    let behind: Vec<_> = placed.iter().map(|placed| (placed.layer, placed.behind_layer)).collect();
    assert_eq!(behind, [(3, 2), (2, 2), (1, 1), (1, 1)]);
    let among: Vec<_> = placed.iter().map(|placed| placed.among.len()).collect();
    assert_eq!(among, [1, 1, 0, 0]);
    assert!(placed[0].mirrors && !placed[3].mirrors);
}

#[test]
fn a_wire_is_drawn_before_its_bubble_and_after_it() {
    let ring = Bubble { boundary: Boundary::Ring, ..bubble([0.0; 3]) };
    let placed = placed_bubbles(vec![ring, bubble([0.15, 0.0, 0.0])], Quality::Standard);
    let [ring, near] = &placed[..] else { panic!("{placed:?}") };
    assert_eq!((ring.bodies[0].layers, ring.layer, ring.behind_layer), ([1, 3], 2, 2));
    assert!(near.layer == 4 && near.bodies.is_empty());
}

/// Layer 0 is then the backdrop alone, for what is polarised is known from there on.
#[test]
fn what_is_polarised_is_kept_where_bubbles_lie_over_one_another() {
    let tracks = |centers_m: &[[f64; 3]], quality, change: fn(&mut Composition)| {
        let key = draw_key(centers_m.iter().copied().map(bubble).collect(), quality);
        let mut composition = composition(&key);
        change(&mut composition);
        composition.tracks_polarisation(&key)
    };
    let [over, apart] = [[[0.1, 0.0, 0.0], [-0.1, 0.0, 0.01]], [[0.0, -0.1, 0.0], [0.0, 0.1, 0.0]]];
    assert!(tracks(&over, Quality::Spectral, |_| ()));
    assert!(!tracks(&over, Quality::Standard, |_| ()));
    assert!(!tracks(&apart, Quality::Spectral, |_| ()));
    assert!(!tracks(&over[..1], Quality::Spectral, |_| ()));
    // Something at a film that lies over nothing but the backdrop leaves all bubbles in layer 0.
    let beside = |composition: &mut Composition| {
        let rect = composition.placed[0].rect.clone();
        composition.placed[0].bodies.push(PlacedBody { rect, layers: [0, 1] });
    };
    assert!(!tracks(&apart, Quality::Spectral, beside));
}

#[test]
fn bubbles_mirror_those_that_look_large_from_them() {
    let centers_m = [[0.0, -0.05, 0.0], [0.0, 0.05, 0.0], [-9.0, 0.3, 0.0]];
    let mirrored = |quality| placed(&centers_m, quality).into_iter().map(|placed| placed.mirrored.len());
    assert_eq!(mirrored(Quality::Standard).collect::<Vec<_>>(), [1, 1, 0]);
    assert_eq!(mirrored(Quality::Fast).sum::<usize>(), 0);
}

#[test]
fn a_rectangle_holds_the_whole_outline_within_some_rows() {
    let rect = placed(&[[0.0; 3]], Quality::Fast)[0].rect.clone();
    // tan of the limb, over the height of a pixel on the plane one metre before the eye.
    let radius = (0.04_f64 / 0.6).asin().tan() / (2.0 * 15.0_f64.to_radians().tan() / 720.0);
    let [low, high] = [rect.rows.start, rect.rows.end].map(f64::from);
    assert!(low < 360.0 - radius && low > 355.0 - radius && high > 360.0 + radius && high < 365.0 + radius);
    assert_eq!(rect.within(&(0..100)), None);
    assert_eq!(rect.within(&(0..360)).map(|part| part.rows), Some(rect.rows.start..360));
}
