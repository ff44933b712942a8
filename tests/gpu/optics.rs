//! Colours and pictures as `soapfilm verify` measures them, with its limits.

use soapfilm::verify::Part;

use crate::support::hold;

/// One and two walls under several lights at each quality; what is not there is not seen.
#[test]
fn colours_of_films_match_the_spectral_sum() {
    hold(Part::Optics, 30);
}

/// Random bubbles in coloured light.
#[test]
fn pictures_in_coloured_light_match_the_f64_pictures() {
    hold(Part::Picture, 4);
}

/// Random bubbles seen through and in one another.
#[test]
fn bubbles_through_bubbles_match_the_f64_pictures() {
    hold(Part::Crowd, 5);
}
