//! The library's front door draws what the renderer draws, and reads films as pictures see them.

use soapfilm::{
    CubeMap, Error, FilmCell, LoadedScene, Scene, Studio,
    glam::DVec3,
    load_scene,
    scene::{Boundary, Change, Event, Prick},
};

use crate::support;

/// A studio on the adapter to test on.
fn studio() -> Option<Studio> {
    support::gpu().map(Studio::on)
}

fn scene(change: impl FnOnce(&mut Scene)) -> LoadedScene {
    let mut scene = Scene::default();
    scene.bubbles[0].film.cells = 32;
    change(&mut scene);
    LoadedScene::from_scene(scene).unwrap()
}

fn mean_nm(film: &[FilmCell]) -> f64 {
    film.iter().map(|cell| cell.solid_angle_sr * cell.thickness_nm).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

#[test]
fn studio_pictures_match_the_renderer() {
    let (Some(mut studio), Some(mut renderer)) = (studio(), support::renderer()) else { return };
    let loaded = load_scene("furnace").unwrap();
    let request = support::still(&loaded, [40, 30], 0.5);
    let expected = support::radiance(&mut renderer, &request);
    let found = studio.radiance(&loaded, [40, 30], 0.5).unwrap();
    assert_eq!((found.rgb.len(), found.rows().len()), (1200, 30));
    let to_bt709 = soapfilm::physics::colour::bt2020_to_bt709();
    for (found, expected) in found.rgb.iter().zip(expected) {
        assert_eq!(*found, (to_bt709 * expected).as_vec3().to_array());
    }
    let picture = studio.render(&loaded, [40, 30], 0.5).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.png");
    picture.save(&file).unwrap();
    let read = image::open(&file).unwrap().to_rgba8();
    assert_eq!((read.dimensions(), read.into_raw()), ((40, 30), picture.rgba));
}

#[test]
fn films_keep_their_liquid_wherever_the_camera_looks() {
    let Some(mut studio) = studio() else { return };
    let loaded = scene(|scene| scene.camera.azimuth_deg = 10.0);
    let away = scene(|scene| scene.camera.target_m = [0.0, 50.0, 0.0]);
    let film = studio.film(&loaded, 0, 0.2).unwrap();
    assert_eq!(film.len(), 6 * 32 * 32);
    // The film is kept as f32, and its liquid within 1e-7.
    let [before, after] = [&studio.film(&loaded, 0, 0.0).unwrap(), &film].map(|film| mean_nm(film));
    assert!((after / before - 1.0).abs() < 1e-6, "{before} nm at first, {after} nm later");
    // That of one seed differs from the scene's mean by some percent.
    assert!((before / loaded.scene.bubbles[0].film.thickness_nm - 1.0).abs() < 0.1, "{before} nm");
    let (thin, thick) = film
        .iter()
        .fold((f64::MAX, 0.0_f64), |(thin, thick), cell| (thin.min(cell.thickness_nm), thick.max(cell.thickness_nm)));
    assert!(thick > 1.1 * thin, "blown film varies: {thin} to {thick} nm");
    assert!(film.iter().all(|cell| (cell.direction.length() - 1.0).abs() < 1e-12));
    // From 50 m away the bubble is small in the picture, and its film takes half of the cells along an edge.
    assert_eq!(studio.film(&away, 0, 0.2).unwrap().len(), 6 * 16 * 16);
}

#[test]
fn cells_beyond_a_rim_have_no_film() {
    let Some(mut studio) = studio() else { return };
    let bath = scene(|scene| scene.bubbles[0].boundary = Boundary::Bath);
    for cell in studio.film(&bath, 0, 0.0).unwrap() {
        assert_eq!(cell.thickness_nm > 0.0, cell.direction.z >= 0.0, "{cell:?}");
    }
    let told = studio.film(&bath, 1, 0.0).unwrap_err();
    assert!(matches!(told, Error::NoBubble { index: 1, count: 1 }), "{told}");
    let told = studio.render(&bath, [0, 5], 0.0).unwrap_err();
    assert!(matches!(told, Error::Size([0, 5])), "{told}");
}

#[test]
fn a_bubble_that_is_pricked_has_a_hole_and_then_no_film() {
    let Some(mut studio) = studio() else { return };
    let pricked = scene(|scene| {
        scene.motion.burst_slowdown = 100.0;
        scene.events.push(Event { tick: 6, change: Change::Prick(Prick { bubble: 0, at: [0.0, 0.0, 1.0] }) });
    });
    let without = |studio: &mut Studio, time_s: f64| {
        let film = studio.film(&pricked, 0, time_s).unwrap();
        film.into_iter().filter(|cell| cell.thickness_nm == 0.0).collect::<Vec<_>>()
    };
    assert!(without(&mut studio, 0.05).is_empty());
    let hole = without(&mut studio, 0.3);
    assert!(!hole.is_empty() && hole.iter().all(|cell| cell.direction.z > 0.5), "{} cells", hole.len());
    // A film of 5 cm bursts within some 20 ms, here in 2 s, and a new bubble is blown after 2 s more.
    let told = studio.film(&pricked, 0, 3.0).unwrap_err();
    assert!(matches!(told, Error::NoFilm { bubble: 0, .. }), "{told}");
}

#[test]
fn an_own_environment_lights_the_picture() {
    let Some(mut studio) = studio() else { return };
    let loaded = scene(|scene| {
        scene.bubbles.clear();
        scene.view.backdrop = soapfilm::scene::Backdrop::Environment;
    });
    let lit = loaded.with_environment(CubeMap::from_fn(16, 1, |direction| DVec3::splat(direction.normalize().z.abs())));
    let radiance = studio.radiance(&lit.unwrap(), [9, 9], 0.0).unwrap();
    // The camera looks down by 8 degrees.
    let [red, green, blue] = radiance.rgb[40];
    let expected = 8_f32.to_radians().sin();
    // A texel of the cube spans 7 degrees.
    assert!([red, green, blue].iter().all(|value| (value - expected).abs() < 0.03), "{:?}", radiance.rgb[40]);
}
