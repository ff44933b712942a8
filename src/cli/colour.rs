//! `soapfilm colour`: the colour that a film reflects.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, ValueEnum};
use glam::DVec3;

use super::{AdapterArguments, parse, progress::progress, strip};
use crate::{
    export,
    gpu::passes::probe_colour::{ColourProbe, ProbePoint},
    input::{load_illuminant, load_liquid, read_table_text},
    output::{Metadata, print, write_text},
    parallel,
    physics::{
        colour::{BT709, BT2020, FilmOptics, Walls, srgb_encode},
        optics::FilmMaterial,
        table::{Row, Table},
    },
    plan::OpticsKey,
    scene::Quality,
};

/// Report the colour that a film reflects.
#[derive(Args)]
#[command(
    after_help = "Examples:\n  soapfilm colour --thickness 320 --cos 0.8\n  soapfilm colour --thickness 320 --angle 45 --spectrum rows\n  soapfilm colour --thickness 320 --back 500 --cos 0.8\n  soapfilm colour --points films.csv -o colours.csv\n  soapfilm colour --strip strip.png\n\nPoints have columns thickness_nm,cos_theta and may have back_nm,exit_nm: then the answer is front + back wall, R0 + T0 R1 T2 with\nthickness_nm, back_nm and exit_nm for 0, 1 and 2. Output: the input's\ncolumns, X,Y,Z (perfect mirror: Y = 1), linear BT.2020 r,g,b, and s_r,s_g,s_b, this colour in encoded sRGB, 0 to 1 where it is in gamut.\n--spectrum writes R360 to R780, the reflectance every 5 nm, instead of s_r,s_g,s_b. --spectrum rows writes rows of wavelength_nm,R,T\nfor one film, where T is the transmittance.\n\nCSV files may have commas, semicolons, tabs or spaces between columns, decimal points or decimal commas, and # comments. Spectra\nare in nm (or µm, where only that covers the visible range) and cover 380 to 780 nm; from there down to 360 nm the first value is repeated."
)]
pub struct Arguments {
    /// Thickness in nm; with --back, of the front wall
    #[arg(long, value_name = "NM", allow_negative_numbers = true, value_parser = parse::thickness_nm, requires = "direction", required_unless_present_any = ["points", "strip"])]
    thickness: Option<f64>,
    /// Cosine of the angle outside the film
    #[arg(long, value_name = "C", allow_negative_numbers = true, value_parser = parse::cosine, requires = "thickness", group = "direction")]
    cos: Option<f64>,
    /// Angle outside the film, from its normal
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, value_parser = parse::angle_cos, requires = "thickness", group = "direction", conflicts_with = "cos")]
    angle: Option<f64>,
    /// Thickness in nm of the back wall, seen through the front wall
    #[arg(long, value_name = "NM", allow_negative_numbers = true, value_parser = parse::thickness_nm, requires = "thickness")]
    back: Option<f64>,
    /// Thickness in nm of the front wall where light from the back wall leaves through it; by default --thickness
    #[arg(long, value_name = "NM", allow_negative_numbers = true, value_parser = parse::thickness_nm, requires = "back")]
    exit: Option<f64>,
    /// A CSV file of films
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["thickness", "direction", "back"])]
    points: Option<PathBuf>,
    /// Paint the colours of films from 0 to 1500 nm at normal incidence, one column per nanometre, instead of a report
    #[arg(long, value_name = "FILE.png", conflicts_with_all = ["thickness", "direction", "back", "points", "spectrum", "output"])]
    strip: Option<PathBuf>,
    /// `water`, `water 25C`, `glycerol 30%`, a refractive index, or a CSV file of wavelengths and indices
    #[arg(long, value_name = "FILM", default_value = "water", allow_negative_numbers = true)]
    film: String,
    /// Thickness in nm of the layer of soap molecules on each face
    #[arg(long, value_name = "NM", default_value = "0", allow_negative_numbers = true, value_parser = parse::skin_nm)]
    skin: f64,
    #[arg(long, value_name = "LIGHT", default_value = "D65", help = parse::illuminant_help())]
    illuminant: String,
    /// `fast`, `standard`, `spectral` (as in pictures of that quality) or `reference` (f64 on the CPU, no GPU needed)
    #[arg(long, value_name = "QUALITY", default_value = "standard", value_parser = parse::quality)]
    quality: export::Quality,
    /// Add the reflectance every 5 nm from 360 to 780 nm in columns, or write the spectrum of one film in rows instead of its colour
    #[arg(long, value_name = "columns|rows", num_args = 0..=1, default_missing_value = "columns")]
    spectrum: Option<Spectrum>,
    /// Write to a file instead of the terminal
    #[arg(short, value_name = "FILE.csv")]
    output: Option<PathBuf>,
    #[command(flatten)]
    adapter: AdapterArguments,
}

