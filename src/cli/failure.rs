//! How the command line reports a failure: one helpful line, and the exit code.

use std::{backtrace, ffi::OsString, panic::PanicHookInfo, process::ExitCode};

use clap::{CommandFactory, error::ErrorKind};

use super::Arguments;
use crate::{
    output::{StreamError, tell},
    scene::{nearest, preset_names, preset_toml, shorten},
};

/// The exit code of a program that a closed pipe ends: 128 and the number of the signal SIGPIPE, which shells give other programs.
const CLOSED_PIPE: u8 = 141;

/// Reports why a command failed, unless its reader has stopped, and returns the exit code.
pub fn report(error: &anyhow::Error) -> u8 {
    if matches!(error.downcast_ref(), Some(StreamError::Closed)) {
        return CLOSED_PIPE;
    }
    tell(format_args!("error: {}", in_words(error)));
    1
}

/// An error and its cause, in one line. Many errors include their cause: nothing is repeated.
fn in_words(error: &anyhow::Error) -> String {
    let causes = error.chain().map(|cause| one_line(&cause.to_string()));
    causes.fold(String::new(), |told, cause| match told.as_str() {
        "" => cause,
        before if before.contains(&cause) => told,
        before => format!("{before}: {cause}"),
    })
}

/// A text in one line of limited length, without control characters and without folders of the machine that built the
/// program.
pub fn one_line(text: &str) -> String {
    const LONGEST: usize = 2000;
    let words: Vec<_> = text.split_whitespace().map(without_build_folder).collect();
    let printable = |character: char| if character.is_control() { char::REPLACEMENT_CHARACTER } else { character };
    shorten(&words.join(" "), LONGEST).chars().map(printable).collect()
}

/// A place in source code by its package, as in `winit-0.30.13/src/window.rs:12`; any other word as it is.
fn without_build_folder(word: &str) -> &str {
    let Some(source) = word.rfind("/src/").or_else(|| word.rfind("\\src\\")).filter(|_| word.contains(".rs:")) else {
        return word;
    };
    let package = word[..source].rfind(['/', '\\']).map_or(0, |folder| folder + 1);
    &word[package..]
}

/// Reports in one line a fault of the program itself, and its place; `RUST_BACKTRACE` adds a backtrace.
pub fn report_panic(panic: &PanicHookInfo) {
    let place = panic.location().map_or(String::new(), |place| format!(" ({place})"));
    let reason = panic.payload_as_str().unwrap_or("no reason was given");
    tell(one_line(&format!("error: a fault of soapfilm itself stopped it: {reason}{place}; please report this line")));
    let trace = backtrace::Backtrace::capture();
    if trace.status() == backtrace::BacktraceStatus::Captured {
        tell(trace);
    }
}

/// What is wrong with the arguments in one line; help and version as they are.
pub fn explain(error: &clap::Error, arguments: &[OsString]) -> ExitCode {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        let printed = error.print().and_then(|()| std::io::Write::flush(&mut std::io::stdout()));
        return printed.map_or_else(|error| report(&StreamError::from(error).into()), |()| 0).into();
    }
    let odd = arguments.iter().find(|argument| argument.to_str().is_none());
    let told = match odd.filter(|_| error.kind() == ErrorKind::InvalidUtf8) {
        Some(odd) => format!("error: the argument `{}` is not UTF-8 text", odd.display()),
        None => told_by_clap(&error.to_string()),
    };
    tell(format_args!("{} (see --help)", one_line(&told)));
    ExitCode::from(2)
}

/// What clap says, without the usage below it.
fn told_by_clap(text: &str) -> String {
    let told = text.split("\n\nUsage:").next().and_then(|text| text.split("\n\nFor more").next()).unwrap_or(text);
    told.replace("\n\n  tip: ", "; ").replace("\n  [possible", "; [possible")
}

/// What is wrong with the first argument if it is neither a command nor a scene: without a command it is the scene that a window opens.
pub fn mistyped(arguments: &[OsString]) -> Option<String> {
    let word = arguments.get(1)?.to_str()?;
    let known = Arguments::command();
    let mut commands: Vec<&str> = known.get_subcommands().map(clap::Command::get_name).collect();
    commands.push("help");
    let is_file = word.starts_with('-') || word.contains(['.', '/', '\\']) || std::path::Path::new(word).exists();
    if word.is_empty() || is_file || commands.contains(&word) || preset_toml(word).is_some() {
        return None;
    }
    let mut names: Vec<&str> = preset_names().collect();
    names.extend(&commands);
    let hint = match nearest(word, &names) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("commands: {}", commands.join(", ")),
    };
    Some(one_line(&format!("error: no command, preset or scene file is named `{word}`; {hint} (see --help)")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::{Context, anyhow};

    #[test]
    fn nothing_is_said_twice() {
        let doubled =
            Err::<(), _>(anyhow!("no display")).context("no window (no display); draw without one").unwrap_err();
        assert_eq!(in_words(&doubled), "no window (no display); draw without one");
        let chain = Err::<(), _>(anyhow!("full")).context("cannot write").context("a.png").unwrap_err();
        assert_eq!(in_words(&chain), "a.png: cannot write: full");
    }

    #[test]
    fn folders_of_the_build_are_left_out_and_others_are_kept() {
        let told =
            one_line("os error at /root/.cargo/registry/src/index-1/winit-0.30.13/src/x/mod.rs:763: no\n display");
        assert_eq!(told, "os error at winit-0.30.13/src/x/mod.rs:763: no display");
        let windows = one_line("at C:\\me\\.cargo\\registry\\src\\index-1\\exr-1.7\\src\\lib.rs:1");
        assert_eq!(windows, "at exr-1.7\\src\\lib.rs:1");
        for kept in ["/home/me/src/a.toml:3: wrong", "src/plan/mod.rs:12:3"] {
            assert_eq!(one_line(kept), kept);
        }
    }

    #[test]
    fn lines_are_bounded_and_harmless() {
        let told = one_line(&format!("\u{1b}[31m{}", "x".repeat(1_000_000)));
        assert!(told.chars().count() == 2000 && !told.contains('\u{1b}'), "{}", &told[..40]);
    }

    #[test]
    fn mistyped_words_have_a_neighbour() {
        let told = |word: &str| mistyped(&["soapfilm".into(), word.into()]);
        assert!(told("rendre").unwrap().contains("did you mean `render`?"));
        assert!(told("windws").unwrap().contains("did you mean `windows`?"));
        assert!(told("qqqq").unwrap().contains("commands: app, render"));
        for fine in ["render", "help", "windows", "--help", "my.toml", "scenes/one", "src"] {
            assert_eq!(told(fine), None, "{fine}");
        }
    }
}
