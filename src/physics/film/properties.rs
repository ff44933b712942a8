//! What a soap film is made of, and what follows: viscosity, drag, evaporation, drainage, black film, and how it bursts.
//! All in SI units; h is the total thickness.

use std::f64::consts::FRAC_PI_2;

/// Density of the liquid, kg/m³: water's, which soap hardly changes.
pub const DENSITY: f64 = 1000.0;
/// Surface tension of soapy water, N/m (pure water has 0.0728).
pub const SURFACE_TENSION: f64 = 0.025;
/// Dynamic viscosity of soapy water at 20 °C, Pa s; with glycerol up to 0.12.
pub const VISCOSITY: f64 = 1.1e-3;
/// Surface shear viscosity of a mobile surfactant layer, Pa s m; layers in use have 1e-8 to 1e-5.
pub const SURFACE_VISCOSITY: f64 = 3e-8;
/// Density of air at 25 °C, kg/m³.
pub const AIR_DENSITY: f64 = 1.184;
/// Kinematic viscosity of air at 25 °C, m²/s.
pub const AIR_VISCOSITY: f64 = 1.562e-5;
/// Standard gravity, m/s².
pub const GRAVITY: f64 = 9.80665;
/// Diffusivity of water vapour in air at 20 °C, m²/s.
pub const VAPOUR_DIFFUSIVITY: f64 = 2.5e-5;
/// Density of saturated water vapour at 20 °C, kg/m³.
pub const SATURATED_VAPOUR: f64 = 0.0173;
/// Thickness of black film in nm, at which evaporation ends. Common black films are 10 to 30 nm thick, where the repulsion of the charged surfaces
/// meets van der Waals' attraction and the suction of the rim (Israelachvili 2011, "Intermolecular and Surface Forces").
pub const BLACK_FILM_NM: f64 = 10.0;
/// Thickness below which two surfaces that only attract each other collapse to black film, m (40 to 60 nm).
pub const BLACK_FILM_ONSET: f64 = 50e-9;
/// Rate at which film thinner than that collapses, 1/s. In real films black spots spread by suction at their rim, within a fraction of a
/// second to seconds; this is a choice, for the collapse itself is faster than pictures and finer than cells.
pub const BLACK_FILM_COLLAPSE: f64 = 10.0;

/// Kinematic viscosity of a film as a two-dimensional fluid, m²/s: `μ/ρ + 2 μ_s/(ρ h)`, of the liquid and of the two surfaces
/// (Trapeznikov 1957; Couder, Chomaz & Rabaud 1989, Physica D 37). `viscosity` in Pa s, `surface_viscosity` in Pa s m.
#[must_use]
pub fn kinematic_viscosity(viscosity: f64, surface_viscosity: f64, thickness_m: f64) -> f64 {
    (viscosity + 2.0 * surface_viscosity / thickness_m) / DENSITY
}

/// Rate α at which the air slows a film down, 1/s: the friction of a laminar boundary layer of the length R at speed U on each side,
/// `ρ_a √(ν_a U/R) / (ρ h/2)`. `speed_m_s` is the film's against the air.
#[must_use]
pub fn air_drag(thickness_m: f64, speed_m_s: f64, radius_m: f64) -> f64 {
    AIR_DENSITY * (AIR_VISCOSITY * speed_m_s.abs() / radius_m).sqrt() / (0.5 * DENSITY * thickness_m)
}

/// How fast a bubble's film loses thickness by evaporation, m/s, from its outer side (inside the air is saturated): diffusion around a
/// sphere in air of relative humidity 0 to 1, quickened by air that streams past it (Ranz & Marshall 1952: Sh = 2 + 0.6 Re^½ Sc^⅓).
#[must_use]
pub fn evaporation_rate(humidity: f64, radius_m: f64, air_speed_m_s: f64) -> f64 {
    let reynolds = 2.0 * radius_m * air_speed_m_s.abs() / AIR_VISCOSITY;
    let schmidt = AIR_VISCOSITY / VAPOUR_DIFFUSIVITY;
    let sherwood = 2.0 + 0.6 * reynolds.sqrt() * schmidt.cbrt();
    let missing = SATURATED_VAPOUR * (1.0 - humidity.clamp(0.0, 1.0));
    0.5 * sherwood * VAPOUR_DIFFUSIVITY * missing / (DENSITY * radius_m)
}

