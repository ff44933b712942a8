//! Loads the light that a scene names: its environment, its spectrum, and the parts of it that have others.

use std::{path::Path, sync::Arc};

use glam::{DVec2, DVec3};

use super::{LoadError, read_environment, read_table_text};
use crate::{
    physics::{
        colour::{BT2020, Illuminant, bt709_to_bt2020, seen_light, unseen},
        environment::{CubeMap, Lamp, Patch, Procedural},
    },
    plan::SpectralLight,
    scene::{Environment, Fault, LampShape, Light, LightLamp, LightPatch, is_table},
};

/// Minimum texels along an edge of a cube map with patches: their edges are then sharp to a third of a degree.
const MIN_PATCHED_SIZE: usize = 256;

/// Loads the environment that a light names, and the spectral lights that its patches take out of it; file paths start from a folder. What a user
/// should know of how files were read is added to `notes`, a line each.
pub fn load_environment(
    light: &Light,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<(Arc<CubeMap>, Vec<SpectralLight>), LoadError> {
    #[cfg(target_arch = "wasm32")]
    if let Some(made) = super::made_elsewhere::take(light, folder) {
        return Ok(made.into_parts(notes));
    }
    make_environment(light, folder, notes)
}

#[cfg(target_arch = "wasm32")]
impl super::LightNamed {
    /// Makes its environment.
    ///
    /// # Errors
    /// A file cannot be read.
    pub fn made(&self) -> Result<super::MadeEnvironment, LoadError> {
        let scene = crate::scene::SceneSource::new("light", &self.scene, &[]).read()?;
        let mut notes = Vec::new();
        let (map, spectral_lights) = make_environment(&scene.light, &self.folder, &mut notes)?;
        Ok(super::MadeEnvironment(map, spectral_lights, notes))
    }
}

/// Reads or computes the environment that a light names.
fn make_environment(
    light: &Light,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<(Arc<CubeMap>, Vec<SpectralLight>), LoadError> {
    let map = match &light.environment {
        // Without lamps its colour is a factor on white, which texels do not round.
        _ if let Some(constant) = light.constant => {
            let is_factor = light.lamps.is_empty();
            Arc::new(CubeMap::constant(if is_factor { DVec3::ONE } else { linear(constant) }))
        }
        Environment::Tent => Procedural::Tent.map(),
        Environment::Windows => Procedural::Windows.map(),
        Environment::Park => Procedural::Park.map(),
        Environment::Studio => Procedural::Studio.map(),
        Environment::File(path) => {
            let picture = read_environment(&folder.join(path), notes);
            let picture = picture.map_err(|error| Fault::unusable("environment", error).inside("light"))?;
            Arc::new(CubeMap::from_equirect(&picture))
        }
    };
    lit(light, map, folder, notes)
}

/// An environment in which the patches of a light have a spectrum of their own, with the light's lamps before both.
pub(super) fn lit(
    light: &Light,
    map: Arc<CubeMap>,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<(Arc<CubeMap>, Vec<SpectralLight>), LoadError> {
    let (rest, spectral_lights) = without_patches(light, map, folder, notes)?;
    Ok((with_lamps(light, rest, folder, notes)?, spectral_lights))
}

/// An environment with the lamps of a light before it.
fn with_lamps(
    light: &Light,
    map: Arc<CubeMap>,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<Arc<CubeMap>, LoadError> {
    if light.lamps.is_empty() {
        return Ok(map);
    }
    let illuminant = load_illuminant_of(light, folder, notes)?;
    let lamps = light.lamps.iter().map(|lamp| lamp_of(lamp, &illuminant)).collect::<Result<Vec<_>, _>>()?;
    Ok(Arc::new(CubeMap::clone(&map).with_lamps(lamps)))
}

/// A lamp whose light has its colour under an illuminant.
fn lamp_of(lamp: &LightLamp, illuminant: &Illuminant) -> Result<Lamp, LoadError> {
    let half = |degrees: f64| (0.5 * degrees).to_radians().tan();
    let (width, height) = match lamp.shape {
        LampShape::Disc => (lamp.width_deg, lamp.width_deg),
        LampShape::Softbox => (lamp.width_deg, lamp.height_deg),
        LampShape::Strip => (0.2 * lamp.width_deg, lamp.height_deg),
    };
    let half_size = DVec2::new(half(width), half(height));
    let corner = if lamp.shape == LampShape::Disc { 1.0 } else { 0.15 } * half_size.min_element();
    let white = match lamp.kelvin {
        None => DVec3::ONE,
        Some(kelvin) => {
            let colour = seen_light(&format!("{kelvin} K").parse()?) * DVec3::ONE;
            let relative = unseen(&seen_light(illuminant)) * colour;
            (relative / colour.dot(BT2020.luminance_weights())).max(DVec3::ZERO)
        }
    };
    let angles = [lamp.azimuth_deg, lamp.elevation_deg, lamp.roll_deg].map(f64::to_radians);
    let edge = 0.5 * lamp.edge_deg.to_radians();
    Ok(Lamp { edge: edge.min(corner), ..Lamp::new(angles, half_size, corner, lamp.luminance * white) })
}

/// An environment without the light of its patches, and these patches as spectral lights.
fn without_patches(
    light: &Light,
    map: Arc<CubeMap>,
    folder: &Path,
    notes: &mut Vec<String>,
) -> Result<(Arc<CubeMap>, Vec<SpectralLight>), LoadError> {
    if light.patches.is_empty() {
        return Ok((map, Vec::new()));
    }
    let patches: Vec<Patch> = light.patches.iter().map(patch).collect();
    let size = map.size().max(MIN_PATCHED_SIZE);
    let share = |direction| Patch::shares(&patches, direction)[patches.len()];
    let lamps = map.lamps().iter().map(|lamp| Lamp { radiance: share(lamp.towards) * lamp.radiance, ..*lamp });
    let rest = CubeMap::from_fn(size, 1, |direction| share(direction) * map.far(direction)).with_lamps(lamps);
    let mut names: Vec<&str> = light.patches.iter().map(|patch| patch.illuminant.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    let spectral_light = |name: &str| {
        let environment =
            Arc::new(CubeMap::from_fn(size, 1, |direction| radiance_of(light, &patches, name, &map, direction)));
        let illuminant = load_illuminant(name, folder, notes).map_err(|error| {
            let patch = light.patches.iter().position(|patch| patch.illuminant == name).unwrap_or(0);
            Fault::unusable("illuminant", error).inside_item("patch", patch).inside("light")
        })?;
        Ok(SpectralLight { environment, illuminant: illuminant.into() })
    };
    let spectral_lights = names.into_iter().map(spectral_light).collect::<Result<_, LoadError>>()?;
    Ok((Arc::new(rest), spectral_lights))
}

fn patch(patch: &LightPatch) -> Patch {
    let (azimuth, elevation) = (patch.azimuth_deg.to_radians(), patch.elevation_deg.to_radians());
    Patch {
        towards: DVec3::new(elevation.cos() * azimuth.cos(), elevation.cos() * azimuth.sin(), elevation.sin()),
        radius_rad: patch.radius_deg.to_radians(),
        edge_rad: patch.edge_deg.to_radians(),
    }
}

fn linear(rgb: [f64; 3]) -> DVec3 {
    bt709_to_bt2020() * DVec3::from(rgb)
}

/// Radiance from a direction, in the light of all patches with one illuminant.
fn radiance_of(light: &Light, patches: &[Patch], illuminant: &str, map: &CubeMap, direction: DVec3) -> DVec3 {
    let constant = light.constant.filter(|_| light.lamps.is_empty());
    let there = constant.map_or(DVec3::ONE, linear) * map.far(direction);
    let shares = Patch::shares(patches, direction);
    let own = light.patches.iter().zip(shares).filter(|(patch, _)| patch.illuminant == illuminant);
    own.map(|(patch, share)| share * patch.radiance.map_or(there, linear)).sum()
}

/// A light by its name, or from the `.csv` file of that path. What a user should know of how it was read is added to `notes`.
pub fn load_illuminant(name: &str, folder: &Path, notes: &mut Vec<String>) -> Result<Illuminant, LoadError> {
    if !is_table(name) {
        return Ok(name.parse()?);
    }
    Ok(Illuminant::from_csv(name, &read_table_text(&folder.join(name))?, notes)?)
}

/// The illuminant of a light: of the spectrum that stands in the scene, or else the one that is named. What a user should know of how it was read is added
/// to `notes`.
pub fn load_illuminant_of(light: &Light, folder: &Path, notes: &mut Vec<String>) -> Result<Illuminant, LoadError> {
    let fault = match &light.spectrum {
        Some(spectrum) => match spectrum.illuminant() {
            Ok(illuminant) => return Ok(illuminant),
            Err(error) => Fault::unusable("spectrum", error),
        },
        None => match load_illuminant(&light.illuminant, folder, notes) {
            Ok(illuminant) => return Ok(illuminant),
            Err(error) => Fault::unusable("illuminant", error),
        },
    };
    Err(fault.inside("light").into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::LightSpectrum;

    fn lit(patches: Vec<LightPatch>) -> (Arc<CubeMap>, Vec<SpectralLight>) {
        let light = Light { constant: Some([0.5, 0.4, 0.3]), patches, ..Light::default() };
        load_environment(&light, Path::new(""), &mut Vec::new()).expect("all is built in")
    }

    #[test]
    fn patches_take_from_the_environment_what_they_show() {
        let sodium = LightPatch { illuminant: "sodium".to_owned(), radius_deg: 30.0, ..LightPatch::default() };
        let (rest, spectral_lights) = lit(vec![sodium]);
        assert_eq!(spectral_lights.len(), 1);
        let constant = bt709_to_bt2020() * DVec3::new(0.5, 0.4, 0.3);
        let mut covered = 0;
        for angle in (0..36).map(|k| f64::from(k).to_radians() * 5.0) {
            let direction = DVec3::new(angle.cos(), angle.sin(), 0.1);
            let sum = constant * rest.sample(direction) + spectral_lights[0].environment.sample(direction);
            assert!((sum - constant).abs().max_element() < 1e-3, "{angle}: {sum}");
            covered += u32::from(rest.sample(direction).x < 0.5);
        }
        assert!((5..=7).contains(&covered), "{covered} of 36 directions");
    }

    #[test]
    fn lamps_have_their_radiance_and_their_colour() {
        let lamp =
            |azimuth_deg: f64, kelvin| LightLamp { azimuth_deg, elevation_deg: 0.0, kelvin, ..LightLamp::default() };
        let lamps = vec![lamp(0.0, None), lamp(180.0, Some(3000.0))];
        let light = Light { constant: Some([0.0; 3]), lamps, ..Light::default() };
        let (map, _) = load_environment(&light, Path::new(""), &mut Vec::new()).expect("all is built in");
        assert_eq!(map.sample(DVec3::X), DVec3::splat(10.0));
        assert_eq!(map.sample(DVec3::Y), DVec3::ZERO);
        let warm = seen_light(&Illuminant::default()) * map.sample(DVec3::NEG_X);
        assert!((warm.dot(BT2020.luminance_weights()) - 10.0).abs() < 1e-9, "{warm}");
        assert!(warm.x > 1.5 * warm.y && warm.y > 2.0 * warm.z && warm.z > 0.0, "{warm}");
    }

    #[test]
    fn patches_of_one_illuminant_are_one_lamp_and_may_have_a_radiance() {
        let patch = |azimuth_deg: f64, illuminant: &str| LightPatch {
            azimuth_deg,
            illuminant: illuminant.to_owned(),
            radiance: Some([2.0; 3]),
            ..LightPatch::default()
        };
        let (_, spectral_lights) = lit(vec![patch(0.0, "A"), patch(90.0, "sodium"), patch(180.0, "A")]);
        assert_eq!(spectral_lights.len(), 2);
        let level = |index: usize, direction: DVec3| spectral_lights[index].environment.sample(direction).y;
        assert!((level(0, DVec3::X) - 2.0).abs() < 1e-3 && (level(0, DVec3::NEG_X) - 2.0).abs() < 1e-3);
        assert!((level(1, DVec3::Y) - 2.0).abs() < 1e-3 && level(1, DVec3::X) == 0.0);
    }

    /// Whatever the band, lamps of a temperature have light that can be drawn.
    #[test]
    fn a_spectrum_of_the_scene_takes_the_place_of_the_name() {
        for center_nm in [400.0, 480.0, 550.0, 700.0] {
            let wavelengths_nm = vec![center_nm - 3.0, center_nm, center_nm + 3.0];
            let spectrum = LightSpectrum { wavelengths_nm, power: vec![0.0, 1.0, 0.0] };
            let lamps = vec![LightLamp { kelvin: Some(3000.0), ..LightLamp::default() }];
            let illuminant = "none of this name".to_owned();
            let light =
                Light { constant: Some([0.5; 3]), lamps, illuminant, spectrum: Some(spectrum), ..Light::default() };
            let loaded = load_illuminant_of(&light, Path::new(""), &mut Vec::new()).expect("seen");
            let peak = (loaded.spectrum().at_nm(center_nm), loaded.spectrum().at_nm(center_nm + 4.0));
            assert_eq!((peak, loaded.name()), ((1.0, 0.0), "the spectrum of the scene"));
            let (map, _) = load_environment(&light, Path::new(""), &mut Vec::new()).expect("all is built in");
            assert!(map.lamps().iter().all(|lamp| lamp.radiance.is_finite() && lamp.radiance.max_element() > 0.0));
        }
    }
}
