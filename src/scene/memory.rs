//! The memory that a scene takes, and how much is allowed: an absurd number is refused before anything is made.

use super::{Film, FilmStateName, Generator, check::Fault};

/// The most that all films and bubbles of a scene may take, bytes.
const MOST: f64 = 16.0 * GIGABYTE;
const GIGABYTE: f64 = 1e9;
/// What a moving film takes for each cell, bytes: its thickness, its map, its flow and their copies. By the address space that lavapipe takes for
/// films of 256 and of 512 cells it is 111; films that flow together have a second solver.
const FILM_BYTES_PER_CELL: f64 = 150.0;
/// What it takes beside its cells.
const FILM_BYTES: f64 = 0.5e6;
/// What a bubble of a generator takes, on the processor and on the GPU.
const BUBBLE_BYTES: f64 = 500.0;

/// What is taken so far, bytes.
#[derive(Debug, Default)]
pub(super) struct Memory {
    bytes: f64,
}

impl Memory {
    /// Adds films, or tells why there are too many.
    pub fn add_films(&mut self, film: &Film, count: u32) -> Result<(), String> {
        if film.state == FilmStateName::Uniform {
            return Ok(());
        }
        let cells = 6.0 * f64::from(film.cells).powi(2);
        self.add(f64::from(count) * (FILM_BYTES + FILM_BYTES_PER_CELL * cells)).map_err(|taken| {
            format!("takes the films of the scene to {taken}; lower `cells`, or let a [[generator]] share films among bubbles")
        })
    }

    /// Adds the bubbles of a generator and their films, or tells which key asks for too much.
    pub fn add_bubbles(&mut self, generator: &Generator) -> Result<(), Fault> {
        self.add_films(&generator.film, generator.films).map_err(|reason| Fault::new("films", reason))?;
        self.add(f64::from(generator.count) * BUBBLE_BYTES).map_err(|taken| {
            Fault::new(
                "count",
                format!("is {}, which takes the scene to {taken}; ask for fewer bubbles", generator.count),
            )
        })
    }

    fn add(&mut self, bytes: f64) -> Result<(), String> {
        self.bytes += bytes;
        let gigabytes = |bytes: f64| format!("{:.1} GB", bytes / GIGABYTE);
        if self.bytes <= MOST {
            Ok(())
        } else {
            Err(format!("{} of memory, of {} that are allowed", gigabytes(self.bytes), gigabytes(MOST)))
        }
    }
}
