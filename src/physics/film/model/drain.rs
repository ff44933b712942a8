//! What leaves a film at its rim: the twin of `shaders/pass/drain.wgsl`.
//!
//! Between surfaces that do not move liquid runs down a film with the flux c h³ G_t, where c = ρ/12μ and G_t is the part of gravity over the
//! radius along the film. Along the characteristics `dx/dt = 3 c h² G_t`
//!
//! ```text
//! ∂h/∂t + ∇·(c h³ G_t) = 0     ⇒     dh/dt = 2 c h³ G·n                                              (D1)
//! ```
//!
//! which is followed back for the ticks since the last remap, by the midpoint of the way. Black film does not drain, and neither does what
//! is in the drop. Thin patches take the place of film at a rim (see [`Regeneration`](super::super::Regeneration)): with w a patch's thickness over
//! the thickness of the film around and s a smooth step from its middle outwards
//!
//! ```text
//! h ← h Π (1 − s (1 − w))                                                                            (D2)
//! ```

use glam::DVec3;

use crate::physics::sphere::{Cap, PaddedField};

/// Patches from its rim that a film takes in one step at most.
pub const MAX_RIM_PATCHES: usize = 64;
/// The longest time between two remaps of a film that regenerates, s: patches are seen when they have risen by a part of their size.
pub const REGENERATION_S: f64 = 0.1;
/// Angle from the lowest point of a film within which what drains is in the drop, where nothing else says how large that is, radians: 5°.
pub const DROP_RAD: f64 = 0.0873;

/// The maximum number of ticks between two remaps of a film that drains, or regenerates, and that other reasons remap after `remap_ticks`.
#[must_use]
pub fn latest_ticks(regenerates: bool, remap_ticks: u32, tick_s: f64) -> f64 {
    let max_ticks = if regenerates { REGENERATION_S / tick_s } else { f64::from(remap_ticks) };
    max_ticks.max(1.0)
}

/// How film leaves at its rim, now.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrainLaw {
    /// Gravity over the radius, 1/s².
    pub gravity: DVec3,
    /// Times it and the cube of a thickness in nm, the flux of drainage in a tick, nm rad.
    pub flux: f64,
    /// What has evaporated, nm.
    pub evaporated_nm: f64,
    /// Thickness of black film, nm.
    pub black_nm: f64,
    /// Angle from the lowest point within which what drains is in the drop, radians; 0 where film drains over a rim.
    pub drop_rad: f64,
    /// Radius of a patch, radians.
    pub patch_radius: f64,
    /// Patches of the last ticks: middle, thickness over that around, and ticks since they left.
    pub patches: Vec<(DVec3, f64, u32)>,
}

/// A film before it drains.
struct Draining<'a> {
    law: &'a DrainLaw,
    tracer: &'a PaddedField<f64>,
    /// What the tracer departs from, less what has evaporated, nm.
    level_nm: f64,
    /// Ticks since the last remap.
    ticks: u32,
}

/// A tracer, which departs from a level in nm, after film has left it for some ticks: (D1) and (D2). Lookups are by 4 × 4 cells, and within the
/// range of the four around.
#[must_use]
pub fn drain(
    tracer: &PaddedField<f64>,
    law: &DrainLaw,
    level_nm: f64,
    ticks: u32,
    cap: Option<Cap>,
) -> PaddedField<f64> {
    let film = Draining { law, tracer, level_nm: level_nm - law.evaporated_nm, ticks };
    let grid = tracer.grid();
    PaddedField::from_places(grid, 0, |place| {
        let x = grid.padded_direction(place);
        match cap.filter(|cap| !cap.contains(x)) {
            None => film.after(x, tracer.padded()[place]),
            Some(cap) => film.after(cap.image(x), tracer.bicubic_limited(cap.image(x))),
        }
    })
}

