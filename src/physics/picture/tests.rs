use glam::{DMat3, DVec2, DVec3};

mod polarised;

use super::{FilmSphere, PictureCamera, PictureScene, bath::mirrored_part, light_path::LightPath};
use crate::physics::{
    colour::{BT2020, FilmOptics, Illuminant, Walls, bt709_to_bt2020, daylight_scale, seen_light},
    optics::{FilmIndex, FilmMaterial, Polarised},
};

const SIZE: [u32; 2] = [9, 9];

/// Looks from +x at the origin, z up; a sphere of radius 1 fills the picture's middle.
fn camera(eye_x: f64, fov: f64) -> PictureCamera {
    let right = DVec3::Y;
    let pixel_height_m = 2.0 * (0.5 * fov).tan() / f64::from(SIZE[1]);
    PictureCamera { eye_m: eye_x * DVec3::X, forward: DVec3::NEG_X, right, up: DVec3::Z, pixel_height_m }
}

fn water() -> FilmOptics {
    FilmOptics::new(FilmIndex::Water, &Illuminant::default())
}

/// A sphere of radius 1 with one thickness.
fn sphere(optics: &FilmOptics, center_m: DVec3, thickness_nm: f64) -> FilmSphere<'_> {
    let thickness_nm = Box::new(move |_| thickness_nm);
    FilmSphere { optics, center_m, radius_m: 1.0, stretch: DMat3::IDENTITY, thickness_nm }
}

/// The picture of bubbles before a black environment, from the camera 4 m away.
fn scene<'a>(optics: &'a FilmOptics, spheres: Vec<FilmSphere<'a>>) -> PictureScene<'a> {
    PictureScene {
        size: SIZE,
        camera: camera(4.0, 0.6),
        light: optics.weights(),
        spheres,
        surroundings: &|_| DVec3::ZERO,
        backdrop: None,
        polariser: None,
        on_bath: false,
        negligible: 1e-6,
        samples: 1,
    }
}

/// The colour of light that each wavelength keeps a part of; for daylight, whose white is then (1, 1, 1).
fn colour(optics: &FilmOptics, part: impl FnMut(usize) -> f64) -> DVec3 {
    daylight_scale() * (BT2020.from_xyz() * optics.weights().integrate(part))
}

fn radiance(
    illuminant: &Illuminant,
    camera: PictureCamera,
    thickness_nm: f64,
    surroundings: &(dyn Fn(DVec3) -> DVec3 + Sync),
    backdrop: Option<DVec3>,
) -> Vec<DVec3> {
    let optics = FilmOptics::new(FilmIndex::Water, illuminant);
    let bubble = sphere(&optics, DVec3::ZERO, thickness_nm);
    let card = |_: DVec3| backdrop.unwrap_or_default();
    let backdrop = backdrop.is_some().then_some(&card as _);
    PictureScene { camera, surroundings, backdrop, ..scene(&optics, vec![bubble]) }.radiance(&|| ())
}

fn middle(pixels: &[DVec3]) -> DVec3 {
    pixels[pixels.len() / 2]
}

/// Light from one direction alone, of which nothing stands behind the bubbles.
fn only_from(lit: DVec3) -> impl Fn(DVec3) -> DVec3 {
    move |direction| if direction.distance(lit) < 1e-9 { DVec3::ONE } else { DVec3::ZERO }
}

/// What a direction becomes at a wall with a unit vector across.
fn reflected(direction: DVec3, normal: DVec3) -> DVec3 {
    direction - 2.0 * direction.dot(normal) * normal
}

