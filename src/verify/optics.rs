//! Colours of films as the shaders of each quality give them, against the spectral sum over all wavelengths in f64.

use glam::DVec3;

use super::{Run, random::Random};
use crate::{
    gpu::{
        Gpu, GpuError,
        passes::probe_colour::{ColourProbe, ProbePoint},
    },
    parallel,
    physics::{
        colour::{BT2020, Walls, m2_delta_e},
        optics::{FilmIndex, FilmMaterial},
    },
    plan::OpticsKey,
    scene::Quality,
};

/// Points of each measurement.
const POINTS: usize = 20_000;
/// Points of a short one, of films to 3 µm: they have the same mean, and miss some of the worst.
const FEW_POINTS: usize = 2_500;
/// Rays flatter than this count in the mean, but not in the maximum of two walls: films reflect like mirrors there.
const STEEP_COS: f64 = 0.26;

/// What is measured and what it may be. Colour differences are CIEDE2000, each angle exposed so that its brightest film is white.
struct Case {
    film: FilmIndex,
    light: &'static str,
    quality: Quality,
    thickest_nm: f64,
    walls: u32,
    /// Limits on the mean, the maximum over steep rays, and the maximum over all, cos θ ≥ 0.05.
    limits: [Option<f64>; 3],
}

fn water(light: &'static str, quality: Quality, thickest_nm: f64, walls: u32, limits: [Option<f64>; 3]) -> Case {
    Case { film: FilmIndex::Water, light, quality, thickest_nm, walls, limits }
}

/// Fringes of dense films are as narrow at grazing as the table's samples of the spectrum are apart.
fn dense_cases(index: f64) -> [Case; 3] {
    let film = FilmIndex::Constant(index);
    let case = |quality, walls, limits| Case { film: film.clone(), ..water("D65", quality, 1500.0, walls, limits) };
    [
        case(Quality::Standard, 1, [Some(0.01), None, Some(1.0)]),
        case(Quality::Fast, 2, [Some(1.0), Some(15.0), None]),
        case(Quality::Standard, 2, [Some(0.15), None, None]),
    ]
}

/// Under white light: the table alone for one wall, the table and products of few wavelengths for two, many wavelengths. The limits hold
/// to 3 µm, where f32's phases cost a little more in the mean.
fn cases() -> Vec<Case> {
    use Quality::{Fast, Spectral, Standard};
    let (table, table_thick) = ([Some(0.005), None, Some(0.1)], [Some(0.006), None, Some(0.1)]);
    let spectral = [Some(0.012), Some(0.12), Some(2.0)];
    let standard = [Some(0.15), Some(1.5), None];
    let fast = [Some(1.0), Some(15.0), None];
    let mut cases = vec![
        water("D65", Fast, 1500.0, 1, table),
        water("D65", Standard, 1500.0, 1, table),
        water("D65", Standard, 3000.0, 1, table_thick),
        water("D65", Fast, 1500.0, 2, fast),
        water("D65", Standard, 1500.0, 2, standard),
        water("D65", Standard, 3000.0, 2, standard),
    ];
    for walls in [1, 2] {
        cases.push(water("D65", Spectral, 1500.0, walls, spectral));
        cases.push(water("D65", Spectral, 3000.0, walls, [Some(0.018), Some(0.12), Some(2.0)]));
    }
    for light in ["A", "FL11", "LED"] {
        cases.push(water(light, Standard, 1500.0, 2, standard));
        cases.push(water(light, Spectral, 1500.0, 2, spectral));
    }
    // More wavelengths for thicker films keep `fast` what it is for thin ones.
    cases.extend([3000.0, 10_000.0, 30_000.0].map(|thickest_nm| water("D65", Fast, thickest_nm, 2, fast)));
    // Beyond the last visible fringe of one wall. Two walls of nearly one thickness show fringes however thick they are, and so do one and
    // another of nearly twice its thickness.
    for quality in [Standard, Spectral] {
        cases.push(water("D65", quality, 10_000.0, 2, standard));
        cases.push(water("D65", quality, 30_000.0, 1, [Some(0.05), Some(0.15), Some(1.0)]));
        cases.push(water("D65", quality, 30_000.0, 2, standard));
    }
    cases.push(water("D65", Spectral, 6000.0, 2, standard));
    cases.extend([2.0, 4.0].into_iter().flat_map(dense_cases));
    let glycerol = FilmIndex::Glycerol(40.0);
    cases.push(Case { film: glycerol, ..water("D65", Standard, 1500.0, 2, standard) });
    cases
}

pub fn run(run: &mut Run<'_>) -> Result<(), GpuError> {
    for case in cases() {
        let errors = case.errors(run.gpu, run.short_or_full(case.few_points(), POINTS))?;
        let steep = |(cos, _): &&(f64, f64)| *cos >= STEEP_COS;
        let max = |errors: &mut dyn Iterator<Item = &(f64, f64)>| errors.map(|(_, e)| *e).fold(0.0, worse);
        let mean = errors.iter().map(|(_, error)| error).sum::<f64>() / errors.len() as f64;
        let measured = [mean, max(&mut errors.iter().filter(steep)), max(&mut errors.iter())];
        let what = ["mean", "max, cos >= 0.26", "max, cos >= 0.05"];
        for ((measured, limit), what) in measured.into_iter().zip(case.limits).zip(what) {
            if let Some(limit) = limit {
                run.at_most(format!("{}: dE2000 {what}", case.name()), measured, limit);
            }
        }
    }
    nothing(run)
}

