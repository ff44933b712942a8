//! A few wavelengths that stand for the whole spectrum: what shaders sum over where a table cannot help.
//!
//! The colour of light that met a bubble's walls is an integral over 421 wavelengths of products of reflectances. These products are
//! smooth: a film of d nm makes no fringes narrower than its optical path allows. So a sum over a few wavelengths can give the same
//! integrals, if wavelengths and weights are fitted to such products. The fit is least squares over many films at many angles, with errors
//! weighted as the eye sees them, and an exchange that moves one wavelength after another for as long as that helps.

use glam::{DMat3, DVec3};
use serde::{Deserialize, Serialize};

use super::{BT2020, ColourWeights, FilmOptics, Uplift, bt2020_to_bt709};
use crate::{
    parallel,
    physics::optics::{Polarised, SpectralWall},
};

/// One wavelength of a fitted sum.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct QuadratureWavelength {
    /// Its wavelength.
    pub wavelength_nm: f64,
    /// Refractive index of the film's liquid there.
    pub index: f64,
    /// Matrix from the light, linear BT.2020, to its colour where the film reflects 1 at this wavelength, linear BT.2020.
    pub response: DMat3,
}

/// What a quadrature is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuadratureTask {
    /// Only the products of two and more walls' reflectances; single walls come from a table.
    CrossTerms,
    /// Single walls too.
    Everything,
}

/// Films that the fit is trained on; each gives a row for each of three products.
const FILMS: usize = 1500;
/// Candidate wavelengths, nm: beyond them the observer sees too little.
const CANDIDATES: std::ops::RangeInclusive<u32> = 384..=716;
/// Wavelengths from which on they stand as close as their candidates: all of those are then tried that there are, and moving single ones no longer
/// helps.
const MANY: usize = 120;
/// Smallest cosine of the angle of incidence in training.
const MIN_COS: f64 = 0.04;
/// Weight of a solution's size against its error, relative to the mean square of the films' reflectance: keeps weights small enough for f32.
const RIDGE: f64 = 1e-9;

/// Fits `count` wavelengths for films up to `range_nm`. A light with no more wavelengths than that is summed exactly.
pub fn fit_quadrature(
    optics: &FilmOptics,
    task: QuadratureTask,
    count: usize,
    range_nm: f64,
) -> Vec<QuadratureWavelength> {
    let responses = responses(optics.weights());
    let wavelengths = optics.weights().wavelengths_nm();
    if wavelengths.len() <= count {
        let fitted = wavelengths.iter().zip(optics.indices()).zip(responses);
        return fitted
            .map(|((nm, n), response)| QuadratureWavelength { wavelength_nm: *nm, index: *n, response })
            .collect();
    }
    // Finer places change the errors of fewer wavelengths by less than a tenth.
    let step_nm = if count > MANY { 1 } else { 2 };
    let candidates: Vec<f64> = CANDIDATES.step_by(step_nm).map(f64::from).collect();
    let fit = Fit::new(&training(optics, task, range_nm, &candidates, &responses), candidates.len());
    let start = fit.start(&candidates, count);
    let chosen = if count > MANY { start } else { fit.exchanged(start) };
    let weights = fit.solve(&chosen);
    let wavelength = |(k, at): (usize, &usize)| QuadratureWavelength {
        wavelength_nm: candidates[*at],
        index: optics.film().index.n(candidates[*at]),
        response: DMat3::from_cols_array(&std::array::from_fn(|target| weights[k][target])),
    };
    chosen.iter().enumerate().map(wavelength).collect()
}

/// For each wavelength of the light, the matrix from BT.2020 light to its colour, where everything is reflected.
pub fn responses(weights: &ColourWeights) -> Vec<DMat3> {
    let (to_bt2020, to_bt709) = (BT2020.from_xyz(), bt2020_to_bt709());
    let response = |(weight, nm): (&DVec3, &f64)| {
        let seen = to_bt2020 * *weight;
        // Row vector ρᵀ M: how much of this wavelength each component of BT.2020 light has.
        let shares = to_bt709.transpose() * Uplift::bt709().at_nm(*nm);
        DMat3::from_cols(seen * shares.x, seen * shares.y, seen * shares.z)
    };
    weights.as_slice().iter().zip(weights.wavelengths_nm()).map(response).collect()
}

/// Numbers of a response matrix.
const TARGETS: usize = 9;

/// One product of reflectances of one film: its value at each candidate, and its integrals, all weighted as the eye sees errors.
struct Row {
    values: Vec<f64>,
    targets: [f64; TARGETS],
}