/// The k-th of numbers that fill [0, 1) evenly, another series for each irrational step.
fn even(k: u32, step: f64) -> f64 {
    (0.5 + f64::from(k) * step).fract()
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

#[test]
fn without_bubbles_the_environment_is_seen() {
    let (optics, light) = (water(), DVec3::new(0.3, 0.5, 0.7));
    let empty = PictureScene { surroundings: &|_| light, ..scene(&optics, Vec::new()) };
    let expected = seen_light(&Illuminant::default()) * light;
    assert!((middle(&empty.radiance(&|| ())) - expected).abs().max_element() < 1e-12);
}

/// Straight through the middle of a uniform bubble every reflection goes to and fro, so light from behind the camera alone shows the
/// front wall and what comes back from the others: the geometric series R + T² R (1 + R² + …) per wavelength.
#[test]
fn the_middle_pixel_sums_the_series_of_reflections() {
    let front_light = |direction: DVec3| if direction.x > 0.0 { DVec3::ONE } else { DVec3::ZERO };
    let seen = middle(&radiance(&Illuminant::default(), camera(4.0, 0.6), 300.0, &front_light, Some(DVec3::ZERO)));
    let optics = water();
    let wall = |i: usize| Walls::One { thickness_nm: 300.0 }.reflectance(&optics.wall(i, 1.0));
    let series = |r: f64| r + (1.0 - r).powi(2) * r / (1.0 - r * r);
    let expected = colour(&optics, |i| series(wall(i)));
    // What is left after the last direction followed is below 1e-6.
    assert!((seen - expected).abs().max_element() < 1e-6, "{seen} {expected}");
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
    let optics = water();
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

/// Bubbles in a row, whose walls all have one plane of incidence, before a white card in a black room: each wall leaves 1 − R of s and of
/// p light, and no reflection brings any.
#[test]
fn a_card_is_seen_through_bubbles_in_a_row() {
    let glycerol = FilmMaterial { index: FilmIndex::Constant(1.45), skin_nm: 2.0 };
    let liquids = [water(), FilmOptics::new(glycerol, &Illuminant::default())];
    for count in [2, 5] {
        let film = |k: u32| (&liquids[k as usize % 2], 170.0 + 130.0 * f64::from(k));
        let center = |k: u32| -3.0 * f64::from(k);
        let row = (0..count).map(|k| sphere(film(k).0, center(k) * DVec3::X, film(k).1)).collect();
        let row = PictureScene { backdrop: Some(&|_| DVec3::ONE), ..scene(&liquids[0], row) };
        // The last bubble is met at a sine of this times its distance from the eye.
        for sine in [0.0, 0.9 / (4.0 - center(count - 1))] {
            let left = |i: usize| {
                let walls = (0..count).map(|k| {
                    let cos_theta = (1.0 - (sine * (4.0 - center(k))).powi(2)).sqrt();
                    film(k).0.wall(i, cos_theta).reflectance(film(k).1).rest()
                });
                let all = walls.fold(Polarised { s: 1.0, p: 1.0 }, |left, t| left.times(t).times(t));
                all.mean()
            };
            let ray = DVec3::new(-(1.0 - sine * sine).sqrt(), 0.6 * sine, 0.8 * sine);
            let (seen, expected) = (LightPath::new(&row).colour(ray), colour(&liquids[0], left));
            assert!((seen - expected).abs().max_element() < 1e-12, "{count} {sine}: {seen} {expected}");
        }
    }
}

/// Bubbles of three liquids at random places around the eye, of all sizes, through one another and inside one another.
fn crowd(liquids: &[FilmOptics; 3], count: u32) -> Vec<FilmSphere<'_>> {
    let bubble = |k: u32| {
        let place = [0.8191725133961645, 0.6710436067037893, 0.5497004779019703].map(|step| even(k, step) - 0.5);
        let (size, wobble) = (even(k, 0.618_033_988_7), 0.1 * even(k, 0.754_877_666_2));
        FilmSphere {
            optics: &liquids[k as usize % 3],
            center_m: DVec3::new(4.0, 0.0, 0.0) + 4.0 * DVec3::from_array(place),
            radius_m: 0.2 + 1.3 * size * size,
            stretch: if k.is_multiple_of(2) {
                DMat3::IDENTITY
            } else {
                DMat3::from_diagonal(DVec3::new(1.0, 1.0 + wobble, 1.0 - wobble))
            },
            thickness_nm: Box::new(move |place| 400.0 + 300.0 * (f64::from(k) + 3.0 * place.z).sin()),
        }
    };
    (0..count).map(bubble).collect()
}

fn liquids() -> [FilmOptics; 3] {
    let coated = FilmMaterial { index: FilmIndex::Water, skin_nm: 2.0 };
    // Its two wavelengths are as good as many where no colour is compared with a formula.
    let lamp: Illuminant = "sodium".parse().expect("built in");
    [FilmMaterial::default(), FilmIndex::Constant(1.6).into(), coated].map(|film| FilmOptics::new(film, &lamp))
}

/// Rays in all directions.
fn rays(count: u32) -> impl Iterator<Item = DVec3> {
    (0..count).map(|k| {
        let (z, turn) = (2.0 * even(k, 0.618_033_988_7) - 1.0, std::f64::consts::TAU * even(k, 0.754_877_666_2));
        let across = (1.0 - z * z).sqrt();
        DVec3::new(across * turn.cos(), across * turn.sin(), z)
    })
}

#[test]
fn forty_bubbles_vanish_in_the_same_light_from_everywhere() {
    let liquids = liquids();
    let bubbles = crowd(&liquids, 40);
    let eye_m = camera(4.0, 0.6).eye_m;
    let around_eye = bubbles.iter().filter(|bubble| bubble.center_m.distance(eye_m) < 0.9 * bubble.radius_m).count();
    assert!(around_eye >= 2, "{around_eye}");
    for polariser in [None, Some(DVec3::Y)] {
        let bubbles = crowd(&liquids, 40);
        let scene =
            PictureScene { surroundings: &|_| DVec3::ONE, polariser, negligible: 1e-3, ..scene(&liquids[0], bubbles) };
        let paths = LightPath::new(&scene);
        let white = BT2020.from_xyz() * liquids[0].weights().white() * daylight_scale();
        let error = rays(60).map(|ray| (paths.colour(ray) - white).abs().max_element()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{error}");
    }
}

/// Surroundings that no two directions share.
fn varied(direction: DVec3) -> DVec3 {
    DVec3::new(1.0 + (3.0 * direction.x).sin(), 1.0 + (5.0 * direction.y).cos(), 1.0 + direction.z)
}

#[test]
fn the_order_of_bubbles_does_not_matter() {
    let liquids = liquids();
    let mut reversed = crowd(&liquids, 12);
    reversed.reverse();
    let [one, other] = [crowd(&liquids, 12), reversed].map(|bubbles| {
        let scene = PictureScene { surroundings: &varied, negligible: 1e-4, ..scene(&liquids[0], bubbles) };
        rays(40).map(|ray| LightPath::new(&scene).colour(ray)).collect::<Vec<_>>()
    });
    assert_eq!(one, other);
}

/// Reflectance and transmittance of walls one behind another at normal incidence, reflections between them included: the adding of layers
/// (H. C. van de Hulst, *Multiple Light Scattering*, 1980, ch. 4), with walls that reflect alike on both sides.
struct Stack {
    /// From the front, from the back.
    reflectance: [f64; 2],
    transmittance: f64,
}

impl Stack {
    fn of(walls: &[f64]) -> Self {
        walls.iter().fold(Self { reflectance: [0.0, 0.0], transmittance: 1.0 }, |stack, &wall| stack.before(wall))
    }

    fn before(&self, wall: f64) -> Self {
        let ([front, back], through) = (self.reflectance, self.transmittance);
        let between = 1.0 / (1.0 - back * wall);
        Self {
            reflectance: [front + through * through * wall * between, wall + (1.0 - wall).powi(2) * back * between],
            transmittance: through * (1.0 - wall) * between,
        }
    }
}

/// On the axis of nested bubbles all light goes to and fro.
#[test]
fn nested_bubbles_are_walls_one_behind_another() {
    let optics = water();
    // From the front: the big bubble's wall, the small one's, and both again.
    let thicknesses_nm = [260.0, 420.0, 110.0, 330.0];
    let shell = |radius_m: f64, front_nm: f64, back_nm: f64| FilmSphere {
        radius_m,
        thickness_nm: Box::new(move |place: DVec3| if place.x > 0.0 { front_nm } else { back_nm }),
        ..sphere(&optics, DVec3::ZERO, 0.0)
    };
    let seen = |eye_x: f64, lit_x: f64| {
        let [big_front, small_front, small_back, big_back] = thicknesses_nm;
        let bubbles = vec![shell(0.4, small_front, small_back), shell(1.0, big_front, big_back)];
        let lit = move |direction: DVec3| if direction.x * lit_x > 0.0 { DVec3::ONE } else { DVec3::ZERO };
        let camera = camera(eye_x, 0.6);
        let scene = PictureScene { camera, surroundings: &lit, negligible: 1e-10, ..scene(&optics, bubbles) };
        LightPath::new(&scene).colour(DVec3::NEG_X)
    };
    // The walls before the eye are those from this number on.
    for (eye_x, first) in [(4.0, 0), (0.7, 1), (0.0, 2), (-0.7, 3)] {
        let expected = |lit_x: f64| {
            colour(&optics, |i| {
                let walls = thicknesses_nm.map(|nm| optics.wall(i, 1.0).reflectance(nm).mean());
                let (behind, before) = (Stack::of(&walls[..first]), Stack::of(&walls[first..]));
                let between = 1.0 / (1.0 - behind.reflectance[1] * before.reflectance[0]);
                between * if lit_x > 0.0 { before.reflectance[0] * behind.transmittance } else { before.transmittance }
            })
        };
        for lit_x in [-1.0, 1.0] {
            let (seen, expected) = (seen(eye_x, lit_x), expected(lit_x));
            assert!((seen - expected).abs().max_element() < 1e-7, "{eye_x} {lit_x}: {seen} {expected}");
        }
    }
}

/// Light that two bubbles reflect in planes of incidence that are turned: each wall's s light is partly the other's p.
#[test]
fn a_bubble_is_seen_in_another() {
    let optics = water();
    let [first_nm, second_nm] = [290.0, 350.0];
    let (first, second) = (DVec3::new(0.5, 0.3, 0.6).normalize(), DVec3::new(0.6, -0.8, 0.1).normalize());
    // To a place on the bubble at the origin, and from there to one on the other.
    let rays = [DVec3::NEG_X, reflected(DVec3::NEG_X, first)];
    let center_m = first + 2.0 * rays[1] - second;
    let lit = reflected(rays[1], second);
    let cosines = [-rays[0].dot(first), -rays[1].dot(second)];
    assert!(cosines.iter().all(|cos_theta| *cos_theta > 0.2) && center_m.length() > 2.0, "{cosines:?} {center_m}");
    let [across, turned] = [rays[0].cross(first).normalize(), rays[1].cross(second).normalize()];
    let kept = across.dot(turned).powi(2);
    assert!((0.2..0.8).contains(&kept), "{kept}");
    let bubbles = vec![sphere(&optics, DVec3::ZERO, first_nm), sphere(&optics, center_m, second_nm)];
    let camera = PictureCamera { eye_m: first + 3.0 * DVec3::X, ..camera(4.0, 0.6) };
    let lit = only_from(lit);
    let scene = PictureScene { camera, surroundings: &lit, ..scene(&optics, bubbles) };
    let expected = colour(&optics, |i| {
        let [a, b] = [(first_nm, cosines[0]), (second_nm, cosines[1])].map(|(nm, c)| optics.wall(i, c).reflectance(nm));
        0.5 * (a.s * (kept * b.s + (1.0 - kept) * b.p) + a.p * (kept * b.p + (1.0 - kept) * b.s))
    });
    let seen = LightPath::new(&scene).colour(DVec3::NEG_X);
    assert!(expected.min_element() > 1e-4 && (seen - expected).abs().max_element() < 1e-12, "{seen} {expected}");
}

/// A ray that goes down meets the bath, and then a bubble from below.
#[test]
fn a_bath_mirrors_the_bubble_on_it() {
    let optics = water();
    // Up from the bath to a place of the dome.
    let (normal, up) = (DVec3::new(0.8, 0.1, 0.55).normalize(), DVec3::new(-0.95, 0.0, 0.3).normalize());
    let down = up.with_z(-up.z);
    let at_bath = normal - normal.z / up.z * up;
    let camera = PictureCamera { eye_m: at_bath - 2.0 * down, ..camera(4.0, 0.6) };
    let lit = only_from(reflected(up, normal));
    let dome = vec![sphere(&optics, DVec3::ZERO, 300.0)];
    let scene = PictureScene { camera, surroundings: &lit, on_bath: true, ..scene(&optics, dome) };
    let expected = colour(&optics, |i| optics.wall(i, -up.dot(normal)).reflectance(300.0).mean());
    let seen = LightPath::new(&scene).colour(down);
    let error = (seen - mirrored_part(down.z) * expected).abs().max_element();
    assert!(expected.min_element() > 1e-3 && error < 1e-12, "{seen} {expected}");
}

#[test]
fn positions_and_rays_are_inverse() {
    let camera = camera(4.0, 1.0);
    for position in [DVec2::new(0.0, 0.0), DVec2::new(8.5, 0.25), DVec2::new(4.5, 4.5)] {
        assert!(camera.position(SIZE, camera.ray(SIZE, position)).unwrap().distance(position) < 1e-12);
    }
    assert_eq!(camera.position(SIZE, DVec3::X), None);
}
