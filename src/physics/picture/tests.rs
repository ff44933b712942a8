use glam::{DMat3, DVec2, DVec3};

use super::{FilmSphere, LightPath, PictureCamera, PictureScene};
use crate::physics::{
    colour::{BT2020, FilmOptics, Illuminant, Walls, bt709_to_bt2020, daylight_scale, seen_light},
    optics::FilmIndex,
};

const SIZE: [u32; 2] = [9, 9];

/// Looks from +x at the origin, z up; a sphere of radius 1 fills the picture's middle.
fn camera(eye_x: f64, fov: f64) -> PictureCamera {
    let right = DVec3::Y;
    let pixel_height_m = 2.0 * (0.5 * fov).tan() / f64::from(SIZE[1]);
    PictureCamera { eye_m: eye_x * DVec3::X, forward: DVec3::NEG_X, right, up: DVec3::Z, pixel_height_m }
}

fn sphere<'a>(thickness_nm: f64) -> FilmSphere<'a> {
    FilmSphere {
        center_m: DVec3::ZERO,
        radius_m: 1.0,
        stretch: DMat3::IDENTITY,
        thickness_nm: Box::new(move |_| thickness_nm),
    }
}

fn radiance(
    illuminant: &Illuminant,
    camera: PictureCamera,
    thickness_nm: f64,
    surroundings: &(dyn Fn(DVec3) -> DVec3 + Sync),
    backdrop: Option<DVec3>,
) -> Vec<DVec3> {
    let optics = FilmOptics::new(FilmIndex::Water, illuminant);
    let spheres = vec![sphere(thickness_nm)];
    PictureScene {
        size: SIZE,
        camera,
        optics: &optics,
        spheres,
        surroundings,
        backdrop,
        polariser: None,
        on_bath: false,
        samples: 1,
    }
    .radiance(&|| ())
}

fn middle(pixels: &[DVec3]) -> DVec3 {
    pixels[pixels.len() / 2]
}

#[test]
fn a_bubble_vanishes_in_the_same_light_from_everywhere() {
    let light = DVec3::new(0.3, 0.5, 0.7);
    for illuminant in ["D65", "A"].map(|name| name.parse().unwrap()) {
        for (eye, thickness_nm) in [(4.0, 0.0), (4.0, 320.0), (4.0, 5000.0), (0.0, 400.0), (0.9, 400.0)] {
            let pixels = radiance(&illuminant, camera(eye, 0.6), thickness_nm, &|_| light, None);
            let light = seen_light(&illuminant) * light;
            let error = pixels.iter().map(|pixel| (*pixel - light).abs().max_element()).fold(0.0, f64::max);
            assert!(error < 1e-12, "{eye} {thickness_nm}: {error}");
        }
    }
}

/// Straight through the middle of a uniform bubble every reflection goes to and fro, so light from behind the camera alone shows the
/// front wall and what comes back from the others: the geometric series R + T² R (1 + R² + …) per wavelength.
#[test]
fn the_middle_pixel_sums_the_series_of_reflections() {
    let illuminant = Illuminant::default();
    let front_light = |direction: DVec3| if direction.x > 0.0 { DVec3::ONE } else { DVec3::ZERO };
    let seen = middle(&radiance(&illuminant, camera(4.0, 0.6), 300.0, &front_light, Some(DVec3::ZERO)));
    let optics = FilmOptics::new(FilmIndex::Water, &illuminant);
    let wall = |i: usize| Walls::One { thickness_nm: 300.0 }.reflectance(&optics.wall(i, 1.0));
    let series = |r: f64| r + (1.0 - r).powi(2) * r / (1.0 - r * r);
    let expected = BT2020.from_xyz() * optics.weights().integrate(|i| series(wall(i)));
    let white = BT2020.from_xyz() * optics.weights().white();
    // What is left after the last direction followed is below 1e-6.
    assert!((seen - expected / white).abs().max_element() < 1e-6, "{seen} {expected}");
}

