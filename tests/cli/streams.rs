//! Streams that are closed or full, and signals.

use std::{
    fs::OpenOptions,
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use super::Desk;

/// A run of the program with its streams, its exit code, and what it says on stderr.
fn run(arguments: &str, stdout: Stdio, stderr: Stdio) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_soapfilm"));
    command.args(arguments.split_whitespace()).stdout(stdout).stderr(stderr);
    let output = command.spawn().unwrap().wait_with_output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// A pipe whose reader has gone.
fn closed() -> Stdio {
    std::io::pipe().unwrap().1.into()
}

fn full() -> Stdio {
    OpenOptions::new().write(true).open("/dev/full").unwrap().into()
}

/// What prints without an adapter, and so on any machine.
const PRINTING: [&str; 4] =
    ["--help", "--version", "render --help", "colour --thickness 300 --cos 1 --quality reference"];

#[test]
fn a_reader_that_stops_ends_the_program_without_a_word() {
    for arguments in PRINTING {
        assert_eq!(run(arguments, closed(), Stdio::piped()), (Some(141), String::new()), "{arguments}");
    }
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_behind_the_output_is_one_line() {
    for arguments in PRINTING {
        let (code, told) = run(arguments, full(), Stdio::piped());
        assert_eq!(code, Some(1), "{arguments}");
        assert!(told.starts_with("error: cannot write to standard output: ") && told.lines().count() == 1, "{told}");
    }
}

/// What cannot be said changes nothing else.
#[test]
fn a_closed_stderr_is_no_reason_to_fail() {
    let code = |arguments: &str| run(arguments, Stdio::null(), closed()).0;
    assert_eq!(code("render nonesuch -o a.png"), Some(1));
    assert_eq!(code("render --no-such-option"), Some(2));
    assert_eq!(code("colour --thickness 300 --cos 1 --quality reference"), Some(0));
    if super::support::gpu().is_some() {
        assert_eq!(code("info"), Some(0));
    }
}

/// Whether it is in the midst of computing, of writing, or has just finished.
#[test]
fn a_program_that_is_told_to_end_leaves_no_half_written_file() {
    let desk = Desk::new();
    for signal in ["TERM", "INT", "HUP"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_soapfilm"));
        command.current_dir(desk.path("")).stderr(Stdio::null());
        command.args(["render", "furnace", "-o", "a.exr", "--size", "2048x2048", "--quality", "reference"]);
        let mut program = command.args(["--set", "bubble=[]"]).spawn().unwrap();
        let started = Instant::now();
        while started.elapsed() < Duration::from_secs(120) && desk.files().is_empty() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let id = program.id().to_string();
        assert!(Command::new("kill").args(["-s", signal, &id]).status().unwrap().success());
        program.wait().unwrap();
        assert!(desk.files().iter().all(|name| name == "a.exr"), "{signal}: {:?}", desk.files());
        let _ = std::fs::remove_file(desk.path("a.exr"));
    }
}