/// How a spectrum is written: in columns `R360` … `R780` of each film's row, or in rows `wavelength_nm,R,T` of one film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Spectrum {
    Columns,
    Rows,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    if let Some(path) = &arguments.strip {
        let is_png = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png"));
        anyhow::ensure!(is_png, "{}: write to a file that ends in .png", path.display());
    }
    let (folder, mut notes) = (Path::new(""), Vec::new());
    let film = FilmMaterial { index: load_liquid(&arguments.film, folder, &mut notes)?, skin_nm: arguments.skin };
    let key = OpticsKey { film, illuminant: load_illuminant(&arguments.illuminant, folder, &mut notes)?.into() };
    super::tell_notes(&notes);
    let points = points(arguments)?;
    let thickest_nm = points.films.iter().map(|film| film.walls.thickest_nm()).fold(0.0, f64::max);
    let optics = key.spectra_to(thickest_nm);
    if arguments.spectrum == Some(Spectrum::Rows) {
        return write(arguments, &spectrum_rows(&points, &optics)?);
    }
    let colours: Vec<DVec3> = match arguments.quality {
        export::Quality::Reference => in_f64(&optics, &points.films),
        export::Quality::Gpu(quality) => through_shaders(arguments, &key, quality, &points.films)?,
    };
    anyhow::ensure!(
        colours.iter().all(|xyz| xyz.is_finite()),
        "the colour of this film is not finite; please report it"
    );
    if let Some(path) = &arguments.strip {
        let metadata = Metadata::new()
            .with("Software", &format!("soapfilm {}", env!("CARGO_PKG_VERSION")))
            .with("Film", &arguments.film)
            .with("Illuminant", &arguments.illuminant);
        return Ok(strip::save(path, &colours, &key.film, &metadata)?);
    }
    write(arguments, &table(&points, &colours, arguments.spectrum.map(|_| &optics))?)
}

fn write(arguments: &Arguments, text: &str) -> anyhow::Result<()> {
    match &arguments.output {
        Some(path) => write_text(path, text)?,
        None => print(text)?,
    }
    Ok(())
}

fn in_f64(optics: &FilmOptics, films: &[FilmPoint]) -> Vec<DVec3> {
    let progress = progress("colour", 1);
    let part = progress.part(films.len() as u64);
    let colour = |film: &FilmPoint| {
        let xyz = optics.xyz(film.cos_theta, film.walls);
        part.add(1);
        xyz
    };
    parallel::map(films.len(), |k| colour(&films[k]))
}

/// One line of sight.
#[derive(Clone, Copy, Debug)]
struct FilmPoint {
    cos_theta: f64,
    walls: Walls,
}

/// Films to measure, with the text they came from.
struct Points {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    films: Vec<FilmPoint>,
}

fn points(arguments: &Arguments) -> anyhow::Result<Points> {
    if let Some(path) = &arguments.points {
        return read_points(path);
    }
    if arguments.strip.is_some() {
        return Ok(films_of_strip());
    }
    let cos_theta = arguments.cos.or(arguments.angle);
    let (thickness_nm, cos_theta) =
        arguments.thickness.zip(cos_theta).context("give --thickness and --cos or --angle, or --points")?;
    let one = Points {
        header: vec!["thickness_nm".to_owned(), "cos_theta".to_owned()],
        rows: vec![vec![thickness_nm.to_string(), cos_theta.to_string()]],
        films: vec![FilmPoint { cos_theta, walls: Walls::One { thickness_nm } }],
    };
    let Some(back_nm) = arguments.back else { return Ok(one) };
    let exit_nm = arguments.exit.unwrap_or(thickness_nm);
    Ok(Points {
        header: [one.header, vec!["back_nm".to_owned(), "exit_nm".to_owned()]].concat(),
        rows: vec![[thickness_nm, cos_theta, back_nm, exit_nm].map(|value| value.to_string()).to_vec()],
        films: vec![FilmPoint { cos_theta, walls: Walls::Two { front_nm: thickness_nm, back_nm, exit_nm } }],
    })
}

fn films_of_strip() -> Points {
    let film = |nm: u32| FilmPoint { cos_theta: 1.0, walls: Walls::One { thickness_nm: nm.into() } };
    Points { header: Vec::new(), rows: Vec::new(), films: (0..=strip::LAST_NM).map(film).collect() }
}

