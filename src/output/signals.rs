//! Signals that end the program, which then leaves no half-written file.

#[cfg(unix)]
pub use unix::watch_signals;

/// Elsewhere the system ends the program, and its next run clears what that left.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub fn watch_signals() -> std::io::Result<()> {
    Ok(())
}

#[cfg(unix)]
mod unix {
    use std::{
        io,
        sync::{Arc, atomic::AtomicBool},
        thread,
    };

    use signal_hook::{
        consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ},
        flag,
        iterator::Signals,
        low_level::emulate_default_handler,
    };

    use super::super::atomic::abandon_files;

    /// Lets an interrupt (Ctrl-C), a hang-up and a request to terminate remove temporary files before they end the program as they would
    /// have without. A file that grows beyond its limit fails to be written and ends nothing.
    ///
    /// # Errors
    /// The system refuses a handler or a thread.
    pub fn watch_signals() -> io::Result<()> {
        flag::register(SIGXFSZ, Arc::new(AtomicBool::new(false)))?;
        let mut signals = Signals::new([SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| !is_ignored(*signal)))?;
        let watch = move || {
            if let Some(signal) = signals.forever().next() {
                abandon_files();
                // The program ends here, so that its parent sees which signal it was.
                let _ = emulate_default_handler(signal);
            }
        };
        thread::Builder::new().name("soapfilm signals".to_owned()).spawn(watch)?;
        Ok(())
    }

    /// Whether the program was started with a signal ignored, as `nohup` does with hang-ups: that stays so.
    fn is_ignored(signal: libc::c_int) -> bool {
        // SAFETY: all zeros are a valid `sigaction`, and without a new action the call only writes the old one there.
        unsafe {
            let mut old: libc::sigaction = std::mem::zeroed();
            libc::sigaction(signal, std::ptr::null(), &mut old) == 0 && old.sa_sigaction == libc::SIG_IGN
        }
    }
}
