//! Films that flow together, against the same films each alone.

use soapfilm::{
    gpu::{
        Gpu,
        film::{Company, Field, Member, MovingFilm, play_together, rules},
        readback::Readback,
        timing::Recorder,
        transport_case::values,
    },
    physics::sphere::CubedSphere,
    plan::{FieldKey, FilmKey, Moment, Story},
    scene::{Boundary, Scene, preset},
};

use crate::support::gpu;

/// Steps in one submission.
const STEPS: usize = 3;

/// Keys of the films of a scene at a tick.
fn keys(scene: &Scene, tick: u64) -> Vec<FieldKey> {
    let story = Story::new(scene.clone());
    let key = |film| match story.film_key(film, Moment::tick(tick)) {
        Some(FilmKey::Field(key)) => key,
        _ => unreachable!("a film that moves"),
    };
    (0..scene.bubbles.len()).map(key).collect()
}

fn seeded(gpu: &Gpu, key: &FieldKey) -> MovingFilm {
    let mut field = Field::new(gpu, CubedSphere::new(key.cells as usize).unwrap(), rules(key)).unwrap();
    field.seed(gpu, key.initial.profile());
    MovingFilm::new(field)
}

/// Plays films together; gives the dispatches that it took.
fn play(gpu: &Gpu, members: &mut [Member<'_>], company: &mut Company, from_tick: u64) -> u64 {
    let mut dispatches = 0;
    play_together(gpu, members, company, (from_tick, STEPS), |recorder: Recorder<'_>| {
        dispatches += recorder.submit(&Default::default()).dispatches;
        gpu.wait()
    })
    .unwrap();
    dispatches
}

/// Thickness and vorticity, bit by bit.
fn bits(gpu: &Gpu, film: &mut MovingFilm) -> Vec<u64> {
    let thickness = values(gpu, &mut film.field).unwrap();
    let flow = film.flow().unwrap();
    let zeta = Readback::of_buffer(gpu, flow.zeta(), flow.zeta().size()).wait(gpu).unwrap();
    let zeta: Vec<f32> = flow.inner(&bytemuck::pod_collect_to_vec(&zeta));
    thickness.into_iter().map(f64::to_bits).chain(zeta.into_iter().map(|value| value.to_bits().into())).collect()
}

/// Free bubbles of different sizes and thicknesses, one of which hangs from a wand, so that it flows alone.
fn scene() -> Scene {
    let mut scene = preset("tent").unwrap();
    scene.bubbles[0].film.cells = 16;
    let bubble = |k: usize| {
        let mut bubble = scene.bubbles[0].clone();
        bubble.radius_mm *= 1.0 - 0.2 * k as f64;
        bubble.film.thickness_nm += 40.0 * k as f64;
        bubble.film.seed += k as u64;
        bubble.boundary = if k == 2 { Boundary::Bath } else { bubble.boundary };
        bubble
    };
    scene.bubbles = (0..4).map(bubble).collect();
    scene
}

/// Nor does it show when the company changes on the way: here the first film stays behind for some ticks.
#[test]
fn a_film_does_not_feel_which_others_flow_with_it() {
    let Some(gpu) = gpu() else { return };
    let scene = scene();
    let (soon, late) = (keys(&scene, 5), keys(&scene, 11));
    let mut films: Vec<MovingFilm> = soon.iter().map(|key| seeded(&gpu, key)).collect();
    let mut company = Company::default();
    let mut members: Vec<Member<'_>> = films.iter_mut().zip(&soon).skip(1).collect();
    play(&gpu, &mut members, &mut company, 0);
    play(&gpu, &mut [(&mut films[0], &soon[0])], &mut company, 0);
    let mut members: Vec<Member<'_>> = films.iter_mut().zip(&late).collect();
    play(&gpu, &mut members, &mut company, 5);
    for (place, (film, key)) in films.iter_mut().zip(&late).enumerate() {
        let mut alone = seeded(&gpu, key);
        play(&gpu, &mut [(&mut alone, key)], &mut Company::default(), 0);
        assert!(bits(&gpu, film) == bits(&gpu, &mut alone), "film {place}");
    }
}

/// The flow's dispatches are shared: each further film brings only those of its own thickness.
#[test]
fn company_shares_the_dispatches_of_the_flow() {
    let Some(gpu) = gpu() else { return };
    let mut scene = scene();
    // Steps of small bubbles take more parts.
    let radius_mm = scene.bubbles[0].radius_mm;
    scene.bubbles.iter_mut().for_each(|bubble| bubble.radius_mm = radius_mm);
    scene.bubbles.remove(2);
    let keys = keys(&scene, 6);
    let dispatches = [1, 2, 3].map(|count| {
        let mut films: Vec<MovingFilm> = keys.iter().take(count).map(|key| seeded(&gpu, key)).collect();
        let mut members: Vec<Member<'_>> = films.iter_mut().zip(&keys).collect();
        // The first step sets films in motion, each by itself.
        let first: Vec<FieldKey> = keys.iter().map(|key| key.at(Moment::tick(1))).collect();
        let mut early: Vec<Member<'_>> =
            members.iter_mut().zip(&first).map(|((film, _), key)| (&mut **film, key)).collect();
        play(&gpu, &mut early, &mut Company::default(), 0);
        play(&gpu, &mut members, &mut Company::default(), 1)
    });
    eprintln!("measured: dispatches of 5 steps of 1, 2 and 3 films: {dispatches:?}");
    let [of_one, of_two, of_three] = dispatches;
    assert_eq!(of_three - of_two, of_two - of_one);
    assert!(3 * (of_two - of_one) < of_one, "{dispatches:?}");
}