/// Speed of the rim of a hole, m/s: `√(2γ/(ρ h))` (Taylor 1959, Culick 1960).
#[must_use]
pub fn taylor_culick_speed(surface_tension: f64, thickness_m: f64) -> f64 {
    (2.0 * surface_tension / (DENSITY * thickness_m)).sqrt()
}

/// Liquid that drains down a film between immobile surfaces, m²/s a unit of width: `ρ g h³ sin ϑ / (12 μ)`, ϑ the angle from the top.
#[must_use]
pub fn drainage_flux(thickness_m: f64, colatitude: f64, viscosity: f64) -> f64 {
    DENSITY * GRAVITY * thickness_m.powi(3) * colatitude.sin() / (12.0 * viscosity)
}

/// A bubble that drains by [`drainage_flux`] alone from one thickness everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drainage {
    /// Thickness at the start, m.
    pub thickness_m: f64,
    /// Radius of the bubble, m.
    pub radius_m: f64,
    /// Dynamic viscosity, Pa s.
    pub viscosity: f64,
}

impl Drainage {
    /// ρ g h₀² / (4 μ R): how fast the pattern runs down the equator at first, rad/s.
    fn rate(&self) -> f64 {
        DENSITY * GRAVITY * self.thickness_m.powi(2) / (4.0 * self.viscosity * self.radius_m)
    }

    /// Thickness at the top, m: `h₀ / √(1 + ρ g h₀² t / (3 μ R))`.
    #[must_use]
    pub fn apex_m(&self, time_s: f64) -> f64 {
        self.thickness_m / (1.0 + 4.0 / 3.0 * self.rate() * time_s).sqrt()
    }

    /// Thickness in the upper half, colatitude 0 to π/2, m. Along characteristics `h sin^⅔ ϑ` stays and ϑ grows at
    /// `(ρ g h²/4μR) sin ϑ`, so that one from ϑ₀ is at ϑ when `∫ sin^⅓ dϑ = (ρ g h₀²/4μR) sin^{4/3} ϑ₀ t`.
    #[must_use]
    pub fn thickness_m(&self, colatitude: f64, time_s: f64) -> f64 {
        let end = colatitude.clamp(0.0, FRAC_PI_2);
        if end < 1e-6 {
            return self.apex_m(time_s);
        }
        let travelled = self.rate() * time_s;
        let arrives_beyond = |start: f64| travelled * start.sin().powf(4.0 / 3.0) > sine_root_integral(start, end);
        let start = bisect(0.0, end, arrives_beyond);
        self.thickness_m * (start.sin() / end.sin()).powf(2.0 / 3.0)
    }
}

