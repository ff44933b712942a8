//! `soapfilm transport`: the published tests of transport on the sphere, on the GPU.

use std::{
    f64::consts::{FRAC_PI_2, PI, TAU},
    path::PathBuf,
    time::{Duration, Instant},
};

use clap::{Args, ValueEnum};
use cpu_time::ProcessTime;
use glam::DVec3;
use serde_json::json;

use super::{AdapterArguments, parse, progress::progress};
use crate::{
    export::Part,
    gpu::{
        Gpu, GpuError,
        film::Field,
        timing::Recorder,
        transport_case::{Case, values},
    },
    output::{Metadata, Picture, check_target, print, write_text},
    physics::{
        colour::Gamut,
        sphere::{CubedSphere, HaloTable, PaddedField},
        transport::{Measured, Quantity, Scheme, Tracer, TracerKind, Wind, WindKind},
    },
};

/// Run a published test of transport on the sphere.
#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm transport --wind nd --tracer cb --cells 60 --steps 120 --json norms.json")]
pub struct Arguments {
    /// Solid body, non-divergent or divergent
    #[arg(long, value_name = "sb|nd|dv")]
    wind: WindKind,
    /// Gaussian hills, cosine bells, correlated cosine bells, slotted cylinders, or the bell of test case 1
    #[arg(long, value_name = "gh|cb|ccb|sc|tc1")]
    tracer: TracerKind,
    /// Cells along an edge of the cube
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(8..=1024))]
    cells: u32,
    /// Steps per period
    #[arg(long, value_name = "M", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    steps: u32,
    /// Number of periods
    #[arg(long, value_name = "P", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    periods: u32,
    /// Stop after this fraction of the steps
    #[arg(long, value_name = "F", default_value = "1", value_parser = fraction)]
    until: f64,
    /// Axis of the wind [default: 1,0,0 for sb, 0,0,1 for nd and dv]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::direction, allow_hyphen_values = true)]
    axis: Option<DVec3>,
    /// Direction of one feature of the tracer
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::direction, allow_hyphen_values = true)]
    tracer_at: Option<DVec3>,
    /// Meaning of the tracer: `density` or `ratio`; they differ in the divergent wind
    #[arg(long, value_name = "density|ratio", default_value = "density")]
    kind: Quantity,
    /// Transport scheme: the flow map, remapped rarely; the flow map with a finer tracer; or remapping at each step
    #[arg(long, value_name = "bilinear|bicubic|bfecc|map|map-accurate", default_value = "map")]
    scheme: Scheme,
    /// Cells that a cell of the map spans along each side
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    map_coarsening: u32,
    /// Limiter of overshoots and undershoots
    #[arg(long, value_name = "on|off", default_value = "off")]
    limiter: Switch,
    /// Write all cells to a CSV file
    #[arg(short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    /// Write a map of the tracer, longitude by latitude, black for 0 and white for 1
    #[arg(long, value_name = "FILE.png")]
    map: Option<PathBuf>,
    /// Write the norms to a JSON file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Switch {
    On,
    Off,
}

fn fraction(text: &str) -> Result<f64, String> {
    let value = parse::finite(text)?;
    if (0.0..=1.0).contains(&value) { Ok(value) } else { Err("a fraction lies between 0 and 1".to_owned()) }
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let case = case(arguments)?;
    for file in [&arguments.output, &arguments.map, &arguments.json].into_iter().flatten() {
        check_target(file)?;
    }
    let gpu = arguments.adapter.open()?;
    let (moved, norms) = measured(&gpu, &case)?;
    let finite = [norms.l1, norms.l2, norms.linf, norms.min, norms.max].iter().all(|norm| norm.is_finite());
    anyhow::ensure!(finite, "the tracer is no longer finite on the GPU: take more --steps, or another --scheme");
    print(format_args!(
        "{} steps of {}, {} remaps: l1 {:.6}, l2 {:.6}, linf {:.6}, range {:.6} to {:.6}\n",
        case.steps,
        case.scheme.name(),
        moved.remaps,
        norms.l1,
        norms.l2,
        norms.linf,
        norms.min,
        norms.max
    ))?;
    if let Some(path) = &arguments.output {
        write_text(path, &cells_csv(&case, &moved.values))?;
    }
    if let Some(path) = &arguments.map {
        let about = Metadata::new().with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")));
        map(&case, &moved.values).save(path, &about)?;
    }
    if let Some(path) = &arguments.json {
        let copy_ms = copy_ms_per_step(&gpu, &case)?;
        let report = report(&case, &norms, &moved, arguments.kind, copy_ms);
        write_text(path, &serde_json::to_string_pretty(&report)?)?;
    }
    Ok(())
}