fn read_points(path: &Path) -> anyhow::Result<Points> {
    let table = Table::parse(&read_table_text(path)?);
    let file = path.display();
    let block = table.blocks.first().with_context(|| format!("{file}: no points"))?;
    if let Some(second) = table.blocks.get(1) {
        anyhow::bail!("{file}:{}: no numbers, but a heading; keep one table in the file", second.line);
    }
    let column = |name: &str| block.heading.iter().position(|known| known == name);
    let needed = |name: &str| {
        let told =
            || format!("{file}:{}: no column `{name}`; the line above the numbers names the columns", block.line);
        column(name).with_context(told)
    };
    let columns = [
        needed("thickness_nm")?,
        needed("cos_theta")?,
        column("back_nm").unwrap_or(usize::MAX),
        column("exit_nm").unwrap_or(usize::MAX),
    ];
    let film = |row: &Row| {
        let (found, named) = (row.fields.len(), block.heading.len());
        anyhow::ensure!(found == named, "{found} values for {named} columns ({})", table.separator.hint());
        film_of(&row.fields, columns)
    };
    let films = block.rows.iter().map(|row| film(row).with_context(|| format!("{file}:{}", row.line)));
    let films: Vec<FilmPoint> = films.collect::<Result<_, _>>()?;
    anyhow::ensure!(!films.is_empty(), "{file}: no points below the header");
    Ok(Points { header: block.heading.clone(), rows: block.rows.iter().map(|row| row.fields.clone()).collect(), films })
}

fn film_of(fields: &[String], [thickness, cosine, back, exit]: [usize; 4]) -> anyhow::Result<FilmPoint> {
    let text_at = |column: usize| fields.get(column).map_or("", String::as_str);
    let parsed = |column: usize, name: &str, parser: fn(&str) -> Result<f64, String>| {
        let text = text_at(column);
        anyhow::ensure!(
            !text.is_empty(),
            "{name} is missing; a film needs thickness_nm and cos_theta, two walls back_nm and exit_nm too"
        );
        parser(text).map_err(|reason| anyhow::anyhow!("{name} `{text}`: {reason}"))
    };
    let given = |column: usize| !text_at(column).is_empty();
    let front_nm = parsed(thickness, "thickness_nm", parse::thickness_nm)?;
    let cos_theta = parsed(cosine, "cos_theta", parse::cosine)?;
    let walls = if given(back) || given(exit) {
        let back_nm = parsed(back, "back_nm", parse::thickness_nm)?;
        let exit_nm = parsed(exit, "exit_nm", parse::thickness_nm)?;
        Walls::Two { front_nm, back_nm, exit_nm }
    } else {
        Walls::One { thickness_nm: front_nm }
    };
    Ok(FilmPoint { cos_theta, walls })
}

/// Unpolarised XYZ through the table, the wavelengths and the shader functions of pictures.
fn through_shaders(
    arguments: &Arguments,
    key: &OpticsKey,
    quality: Quality,
    films: &[FilmPoint],
) -> anyhow::Result<Vec<DVec3>> {
    let gpu = arguments.adapter.open()?;
    let points: Vec<ProbePoint> = films
        .iter()
        .map(|film| ProbePoint::new(film.cos_theta, film.walls.map(|nm| key.film.equivalent_nm(nm))))
        .collect();
    let thickest_nm = points.iter().map(ProbePoint::thickest_nm).fold(0.0, f64::max);
    let colours = ColourProbe::new(&gpu, key, quality, thickest_nm)?.measure(&gpu, &points)?;
    Ok(colours.into_iter().map(|colour| BT2020.to_xyz() * colour).collect())
}

/// The table of colours. Scripts read columns by place too, from the left or from the right: sRGB comes last, and leaves the spectrum alone.
fn table(points: &Points, colours: &[DVec3], spectrum: Option<&FilmOptics>) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let last: Vec<String> = match spectrum {
        Some(_) => (360..=780).step_by(5).map(|nm| format!("R{nm}")).collect(),
        None => ["s_r", "s_g", "s_b"].map(str::to_owned).to_vec(),
    };
    let added = ["X", "Y", "Z", "r", "g", "b"].map(str::to_owned).into_iter();
    writer.write_record(points.header.iter().cloned().chain(added).chain(last))?;
    for ((row, film), xyz) in points.rows.iter().zip(&points.films).zip(colours) {
        let numbers = xyz.to_array().into_iter().chain((BT2020.from_xyz() * *xyz).to_array());
        let last: Vec<f64> = match spectrum {
            Some(optics) => optics.spectrum(film.cos_theta, film.walls).iter().map(|point| point.reflectance).collect(),
            None => (BT709.from_xyz() * *xyz).to_array().map(srgb_encode).to_vec(),
        };
        writer.write_record(row.iter().cloned().chain(numbers.chain(last).map(|number| number.to_string())))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// The spectrum of the one film.
fn spectrum_rows(points: &Points, optics: &FilmOptics) -> anyhow::Result<String> {
    let [film] = points.films[..] else {
        anyhow::bail!(
            "--spectrum rows writes the spectrum of one film, and there are {}: use --spectrum",
            points.films.len()
        );
    };
    let mut text = String::from("wavelength_nm,R,T\n");
    for point in optics.spectrum(film.cos_theta, film.walls) {
        text += &format!("{},{},{}\n", point.wavelength_nm, point.reflectance, point.transmittance);
    }
    Ok(text)
}
