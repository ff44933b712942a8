//! Extreme steps, grids, fields, winds and pushes, as `soapfilm verify stability` has them: the longest test, which starts among the first.

use soapfilm::verify::Part;

use crate::support::hold;

#[test]
fn what_breaks_solvers_does_not_break_this_one() {
    hold(Part::Stability, 10);
}
