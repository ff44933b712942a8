//! What a studio refuses, and colours: all that needs no GPU.

use super::*;

fn told<T: std::fmt::Debug>(result: Result<T, Error>) -> String {
    let error = result.expect_err("refused");
    // What a `main` prints that returns the error.
    assert_eq!(format!("{error:?}"), error.to_string());
    error.to_string()
}

#[test]
fn times_are_reached_or_refused() {
    let scene = Scene::default();
    assert_eq!(moment(&scene, 0.5).expect("reached"), Moment::tick(30));
    for time_s in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(told(moment(&scene, time_s)).contains("give a finite number of seconds, 0 or more"));
    }
    assert!(told(moment(&scene, 1e7)).contains("600000000 ticks"));
}

#[test]
fn colours_match_the_reference() {
    use crate::physics::{
        colour::{FilmOptics, Illuminant, Walls},
        optics::FilmMaterial,
    };
    let optics = FilmOptics::new(FilmMaterial::default(), &Illuminant::default());
    let walls = Walls::One { thickness_nm: 320.0 };
    let found = colour(320.0, 0.8).expect("in range");
    assert_eq!(found.xyz, optics.xyz(0.8, walls));
    let [red, green, blue] = found.srgb(3.5);
    let linear = found.bt709();
    assert_eq!(red > green, linear.x > linear.y);
    assert_eq!(green > blue, linear.y > linear.z);
}

#[test]
fn numbers_that_no_film_has_are_refused() {
    for thickness_nm in [-1.0, 30_001.0, f64::NAN] {
        assert!(told(colour(thickness_nm, 1.0)).contains("give 0 to 30000 nm"));
    }
    for cosine in [-0.1, 1.1, f64::NAN] {
        assert!(told(colour(100.0, cosine)).contains("give 0 to 1"));
    }
    assert_eq!(told(Err::<(), _>(Error::Size([0, 5]))).split(':').next(), Some("a picture of 0x5 pixels is empty"));
}
