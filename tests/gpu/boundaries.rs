//! Films that end somewhere: on a bath, on a ring, at a drop.

use soapfilm::verify::{Part, reference};

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
        // The reference has no wire.
        loaded.scene.bubbles[0].wire_mm = 0.0;
        let mut request = still(&loaded, [64, 36], 0.0);
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
