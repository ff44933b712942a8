//! Colours and pictures as `soapfilm verify` measures them, with its limits.

use soapfilm::verify::Part;

use crate::support::hold;

/// One and two walls under several lights at each quality; what is not there is not seen.
#[test]
fn colours_of_films_match_the_spectral_sum() {
    hold(Part::Optics, 30);
}

/// Random bubbles in coloured light; and a room with windows, whose edges would be jagged near the limb.
#[test]
fn pictures_match_the_f64_pictures_and_have_no_jagged_edges() {
    hold(Part::Picture, 7);
}

/// Random bubbles seen through and in one another.
#[test]
fn bubbles_through_bubbles_match_the_f64_pictures() {
    hold(Part::Crowd, 8);
}