/// ∫ sin^⅓ ϑ dϑ between two colatitudes, by Simpson's rule in s = ϑ^{4/3}, in which the integrand is smooth.
fn sine_root_integral(from: f64, to: f64) -> f64 {
    const PARTS: u32 = 64;
    let [a, b] = [from, to].map(|angle| angle.powf(4.0 / 3.0));
    let integrand = |s: f64| {
        let angle = s.powf(0.75);
        0.75 * if angle > 0.0 { (angle.sin() / angle).cbrt() } else { 1.0 }
    };
    let weight = |k: u32| if k == 0 || k == PARTS { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    let step = (b - a) / f64::from(PARTS);
    (0..=PARTS).map(|k| weight(k) * integrand(a + f64::from(k) * step)).sum::<f64>() * step / 3.0
}

/// Where a condition that fails at `low` begins to hold.
fn bisect(low: f64, high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let halve = |(low, high): (f64, f64), _| {
        let middle = 0.5 * (low + high);
        if holds(middle) { (low, middle) } else { (middle, high) }
    };
    (0..60).fold((low, high), halve).1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn viscosity_of_films_is_that_of_their_surfaces() {
        let thin = kinematic_viscosity(VISCOSITY, SURFACE_VISCOSITY, 1e-6);
        assert!((thin - 6.11e-5).abs() < 1e-8, "{thin:e}");
        // Real films: 2e-5 to 2e-3 m²/s.
        for surface in [1e-8, 1e-6] {
            assert!((2e-5..=2.1e-3).contains(&kinematic_viscosity(VISCOSITY, surface, 1e-6)));
        }
        assert!((kinematic_viscosity(VISCOSITY, SURFACE_VISCOSITY, 1.0) / 1.1e-6 - 1.0).abs() < 1e-4, "bulk alone");
    }

    #[test]
    fn air_nearly_stops_the_slosh_of_a_thin_film() {
        assert!((air_drag(1e-6, 0.1, 0.05) - 13.2).abs() < 0.1);
        assert_eq!(air_drag(1e-6, 0.0, 0.05), 0.0);
        assert!((air_drag(5e-7, 0.1, 0.05) / air_drag(1e-6, 0.1, 0.05) - 2.0).abs() < 1e-12, "as 1/h");
    }

    #[test]
    fn evaporation_is_slow_in_still_air_and_fast_in_a_draught() {
        let rate = |speed| 1e9 * evaporation_rate(0.5, 0.05, speed);
        assert!((rate(0.0) - 4.3).abs() < 0.1, "{} nm/s", rate(0.0));
        assert!(rate(0.1) > 30.0 && rate(0.3) < 55.0, "{} to {} nm/s", rate(0.1), rate(0.3));
        assert_eq!(evaporation_rate(1.0, 0.05, 0.2), 0.0);
        assert_eq!(evaporation_rate(7.0, 0.05, 0.2), 0.0, "no more than saturated");
    }

    #[test]
    fn holes_open_at_metres_a_second() {
        assert!((taylor_culick_speed(SURFACE_TENSION, 1e-6) - 7.07).abs() < 0.01);
        assert!((taylor_culick_speed(SURFACE_TENSION, 1e-7) - 22.4).abs() < 0.1);
    }

    #[test]
    fn drainage_obeys_its_conservation_law() {
        let film = Drainage { thickness_m: 2e-6, radius_m: 0.05, viscosity: VISCOSITY };
        let (theta, time, d) = (0.8, 3000.0, 1e-4);
        let h = |theta: f64, time: f64| film.thickness_m(theta, time);
        let by_time = (h(theta, time * (1.0 + d)) - h(theta, time * (1.0 - d))) / (2.0 * d * time);
        let flux = |theta: f64| drainage_flux(h(theta, time), theta, VISCOSITY) * theta.sin();
        let by_place = (flux(theta + d) - flux(theta - d)) / (2.0 * d * film.radius_m * theta.sin());
        assert!((by_time / -by_place - 1.0).abs() < 1e-4, "{by_time:e} {by_place:e}");
    }

    #[test]
    fn drainage_starts_even_and_joins_the_apex() {
        let film = Drainage { thickness_m: 1e-6, radius_m: 0.05, viscosity: VISCOSITY };
        for theta in [0.0, 0.01, 0.7, FRAC_PI_2] {
            assert!((film.thickness_m(theta, 0.0) / 1e-6 - 1.0).abs() < 1e-9);
        }
        let near = film.thickness_m(1e-3, 2e4);
        assert!((near / film.apex_m(2e4) - 1.0).abs() < 1e-5, "{near:e} {:e}", film.apex_m(2e4));
        assert!(film.thickness_m(0.5, 2e4) > near, "thicker below");
    }
}