#[test]
fn a_bubble_without_film_shows_what_is_behind_it() {
    let sky = |direction: DVec3| DVec3::splat(0.5 + 0.3 * direction.y + 0.1 * direction.z);
    let with = radiance(&Illuminant::default(), camera(4.0, 0.6), 0.0, &sky, None);
    let without: Vec<DVec3> = (0..81)
        .map(|k| sky(camera(4.0, 0.6).ray(SIZE, DVec2::new(f64::from(k % 9) + 0.5, f64::from(k / 9) + 0.5))))
        .collect();
    // Rim pixels are means over samples of a curved function.
    let error = with.iter().zip(&without).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
    assert!(error < 1e-3, "{error}");
}

/// RGB light stands for a spectrum: the front wall in red light from behind the camera is the film's matrix, not a product of colours.
#[test]
fn coloured_light_meets_the_film_as_a_spectrum() {
    let red = bt709_to_bt2020() * DVec3::new(1.0, 0.02, 0.02);
    let optics = FilmOptics::new(FilmIndex::Water, &Illuminant::default());
    let front_light = |direction: DVec3| if direction.x > 0.0 { red } else { DVec3::ZERO };
    // From just inside the front wall nothing but the back wall's two reflections of light from the front is seen.
    let seen = middle(&radiance(&Illuminant::default(), camera(4.0, 0.6), 430.0, &front_light, Some(DVec3::ZERO)));
    let matrix = optics.light_matrix(1.0, Walls::One { thickness_nm: 430.0 });
    let single = daylight_scale() * (BT2020.from_xyz() * (matrix * DVec3::new(1.0, 0.02, 0.02)));
    // Front and back wall, each dimmed a little by the other.
    let ratio = seen / (2.0 * single);
    assert!((0.85..1.0).contains(&ratio.x), "{seen} {single}");
    let product = red * (BT2020.from_xyz() * optics.xyz(1.0, Walls::One { thickness_nm: 430.0 }));
    assert!((single / product - 1.0).abs().max_element() > 0.2, "{single} {product}");
}

/// At Brewster's angle a polariser that passes only p light sees no film, one across it twice the unpolarised reflection.
#[test]
fn a_polariser_takes_the_reflection_at_brewsters_angle() {
    let optics = FilmOptics::new(FilmIndex::Constant(4.0 / 3.0), &Illuminant::default());
    let paths = |axis| LightPath::new(&optics, axis);
    // The foot of a ray at Brewster's angle: sin θ = n / √(1 + n²) = 0.8.
    let (eye, ray) = (DVec3::new(4.0, 0.8, 0.0), DVec3::NEG_X);
    let front =
        |axis| paths(axis).trace(eye, ray, DMat3::IDENTITY, None, &|_| 300.0).unwrap().reflected[0].1 * DVec3::ONE;
    let (unpolarised, s, p) = (front(None), front(Some(DVec3::Z)), front(Some(DVec3::Y)));
    assert!(p.max_element() < 1e-12 && (s - 2.0 * unpolarised).abs().max_element() < 1e-12, "{s} {p} {unpolarised}");
}

#[test]
fn the_nearer_bubble_hides_the_farther() {
    let optics = FilmOptics::new(FilmIndex::Water, &Illuminant::default());
    let picture = |spheres| {
        let scene = PictureScene {
            size: SIZE,
            camera: camera(9.0, 0.2),
            optics: &optics,
            spheres,
            surroundings: &|_| DVec3::ONE,
            backdrop: Some(DVec3::ZERO),
            polariser: None,
            on_bath: false,
            samples: 1,
        };
        middle(&scene.radiance(&|| ()))
    };
    let far = || FilmSphere { center_m: DVec3::new(-3.0, 0.0, 0.0), ..sphere(500.0) };
    assert_eq!(picture(vec![far(), sphere(300.0)]), picture(vec![sphere(300.0)]));
    assert_ne!(picture(vec![far(), sphere(300.0)]), picture(vec![far()]));
}

#[test]
fn positions_and_rays_are_inverse() {
    let camera = camera(4.0, 1.0);
    for position in [DVec2::new(0.0, 0.0), DVec2::new(8.5, 0.25), DVec2::new(4.5, 4.5)] {
        assert!(camera.position(SIZE, camera.ray(SIZE, position)).unwrap().distance(position) < 1e-12);
    }
    assert_eq!(camera.position(SIZE, DVec3::X), None);
}
