//! Published benchmarks of transport, as `soapfilm verify transport` runs them: a long test, which starts among the first.

use soapfilm::verify::Part;

use crate::support::hold;

#[test]
fn published_tests_of_transport_keep_to_their_limits() {
    hold(Part::Transport, 10);
}