/// Three products for each of many films: those that stand before the light from different directions, and so must each be right.
fn training(
    optics: &FilmOptics,
    task: QuadratureTask,
    range_nm: f64,
    candidates: &[f64],
    responses: &[DMat3],
) -> Vec<Row> {
    let indices: Vec<f64> = candidates.iter().map(|nm| optics.film().index.n(*nm)).collect();
    let film = |k: usize| {
        // An additive recurrence (the generalised golden ratio of four dimensions) fills the box of films evenly.
        let part = |step: f64| (0.5 + step * (k + 1) as f64).fract();
        let angle = part(0.8566748838545029);
        let cos_theta = match task {
            // As on a disk: the eye meets few pixels at the rim.
            QuadratureTask::CrossTerms => (MIN_COS * MIN_COS + (1.0 - MIN_COS * MIN_COS) * angle).sqrt(),
            QuadratureTask::Everything => MIN_COS + (1.0 - MIN_COS) * angle,
        };
        let walls_nm = [0.733891856627126, 0.6287067210378087, 0.5385972572236101].map(|step| range_nm * part(step));
        let at_candidates = optics.film().spectral_wall(&indices, cos_theta, candidates);
        film_rows(optics, task, cos_theta, walls_nm, &at_candidates, responses)
    };
    parallel::map(FILMS, film).into_flattened()
}

fn film_rows(
    optics: &FilmOptics,
    task: QuadratureTask,
    cos_theta: f64,
    walls_nm: [f64; 3],
    at_candidates: &SpectralWall,
    responses: &[DMat3],
) -> [Row; 3] {
    let spectra = |wall: &SpectralWall| walls_nm.map(|nm| wall.reflectances(nm));
    let light = spectra(&optics.spectral_wall(cos_theta));
    let mut targets = [DMat3::ZERO; 3];
    let mut seen = 0.0;
    for (i, response) in responses.iter().enumerate() {
        let reflected = light.each_ref().map(|spectrum| spectrum[i]);
        let products = products(task, reflected);
        (0..3).for_each(|k| targets[k] += *response * products[k]);
        seen += optics.weights().as_slice()[i].y * (reflected[0].mean() + reflected[1].mean());
    }
    // CIEDE2000 goes with the change of the cube root, at the exposure M2.
    let exposure = 0.5 / optics.film().max_reflectance(cos_theta).max(1e-6);
    let scale = exposure / (exposure * seen + 0.04).powf(2.0 / 3.0);
    let candidates = spectra(at_candidates);
    let at = |i: usize| products(task, candidates.each_ref().map(|spectrum| spectrum[i]));
    let values: Vec<[f64; 3]> = (0..candidates[0].len()).map(at).collect();
    [0, 1, 2].map(|k| Row {
        values: values.iter().map(|products| scale * products[k]).collect(),
        targets: (targets[k] * scale).to_cols_array(),
    })
}

/// The products that a quadrature must give, unpolarised: see `shaders/optics/walls.wgsl`.
fn products(task: QuadratureTask, [front, back, second]: [Polarised; 3]) -> [f64; 3] {
    let mean = |f: &dyn Fn(f64, f64, f64) -> f64| 0.5 * (f(front.s, back.s, second.s) + f(front.p, back.p, second.p));
    let deep = mean(&|r0, r1, r2| (1.0 - r0) * r1 * r2);
    match task {
        QuadratureTask::CrossTerms => {
            [mean(&|r0, r1, _| r0 * r1), mean(&|r0, r1, r2| r0 * r1 - (1.0 - r0) * r1 * r2), deep]
        }
        QuadratureTask::Everything => {
            [mean(&|r0, _, _| r0), mean(&|r0, r1, r2| r0 + (1.0 - r0) * r1 * (1.0 - r2)), deep]
        }
    }
}

/// The sum of products, in several lanes so that compilers can turn them into vector instructions.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a, b) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let lanes = a.0.iter().zip(b.0).fold([0.0; LANES], |mut sums, (a, b)| {
        (0..LANES).for_each(|lane| sums[lane] += a[lane] * b[lane]);
        sums
    });
    lanes.iter().sum::<f64>() + a.1.iter().zip(b.1).map(|(a, b)| a * b).sum::<f64>()
}

/// Normal equations of the least squares over all candidates.
struct Fit {
    size: usize,
    /// Products of candidates, averaged over films: row by row.
    gram: Vec<f64>,
    /// Products of candidates and targets.
    mixed: Vec<[f64; TARGETS]>,
    /// Sum over the columns of a response: the response to white light, by which wavelengths are chosen.
    white: Vec<[f64; 3]>,
}

