//! Reads a film and writes it as a NumPy array of shape (cells, 5) with the columns x, y, z, solid angle in sr and thickness in nm.
//!
//!     cargo run --example film_npy -- film.npy
//!     python3 -c "import numpy; print(numpy.load('film.npy').mean(axis=0))"

use std::{
    fs::File,
    io::{BufWriter, Write},
    path::PathBuf,
};

use soapfilm::{FilmCell, Studio, load_scene};

/// Writes rows of numbers in version 1.0 of NumPy's format: a magic word, a header in Python's words, then f64 in little endian.
fn write_npy<const N: usize>(mut file: impl Write, rows: &[[f64; N]]) -> std::io::Result<()> {
    let shape = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {N}), }}", rows.len());
    // The numbers start at a multiple of 64 bytes: 10 go before the header, and a line end closes it.
    let length = (10 + shape.len() + 1).next_multiple_of(64) - 10;
    file.write_all(b"\x93NUMPY\x01\x00")?;
    file.write_all(&(length as u16).to_le_bytes())?;
    file.write_all(format!("{shape:<width$}\n", width = length - 1).as_bytes())?;
    rows.iter().flatten().try_for_each(|number| file.write_all(&number.to_le_bytes()))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).map_or_else(|| std::env::temp_dir().join("film.npy"), PathBuf::from);
    let scene = load_scene("default")?;
    // The first bubble, half a second after it was blown.
    let film = Studio::open()?.film(&scene, 0, 0.5)?;
    let row = |cell: &FilmCell| {
        let [x, y, z] = cell.direction.to_array();
        [x, y, z, cell.solid_angle_sr, cell.thickness_nm]
    };
    let rows: Vec<[f64; 5]> = film.iter().map(row).collect();
    let mut file = BufWriter::new(File::create(&path)?);
    write_npy(&mut file, &rows)?;
    file.flush()?;

    let whole: f64 = film.iter().map(|cell| cell.solid_angle_sr).sum();
    let mean_nm = film.iter().map(|cell| cell.solid_angle_sr * cell.thickness_nm).sum::<f64>() / whole;
    println!("wrote {} cells to {}; the film is {mean_nm:.1} nm thick on average", film.len(), path.display());
    Ok(())
}
