//! Light whose polarisation is seen.

use std::f64::consts::TAU;

use super::*;
use crate::physics::optics::{FilmIndex, FilmMaterial, SKIN_INDEX, cos_refracted};

fn of_index(n: f64) -> FilmOptics {
    FilmOptics::new(FilmIndex::Constant(n), &Illuminant::default())
}

/// At Brewster's angle a polariser that passes only p light sees no film, one across it twice the unpolarised reflection; a bubble of no
/// film in front, whose plane of incidence lies at 45° to both, takes nothing from that.
#[test]
fn a_polariser_takes_the_reflection_at_brewsters_angle() {
    let (optics, clear) = (of_index(4.0 / 3.0), of_index(1.0));
    // A ray at Brewster's angle: sin θ = n / √(1 + n²) = 0.8.
    let camera = PictureCamera { eye_m: DVec3::new(4.0, 0.8, 0.0), ..camera(4.0, 0.6) };
    let lit = only_from(reflected(DVec3::NEG_X, DVec3::new(0.6, 0.8, 0.0)));
    for clear_bubbles in 0..3 {
        let front = |polariser| {
            let place = |k: u32| DVec3::new(1.9 + 0.1 * f64::from(k), 1.1, 0.3);
            let in_front = |k| FilmSphere { radius_m: 0.7, ..sphere(&clear, place(k), 300.0) };
            let mut bubbles = vec![sphere(&optics, DVec3::ZERO, 300.0)];
            bubbles.extend((0..clear_bubbles).map(in_front));
            let scene = PictureScene { camera, surroundings: &lit, polariser, ..scene(&optics, bubbles) };
            LightPath::new(&scene).colour(DVec3::NEG_X)
        };
        let (unpolarised, s, p) = (front(None), front(Some(DVec3::Z)), front(Some(DVec3::Y)));
        assert!(unpolarised.min_element() > 0.01, "{unpolarised}");
        let error = (s - 2.0 * unpolarised).abs().max_element();
        assert!(p.max_element() < 1e-12 && error < 1e-12, "{clear_bubbles}: {s} {p} {unpolarised}");
    }
}

/// A bubble of no thickness, and one of no index.
#[test]
fn a_bubble_of_no_film_in_front_changes_nothing() {
    let (optics, clear) = (water(), of_index(1.0));
    let seen = |spheres| -> Vec<DVec3> {
        let polariser = Some(DVec3::new(0.0, 0.6, 0.8));
        let scene = PictureScene { surroundings: &varied, polariser, ..scene(&optics, spheres) };
        let paths = LightPath::new(&scene);
        (0..81).map(|k| paths.colour(scene.camera.ray(SIZE, DVec2::new(f64::from(k % 9), f64::from(k / 9))))).collect()
    };
    let film = || sphere(&optics, DVec3::ZERO, 300.0);
    let without = seen(vec![film()]);
    for (optics, thickness_nm) in [(&optics, 0.0), (&clear, 300.0)] {
        let none = FilmSphere { radius_m: 0.8, ..sphere(optics, DVec3::new(2.0, 0.2, 0.1), thickness_nm) };
        let with = seen(vec![none, film()]);
        let error = with.iter().zip(&without).map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
        assert!(error < 1e-12, "{thickness_nm}: {error}");
    }
}

/// Real and imaginary part of an electric field.
type Field = [DVec3; 2];

/// What layers of film in air do to the fields of s and of p light along their faces: complex factors.
struct Jones {
    reflected: [DVec2; 2],
    passed: [DVec2; 2],
}

impl Jones {
    /// By the characteristic matrices of layers of an index and a thickness in nm (Macleod, *Thin-Film Optical Filters*, ch. 2).
    fn new(layers: &[(f64, f64)], cos_theta: f64, wavelength_nm: f64) -> Self {
        let polarisations = [false, true].map(|is_p| {
            let (mut electric, mut magnetic) = (DVec2::X, DVec2::X);
            for &(n, nm) in layers {
                let cos_t = cos_refracted(n, cos_theta);
                let admittance = if is_p { n * cos_theta / cos_t } else { n * cos_t / cos_theta };
                let (sin, cos) = (TAU * n * cos_t * nm / wavelength_nm).sin_cos();
                // `perp` is i times.
                (electric, magnetic) = (
                    cos * electric + sin / admittance * magnetic.perp(),
                    cos * magnetic + sin * admittance * electric.perp(),
                );
            }
            let sum = electric + magnetic;
            let inverse = sum.with_y(-sum.y) / sum.length_squared();
            [(electric - magnetic).rotate(inverse), 2.0 * inverse]
        });
        Self { reflected: polarisations.map(|of| of[0]), passed: polarisations.map(|of| of[1]) }
    }

    fn reflect(&self, field: Field, light: DVec3, normal: DVec3) -> Field {
        multiplied(field, light, normal, self.reflected).map(|part| reflected(part, normal))
    }

    fn pass(&self, field: Field, light: DVec3, normal: DVec3) -> Field {
        multiplied(field, light, normal, self.passed)
    }
}

/// The field of light in a direction, multiplied across and along its plane of incidence.
fn multiplied(field: Field, light: DVec3, normal: DVec3, factors: [DVec2; 2]) -> Field {
    let s = light.cross(normal).normalize();
    let axes = [s, light.cross(s)];
    let parts = [0, 1].map(|k| factors[k].rotate(DVec2::from_array(field.map(|part| part.dot(axes[k])))));
    [parts[0].x * axes[0] + parts[1].x * axes[1], parts[0].y * axes[0] + parts[1].y * axes[1]]
}

