//! Run time against error: lookup tables of several sizes, numbers of wavelengths, the qualities, the schemes of transport, the flow solver,
//! going back in time, and planning, as tables, and as CSV files and plots in `target/`.
//!
//! `cargo bench --bench error_time -- --smoke` runs the smallest case of each, to see that it works; a name (`tables`, `front`, `transport`,
//! `flow`, `qualities`, `history`, `planning`) runs that part alone.

mod colour;
mod flow;
mod history;
mod planning;
mod plot;
mod report;
mod transport;

use std::time::Instant;

use cpu_time::ProcessTime;
use soapfilm::gpu::{AdapterChoice, Gpu, GpuError};

const PARTS: [&str; 7] = ["tables", "front", "transport", "flow", "qualities", "history", "planning"];

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let smoke = arguments.iter().any(|argument| argument == "--smoke");
    let named = |part: &str| arguments.iter().any(|argument| argument == part);
    let runs = |part: &str| named(part) || !PARTS.into_iter().any(named);
    let gpu = pollster::block_on(Gpu::headless(&AdapterChoice::default().or_env()))?;
    println!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
    colour::warm_up(&gpu)?;
    if runs("tables") {
        colour::tables(&gpu, smoke)?;
    }
    if runs("front") {
        colour::front(&gpu, smoke)?;
    }
    if runs("transport") {
        transport::warm_up(&gpu)?;
        transport::run(&gpu, smoke)?;
    }
    if runs("flow") {
        flow::run(&gpu, smoke)?;
    }
    if runs("qualities") {
        colour::qualities(pollster::block_on(gpu.another())?, smoke)?;
    }
    if runs("planning") {
        planning::run(smoke)?;
    }
    if runs("history") {
        history::run(gpu, smoke)?;
    }
    Ok(())
}

/// The result of some work, its process CPU time and its wall time in milliseconds.
fn timed<T>(work: impl FnOnce() -> Result<T, GpuError>) -> anyhow::Result<(T, f64, f64)> {
    let (cpu, wall) = (ProcessTime::try_now()?, Instant::now());
    let result = work()?;
    Ok((result, cpu.try_elapsed()?.as_secs_f64() * 1e3, wall.elapsed().as_secs_f64() * 1e3))
}