impl Fit {
    fn new(rows: &[Row], size: usize) -> Self {
        // Column by column, the sums below run over neighbours in memory.
        let column = |value: &dyn Fn(&Row) -> f64| -> Vec<f64> { rows.iter().map(value).collect() };
        let values: Vec<_> = (0..size).map(|i| column(&|row| row.values[i])).collect();
        let targets: [_; TARGETS] = std::array::from_fn(|t| column(&|row| row.targets[t]));
        let gram: Vec<f64> = parallel::map(size * size, |k| {
            let (i, j) = (k / size, k % size);
            if j < i { 0.0 } else { dot(&values[i], &values[j]) }
        });
        let gram = (0..size * size).map(|k| gram[(k / size).min(k % size) * size + (k / size).max(k % size)]).collect();
        let mixed: Vec<[f64; TARGETS]> =
            parallel::map(size, |i| targets.each_ref().map(|targets| dot(&values[i], targets)));
        let white = mixed.iter().map(|mixed| [0, 1, 2].map(|c| mixed[c] + mixed[c + 3] + mixed[c + 6])).collect();
        Self { size, gram, mixed, white }
    }

    /// The lower triangle L of L Lᵀ = the chosen candidates' equations, row by row (Cholesky).
    fn factor(&self, chosen: &[usize]) -> Vec<f64> {
        let count = chosen.len();
        let trace: f64 = chosen.iter().map(|i| self.gram[i * self.size + i]).sum();
        let mut l = vec![0.0; count * count];
        for i in 0..count {
            for j in 0..=i {
                let ridge = if i == j { RIDGE * trace / count as f64 } else { 0.0 };
                let known: f64 = (0..j).map(|k| l[i * count + k] * l[j * count + k]).sum();
                let rest = self.gram[chosen[i] * self.size + chosen[j]] + ridge - known;
                // The ridge keeps the diagonal positive; the floor is for films that reflect nothing at all.
                l[i * count + j] = if i == j { rest.max(1e-300).sqrt() } else { rest / l[j * count + j] };
            }
        }
        l
    }

    /// How much of the targets' square the chosen candidates explain: the more, the smaller the error.
    fn explained(&self, chosen: &[usize]) -> f64 {
        let l = self.factor(chosen);
        let mut y: Vec<[f64; 3]> = Vec::with_capacity(chosen.len());
        for (i, at) in chosen.iter().enumerate() {
            let known = |c: usize| (0..i).map(|k| l[i * chosen.len() + k] * y[k][c]).sum::<f64>();
            let next = [0, 1, 2].map(|c| (self.white[*at][c] - known(c)) / l[i * chosen.len() + i]);
            y.push(next);
        }
        // Green carries most of the lightness.
        y.iter().map(|y| y[0] * y[0] + 2.0 * y[1] * y[1] + y[2] * y[2]).sum()
    }

