//! What lights and materials need, and the backdrop out of focus.

use super::*;
use crate::physics::environment::CubeFace;

#[test]
fn each_light_has_what_it_needs_and_loses_nothing_to_another() {
    let spectral_light = |illuminant: &str| SpectralLight {
        environment: Arc::new(CubeMap::constant(DVec3::ONE)),
        illuminant: Arc::new(illuminant.parse().unwrap()),
    };
    let lit = |spectral_lights: Vec<SpectralLight>| {
        request(&uniform_scene(), &Resources { spectral_lights, ..resources() }, &shot(0, Pace::Whole)).unwrap()
    };
    let alone = plan(&lit(vec![]), &GpuState::default());
    let both = plan(&lit(vec![spectral_light("A")]), &alone.after);
    assert_eq!(both.after.lights.len(), 2);
    let mut passes = names(&both);
    passes.dedup();
    assert_eq!(passes, ["bake_table", "fit_quadrature", "upload_environment", "draw", "tonemap"]);
    assert!(plan(&lit(vec![spectral_light("A")]), &both.after).is_empty());
    assert_eq!(names(&plan(&lit(vec![]), &both.after)), ["draw", "tonemap"]);
}

#[test]
fn a_lens_blurs_the_tiles_in_sight_once() {
    let mut scene = uniform_scene();
    scene.view.backdrop = Backdrop::Environment;
    (scene.camera.azimuth_deg, scene.camera.elevation_deg) = (0.0, 0.0);
    let sharp = scene.clone();
    scene.lens.aperture_mm = 10.0;
    // So many texels that none is seen where it is sharp.
    let surroundings = Arc::new(CubeMap::from_fn(640, 1, |direction| direction.abs()));
    let resources = Resources { environment: surroundings, ..resources() };
    let made = |from: &GpuState, scene: &Scene| -> (Vec<(usize, bool)>, GpuState) {
        let plan = plan(&request(scene, &resources, &shot(0, Pace::Whole)).unwrap(), from);
        let blurred = plan.steps.iter().filter_map(|(pass, _)| match pass {
            Pass::DefocusBackdrop { key, adds, .. } => Some((key.tiles.iter().count(), *adds)),
            _ => None,
        });
        (blurred.collect(), plan.after)
    };
    let (none, start) = made(&GpuState::default(), &sharp);
    let (first, seen) = made(&start, &scene);
    assert_eq!((none, first), (vec![], vec![(8, false)]));
    // Other tiles come into sight, and none goes.
    scene.camera.azimuth_deg = 30.0;
    let (second, seen) = made(&seen, &scene);
    scene.camera.azimuth_deg = 0.0;
    let (third, seen) = made(&seen, &scene);
    assert_eq!((second, third), (vec![(2, true)], vec![]));
    scene.lens.aperture_mm = 5.0;
    let (other, seen) = made(&seen, &scene);
    assert_eq!((other, made(&seen, &sharp).0), (vec![(8, false)], vec![]));
    assert!(made(&seen, &sharp).1.lights[0].defocused.is_none());
    // Discs narrower than a texel.
    scene.lens.aperture_mm = 1e-6;
    assert_eq!(made(&start, &scene).0, vec![]);
}

#[test]
fn an_environment_that_is_magnified_shows_no_texels() {
    let mut scene = uniform_scene();
    scene.view.backdrop = Backdrop::Environment;
    let surroundings = |size| Arc::new(CubeMap::from_fn(size, 1, |direction| direction.abs()));
    let seen = |scene: &Scene, texels: usize, pixels: u32| {
        let resources = Resources { environment: surroundings(texels), ..resources() };
        let shot = Shot { size: [16 * pixels, 9 * pixels], ..shot(0, Pace::Whole) };
        let draw = request(scene, &resources, &shot).unwrap().picture.draw;
        (draw.defocus(&draw.lighting).map(|key| key.half_angle_rad), draw.lighting.light.defocus_rad)
    };
    scene.camera.fov_y_deg = 30.0;
    // As wide whatever the pixels, so that stills of many samples look the same. Lamps stay sharp.
    assert_eq!(seen(&scene, 64, 4), (Some(2.5 / 64.0), 0.0));
    assert_eq!(seen(&scene, 64, 40), seen(&scene, 64, 4));
    assert_eq!(seen(&scene, 2, 4).0, Some(0.5));
    assert_eq!(seen(&scene, 1, 4).0, None);
    scene.camera.fov_y_deg = 140.0;
    assert_eq!(seen(&scene, 64, 4).0, None);
    // A lens that spreads it farther does so.
    (scene.camera.fov_y_deg, scene.lens.aperture_mm) = (30.0, 100.0);
    let (blur_rad, defocus_rad) = seen(&scene, 64, 4);
    assert!(defocus_rad > 2.5 / 64.0 && blur_rad == Some(defocus_rad));
}

#[test]
fn a_part_of_a_picture_asks_for_the_tiles_that_it_shows() {
    let mut scene = uniform_scene();
    scene.view.backdrop = Backdrop::Environment;
    (scene.camera.azimuth_deg, scene.camera.elevation_deg, scene.camera.fov_y_deg) = (30.0, 0.0, 30.0);
    scene.lens.aperture_mm = 10.0;
    let surroundings = Arc::new(CubeMap::from_fn(256, 1, |direction| direction.abs()));
    let resources = Resources { environment: surroundings, ..resources() };
    let whole = request(&scene, &resources, &shot(0, Pace::Whole)).unwrap().picture.draw;
    let tiles = |draw: &DrawKey| draw.defocus(&draw.lighting).map(|key| key.tiles).unwrap();
    let faces = |face: CubeFace| tiles(&whole).iter().any(|tile| tile.face == face);
    assert_eq!(CubeFace::ALL.into_iter().filter(|face| faces(*face)).count(), 2);
    let parts = [0, 32].map(|x| tiles(&whole.cut(&(x..x + 32), &(0..36))));
    let counts = [tiles(&whole), parts[0], parts[1]].map(|tiles| tiles.iter().count());
    assert!(tiles(&whole).without(parts[0].union(parts[1])).is_empty(), "{counts:?}");
    assert!(counts[0] < 12 && counts[1] < counts[0] && counts[2] < counts[0], "{counts:?}");
}

#[test]
fn each_material_in_sight_has_a_table() {
    let film = |index: f64| Film { index: FilmIndexName::Constant(index), ..Film::default() };
    let bubble = |index: f64, y: f64| Bubble { film: film(index), center_m: [0.0, y, 0.0], ..Bubble::default() };
    let bakes = |bubbles: Vec<Bubble>| {
        let plan =
            plan(&frame_request(&Scene { bubbles, ..uniform_scene() }, 0, Pace::UNMEASURED), &GpuState::default());
        names(&plan).into_iter().filter(|name| *name == "bake_table").count()
    };
    assert_eq!(bakes(vec![bubble(1.3, 0.0), bubble(1.5, 0.01), bubble(1.3, 0.02)]), 2);
    assert_eq!(bakes(vec![bubble(1.3, 0.0), bubble(1.5, 900.0)]), 1, "the second is far out of sight");
}
