//! The command line: one module a command.
//!
//! Every command names the adapter it used on stderr, fails with one clear line there and a non-zero exit, and never leaves a
//! half-written file. Exit codes: 0, done; 1, it cannot be done; 2, the arguments make no sense; 141, the reader of standard output has
//! stopped, as `head` does, which is not an error and ends the program without a message.

mod colour;
mod failure;
mod film;
mod flow;
mod info;
mod lut;
mod measure;
mod parse;
mod picture;
mod presets;
mod progress;
mod render;
mod sequence;
mod strip;
mod transport;
mod verify;

use std::{
    ffi::OsString,
    io::Write,
    path::{Path, PathBuf},
    process::ExitCode,
};

use clap::{Arg, Args, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::{
    gpu::{AdapterChoice, Gpu, GpuError},
    input::{LoadError, LoadedScene, load_scene_with},
    output::{tell, watch_signals},
    scene::Setting,
    verify::trial,
};

/// Accompanies all errors of colours: small ones concern the numerics alone, and are no claim about a real film.
const PHYSICS_IS_LESS_CERTAIN: &str = "Colours are less certain than the numerics: an error of 0.001 in the index of the film changes them by a mean dE2000 of 0.44, an error of 1 nm in its thickness by 0.64.";

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
    /// Write the thickness of a bubble's film, cell by cell
    Film(film::Arguments),
    /// Report the colour that a film reflects
    Colour(colour::Arguments),
    /// Write the lookup table of film colours, with code that samples it
    Lut(lut::Arguments),
    /// Run a published test of transport on the sphere
    Transport(transport::Arguments),
    /// Run a test of the flow solver against an exact solution
    Flow(flow::Arguments),
    /// Measure this machine's GPU against the references
    Verify(verify::Arguments),
    /// List the graphics adapters and the features that soapfilm uses
    Info(info::Arguments),
}

#[derive(Args)]
#[command(after_help = "Example:\n  soapfilm app windows")]
struct AppArguments {
    /// A scene file, or the name of a preset [default: the default bubble]
    scene: Option<PathBuf>,
    #[command(flatten)]
    settings: SceneSettings,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// Which adapter a command runs on.
#[derive(Args, Clone, Debug)]
struct AdapterArguments {
    /// Adapter to use, by a part of its name [default: $WGPU_ADAPTER_NAME, else the best adapter]
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Graphics backend to use: vulkan, metal, dx12 or gl [default: $WGPU_BACKEND, else the best backend]
    #[arg(long, value_name = "NAME")]
    backend: Option<String>,
}

impl AdapterArguments {
    fn choice(&self) -> AdapterChoice {
        AdapterChoice { name: self.adapter.clone(), backend: self.backend.clone() }.or_env()
    }

    /// Opens the adapter without a window, and names it on stderr.
    fn open(&self) -> Result<Gpu, GpuError> {
        let gpu = without_logs(|| {
            let gpu = pollster::block_on(Gpu::headless(&self.choice()))?;
            trial(&gpu).map(|()| gpu)
        })?;
        tell(format_args!("adapter: {}, {}", gpu.adapter_name(), gpu.driver()));
        Ok(gpu)
    }
}

/// Values of a scene that are given on the command line.
#[derive(Args, Clone, Debug)]
struct SceneSettings {
    /// Set a key of the scene, as in `view.exposure_ev=2`, `bubble.0.film.thickness_nm=400` or `light.illuminant=A`; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    settings: Vec<Setting>,
}

impl SceneSettings {
    /// Loads a scene with these settings; warns on stderr about unphysical values, and notes how its files were read where that is in doubt.
    fn load(&self, name: &Path) -> Result<LoadedScene, LoadError> {
        let loaded = load_scene_with(name, &self.settings)?;
        for warning in loaded.scene.warnings() {
            tell(format_args!("warning: {warning}"));
        }
        tell_notes(&loaded.notes);
        Ok(loaded)
    }
}

/// Opens the window on a scene and returns when it is closed.
pub type OpenWindow = fn(LoadedScene, &AdapterChoice) -> anyhow::Result<()>;

/// Runs the program with its arguments, the program's own name first. The window belongs to another layer, so it is handed in.
pub fn main(arguments: impl IntoIterator<Item = OsString>, open_window: OpenWindow) -> ExitCode {
    std::panic::set_hook(Box::new(failure::report_panic));
    report_logs();
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    if let Some(told) = failure::mistyped(&arguments) {
        tell(told);
        return ExitCode::from(2);
    }
    let parsed = match parsed(&arguments) {
        Ok(parsed) => parsed,
        Err(error) => return failure::explain(&error, &arguments),
    };
    if let Err(error) = watch_signals() {
        log::warn!("an interrupt may leave temporary files until the next run: {error}");
    }
    run(parsed, open_window).map_or_else(|error| failure::report(&error), |()| 0).into()
}

/// The arguments, with what begins with a sign and a digit taken as a value: whether it is a good one the option knows best.
fn parsed(arguments: &[OsString]) -> Result<Arguments, clap::Error> {
    let signed = |argument: Arg| {
        let is_option = argument.get_long().is_some() && argument.get_action().takes_values();
        if is_option { argument.allow_negative_numbers(true) } else { argument }
    };
    let command = Arguments::command().mut_args(signed).mut_subcommands(|command| command.mut_args(signed));
    Arguments::from_arg_matches(&command.try_get_matches_from(arguments)?)
}

fn run(arguments: Arguments, open_window: OpenWindow) -> anyhow::Result<()> {
    match arguments.command.unwrap_or(Command::App(arguments.app)) {
        Command::App(arguments) => {
            let scene = arguments.settings.load(arguments.scene.as_deref().unwrap_or(Path::new("default")))?;
            open_window(scene, &arguments.adapter.choice())
        }
        Command::Render(arguments) => render::run(&arguments),
        Command::Sequence(arguments) => sequence::run(&arguments),
        Command::Presets(arguments) => presets::run(&arguments),
        Command::Film(arguments) => film::run(&arguments),
        Command::Colour(arguments) => colour::run(&arguments),
        Command::Lut(arguments) => lut::run(&arguments),
        Command::Transport(arguments) => transport::run(&arguments),
        Command::Flow(arguments) => flow::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
    }
}

/// Prints on stderr what a user should know of how files were read.
fn tell_notes(notes: &[String]) {
    notes.iter().for_each(|note| tell(format_args!("note: {note}")));
}

/// Runs something whose result tells the user everything: missing drivers log long complaints when others are looked
/// for. `RUST_LOG` shows these logs.
fn without_logs<T>(action: impl FnOnce() -> T) -> T {
    let level = log::max_level();
    if std::env::var_os("RUST_LOG").is_none() {
        log::set_max_level(log::LevelFilter::Off);
    }
    let result = action();
    log::set_max_level(level);
    result
}

/// Errors that drivers and libraries log reach the user in a line each; `RUST_LOG` asks for more.
fn report_logs() {
    let mut logger = env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error"));
    logger.format(|line, record| {
        let told = failure::one_line(&record.args().to_string());
        writeln!(line, "{} ({}): {told}", record.level().as_str().to_lowercase(), record.target())
    });
    logger.init();
}