    /// The best of some evenly spread choices: even in wavenumber, in which fringes are even.
    fn start(&self, candidates: &[f64], count: usize) -> Vec<usize> {
        let spread = |low: f64, high: f64| {
            let nm = |k: usize| {
                let t = k as f64 / (count - 1).max(1) as f64;
                1.0 / (t / high + (1.0 - t) / low)
            };
            let nearest = |nm: f64| ((nm - candidates[0]) / (candidates[1] - candidates[0])).round() as usize;
            let mut chosen: Vec<usize> = (0..count).map(|k| nearest(nm(k)).min(candidates.len() - 1)).collect();
            // Many wavelengths stand closer than the candidates at the short end.
            for k in 1..count {
                chosen[k] = chosen[k].max(chosen[k - 1] + 1);
            }
            chosen.retain(|at| *at < candidates.len());
            chosen
        };
        let ends = [392.0, 400.0, 410.0, 420.0]
            .into_iter()
            .flat_map(|low| [640.0, 660.0, 680.0, 700.0].map(|high| (low, high)));
        let starts = ends.map(|(low, high)| spread(low, high));
        let best = starts.map(|start| (self.explained(&start), start)).max_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, start)| start).unwrap_or_default()
    }

    /// Moves single wavelengths for as long as that helps.
    fn exchanged(&self, mut chosen: Vec<usize>) -> Vec<usize> {
        let mut best = self.explained(&chosen);
        for step in [4_isize, 2, 1] {
            for _ in 0..6 {
                let before = best;
                for k in 0..chosen.len() {
                    for move_by in [-step, step] {
                        let Some(at) = chosen[k].checked_add_signed(move_by).filter(|at| *at < self.size) else {
                            continue;
                        };
                        if chosen.contains(&at) {
                            continue;
                        }
                        let mut other = chosen.clone();
                        other[k] = at;
                        let explained = self.explained(&other);
                        if explained > best {
                            (best, chosen) = (explained, other);
                        }
                    }
                }
                if best == before {
                    break;
                }
            }
        }
        chosen.sort_unstable();
        chosen
    }

    /// The weights of the chosen candidates for each target.
    fn solve(&self, chosen: &[usize]) -> Vec<[f64; TARGETS]> {
        let (l, count) = (self.factor(chosen), chosen.len());
        let mut x: Vec<[f64; TARGETS]> = chosen.iter().map(|at| self.mixed[*at]).collect();
        for i in 0..count {
            let known = |t: usize| -> f64 { (0..i).map(|k| l[i * count + k] * x[k][t]).sum() };
            x[i] = std::array::from_fn(|t| (x[i][t] - known(t)) / l[i * count + i]);
        }
        for i in (0..count).rev() {
            let known = |t: usize| -> f64 { (i + 1..count).map(|k| l[k * count + i] * x[k][t]).sum() };
            x[i] = std::array::from_fn(|t| (x[i][t] - known(t)) / l[i * count + i]);
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        colour::{Walls, m2_delta_e},
        optics::FilmIndex,
    };

    fn optics(light: &str) -> FilmOptics {
        FilmOptics::new(FilmIndex::Water, &light.parse().expect("built in"))
    }

    /// Largest and mean error of the quadrature at films that the fit did not see, cos θ ≥ 0.26.
    fn errors(light: &str, count: usize, range_nm: f64, two_walls: bool) -> [f64; 2] {
        let optics = optics(light);
        let fitted = fit_quadrature(&optics, QuadratureTask::Everything, count, range_nm);
        let part = |k: u32, step: f64| (0.1 + step * f64::from(k)).fract();
        let error = |k: u32| {
            let cos_theta = (0.0676 + 0.9324 * part(k, 0.618_033_988_7)).sqrt();
            let [front_nm, back_nm, exit_nm] =
                [0.414_213_6, 0.732_050_8, 0.236_068].map(|step| range_nm * part(k, step));
            let wavelength = Walls::One { thickness_nm: front_nm };
            let walls = if two_walls { Walls::Two { front_nm, back_nm, exit_nm } } else { wavelength };
            let seen = |wavelength: &QuadratureWavelength| {
                let wall = optics.film().wall(wavelength.index, cos_theta, wavelength.wavelength_nm);
                wavelength.response * DVec3::splat(walls.reflectance(&wall))
            };
            let sum = BT2020.to_xyz() * fitted.iter().map(seen).sum::<DVec3>();
            let truth = optics.xyz(cos_theta, walls);
            m2_delta_e(sum, truth, optics.film(), cos_theta, walls.count(), optics.weights().white())
        };
        let errors: Vec<f64> = (0..2000).map(error).collect();
        [errors.iter().copied().fold(0.0, f64::max), errors.iter().sum::<f64>() / 2000.0]
    }

    #[test]
    fn thirty_two_wavelengths_stand_for_the_spectrum() {
        for (light, two_walls) in [("D65", false), ("D65", true), ("FL11", true)] {
            let [max, mean] = errors(light, 32, 1500.0, two_walls);
            eprintln!("measured: 32 wavelengths, {light}, two walls {two_walls}: max {max:.4}, mean {mean:.5}");
            assert!(max <= 0.12 && mean <= 0.012, "{light} {two_walls}: {max} {mean}");
        }
    }

    #[test]
    fn more_wavelengths_are_better() {
        let [few, more] = [8, 16].map(|count| errors("D65", count, 1500.0, true)[1]);
        assert!(more < 0.3 * few, "{few} {more}");
    }

    #[test]
    fn the_two_lines_of_sodium_are_summed_as_they_are() {
        let fitted = fit_quadrature(&optics("sodium"), QuadratureTask::Everything, 32, 1500.0);
        assert_eq!(fitted.iter().map(|wavelength| wavelength.wavelength_nm).collect::<Vec<_>>(), [588.995, 589.592]);
        assert!(errors("sodium", 32, 1500.0, true)[0] < 1e-9);
    }

    #[test]
    fn responses_of_white_light_add_up_to_the_white() {
        let optics = optics("A");
        let white: DVec3 = responses(optics.weights()).iter().map(|response| *response * DVec3::ONE).sum();
        assert!((white - BT2020.from_xyz() * optics.weights().white()).abs().max_element() < 1e-12, "{white}");
    }
}