impl Draining<'_> {
    /// The departure at unit vector `x` afterwards, where it is so much now.
    fn after(&self, x: DVec3, departure: f64) -> f64 {
        let gained = self.gained_nm(x, departure);
        let nm = departure + self.level_nm + gained;
        // No patch is thinner than black film.
        let lost = (nm * (1.0 - self.left_by_patches(x))).min((nm - self.law.black_nm).max(0.0));
        departure + (gained - lost)
    }

    /// What a place gains by drainage (D1), nm.
    fn gained_nm(&self, x: DVec3, departure: f64) -> f64 {
        let DrainLaw { gravity, flux, black_nm, drop_rad, .. } = *self.law;
        let nm = departure + self.level_nm;
        let in_drop = drop_rad > 0.0 && gravity.dot(x) > drop_rad.cos() * gravity.length();
        if flux == 0.0 || nm <= black_nm || in_drop {
            return 0.0;
        }
        let rate = flux * f64::from(self.ticks);
        let along = gravity - gravity.dot(x) * x;
        // The middle of the way, for the second order.
        let half_way = (x - 1.5 * rate * nm * nm * along).normalize();
        let middle = (self.tracer.bicubic_limited(half_way) + self.level_nm).max(black_nm);
        let origin = (x - 3.0 * rate * middle * middle * along).normalize();
        let carried = self.tracer.bicubic_limited(origin) - departure;
        (carried + 2.0 * rate * middle.powi(3) * gravity.dot(half_way)).max(black_nm - nm)
    }

    /// What patches that left since the last remap leave of the thickness (D2).
    fn left_by_patches(&self, x: DVec3) -> f64 {
        let new = self.law.patches.iter().take(MAX_RIM_PATCHES).filter(|(.., age)| *age < self.ticks);
        let left = new.map(|(middle, thickness, _)| {
            let t = ((x.distance(*middle) / self.law.patch_radius - 0.7) / 0.6).clamp(0.0, 1.0);
            let inside = 1.0 - t * t * (3.0 - 2.0 * t);
            1.0 - inside * (1.0 - thickness)
        });
        left.product()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{
        film::properties::{DENSITY, Drainage, GRAVITY, VISCOSITY},
        sphere::CubedSphere,
    };

    const RADIUS_M: f64 = 0.05;

    fn even() -> PaddedField<f64> {
        PaddedField::sample(CubedSphere::new(24).unwrap(), |_| 0.0)
    }

    #[test]
    fn an_even_film_drains_as_the_closed_form_has_it() {
        let (nm, tick_s) = (2000.0, 5.0);
        let law = DrainLaw {
            gravity: DVec3::NEG_Z * GRAVITY / RADIUS_M,
            flux: 1e-18 * DENSITY / (12.0 * VISCOSITY) * tick_s,
            black_nm: 10.0,
            patch_radius: 1.0,
            ..DrainLaw::default()
        };
        let drained = (0..100).fold(even(), |film, _| drain(&film, &law, nm, 4, Some(Cap::HEMISPHERE)));
        let exact = Drainage { thickness_m: 1e-9 * nm, radius_m: RADIUS_M, viscosity: VISCOSITY };
        let grid = drained.grid();
        for (cell, departure) in drained.cells().into_iter().enumerate() {
            let z = grid.cell_direction(cell).z;
            if z > 0.05 {
                let expected = 1e9 * exact.thickness_m(z.acos(), 400.0 * tick_s);
                assert!(((nm + departure) / expected - 1.0).abs() < 5e-3, "{z}: {} {expected}", nm + departure);
            }
        }
    }

    #[test]
    fn patches_thin_what_they_cover_once_and_no_film_below_black() {
        let middle = DVec3::X;
        let law = DrainLaw {
            patch_radius: 0.3,
            patches: vec![(middle, 0.8, 3), (middle, 0.5, 9)],
            black_nm: 10.0,
            ..DrainLaw::default()
        };
        let left = |ticks, level_nm: f64| level_nm + drain(&even(), &law, level_nm, ticks, None).bicubic(middle);
        assert!((left(3, 500.0) - 500.0).abs() < 1e-9, "both left before the last remap");
        assert!((left(4, 500.0) - 400.0).abs() < 1e-9 && (left(10, 500.0) - 200.0).abs() < 1e-9);
        assert!((left(10, 12.0) - 10.0).abs() < 1e-9 && (left(10, 8.0) - 8.0).abs() < 1e-9);
    }

    #[test]
    fn nothing_drains_out_of_the_drop_or_without_a_flux() {
        let law = DrainLaw {
            gravity: 100.0 * DVec3::NEG_Z,
            drop_rad: 0.5,
            black_nm: 10.0,
            patch_radius: 1.0,
            ..DrainLaw::default()
        };
        assert_eq!(drain(&even(), &law, 700.0, 5, None), even());
        let drains = drain(&even(), &DrainLaw { flux: 1e-12, ..law }, 700.0, 5, None);
        assert_eq!(drains.bilinear(DVec3::NEG_Z), 0.0);
        assert!(drains.bilinear(DVec3::Z) < 0.0 && drains.bilinear(DVec3::new(0.8, 0.0, -0.6)) > 0.0);
    }
}
