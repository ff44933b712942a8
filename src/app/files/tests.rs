use super::*;
use std::time::Duration;

use crate::{
    app::model::tests::model,
    input::load_scene,
    scene::{Environment, Scene},
};

/// Files that tell by a channel when something has arrived.
fn files() -> (Files, Receiver<()>) {
    let (sender, receiver) = channel();
    (Files::new(move || sender.send(()).unwrap()), receiver)
}

const PATIENCE: Duration = Duration::from_secs(60);

#[test]
fn a_file_that_fails_says_so_and_changes_nothing() {
    let ((mut files, arrived), mut model) = (files(), model());
    let before = Scene::clone(&model.scene);
    files.load_scene(&mut model, "/no/such/scene.toml".to_owned());
    assert!(model.loading.is_some());
    arrived.recv_timeout(PATIENCE).unwrap();
    assert_eq!(files.collect(&mut model), []);
    assert!(model.messages.at(0.0)[0].text.contains("/no/such/scene.toml"));
    assert_eq!((&*model.scene, model.loading), (&before, None));
}

#[test]
fn only_the_latest_load_counts() {
    let ((mut files, arrived), mut model) = (files(), model());
    files.load_scene(&mut model, "black".to_owned());
    files.load_scene(&mut model, "bands".to_owned());
    for _ in 0..2 {
        arrived.recv_timeout(PATIENCE).unwrap();
    }
    assert_eq!(files.collect(&mut model), [Arrival::Scene]);
    assert_eq!((model.name.as_str(), model.loading), ("bands", None));
}

#[test]
fn a_light_and_what_it_names_arrive_together() {
    let ((mut files, arrived), mut model) = (files(), model());
    let before = model.resources.environment.id();
    let light = Light { environment: Environment::Windows, ..Light::default() };
    files.load_light(&mut model, light.clone());
    assert_ne!(model.scene.light, light);
    arrived.recv_timeout(PATIENCE).unwrap();
    assert_eq!(files.collect(&mut model), []);
    assert_eq!(model.scene.light, light);
    assert_ne!(model.resources.environment.id(), before);
}

#[test]
fn a_photograph_is_put_behind_the_bubbles_and_taken_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("street.png");
    image::RgbImage::from_pixel(3, 2, image::Rgb([9, 99, 199])).save(&path).unwrap();
    let ((mut files, arrived), mut model) = (files(), model());
    let name = path.to_str().unwrap().to_owned();
    files.load_plate(&mut model, name.clone());
    arrived.recv_timeout(PATIENCE).unwrap();
    assert_eq!(files.collect(&mut model), []);
    assert_eq!(model.scene.view.plate, Some(name));
    assert_eq!(model.resources.plate.as_ref().map(|plate| plate.size()), Some([3, 2]));
    model.undo();
    assert!(model.scene.view.plate.is_none() && model.resources.plate.is_none());
    files.load_plate(&mut model, folder.path().join("none.png").display().to_string());
    arrived.recv_timeout(PATIENCE).unwrap();
    files.collect(&mut model);
    assert!(model.scene.view.plate.is_none() && model.loading.is_none());
}

#[test]
fn a_scene_saved_elsewhere_finds_all_of_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let [old, new] = ["old", "new"].map(|name| folder.path().join(name));
    std::fs::create_dir_all(&old).unwrap();
    std::fs::create_dir_all(&new).unwrap();
    let table = |value: &str| format!("360,{value}\n780,{value}\n");
    for (path, value) in [(old.join("lamp.csv"), "1"), (new.join("patch.csv"), "2"), (old.join("n.csv"), "1.4")] {
        std::fs::write(path, table(value)).unwrap();
    }
    let photograph = image::RgbImage::from_pixel(2, 2, image::Rgb([9, 99, 199]));
    photograph.save(old.join("street.png")).unwrap();
    let text = "version = 1\n[view]\nplate = 'street.png'\n[light]\nilluminant = 'lamp.csv'\nconstant = [1, 1, 1]\n\
                [[light.patch]]\nilluminant = '../new/patch.csv'\n[[bubble]]\n[bubble.film]\nindex = 'n.csv'\n";
    std::fs::write(old.join("scene.toml"), text).unwrap();
    let loaded = load_scene(old.join("scene.toml")).unwrap();
    let (files, arrived) = files();
    let saved = new.join("saved.toml");
    let model = Model::new(loaded.clone());
    files.save_scene(saved.clone(), &model);
    arrived.recv_timeout(PATIENCE).unwrap();
    let read = load_scene(&saved).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(read.resources.illuminant.spectrum(), loaded.resources.illuminant.spectrum());
    assert_eq!(
        read.resources.spectral_lights[0].illuminant.spectrum(),
        loaded.resources.spectral_lights[0].illuminant.spectrum()
    );
    assert_eq!(read.resources.liquids.len(), 1);
    assert_eq!(read.resources.plate, loaded.resources.plate);
    assert!(read.resources.plate.is_some());

    files.save_scene(old.join("again.toml"), &model);
    arrived.recv_timeout(PATIENCE).unwrap();
    assert_eq!(load_scene(old.join("again.toml")).unwrap().scene, *model.scene, "in its own folder nothing changes");
}

#[test]
#[cfg(unix)]
fn paths_into_the_new_folder_are_relative_and_others_are_whole() {
    let environment = |path: &str| Scene {
        light: Light { environment: Environment::File(path.to_owned()), ..Light::default() },
        ..Scene::default()
    };
    let at = |path: &str, to: &str| moved(environment(path), Path::new("/a"), Path::new(to)).unwrap().light.environment;
    assert_eq!(at("hall.exr", "/b"), Environment::File("/a/hall.exr".to_owned()));
    assert_eq!(at("sky/hall.exr", "/a/sky"), Environment::File("hall.exr".to_owned()));
    assert_eq!(at("/c/hall.exr", "/b"), Environment::File("/c/hall.exr".to_owned()));
}

#[test]
fn work_that_panics_is_a_problem_and_no_crash() {
    let ((files, arrived), mut model) = (files(), model());
    files.run(|| panic!("planted"));
    arrived.recv_timeout(PATIENCE).unwrap();
    files.collect(&mut model);
    assert!(model.messages.at(0.0)[0].text.contains("internal error"));
}
