//! The command line: one module a command.
//!
//! Every command names the adapter it used on stderr, fails with one clear line there and a non-zero exit, and never leaves a
//! half-written file.

mod colour;
mod flow;
mod info;
mod lut;
mod measure;
mod parse;
mod picture;
mod presets;
mod progress;
mod reference;
mod render;
mod sequence;
mod strip;
mod transport;
mod verify;

use std::{ffi::OsString, process::ExitCode};

use clap::{Args, Parser, Subcommand, error::ErrorKind};

use crate::{
    gpu::{AdapterChoice, Gpu, GpuError},
    input::{LoadError, LoadedScene, load_scene},
};

/// Said wherever errors of colours are: small ones make the numerics invisible, and are no claim about a real film.
const PHYSICS_IS_LESS_CERTAIN: &str = "Colours are less certain than their numerics: 0.001 in a film's index is a mean dE2000 of 0.44, a nanometre of its thickness 0.64.";

/// Soap bubbles with correct thin-film interference and a film that flows.
#[derive(Parser)]
#[command(
    version,
    about,
    args_conflicts_with_subcommands = true,
    after_help = "Example:\n  soapfilm render windows -o bubble.png --size 1920x1080 --time 5"
)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    app: AppArguments,
}

#[derive(Subcommand)]
enum Command {
    /// Open the window
    App(AppArguments),
    /// Draw one picture into a PNG or EXR file
    Render(render::Arguments),
    /// Draw numbered pictures of a film as it moves
    Sequence(sequence::Arguments),
    /// List the built-in scenes
    Presets(presets::Arguments),
    /// Report the colour that a film reflects
    Colour(colour::Arguments),
    /// Write the lookup table of film colours, and how to sample it
    Lut(lut::Arguments),
    /// Run a published test of transport on the sphere
    Transport(transport::Arguments),
    /// Run a test of the flow solver against its exact solution
    Flow(flow::Arguments),
    /// Measure this machine's GPU against the references
    Verify(verify::Arguments),
    /// List the graphics adapters and what soapfilm uses of them
    Info(info::Arguments),
}

#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm app windows")]
struct AppArguments {
    /// A scene file, or the name of a preset; the default bubble without one
    scene: Option<String>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Which adapter a command runs on.
#[derive(Args, Clone, Debug)]
struct AdapterArguments {
    /// Part of the name of the adapter to use [default: $WGPU_ADAPTER_NAME, else the best one]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Graphics backend to use: vulkan, metal, dx12 or gl [default: $WGPU_BACKEND, else the best one]
    #[arg(long, value_name = "NAME")]
    backend: Option<String>,
}

impl AdapterArguments {
    fn choice(&self) -> AdapterChoice {
        AdapterChoice { name: self.adapter.clone(), backend: self.backend.clone() }.or_env()
    }

    /// Opens the adapter without a window, and names it on stderr.
    fn open(&self) -> Result<Gpu, GpuError> {
        let gpu = pollster::block_on(Gpu::headless(&self.choice()))?;
        eprintln!("adapter: {}, {}", gpu.adapter_name(), gpu.driver());
        Ok(gpu)
    }
}

/// Opens the window on a scene and returns when it is closed.
pub type OpenWindow = fn(LoadedScene, &AdapterChoice) -> anyhow::Result<()>;

/// Runs the program with its arguments, the program's own name first. The window belongs to another layer, so it is handed in.
pub fn main(arguments: impl IntoIterator<Item = OsString>, open_window: OpenWindow) -> ExitCode {
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("off")).init();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => return explain(&error),
    };
    match run(arguments, open_window) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", one_line(&format!("{error:#}")));
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments, open_window: OpenWindow) -> anyhow::Result<()> {
    match arguments.command.unwrap_or(Command::App(arguments.app)) {
        Command::App(arguments) => {
            let scene = load(arguments.scene.as_deref().unwrap_or("default"))?;
            open_window(scene, &arguments.adapter.choice())
        }
        Command::Render(arguments) => render::run(&arguments),
        Command::Sequence(arguments) => sequence::run(&arguments),
        Command::Presets(arguments) => presets::run(&arguments),
        Command::Colour(arguments) => colour::run(&arguments),
        Command::Lut(arguments) => lut::run(&arguments),
        Command::Transport(arguments) => transport::run(&arguments),
        Command::Flow(arguments) => flow::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
    }
}

/// Loads a scene, and says on stderr what of it no real bubble does.
fn load(name: &str) -> Result<LoadedScene, LoadError> {
    let loaded = load_scene(name)?;
    for warning in loaded.scene.warnings() {
        eprintln!("warning: {warning}");
    }
    Ok(loaded)
}

/// What is wrong with the arguments in one line; help and version as they are.
fn explain(error: &clap::Error) -> ExitCode {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        // Help that nobody reads, because the pipe is closed, is no failure.
        let _ = error.print();
        return ExitCode::SUCCESS;
    }
    let text = error.to_string();
    let told = text.split("\n\nUsage:").next().and_then(|text| text.split("\n\nFor more").next()).unwrap_or(&text);
    eprintln!("{} (see --help)", one_line(told));
    ExitCode::from(2)
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
