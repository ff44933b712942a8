//! The `soapfilm` program: hands its arguments to the command line, and the window to it.

use std::process::ExitCode;

use soapfilm::{gpu::AdapterChoice, input::LoadedScene};

fn main() -> ExitCode {
    soapfilm::cli::main(std::env::args_os(), open_window)
}

#[cfg(feature = "gui")]
fn open_window(scene: LoadedScene, choice: &AdapterChoice) -> anyhow::Result<()> {
    Ok(soapfilm::app::run(scene, choice)?)
}

#[cfg(not(feature = "gui"))]
fn open_window(_: LoadedScene, _: &AdapterChoice) -> anyhow::Result<()> {
    anyhow::bail!("this build has no window: build it with the feature `gui`, or use `soapfilm render`")
}
