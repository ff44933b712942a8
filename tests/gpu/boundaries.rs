//! Films that end somewhere: on a bath, on a ring, at a drop.

use soapfilm::{
    gpu::Renderer,
    scene::{Boundary, Change, Event, Prick},
    verify::{Part, reference},
};

use crate::support::{hold, load, mean_and_max, radiance, renderer, short_or_long, still};

#[test]
fn films_that_end_keep_to_theory() {
    hold(Part::Rims, 20);
}

/// The same bits however the history was cut into frames, with patches on their way.
#[test]
fn a_film_on_a_bath_is_a_function_of_its_scene_and_tick() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("bath");
    loaded.scene.bubbles[0].film.cells = short_or_long(32, 64);
    loaded.scene.bubbles[0].regeneration = 5.0;
    loaded.scene.motion.drainage = 100.0;
    let film = |renderer: &mut soapfilm::gpu::Renderer, time_s: f64| {
        renderer.render(&still(&loaded, [64, 36], time_s)).unwrap();
        renderer.read_film(0).unwrap().unwrap().1.wait(&renderer.gpu).unwrap()
    };
    let at_once = film(&mut renderer, 0.7);
    for time_s in [0.1, 0.26, 0.41, 0.6] {
        film(&mut renderer, time_s);
    }
    assert!(film(&mut renderer, 0.7) == at_once, "bits differ");
    assert!(film(&mut renderer, 0.6) != at_once, "and it moves");
}

#[test]
fn a_bath_matches_its_f64_twin() {
    let Some(mut renderer) = renderer() else { return };
    for preset in ["bath", "ring"] {
        let mut loaded = load(preset);
        loaded.scene.bubbles[0].film.state = soapfilm::scene::FilmStateName::Rest;
        let mut request = still(&loaded, [64, 36], 0.0);
        // The reference has none.
        request.picture.draw.bubbles[0].bodies.clear();
        // Fewer samples than pictures of this size have, the same for both.
        request.picture.draw.bubbles[0].samples = short_or_long(2, 8);
        let found = radiance(&mut renderer, &request);
        let truth = reference::radiance(&request.picture.draw, &Default::default(), &|| ()).unwrap();
        let brightest = truth.iter().map(|pixel| pixel.max_element()).fold(0.0, f64::max);
        let error = mean_and_max(found.iter().zip(&truth).map(|(a, b)| (*a - *b).abs().max_element() / brightest));
        eprintln!("measured: {preset} against f64, parts of the brightest: {error:?}");
        assert!(error.0 < 4e-3, "{preset}: {error:?}");
    }
}

/// A picture of a bubble that ends at something, in the same light from everywhere: parts of that light.
fn in_a_furnace(renderer: &mut Renderer, boundary: Boundary, rim_deg: f64) -> Vec<f64> {
    let mut loaded = load("furnace");
    loaded.scene.camera.elevation_deg = 20.0;
    let bubble = &mut loaded.scene.bubbles[0];
    (bubble.boundary, bubble.rim_deg, bubble.wire_mm) = (boundary, rim_deg, 5.0);
    let pixels = radiance(renderer, &still(&loaded, [160, 90], 0.0));
    pixels.iter().map(|pixel| pixel.y / pixels[0].y).collect()
}

#[test]
fn a_drop_in_a_furnace_is_not_seen() {
    let Some(mut renderer) = renderer() else { return };
    let pixels = in_a_furnace(&mut renderer, Boundary::Drop, 160.0);
    let (_, most) = mean_and_max(pixels.iter().map(|light| (light - 1.0).abs()));
    assert!(most < 1e-3, "{most}");
}

/// The film before the far half of a wire mirrors light over it; nothing is before the near half.
#[test]
fn a_wire_is_seen_through_the_film_where_it_is_behind_it() {
    let Some(mut renderer) = renderer() else { return };
    let pixels = in_a_furnace(&mut renderer, Boundary::Ring, 100.0);
    let column: Vec<f64> = (0..90).map(|row| pixels[row * 160 + 80]).collect();
    let darkest = |rows: std::ops::Range<usize>| column[rows].iter().copied().fold(f64::MAX, f64::min);
    // The far half is above the middle of the ring.
    let [far, near] = [darkest(30..48), darkest(52..80)];
    assert!((near - 0.5).abs() < 1e-3, "steel: {near}");
    assert!((0.51..0.75).contains(&far), "steel behind film: {far}");
}

#[test]
fn droplets_fly_off_a_hole_beyond_the_bubble() {
    let Some(mut renderer) = renderer() else { return };
    let mut loaded = load("tent");
    loaded.scene.bubbles[0].film.cells = 32;
    loaded.scene.motion.burst_slowdown = 100.0;
    loaded.scene.camera.distance_m *= 2.0;
    let at = [0.2, -0.5, 0.8];
    loaded.scene.events = vec![Event { tick: 10, change: Change::Prick(Prick { bubble: 0, at }) }];
    let mut seen = |time_s: f64| {
        let request = still(&loaded, [160, 90], time_s);
        let pixels = radiance(&mut renderer, &request);
        let bounds = request.picture.draw.bubbles[0].bounds.map(|bound| bound.to_array());
        let beyond = |k: usize| {
            let clip = [(k % 160) as f64 / 80.0 - 0.98, 0.98 - (k / 160) as f64 / 45.0];
            (0..2).any(|axis| clip[axis] < bounds[0][axis] - 0.03 || clip[axis] > bounds[1][axis] + 0.03)
        };
        (0..pixels.len()).filter(|k| beyond(*k) && (pixels[*k] - pixels[0]).abs().max_element() > 1e-4).count()
    };
    assert_eq!(seen(0.1), 0);
    let droplets = seen(1.5);
    assert!(droplets > 20, "{droplets}");
}
