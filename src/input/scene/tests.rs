use super::*;

/// A folder with a scene in it.
fn desk(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.toml");
    std::fs::write(&path, format!("version = 1\n{text}")).unwrap();
    (folder, path)
}

/// The message about a scene that can be read but not used, given its text below the version, without its folder.
fn refusal(text: &str) -> String {
    let (folder, path) = desk(text);
    for (name, content) in [("short.csv", "400,1\n500,1\n"), ("words.csv", "360,a\n"), ("text.hdr", "no picture")] {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    let error = load_scene(&path).expect_err("this scene must be refused").to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

/// The errors that are found after the text has been read name their line and key like all others.
#[test]
fn a_bad_file_of_a_scene_is_refused_by_line_and_key() {
    for (text, told) in [
        ("[light]\nilluminant = \"D66\"", "s.toml:3: `illuminant` in [light] cannot be used: unknown illuminant `D66`"),
        ("[light]\nilluminant = \"5 K\"", "s.toml:3: `illuminant` in [light] cannot be used: a black body of 5 K"),
        (
            "[light]\n\nilluminant = \"no.csv\"",
            "s.toml:4: `illuminant` in [light] cannot be used: file no.csv does not exist",
        ),
        ("[light]\nilluminant = \"words.csv\"", "s.toml:3: `illuminant` in [light] cannot be used: words.csv"),
        (
            "[light.spectrum]\nwavelengths_nm = [360, 362]",
            "s.toml:2: `spectrum` in [light] cannot be used: the spectrum of the scene: cannot be seen",
        ),
        (
            "[light]\nenvironment = \"no.exr\"",
            "s.toml:3: `environment` in [light] cannot be used: file no.exr does not exist",
        ),
        (
            "[light]\nenvironment = \"text.hdr\"",
            "s.toml:3: `environment` in [light] cannot be used: text.hdr is neither",
        ),
        (
            "[[light.patch]]\n[[light.patch]]\nilluminant = \"neon\"",
            "s.toml:4: `illuminant` in [[light.patch]] number 2 cannot be used: unknown illuminant `neon`",
        ),
        (
            "[[bubble]]\n[[bubble]]\nfilm.index = \"water 99C\"",
            "s.toml:4: `index` in [bubble.film] number 2 cannot be used: water of 99 °C",
        ),
        (
            "[[bubble]]\n[bubble.film]\nindex = \"short.csv\"",
            "s.toml:4: `index` in [bubble.film] cannot be used: short.csv",
        ),
    ] {
        let line = refusal(text);
        assert!(line.starts_with(told), "{line}\nis not\n{told}");
    }
}

#[test]
fn a_scene_that_cannot_be_drawn_is_refused_by_line_and_key() {
    let shot = Shot {
        size: [64, 36],
        moment: Default::default(),
        full_precision: false,
        gamut: Default::default(),
        pace: crate::plan::Pace::Whole,
    };
    let (folder, path) = desk("[camera]\nelevation_deg = -9\n[[bubble]]\nboundary = \"bath\"");
    let error = load_scene(&path).unwrap().request(&shot).unwrap_err().to_string();
    assert_eq!(
        error.replace(&format!("{}/", folder.path().display()), ""),
        "s.toml:3: `elevation_deg` in [camera] looks from below the bath that the bubbles stand on; raise it, or `target_m`"
    );
}

#[test]
fn settings_go_over_files_and_presets() {
    let set = |texts: &[&str]| texts.iter().map(|text| text.parse().unwrap()).collect::<Vec<Setting>>();
    let loaded = load_scene_with("windows", &set(&["view.exposure_ev=3", "light.illuminant=A"])).unwrap();
    assert_eq!((loaded.scene.view.exposure_ev, loaded.resources.illuminant.name()), (3.0, "A"));
    let (_folder, path) = desk("[view]\nexposure_ev = 1\n");
    let loaded = load_scene_with(&path, &set(&["view.exposure_ev=2", "view.exposure_ev=4"])).unwrap();
    assert_eq!(loaded.scene.view.exposure_ev, 4.0, "the last one counts");
    let error = load_scene_with("windows", &set(&["light.illuminant=D66"])).unwrap_err().to_string();
    assert!(error.starts_with("--set light.illuminant=D66: `illuminant` in [light] cannot be used"), "{error}");
}

#[test]
fn a_preset_that_is_mistyped_has_a_neighbour() {
    let told = |name: &str| load_scene(name).unwrap_err().to_string();
    assert!(
        told("windws")
            .starts_with("no scene file or preset is named `windws`; did you mean `windows`? presets: default, ")
    );
    assert!(told("qqqq").starts_with("no scene file or preset is named `qqqq`; presets: default, "));
    assert!(told("no/such").starts_with("file no/such does not exist"));
}

#[cfg(unix)]
#[test]
fn paths_need_not_be_utf8() {
    use std::os::unix::ffi::OsStrExt;
    let (folder, path) = desk("");
    let odd = folder.path().join(std::ffi::OsStr::from_bytes(b"caf\xe9.toml"));
    let error = load_scene(&odd).unwrap_err().to_string();
    assert!(error.contains("caf\u{fffd}.toml"), "{error}");
    std::fs::rename(path, &odd).unwrap();
    assert!(load_scene(&odd).unwrap().name.ends_with("caf\u{fffd}.toml"));
}
