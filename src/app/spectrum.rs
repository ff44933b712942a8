//! Editing the spectrum of the light: points from a light that has a name, bands, and what becomes of points that are moved, added and removed.

use crate::{
    physics::{
        colour::Illuminant,
        spectra::{FIRST_NM, LAST_NM, SAMPLES, wavelength_nm},
    },
    scene::{LightSpectrum, MAX_SPECTRUM_POINTS},
};

/// The most points that a light with a name becomes: enough for the bands of a fluorescent lamp, and few enough to take hold of.
const MAX_RESAMPLED: usize = 30;
/// Distance of the points of a smooth light, nm: 13 of them.
const EVEN_NM: usize = 35;
/// Error at which no more points are needed, as a part of the largest power.
const FINE: f64 = 0.005;
/// Least distance of two points, nm: spectra are read every nanometre.
const APART_NM: f64 = 1.0;
/// Half of the width of the triangle that stands for a spectral line, nm: its area is the line's power.
const LINE_NM: f64 = 2.0;

/// What of a spectrum is under way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Editor {
    /// What takes the place of the scene's own while a point is dragged and until it is loaded.
    pub draft: Option<Option<LightSpectrum>>,
    /// The point that the pointer holds, and the power at the top of the plot meanwhile.
    pub held: Option<(usize, f64)>,
    /// The band that is set next.
    pub band: Band,
}

/// Light of a single band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The wavelength of its peak, nm.
    pub center_nm: f64,
    /// Its full width at half of the peak, nm.
    pub width_nm: f64,
}

impl Default for Band {
    fn default() -> Self {
        Self { center_nm: 550.0, width_nm: 30.0 }
    }
}

impl Band {
    /// Peaks that bands may have, nm: light of each of them is seen.
    pub const CENTERS_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;
    /// Widths that bands may have, nm.
    pub const WIDTHS_NM: std::ops::RangeInclusive<f64> = 2.0..=200.0;

    /// The band as a triangle, cut where the spectra of the program end.
    #[must_use]
    pub fn spectrum(&self) -> LightSpectrum {
        let Self { center_nm, width_nm } = *self;
        let foot = |nm: f64| {
            let nm = nm.clamp(FIRST_NM, LAST_NM);
            (nm, rounded(1.0 - (nm - center_nm).abs() / width_nm, 1.0))
        };
        of_points([foot(center_nm - width_nm), (center_nm, 1.0), foot(center_nm + width_nm)])
    }
}

fn of_points(points: impl IntoIterator<Item = (f64, f64)>) -> LightSpectrum {
    let (wavelengths_nm, power) = points.into_iter().unzip();
    LightSpectrum { wavelengths_nm, power }
}

/// A power to a ten-thousandth or less of the largest one: a saved scene shows short numbers.
fn rounded(power: f64, largest: f64) -> f64 {
    let per_unit = 10f64.powi(4 - (largest.max(f64::MIN_POSITIVE).log10().ceil() as i32).clamp(-12, 12));
    (power * per_unit).round() / per_unit
}

/// The power of a light at each wavelength of the grid, its lines as narrow triangles.
#[must_use]
pub fn sampled(light: &Illuminant) -> Vec<f64> {
    let line = |nm: f64| {
        let at = |distance: f64| (1.0 - distance.abs() / LINE_NM).max(0.0) / LINE_NM;
        light.lines().iter().map(|line| line.power * at(nm - line.wavelength_nm)).sum::<f64>()
    };
    (0..SAMPLES).map(|i| light.spectrum().at(i) + line(wavelength_nm(i))).collect()
}

/// A light as 13 to 30 points: the next one stands where those before are the farthest from the light. Where few are enough, there are even ones too.
#[must_use]
pub fn resampled(light: &Illuminant) -> LightSpectrum {
    let powers = sampled(light);
    let largest = powers.iter().copied().fold(0.0, f64::max);
    let mut kept = vec![0, SAMPLES - 1];
    while kept.len() < MAX_RESAMPLED {
        let errors = kept.windows(2).flat_map(|pair| errors_between(&powers, pair[0], pair[1]));
        let Some((error, at)) = errors.max_by(|a, b| a.0.total_cmp(&b.0)) else { break };
        if error <= FINE * largest {
            break;
        }
        kept.insert(kept.partition_point(|known| *known < at), at);
    }
    let even = (0..SAMPLES).step_by(EVEN_NM);
    if kept.len() < even.len() {
        kept.extend(even);
        kept.sort_unstable();
        kept.dedup();
    }
    of_points(kept.into_iter().map(|i| (wavelength_nm(i), rounded(powers[i], largest))))
}

/// How far each sample between two is from the straight line through these.
fn errors_between(powers: &[f64], first: usize, last: usize) -> impl Iterator<Item = (f64, usize)> {
    (first + 1..last).map(move |i| {
        let part = (i - first) as f64 / (last - first) as f64;
        let line = powers[first] + part * (powers[last] - powers[first]);
        ((powers[i] - line).abs(), i)
    })
}

/// The largest power of the points.
#[must_use]
pub fn largest(spectrum: &LightSpectrum) -> f64 {
    spectrum.power.iter().copied().fold(0.0, f64::max)
}

/// Wavelengths that a point may have between its neighbours, nm.
#[must_use]
pub fn room_nm(spectrum: &LightSpectrum, index: usize) -> std::ops::RangeInclusive<f64> {
    let known = &spectrum.wavelengths_nm;
    let low = index.checked_sub(1).map_or(FIRST_NM, |left| known[left] + APART_NM);
    let high = known.get(index + 1).map_or(LAST_NM, |right| right - APART_NM);
    // Points of a file may be nearer to one another; then they keep their places.
    if low <= high { low..=high } else { known[index]..=known[index] }
}

