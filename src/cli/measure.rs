//! Measures frames: process CPU and wall time, medians over repeats, beside the counts of the work in them.

use std::{path::Path, time::Instant};

use cpu_time::ProcessTime;
use serde_json::{Value, json};

use crate::{
    gpu::{
        Renderer,
        timing::{Counts, PassTime},
    },
    output::{tell, write_text},
    plan::{FrameRequest, Rendering},
};

/// What the first frame did, bakes included.
pub struct FirstFrame {
    passes: Vec<PassTime>,
    counts: Counts,
    uploaded_bytes: u64,
    pipelines: u32,
}

/// Notes what was done so far.
pub fn passes(renderer: &Renderer) -> FirstFrame {
    FirstFrame {
        passes: renderer.times.take(),
        counts: renderer.counts,
        uploaded_bytes: renderer.gpu.uploaded_bytes(),
        pipelines: renderer.gpu.pipelines.count(),
    }
}

/// Medians over repeated frames, in milliseconds; `None` without repeats.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cost {
    cpu_ms: Option<f64>,
    wall_ms: Option<f64>,
    yardstick_cpu_ms: Option<f64>,
}

/// Frames drawn before any is measured.
const WARM_UP: u32 = 3;

/// Draws a frame repeatedly, except for baked tables, and takes medians. Yardstick frames alternate with the others, so
/// that both see the same machine.
pub fn frames(renderer: &mut Renderer, request: &FrameRequest, repeats: u32, yardstick: bool) -> anyhow::Result<Cost> {
    let mut plain = request.clone();
    plain.picture.draw.rendering = Rendering::Yardstick;
    let (mut cpu, mut wall, mut yard) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..if repeats > 0 { repeats + WARM_UP } else { 0 } {
        let (cpu_ms, wall_ms) = frame(renderer, request)?;
        let yard_ms = if yardstick { Some(frame(renderer, &plain)?.0) } else { None };
        if round >= WARM_UP {
            cpu.push(cpu_ms);
            wall.push(wall_ms);
            yard.extend(yard_ms);
        }
    }
    Ok(Cost { cpu_ms: median(cpu), wall_ms: median(wall), yardstick_cpu_ms: median(yard) })
}

/// Process CPU and wall time of one frame, in milliseconds.
fn frame(renderer: &mut Renderer, request: &FrameRequest) -> anyhow::Result<(f64, f64)> {
    renderer.forget_picture();
    let (cpu, wall) = (ProcessTime::try_now()?, Instant::now());
    renderer.render(request)?;
    renderer.gpu.wait()?;
    Ok((cpu.try_elapsed()?.as_secs_f64() * 1e3, wall.elapsed().as_secs_f64() * 1e3))
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// Prints the cost, and writes it to a file if one is named.
pub fn report(renderer: &Renderer, first: &FirstFrame, cost: &Cost, file: Option<&Path>) -> anyhow::Result<()> {
    if let (Some(cpu), Some(wall)) = (cost.cpu_ms, cost.wall_ms) {
        let yard = cost.yardstick_cpu_ms;
        let yard = yard.map(|yard| format!("; plain sphere: {yard:.2} ms CPU, ratio {:.2}", cpu / yard));
        let yard = yard.unwrap_or_default();
        tell(format_args!("frame: {cpu:.2} ms of process CPU, {wall:.2} ms of wall time{yard}"));
    }
    match file {
        Some(path) => Ok(write_text(path, &serde_json::to_string_pretty(&json(renderer, first, cost))?)?),
        None => Ok(()),
    }
}

fn json(renderer: &Renderer, first: &FirstFrame, cost: &Cost) -> Value {
    let passes: Vec<Value> =
        first.passes.iter().map(|pass| json!({ "name": pass.name, "gpu_ms": pass.gpu_ms })).collect();
    json!({
        "adapter": renderer.gpu.adapter_name(),
        "driver": renderer.gpu.driver(),
        "passes": passes,
        "dispatches": first.counts.dispatches,
        "draws": first.counts.draws,
        "pixels_shaded": first.counts.pixels_shaded,
        "cells_stepped": first.counts.cells_stepped,
        "bytes_uploaded": first.uploaded_bytes,
        "pipelines_made": first.pipelines,
        "cpu_ms_per_frame": cost.cpu_ms,
        "wall_ms_per_frame": cost.wall_ms,
        "yardstick_cpu_ms_per_frame": cost.yardstick_cpu_ms,
        "cost_over_yardstick": cost.cpu_ms.zip(cost.yardstick_cpu_ms).map(|(frame, yard)| frame / yard),
    })
}
