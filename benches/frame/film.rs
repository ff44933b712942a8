//! What a step of a film costs.

use soapfilm::{gpu::Renderer, plan::Moment};

use crate::{
    clock::{Clock, median},
    draw, frame_request_of,
    parts::renderer,
};

/// Cells along an edge of the films.
const CELLS: [u32; 4] = [64, 128, 256, 512];
/// Ticks from one measurement to the next.
const TICKS: u64 = 2;
/// A picture so small that it costs next to nothing.
const SIZE: [u32; 2] = [64, 36];

/// Prints the table. One round shows that it works: it is of the smallest film alone.
pub fn print(rounds: usize) {
    let mut renderer = renderer();
    let clock = Clock::of(&renderer.gpu);
    println!("adapter: {}, {}", renderer.gpu.adapter_name(), renderer.gpu.driver());
    println!("{} of a step of the film of the preset `tent`, median of {rounds} times {TICKS} ticks", clock.name());
    println!("\n{:<16}{:>10}{:>14}{:>22}", "cells per edge", "ms", "dispatches", "ns for each cell");
    let films = if rounds > 1 { CELLS.len() } else { 1 };
    for cells in CELLS.into_iter().take(films) {
        let Step { ms, dispatches } = step(&mut renderer, clock, cells, rounds);
        println!("{cells:<16}{ms:>10.3}{dispatches:>14.1}{:>22.2}", 1e6 * ms / cells_of_film(cells) as f64);
    }
}

/// What one step costs.
struct Step {
    ms: f64,
    dispatches: f64,
}

fn step(renderer: &mut Renderer, clock: Clock, cells: u32, rounds: usize) -> Step {
    let request = |round: usize| {
        let moment = Moment { tick: TICKS * (round as u64 + 1), fraction: 0.0 };
        frame_request_of(SIZE, moment, |scene| scene.bubbles[0].film.cells = cells)
    };
    // The first picture pays for tables, pipelines and the seed of the film.
    let still_ms = clock.median_ms(renderer, rounds, |renderer| draw(renderer, &request(0)));
    let still = renderer.counts;
    draw(renderer, &request(0));
    let of_picture = renderer.counts.dispatches - still.dispatches;
    let steps = (1..=rounds).map(|round| {
        let before = renderer.counts;
        let request = request(round);
        let ms = clock.ms(renderer, |renderer| draw(renderer, &request)) - still_ms;
        let taken = (renderer.counts.cells_stepped - before.cells_stepped) as f64 / cells_of_film(cells) as f64;
        let dispatches = renderer.counts.dispatches - before.dispatches - of_picture;
        (ms / taken, dispatches as f64 / taken)
    });
    let (ms, dispatches): (Vec<f64>, Vec<f64>) = steps.unzip();
    Step { ms: median(ms), dispatches: median(dispatches) }
}

fn cells_of_film(cells: u32) -> u64 {
    6 * u64::from(cells).pow(2)
}