/// Moves a point as far as its neighbours let it; `largest` is the power that its number is rounded for.
pub fn put(spectrum: &mut LightSpectrum, index: usize, (nm, power): (f64, f64), largest: f64) {
    let room = room_nm(spectrum, index);
    spectrum.wavelengths_nm[index] = ((nm * 10.0).round() / 10.0).clamp(*room.start(), *room.end());
    spectrum.power[index] = rounded(power.max(0.0), largest);
}

/// Adds a point; returns whether there was room for it.
pub fn add(spectrum: &mut LightSpectrum, (nm, power): (f64, f64)) -> bool {
    let nm = (nm * 10.0).round() / 10.0;
    let index = spectrum.wavelengths_nm.partition_point(|known| *known < nm);
    let is_free = spectrum.wavelengths_nm.iter().all(|known| (known - nm).abs() >= APART_NM);
    let has_room = is_free && (FIRST_NM..=LAST_NM).contains(&nm) && spectrum.power.len() < MAX_SPECTRUM_POINTS;
    if has_room {
        spectrum.wavelengths_nm.insert(index, nm);
        spectrum.power.insert(index, rounded(power.max(0.0), largest(spectrum)));
    }
    has_room
}

/// Adds a point in the middle of the widest gap, on the line there; returns whether there was room for it.
pub fn add_in_gap(spectrum: &mut LightSpectrum) -> bool {
    let points: Vec<_> = spectrum.points().collect();
    let widest = points.windows(2).max_by(|a, b| (a[1].0 - a[0].0).total_cmp(&(b[1].0 - b[0].0)));
    let Some([(left, low), (right, high)]) = widest else { return false };
    add(spectrum, (0.5 * (left + right), 0.5 * (low + high)))
}

/// Removes a point; two must be left. Returns whether it was removed.
pub fn remove(spectrum: &mut LightSpectrum, index: usize) -> bool {
    let can_go = spectrum.power.len() > 2 && index < spectrum.power.len();
    if can_go {
        spectrum.wavelengths_nm.remove(index);
        spectrum.power.remove(index);
    }
    can_go
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        physics::colour::{BUILT_IN, ColourWeights, ciede2000, xyz_to_lab},
        scene::{Light, Scene},
    };

    fn is_valid(spectrum: &LightSpectrum) -> bool {
        let light = Light { spectrum: Some(spectrum.clone()), ..Light::default() };
        let scene = Scene { light, ..Scene::default() };
        scene.validate().is_ok() && spectrum.illuminant().is_ok()
    }

    /// Points of a light show nearly its white. Of a fluorescent lamp's bands every one is found.
    #[test]
    fn points_of_a_light_have_its_colour() {
        for built_in in BUILT_IN {
            let light = Illuminant::from(built_in);
            let points = resampled(&light);
            assert!(is_valid(&points) && points.power.len() <= MAX_RESAMPLED, "{}", built_in.name);
            let white = |light: &Illuminant| ColourWeights::new(light).white();
            let seen = white(&points.illuminant().expect("seen"));
            let by_e = xyz_to_lab(seen, glam::DVec3::ONE);
            let delta_e = ciede2000(by_e, xyz_to_lab(white(&light), glam::DVec3::ONE));
            eprintln!("measured: {}: {} points, CIEDE2000 {delta_e:.3}", built_in.name, points.power.len());
            // A difference that is hardly seen.
            assert!(delta_e < 1.0, "{}: {delta_e}", built_in.name);
        }
        assert_eq!(resampled(&"E".parse().expect("built in")).power, [1.0; 13]);
    }

    #[test]
    fn a_band_has_its_width_and_is_seen() {
        for center_nm in [400.0, 550.0, 700.0] {
            for width_nm in [2.0, 30.0, 200.0] {
                let band = Band { center_nm, width_nm }.spectrum();
                assert!(is_valid(&band), "{center_nm} {width_nm}");
                let at = |nm: f64| band.illuminant().expect("seen").spectrum().at_nm(nm);
                assert!((at(center_nm) - 1.0).abs() < 1e-9);
                // On the side that is not cut.
                let half_nm = 0.5 * width_nm * if center_nm < 600.0 { 1.0 } else { -1.0 };
                assert!((at(center_nm + half_nm) - 0.5).abs() < 1e-3, "{center_nm} {width_nm}");
            }
        }
    }

    #[test]
    fn points_keep_their_order_whatever_is_done() {
        let mut points = of_points([(400.0, 1.0), (500.0, 2.0), (600.0, 3.0)]);
        put(&mut points, 1, (900.0, -7.0), 3.0);
        assert_eq!((points.wavelengths_nm[1], points.power[1]), (599.0, 0.0));
        put(&mut points, 1, (0.0, 1.234_567), 3.0);
        assert_eq!((points.wavelengths_nm[1], points.power[1]), (401.0, 1.235));
        assert!(add(&mut points, (450.04, 2.0)) && !add(&mut points, (450.5, 2.0)) && !add(&mut points, (350.0, 1.0)));
        assert_eq!(points.wavelengths_nm, [400.0, 401.0, 450.0, 600.0]);
        assert!(add_in_gap(&mut points));
        assert_eq!(points.points().nth(3), Some((525.0, 2.5)));
        assert!(remove(&mut points, 0) && !remove(&mut points, 9) && is_valid(&points));
        (0..9).for_each(|_| _ = remove(&mut points, 0));
        assert_eq!(points.power.len(), 2);
    }

    #[test]
    fn the_widest_gap_fills_until_there_is_no_room() {
        let mut points = of_points([(500.0, 1.0), (504.0, 1.0)]);
        let added = (0..100).filter(|_| add_in_gap(&mut points)).count();
        assert_eq!((added, is_valid(&points)), (3, true));
    }
}
