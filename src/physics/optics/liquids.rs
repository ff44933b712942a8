//! Refractive indices of water and of glycerol in water, from published fits. Wavelengths are in vacuum.

/// Strengths A of the four Sellmeier terms of water at 20 °C.
const WATER_A: [f64; 4] = [0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688];
/// Resonances B of the four Sellmeier terms of water at 20 °C, µm².
const WATER_B: [f64; 4] = [5.101829712e-3, 1.821153936e-2, 2.620722293e-2, 10.69792721];

/// n of water at 20.0 °C: n² − 1 = Σ A λ² / (λ² − B), λ in µm; 182 to 1129 nm.
///
/// M. Daimon and A. Masumura, "Measurement of the refractive index of distilled water from the near-infrared region to the ultraviolet
/// region", Applied Optics 46, 3811 (2007). [`water_index_at`] agrees within 1.1e-5 over 360 to 780 nm.
pub fn water_index(wavelength_nm: f64) -> f64 {
    let lambda2 = (wavelength_nm * 1e-3).powi(2);
    let terms = WATER_A.iter().zip(WATER_B).map(|(a, b)| a * lambda2 / (lambda2 - b));
    (1.0 + terms.sum::<f64>()).sqrt()
}

/// n of water at atmospheric pressure, 0 to 40 °C: the Lorentz–Lorenz function of IAPWS R9-97, "Release on the Refractive Index of Ordinary
/// Water Substance as a Function of Wavelength, Temperature and Pressure" (1997), with its uncertainty of 1.5e-5 at 1 atm.
pub fn water_index_at(celsius: f64, wavelength_nm: f64) -> f64 {
    let temperature = (celsius + 273.15) / 273.15;
    let density = water_density(celsius) / 1000.0;
    let lambda2 = (wavelength_nm / 589.0).powi(2);
    let per_density = 0.244257733 + 9.74634476e-3 * density - 3.73234996e-3 * temperature
        + 2.68678472e-4 * lambda2 * temperature
        + 1.58920570e-3 / lambda2
        + 2.45934259e-3 / (lambda2 - 0.2292020_f64.powi(2))
        + 0.900704920 / (lambda2 - 5.432937_f64.powi(2))
        - 1.66626219e-2 * density * density;
    from_lorentz_lorenz(density * per_density)
}

/// Density of water at 1 atm in kg/m³, 0 to 40 °C and beyond: G. S. Kell, Journal of Chemical and Engineering Data 20, 97 (1975).
fn water_density(celsius: f64) -> f64 {
    const K: [f64; 6] = [999.83952, 16.945176, -7.9870401e-3, -46.170461e-6, 105.56302e-9, -280.54253e-12];
    let sum = K.iter().rev().fold(0.0, |sum, k| sum * celsius + k);
    sum / (1.0 + 16.879850e-3 * celsius)
}

/// Index of solutions of glycerol at 20 °C and 589.3 nm, relative to air, for each 10 per cent by mass from 0 to 100: Glycerine Producers'
/// Association, *Physical Properties of Glycerine and its Solutions* (1963).
const GLYCEROL_SOLUTIONS: [f64; 11] =
    [1.33303, 1.34481, 1.35749, 1.37070, 1.38413, 1.39809, 1.41299, 1.42789, 1.44290, 1.45839, 1.47399];
/// Wavelength of those indices, nm.
const SODIUM_NM: f64 = 589.3;
/// Index of air at 20 °C, relative to vacuum.
const AIR: f64 = 1.00027;

/// n of a solution of glycerol in water at 20 °C, `share` by mass from 0 to 1.
///
/// At the sodium line the measured index (linear between its lines, within 1e-4); the dispersion is composed of its parts, water after Daimon
/// and Masumura, glycerol after J. Rheims, J. Köser and T. Wriedt, Measurement Science and Technology 8, 601 (1997), in proportion to the
/// share.
pub fn glycerol_solution_index(share: f64, wavelength_nm: f64) -> f64 {
    let place = (share * 10.0).clamp(0.0, 10.0);
    let left = (place as usize).min(9);
    let measured =
        GLYCEROL_SOLUTIONS[left] + (place - left as f64) * (GLYCEROL_SOLUTIONS[left + 1] - GLYCEROL_SOLUTIONS[left]);
    let mixed = |nm: f64| share * glycerol_index(nm) + (1.0 - share) * water_index(nm);
    AIR * measured + mixed(wavelength_nm) - mixed(SODIUM_NM)
}

/// Rheims et al. 1997: Cauchy's formula, λ in µm.
fn glycerol_index(wavelength_nm: f64) -> f64 {
    let lambda2 = (wavelength_nm * 1e-3).powi(2);
    1.45797 + 0.00598 / lambda2 - 0.00036 / (lambda2 * lambda2)
}

fn from_lorentz_lorenz(l: f64) -> f64 {
    ((1.0 + 2.0 * l) / (1.0 - l)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn water_has_its_handbook_index_at_the_sodium_line() {
        // 1.33299 at 589.3 nm and 20 °C (CRC handbook) is relative to air, which has 1.00027; both are good to about 1e-5.
        assert!((water_index(589.3) - 1.33299 * 1.00027).abs() < 1e-5, "{}", water_index(589.3));
    }

    #[test]
    fn the_two_formulas_for_water_agree_at_20_degrees() {
        for nm in (360..=780).step_by(5).map(f64::from) {
            assert!((water_index(nm) - water_index_at(20.0, nm)).abs() < 1.1e-5, "{nm} nm");
        }
    }

    #[test]
    fn warm_water_bends_less() {
        // CRC handbook, relative to air: 1.33395 at 0 °C to 1.33061 at 40 °C.
        for (celsius, handbook) in [(0.0, 1.33395), (10.0, 1.33369), (30.0, 1.33192), (40.0, 1.33061)] {
            let n = water_index_at(celsius, 589.3) / 1.00027;
            assert!((n - handbook).abs() < 3e-5, "{celsius} °C: {n}");
        }
        assert!((water_density(4.0) - 999.973).abs() < 0.003 && (water_density(40.0) - 992.22).abs() < 0.01);
    }

    #[test]
    fn glycerol_solutions_lie_between_water_and_glycerol() {
        // The table's water is 3e-5 from the other measurement, its glycerol 2e-3 from Rheims's, which was drier or wetter.
        assert!((glycerol_solution_index(0.0, 589.3) - water_index(589.3)).abs() < 5e-5);
        assert!((glycerol_solution_index(1.0, 589.3) - glycerol_index(589.3)).abs() < 2.5e-3);
        // CRC handbook, relative to air: 24 % by mass has 1.3627.
        assert!((glycerol_solution_index(0.24, 589.3) / AIR - 1.3627).abs() < 3e-4);
        let rises = (0..100).all(|k| {
            let n = |k: u32| glycerol_solution_index(f64::from(k) * 0.01, 500.0);
            n(k + 1) > n(k)
        });
        assert!(rises);
    }

    #[test]
    fn blue_light_is_bent_more() {
        assert!(water_index(400.0) - water_index(700.0) > 0.01);
        assert!(glycerol_solution_index(0.5, 400.0) - glycerol_solution_index(0.5, 700.0) > 0.01);
    }
}
