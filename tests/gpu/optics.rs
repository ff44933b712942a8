//! Colours and pictures as `soapfilm verify` measures them, with its limits.

use soapfilm::verify::{Check, Part, Run};

use crate::support::gpu;

/// Runs a part, tells what it measured, and fails if a check does.
fn hold(part: Part, at_least: usize) {
    let Some(gpu) = gpu() else { return };
    let mut checks: Vec<Check> = Vec::new();
    let mut report = |check: Check| {
        eprintln!("measured: {}: {:.4e} (limit {:.4e})", check.name, check.measured, check.limit);
        checks.push(check);
    };
    Run { gpu: &gpu, long: false, report: &mut report }.part(part).unwrap();
    assert!(checks.len() >= at_least, "only {} checks", checks.len());
    let failed: Vec<_> = checks.iter().filter(|check| !check.passed()).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

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
