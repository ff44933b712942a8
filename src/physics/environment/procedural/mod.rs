//! Environments made from formulas: what photographers of bubbles build or look for.

mod noise;
mod park;
mod photographer;
mod softbox;
mod studio;
mod tent;
mod windows;

use std::sync::{Arc, LazyLock};

use glam::DVec3;

use super::{CubeMap, Lamp, shape};
use crate::words::words;

words! {
    /// An environment that is built in.
    pub enum Procedural: "environment" {
        Tent = "tent", "A photographer's light tent: bright cloth all round, softboxes, a grey floor";
        Windows = "windows", "A dark room with bright windows: colours live in the windows' reflections";
        Park = "park", "A meadow among dark trees, broken clouds and a low sun: a bubble out of doors";
        Studio = "studio", "Two large softboxes and a strip light on black: a photographer's table";
    }
}

/// The maps of all built-in environments, each made at its first use.
static MAPS: [LazyLock<Arc<CubeMap>>; Procedural::ALL.len()] = [
    LazyLock::new(|| Procedural::Tent.made()),
    LazyLock::new(|| Procedural::Windows.made()),
    LazyLock::new(|| Procedural::Park.made()),
    LazyLock::new(|| Procedural::Studio.made()),
];

impl Procedural {
    /// Its cube map, made once for all that ask.
    #[must_use]
    pub fn map(self) -> Arc<CubeMap> {
        Arc::clone(&MAPS[self as usize])
    }

    fn made(self) -> Arc<CubeMap> {
        Arc::new(
            CubeMap::from_fn(self.cube_size(), self.supersampling(), |direction| self.radiance(direction))
                .with_lamps(self.lamps()),
        )
    }

    /// What is too small and too bright for texels.
    pub fn lamps(self) -> Vec<Lamp> {
        match self {
            Self::Park => vec![park::sun()],
            Self::Tent | Self::Windows | Self::Studio => Vec::new(),
        }
    }

    /// Texels along the edge of a cube map's face that show its finest detail.
    pub fn cube_size(self) -> usize {
        match self {
            Self::Tent => 256,
            Self::Windows | Self::Park | Self::Studio => 512,
        }
    }

    /// Samples along the edge of a texel of that map: one, where all edges are wider than texels.
    fn supersampling(self) -> usize {
        match self {
            Self::Tent => 2,
            Self::Windows | Self::Park | Self::Studio => 1,
        }
    }

    /// Radiance from `direction` (of any length but zero) without the lamps': linear BT.2020 relative to the illuminant, smooth over about 0.4° but for leaves.
    pub fn radiance(self, direction: DVec3) -> DVec3 {
        let direction = direction.normalize();
        match self {
            Self::Tent => tent::radiance(direction),
            Self::Windows => windows::radiance(direction),
            Self::Park => park::radiance(direction),
            Self::Studio => studio::radiance(direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_made_once_and_are_their_own() {
        assert!(Arc::ptr_eq(&Procedural::Tent.map(), &Procedural::Tent.map()));
        for environment in Procedural::ALL {
            assert_eq!(environment.map().size(), environment.cube_size());
        }
    }

    #[test]
    fn radiance_needs_no_repair_and_ignores_length() {
        for environment in Procedural::ALL {
            let map = CubeMap::from_fn(64, 1, |direction| environment.radiance(direction));
            assert_eq!(map.repairs().total(), 0, "{environment:?}");
            let again = CubeMap::from_fn(64, 1, |direction| environment.radiance(direction));
            assert_eq!(map.id(), again.id(), "{environment:?}");
            let direction = DVec3::new(0.3, -0.4, 0.2);
            // Rounding of one normalisation against another.
            assert!(environment.radiance(7.0 * direction).distance(environment.radiance(direction)) < 1e-12);
        }
    }

    #[test]
    fn the_tent_is_as_bright_as_white_on_average() {
        let map = CubeMap::from_fn(64, 2, |direction| Procedural::Tent.radiance(direction));
        let mean = map.mean_radiance();
        assert!((mean - 1.0).abs().max_element() < 0.05, "{mean}");
    }

    #[test]
    fn the_room_is_dark_but_for_its_windows() {
        let map = CubeMap::from_fn(128, 1, |direction| Procedural::Windows.radiance(direction));
        let greens: Vec<_> = map.mips()[0].faces.iter().flatten().map(|texel| texel.radiance().y).collect();
        let share = |test: &dyn Fn(f64) -> bool| {
            greens.iter().filter(|&&green| test(green)).count() as f64 / greens.len() as f64
        };
        assert!(share(&|green| green < 0.1) > 0.6, "dark {}", share(&|green| green < 0.1));
        let bright = share(&|green| green > 5.0);
        assert!((0.03..0.25).contains(&bright), "bright {bright}");
        assert!(greens.iter().all(|&green| green < 16.0));
    }

    #[test]
    fn windows_show_dark_roofs_under_a_sky_that_is_not_even() {
        let toward = |slope: f64, azimuth_deg: f64| {
            let level = glam::DVec2::from_angle(azimuth_deg.to_radians());
            Procedural::Windows.radiance(level.extend(slope)).y
        };
        // Through the window behind the default camera.
        let greens =
            |slope: f64| (-22..5).map(move |azimuth| toward(slope, f64::from(azimuth))).filter(|&green| green > 0.3);
        let roofs = greens(-0.13).fold(0.0, f64::max);
        let (low, high) = greens(0.15).fold((f64::MAX, 0.0f64), |(low, high), green| (low.min(green), high.max(green)));
        assert!((0.3..1.2).contains(&roofs), "{roofs}");
        assert!(high > 8.0 * roofs && high > 1.2 * low, "{low} to {high}");
    }
}
