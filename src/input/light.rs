//! Loads the light that a scene names: its environment, its spectrum, and the parts of it that have others.

use std::{path::Path, sync::Arc};

use glam::DVec3;

use super::{LoadError, read_environment, read_table_text};
use crate::{
    physics::{
        colour::{Illuminant, bt709_to_bt2020},
        environment::{CubeMap, Patch, Procedural},
    },
    plan::SpectralLight,
    scene::{Environment, Fault, Light, LightPatch, is_table},
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
    let map = match &light.environment {
        _ if light.constant.is_some() => Arc::new(CubeMap::constant(DVec3::ONE)),
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
    without_patches(light, map, folder, notes)
}

/// An environment without the light of its patches, and these patches as spectral lights.
pub(super) fn without_patches(
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
    let rest = |direction| Patch::shares(&patches, direction)[patches.len()] * map.sample(direction);
    let rest = CubeMap::from_fn(size, 1, rest);
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

/// Radiance from a direction, in the light of all patches with one illuminant.
fn radiance_of(light: &Light, patches: &[Patch], illuminant: &str, map: &CubeMap, direction: DVec3) -> DVec3 {
    let linear = |rgb: [f64; 3]| bt709_to_bt2020() * DVec3::from(rgb);
    let there = light.constant.map_or(DVec3::ONE, linear) * map.sample(direction);
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
