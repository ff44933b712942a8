//! What a step of a film costs, beside a copy of the bytes that it must read and write.

use soapfilm::{
    gpu::{Gpu, Renderer},
    plan::Moment,
};

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
/// Copies in one submission, so that the cost of submitting is negligible.
const COPIES: u32 = 200;

/// Prints the table. One round shows that it works: it is of the smallest film alone.
pub fn print(rounds: usize) {
    let mut renderer = renderer();
    let clock = Clock::of(&renderer.gpu);
    println!("adapter: {}, {}", renderer.gpu.adapter_name(), renderer.gpu.driver());
    println!("{} of a step of the film of the preset `tent`, median of {rounds} times {TICKS} ticks", clock.name());
    println!(
        "\n{:<16}{:>10}{:>14}{:>20}{:>12}{:>14}{:>14}",
        "cells per edge", "ms", "dispatches", "ns for each cell", "MB moved", "ms of a copy", "step / copy"
    );
    let films = if rounds > 1 { CELLS.len() } else { 1 };
    for cells in CELLS.into_iter().take(films) {
        let Step { ms, dispatches, bytes } = step(&mut renderer, clock, cells, rounds);
        let ns = 1e6 * ms / cells_of_film(cells) as f64;
        let copy_ms = copy_ms(&renderer.gpu, clock, bytes, rounds);
        println!(
            "{cells:<16}{ms:>10.3}{dispatches:>14.1}{ns:>20.2}{:>12.2}{copy_ms:>14.4}{:>14.1}",
            1e-6 * bytes,
            ms / copy_ms
        );
    }
}

/// What one step costs.
struct Step {
    ms: f64,
    dispatches: f64,
    /// Bytes that it must read and write.
    bytes: f64,
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
        let bytes = renderer.counts.state_bytes - before.state_bytes;
        [ms, dispatches as f64, bytes as f64].map(|of_all| of_all / taken)
    });
    let steps: Vec<[f64; 3]> = steps.collect();
    let [ms, dispatches, bytes] = [0, 1, 2].map(|part| median(steps.iter().map(|step| step[part]).collect()));
    Step { ms, dispatches, bytes }
}

/// Milliseconds of a copy that reads and writes a number of bytes in all, within the device.
fn copy_ms(gpu: &Gpu, clock: Clock, bytes: f64, rounds: usize) -> f64 {
    let size = (0.5 * bytes) as u64 / 4 * 4;
    let usage = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    let [from, to] = ["copied", "copy"].map(|label| gpu.buffer(label, size, usage));
    let copy = || {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        for _ in 0..COPIES {
            encoder.copy_buffer_to_buffer(&from, 0, &to, 0, size);
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.wait().expect("a device that worked before");
    };
    copy();
    median((0..rounds).map(|_| clock.ms_of(copy) / f64::from(COPIES)).collect())
}

fn cells_of_film(cells: u32) -> u64 {
    6 * u64::from(cells).pow(2)
}