/// The larger of two errors; NaN is larger than all.
fn worse(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}

impl Case {
    fn name(&self) -> String {
        let walls = if self.walls == 1 { "one wall" } else { "two walls" };
        format!("{}, {}, {walls} to {} nm, {}", self.film, self.light, self.thickest_nm, self.quality.name())
    }

    /// Points of a short measurement: a truth takes as many wavelengths as a film has fringes.
    fn few_points(&self) -> usize {
        (FEW_POINTS as f64 * (3000.0 / self.thickest_nm).min(1.0)) as usize
    }

    /// The colour difference at each of a number of points, and the point's cosine.
    fn errors(&self, gpu: &Gpu, count: usize) -> Result<Vec<(f64, f64)>, GpuError> {
        let key = optics(self.film.clone(), self.light)?;
        let points = points(count, self.thickest_nm, self.walls);
        let seen = measure(gpu, &key, self.quality, &points)?;
        let (optics, material) = (key.spectra_to(self.thickest_nm), &key.film);
        let white = optics.weights().white();
        let error = |k: usize| {
            let (cos, walls) = points[k];
            (cos, m2_delta_e(optics.xyz(cos, walls), seen[k], material, cos, walls.count(), white))
        };
        Ok(parallel::map(points.len(), error))
    }
}

fn optics(film: FilmIndex, light: &str) -> Result<OpticsKey, GpuError> {
    let illuminant = light.parse().map_err(|error| GpuError::Refused(format!("{error}")))?;
    Ok(OpticsKey { film: FilmMaterial::from(film), illuminant: std::sync::Arc::new(illuminant) })
}

/// XYZ of some points through the shaders.
fn measure(gpu: &Gpu, key: &OpticsKey, quality: Quality, points: &[(f64, Walls)]) -> Result<Vec<DVec3>, GpuError> {
    let probes: Vec<ProbePoint> = points.iter().map(|(cos, walls)| ProbePoint::new(*cos, *walls)).collect();
    let thickest_nm = probes.iter().map(ProbePoint::thickest_nm).fold(0.0, f64::max);
    let colours = ColourProbe::new(gpu, key, quality, thickest_nm)?.measure(gpu, &probes)?;
    Ok(colours.into_iter().map(|colour| BT2020.to_xyz() * colour).collect())
}

/// Points as colour errors are measured: uniform on the projected disk with cos θ ≥ 0.05, thickness uniform.
fn points(count: usize, thickest_nm: f64, walls: u32) -> Vec<(f64, Walls)> {
    let mut random = Random::new(2026);
    let mut point = || {
        let cos_theta = (0.0025 + 0.9975 * random.next()).sqrt();
        let [front_nm, back_nm, exit_nm] = [(); 3].map(|()| thickest_nm * random.next());
        let one = Walls::One { thickness_nm: front_nm };
        (cos_theta, if walls == 1 { one } else { Walls::Two { front_nm, back_nm, exit_nm } })
    };
    (0..count).map(|_| point()).collect()
}

/// A film of no thickness reflects exactly nothing, one of air's index nothing but f32's rounding, and a dense one never more than all.
fn nothing(run: &mut Run<'_>) -> Result<(), GpuError> {
    let steps = || (0..=100).map(|k| f64::from(k) * 0.01);
    let films = |nm: f64| {
        let walls = [Walls::One { thickness_nm: nm }, Walls::Two { front_nm: nm, back_nm: nm, exit_nm: nm }];
        steps().flat_map(move |cos| walls.map(|walls| (cos, walls))).collect::<Vec<_>>()
    };
    let cases =
        [("no film", FilmIndex::Water, films(0.0), 0.0), ("index 1", FilmIndex::Constant(1.0), films(500.0), 1e-9)];
    let single: Vec<_> = steps().map(|cos| (cos, Walls::One { thickness_nm: 400.0 })).collect();
    for quality in Quality::ALL {
        for (name, film, points, limit) in &cases {
            let seen = measure(run.gpu, &optics(film.clone(), "D65")?, quality, points)?;
            let max = seen.iter().map(|xyz| xyz.length()).fold(0.0, worse);
            run.at_most(format!("{name}, {}: reflected", quality.name()), max, *limit);
        }
        let dense = optics(FilmIndex::Constant(3.0), "D65")?;
        let seen = measure(run.gpu, &dense, quality, &single)?;
        let out = seen.iter().map(|xyz| (xyz.y - 1.0).max(-xyz.y)).fold(f64::NEG_INFINITY, worse);
        run.at_most(format!("index 3, {}: reflectance outside 0 to 1", quality.name()), out, 2e-3);
        let (water, thin) = (optics(FilmIndex::Water, "D65")?, films(5.0));
        let (spectra, seen) = (water.spectra(), measure(run.gpu, &water, quality, &thin)?);
        // A film of 5 nm is black to the eye: its XYZ is compared, not its colour, to less than a step of 8 bits.
        let off = |((cos, walls), xyz): (&(f64, Walls), &DVec3)| (spectra.xyz(*cos, *walls) - *xyz).abs().max_element();
        let max = thin.iter().zip(&seen).filter(|((cos, _), _)| *cos >= 0.05).map(off).fold(0.0, worse);
        run.at_most(format!("5 nm, {}: XYZ", quality.name()), max, 1.0 / 255.0);
    }
    Ok(())
}
