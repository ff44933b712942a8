//! Scenes that do not come from a preset or a file: from a text, from memory, and in an environment of one's own.

use std::path::{Path, PathBuf};

use super::{LoadError, LoadedScene, light::lit, scene::with_resources};
use crate::{
    physics::environment::CubeMap,
    scene::{Scene, SceneSource},
};

impl LoadedScene {
    /// Reads a scene from TOML text. `name` stands for the text in messages, and paths in the scene start from `folder`.
    ///
    /// # Errors
    /// The text is not a scene, or it names something that cannot be loaded.
    pub fn from_toml(text: &str, name: &str, folder: &Path) -> Result<Self, LoadError> {
        let source = SceneSource::new(name, text, &[]);
        with_resources(source.read()?, source, name.to_owned(), folder.to_owned())
    }

    /// Loads what a scene names that was made in memory; paths in it start from the current folder.
    ///
    /// ```
    /// use soapfilm::{LoadedScene, Scene};
    ///
    /// let mut scene = Scene::default();
    /// scene.bubbles[0].film.thickness_nm = 450.0;
    /// scene.light.illuminant = "LED-B1".to_owned();
    /// let loaded = LoadedScene::from_scene(scene)?;
    /// assert_eq!(loaded.resources.illuminant.name(), "LED-B1");
    /// # Ok::<(), soapfilm::Error>(())
    /// ```
    ///
    /// # Errors
    /// A value lies out of its range, or the scene names something that cannot be loaded.
    pub fn from_scene(scene: Scene) -> Result<Self, LoadError> {
        scene.validate()?;
        let source = SceneSource::new("scene", &scene.to_toml(), &[]);
        with_resources(scene, source, "scene".to_owned(), PathBuf::new())
    }

    /// The same scene in another environment, in linear BT.2020, which takes the place of `light.environment` and `light.constant`. Patches and lamps
    /// of the light remain. A scene file cannot name such an environment: [`Scene::to_toml`] still writes the old one.
    ///
    /// # Errors
    /// An illuminant cannot be loaded.
    pub fn with_environment(mut self, environment: CubeMap) -> Result<Self, LoadError> {
        self.scene.light.constant = None;
        let light = &self.scene.light;
        let (environment, spectral_lights) = lit(light, environment.into(), &self.folder, &mut self.notes)?;
        self.resources.environment = environment;
        self.resources.spectral_lights = spectral_lights;
        Ok(self)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::scene::LightPatch;

    #[test]
    fn scenes_come_from_memory_and_from_text() {
        let scene = Scene::default();
        let loaded = LoadedScene::from_scene(scene.clone()).expect("valid");
        assert_eq!(loaded.scene, scene);
        let loaded = LoadedScene::from_toml("version = 1", "mine", Path::new("")).expect("valid");
        assert_eq!((loaded.scene, loaded.name.as_str()), (scene, "mine"));
    }

    #[test]
    fn wrong_scenes_are_refused_by_their_key() {
        let mut scene = Scene::default();
        scene.bubbles[0].radius_mm = -1.0;
        let told = LoadedScene::from_scene(scene).expect_err("out of range").to_string();
        assert!(told.contains("`radius_mm` in [[bubble]]"), "{told}");
        let told = LoadedScene::from_toml("version = 1\nlihgt = 3", "mine", Path::new("")).expect_err("no key");
        assert!(told.to_string().starts_with("mine:2: "), "{told}");
    }

    #[test]
    fn an_own_environment_takes_the_place_of_the_constant_and_keeps_patches() {
        let mut scene = Scene::default();
        scene.light.constant = Some([0.25; 3]);
        scene.light.patches = vec![LightPatch { illuminant: "sodium".to_owned(), ..LightPatch::default() }];
        let sky = CubeMap::from_fn(16, 1, |direction| DVec3::splat(if direction.z > 0.0 { 2.0 } else { 0.5 }));
        let lit = LoadedScene::from_scene(scene).expect("valid").with_environment(sky).expect("built in");
        assert_eq!(lit.scene.light.constant, None);
        let (rest, spectral_lights) = (&lit.resources.environment, &lit.resources.spectral_lights);
        assert_eq!((rest.sample(DVec3::Z).y, rest.sample(DVec3::NEG_Z).y), (2.0, 0.5));
        // The patch stands at the horizon along +x, and takes what the environment has there.
        assert!(rest.sample(DVec3::new(1.0, 0.0, 0.1)).y == 0.0);
        assert_eq!(spectral_lights[0].environment.sample(DVec3::new(1.0, 0.0, 0.1)).y, 2.0);
    }
}
