//! The `soapfilm` program: hands its arguments to the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    soapfilm::cli::main(std::env::args_os())
}