/// Light that two bubbles reflect and the wall of a third lets pass, in three planes of incidence: as the fields of two lamps, followed to the eye.
#[test]
fn fields_pass_walls_in_turned_planes() {
    let coated = FilmMaterial { index: FilmIndex::Constant(1.33), skin_nm: 2.0 };
    let liquids = [of_index(1.4), of_index(1.6), FilmOptics::new(coated, &Illuminant::default())];
    let layers = [vec![(1.4, 290.0)], vec![(1.6, 350.0)], vec![(SKIN_INDEX, 2.0), (1.33, 410.0), (SKIN_INDEX, 2.0)]];
    // To a place on the bubble at the origin, and from there to one on the next.
    let (first, second) = (DVec3::new(0.3, 0.3, 0.6).normalize(), DVec3::new(0.6, -0.8, 0.3).normalize());
    let mirrored = reflected(DVec3::NEG_X, first);
    let lit = reflected(mirrored, second);
    let eye_m = first + 3.0 * DVec3::X;
    // The third is around the eye.
    let third = DVec3::new(-0.53, -0.4, 0.7).normalize();
    let spheres = || {
        let sphere = |k: usize, center_m| sphere(&liquids[k], center_m, layers[k].iter().map(|layer| layer.1).sum());
        vec![
            sphere(0, DVec3::ZERO),
            sphere(1, first + 2.5 * mirrored - second),
            sphere(2, eye_m - 0.5 * DVec3::X - third),
        ]
    };
    // Place by place as light comes: where it goes, and across what wall.
    let walls = [(-lit, second), (-mirrored, first), (DVec3::X, third)];
    let across = walls.map(|(light, normal)| light.cross(normal).normalize());
    assert!(across[0].dot(across[1]).abs() < 0.9 && across[1].dot(across[2]).abs() < 0.9, "{across:?}");
    let seen = |i: usize, polariser: Option<DVec3>| -> f64 {
        let nm = liquids[0].weights().wavelengths_nm()[i];
        let [one, two, three] = [1, 0, 2].map(|k| layers[k].as_slice());
        let jones = |layers, (light, normal): (DVec3, DVec3)| Jones::new(layers, light.dot(normal).abs(), nm);
        let films = [jones(one, walls[0]), jones(two, walls[1]), jones(three, walls[2])];
        let lamps = <[DVec3; 2]>::from(lit.any_orthonormal_pair());
        let arriving = lamps.map(|lamp| {
            let field = films[0].reflect([lamp, DVec3::ZERO], walls[0].0, walls[0].1);
            let field = films[1].reflect(field, walls[1].0, walls[1].1);
            films[2].pass(field, walls[2].0, walls[2].1)
        });
        let of_part = |part: DVec3| polariser.map_or(0.5 * part.length_squared(), |axis| part.dot(axis).powi(2));
        arriving.iter().flatten().map(|part| of_part(*part)).sum()
    };
    let lit = only_from(lit);
    for polariser in [None, Some(DVec3::Y), Some(DVec3::new(0.0, 0.6, 0.8))] {
        let camera = PictureCamera { eye_m, ..camera(4.0, 0.6) };
        let scene = PictureScene { camera, surroundings: &lit, polariser, ..scene(&liquids[0], spheres()) };
        let (followed, expected) =
            (LightPath::new(&scene).colour(DVec3::NEG_X), colour(&liquids[0], |i| seen(i, polariser)));
        let error = (followed - expected).abs().max_element();
        assert!(expected.min_element() > 1e-4 && error < 1e-12, "{polariser:?}: {followed} {expected}");
    }
}

/// What is seen in a bath is the mirrored world, through a mirrored polariser. From inside a bubble another is seen.
#[test]
fn a_bath_mirrors_polarised_light() {
    let optics = water();
    let (normal, up) = (DVec3::new(0.8, 0.1, 0.55).normalize(), DVec3::new(-0.95, 0.0, 0.3).normalize());
    let mirrored = |direction: DVec3| direction.with_z(-direction.z);
    let down = mirrored(up);
    let eye_m = normal - normal.z / up.z * up - 2.0 * down;
    let axis = DVec3::new(0.1, 0.8, 0.6).normalize();
    let lit = only_from(reflected(up, normal));
    let seen = |eye_m, axis, on_bath, ray| {
        let spheres = vec![sphere(&optics, DVec3::ZERO, 300.0), sphere(&optics, DVec3::new(4.4, -0.3, 0.0), 270.0)];
        let (camera, polariser) = (PictureCamera { eye_m, ..camera(4.0, 0.6) }, Some(axis));
        let scene = PictureScene { camera, surroundings: &lit, polariser, on_bath, ..scene(&optics, spheres) };
        LightPath::new(&scene).colour(ray)
    };
    let in_bath = seen(eye_m, axis, true, down);
    let expected = mirrored_part(up.z) * seen(mirrored(eye_m), mirrored(axis), false, up);
    let error = (in_bath - expected).abs().max_element();
    assert!(expected.min_element() > 1e-3 && error < 1e-12, "{in_bath} {expected}");
}
