//! Films as numbers, by command.

use super::*;

/// Columns x, y, z, solid angle and thickness of each row.
fn rows(csv: &str) -> Vec<[f64; 5]> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("x,y,z,solid_angle_sr,thickness_nm"));
    let row = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        <[f64; 5]>::try_from(numbers).unwrap()
    };
    lines.map(row).collect()
}

#[test]
fn the_reference_moves_a_film_without_any_adapter_as_the_device_does() {
    let desk = Desk::new();
    let film = "film default --time 0.1 --set bubble.0.film.cells=16";
    let nowhere = [("WGPU_ADAPTER_NAME", "no such adapter")];
    let run = desk.run_with(&nowhere, &format!("{film} --reference -o reference.csv"));
    assert!(run.success && run.err.is_empty() && run.out.contains("nm on average"), "{}{}", run.out, run.err);
    let read = |name: &str| rows(&std::fs::read_to_string(desk.path(name)).unwrap());
    let expected = read("reference.csv");
    assert_eq!(expected.len(), 6 * 16 * 16);
    if desk.done(&format!("{film} -o device.csv")).is_none() {
        return;
    }
    let apart = read("device.csv").iter().zip(&expected).map(|(a, b)| (a[4] - b[4]).abs()).fold(0.0, f64::max);
    // What tests/gpu/film_model.rs allows in this many steps.
    assert!(apart < 0.05, "{apart} nm");
}

#[test]
fn films_that_the_reference_does_not_take_are_refused() {
    let desk = Desk::new();
    let told = desk.refused("film default --reference");
    assert!(told.contains("at most 64 cells") && told.contains("--set bubble.0.film.cells=32"), "{told}");
    let told = desk.refused("film default --reference --set bubble.0.film.cells=16 --set motion.scheme=bicubic");
    assert!(told.contains("motion.scheme"), "{told}");
    let told = desk.refused("film default --reference --bubble 3 -o film.csv");
    assert!(told.contains("no bubble 3"), "{told}");
}
