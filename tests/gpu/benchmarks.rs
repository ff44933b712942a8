//! What the literature has measured of other schemes, as `soapfilm verify transport` has it: a long test, which starts among the first.

use soapfilm::verify::Part;

use crate::support::hold;

#[test]
fn published_tests_of_transport_keep_to_their_limits() {
    hold(Part::Transport, 10);
}