fn case(arguments: &Arguments) -> anyhow::Result<Case> {
    let wind = Wind::new(arguments.wind, arguments.axis)?;
    let tracer = match arguments.tracer_at {
        Some(place) => Tracer::at(arguments.tracer, place)?,
        None => Tracer::new(arguments.tracer, wind.tracer_rotation()),
    };
    let all = f64::from(arguments.steps) * f64::from(arguments.periods);
    let map_cells = arguments.cells.div_ceil(arguments.map_coarsening) as usize;
    anyhow::ensure!(
        map_cells >= CubedSphere::MIN_N,
        "the map would have {map_cells} cells along an edge, and the minimum is {}: lower --map-coarsening, or raise --cells",
        CubedSphere::MIN_N
    );
    Ok(Case {
        grid: CubedSphere::new(arguments.cells as usize)?,
        wind,
        tracer,
        quantity: arguments.kind,
        scheme: arguments.scheme,
        map_coarsening: arguments.map_coarsening,
        limiter: arguments.limiter == Switch::On,
        steps_per_period: arguments.steps,
        steps: (arguments.until * all).round() as u64,
        traces_per_step: Case::traces_per_step(arguments.scheme, arguments.steps),
    })
}

/// What a run left, and what a step of it cost.
struct Moved {
    values: Vec<f64>,
    remaps: u64,
    wall_ms: f64,
    cpu_ms: f64,
}

/// Moves the tracer and compares it with the exact answer.
fn measured(gpu: &Gpu, case: &Case) -> Result<(Moved, Measured), GpuError> {
    let progress = progress("transport", 2);
    let moved = advance(gpu, case, &progress.part(case.steps))?;
    let answers = progress.part(case.grid.cells() as u64);
    let norms = case.measure_watched(&moved.values, &|| answers.add(1));
    Ok((moved, norms))
}

fn advance(gpu: &Gpu, case: &Case, steps: &Part) -> Result<Moved, GpuError> {
    // One step first on another field: what drivers compile at first use is no part of a step's cost.
    Case { steps: 1, ..case.clone() }.advance(gpu, &mut case.seed(gpu)?)?;
    gpu.wait()?;
    let mut field = case.seed(gpu)?;
    let (cpu, wall) = (ProcessTime::now(), Instant::now());
    case.advance_watched(gpu, &mut field, &|done| steps.add(done))?;
    let per_step = |time: Duration| time.as_secs_f64() * 1e3 / case.steps.max(1) as f64;
    let (cpu_ms, wall_ms) = (per_step(cpu.elapsed()), per_step(wall.elapsed()));
    Ok(Moved { remaps: case.remaps(gpu, &field)?, values: values(gpu, &mut field)?, wall_ms, cpu_ms })
}

fn cells_csv(case: &Case, values: &[f64]) -> String {
    let areas = case.grid.areas();
    let mut text = String::from("x,y,z,area,value\n");
    for (cell, value) in values.iter().enumerate() {
        let at = case.grid.cell_direction(cell);
        text.push_str(&format!("{},{},{},{},{value}\n", at.x, at.y, at.z, areas[cell]));
    }
    text
}

/// Height of a map in pixels; its width is twice that.
const MAP_HEIGHT: u32 = 400;

/// A map of all longitudes from 0 and all latitudes, north on top; grey levels are proportional to values.
fn map(case: &Case, values: &[f64]) -> Picture {
    let size = [2 * MAP_HEIGHT, MAP_HEIGHT];
    let field = PaddedField::from_cells(case.grid, &HaloTable::new(case.grid), |cell| values[cell]);
    let grey = |pixel: u32| {
        let [column, row] = [pixel % size[0], pixel / size[0]].map(|k| f64::from(k) + 0.5);
        let (sin, cos) = (column / f64::from(size[0]) * TAU).sin_cos();
        let (height, ring) = (FRAC_PI_2 - row / f64::from(size[1]) * PI).sin_cos();
        let value = field.bilinear(DVec3::new(ring * cos, ring * sin, height));
        (255.0 * value.clamp(0.0, 1.0)).round() as u8
    };
    let rgba = (0..size[0] * size[1]).map(grey).flat_map(|grey| [grey, grey, grey, 255]).collect();
    Picture::Display { size, gamut: Gamut::Srgb, rgba }
}

fn report(case: &Case, norms: &Measured, moved: &Moved, kind: Quantity, copy_ms: f64) -> serde_json::Value {
    json!({
        "l1": norms.l1,
        "l2": norms.l2,
        "linf": norms.linf,
        "mass_drift": (kind == Quantity::Density).then_some(norms.mass_drift),
        "min": norms.min,
        "max": norms.max,
        "steps": case.steps,
        "cells": case.grid.cells(),
        "remaps": moved.remaps,
        "scheme": case.scheme.name(),
        "wall_ms_per_step": moved.wall_ms,
        "cpu_ms_per_step": moved.cpu_ms,
        "copy_ms_per_step": copy_ms,
    })
}

/// Wall time of a copy of what a step reads and writes, the map and the tracer: the floor under any step.
fn copy_ms_per_step(gpu: &Gpu, case: &Case) -> Result<f64, GpuError> {
    const COPIES: u32 = 16;
    let field = Field::new(gpu, case.grid, case.rules())?;
    let copies = || {
        let mut recorder = Recorder::new(gpu);
        field.copy_state(&mut recorder, COPIES.into());
        recorder.submit(&Default::default());
        gpu.wait()
    };
    copies()?;
    let wall = Instant::now();
    copies()?;
    Ok(wall.elapsed().as_secs_f64() * 1e3 / f64::from(COPIES))
}
