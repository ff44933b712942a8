//! Every adapter that is accepted shows the same: OpenGL beside the backend that the other tests run on.

use soapfilm::{
    gpu::{
        AdapterChoice, Gpu, GpuError, Renderer,
        passes::probe_colour::{ColourProbe, ProbePoint},
    },
    physics::colour::Walls,
    plan::OpticsKey,
    scene::Quality,
};

use crate::support::{REQUIRE_TOOLS, display, gpu, is_set, load, still};

/// OpenGL's adapter, where there is one; the gate demands it.
fn opengl() -> Option<Gpu> {
    let choice = AdapterChoice { name: None, backend: Some("gl".to_owned()) };
    match pollster::block_on(Gpu::headless(&choice)) {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            assert!(!is_set(REQUIRE_TOOLS), "{REQUIRE_TOOLS}=1, but {error}");
            eprintln!("skipped: {error}");
            None
        }
    }
}

#[test]
fn opengl_gives_the_same_colours() {
    let (Some(own), Some(opengl)) = (gpu(), opengl()) else { return };
    let walls = [Walls::One { thickness_nm: 300.0 }, Walls::Two { front_nm: 420.0, back_nm: 900.0, exit_nm: 610.0 }];
    let points: Vec<_> =
        walls.iter().flat_map(|walls| [0.2, 0.8, 1.0].map(|cos| ProbePoint::new(cos, *walls))).collect();
    let optics = OpticsKey { film: Default::default(), illuminant: Default::default() };
    for quality in Quality::ALL {
        let colours = [&own, &opengl].map(|gpu| {
            let probe = ColourProbe::new(gpu, &optics, quality, 1000.0).unwrap();
            probe.measure(gpu, &points).unwrap()
        });
        for (point, (a, b)) in points.iter().zip(colours[0].iter().zip(&colours[1])) {
            assert!((*a - *b).abs().max_element() < 1e-5, "{}: {point:?}: {a} and {b}", quality.name());
        }
    }
}

#[test]
fn opengl_gives_the_same_picture_of_a_film_that_flows() {
    let (Some(own), Some(opengl)) = (gpu(), opengl()) else { return };
    let mut loaded = load("windows");
    loaded.scene.bubbles[0].film.cells = 32;
    loaded.scene.view.dither = false;
    let mut request = still(&loaded, [96, 54], 0.1);
    request.picture.draw.full_precision = false;
    let [a, b] = [own, opengl].map(|gpu| display(&mut Renderer::new(gpu), &request));
    let apart: Vec<u8> = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).collect();
    let mean = apart.iter().map(|steps| f64::from(*steps)).sum::<f64>() / apart.len() as f64;
    assert!(mean < 0.05, "{mean} steps of 255 on average");
}

/// What an adapter cannot do is said, where it is asked for: not every OpenGL draws into 32-bit floats.
#[test]
fn opengl_draws_in_full_precision_or_says_that_it_cannot() {
    let Some(opengl) = opengl() else { return };
    let mut loaded = load("furnace");
    loaded.scene.bubbles.clear();
    let mut renderer = Renderer::new(opengl);
    match renderer.render(&still(&loaded, [16, 9], 0.0)) {
        Ok(plan) => {
            assert!(plan.complete);
            let bytes = renderer.read_radiance().unwrap().wait(&renderer.gpu).unwrap();
            let pixels: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&bytes);
            assert!(pixels.iter().all(|pixel| (pixel[1] - 0.5).abs() < 1e-3), "{:?}", pixels[0]);
        }
        Err(error) => {
            assert!(matches!(error, GpuError::NoFullPrecision { .. }), "{error}");
            assert!(error.to_string().contains("Rgba32Float"), "{error}");
        }
    }
}
