//! Colours and pictures as `soapfilm verify` measures them, with its limits.

use soapfilm::verify::Part;

use crate::support::hold;

/// One and two walls under several lights at each quality; what is not there is not seen.
#[test]
fn colours_of_films_are_the_spectral_ones() {
    hold(Part::Optics, 30);
}

/// Random bubbles in coloured light.
#[test]
fn pictures_in_coloured_light_are_the_f64_ones() {
    hold(Part::Picture, 4);
}
