//! Settings over a scene's text.

use crate::scene::{Environment, FilmIndexName, Flow, Scene, SceneError, SceneSource};

fn read(text: &str, settings: &[&str]) -> Result<Scene, SceneError> {
    let settings: Vec<_> = settings.iter().map(|setting| setting.parse().unwrap()).collect();
    SceneSource::new("s.toml", text, &settings).read()
}

#[test]
fn they_reach_every_kind_of_key() {
    let text = "version = 1\n[view]\nexposure_ev = 1\n[[bubble]]\n[[bubble]]\nradius_mm = 3\n[[light.patch]]\n";
    let settings = [
        "view.exposure_ev=2",
        "bubble.1.film.thickness_nm = 400",
        "bubble.0.film.index=glycerol 30%",
        "light.constant=[1, 2, 3]",
        "light.constant.1=5",
        r"light.environment=C:\rooms\new.hdr",
        "light.illuminant='A'",
        "light.patch.0.illuminant=3000 K",
        "motion.flow=rest",
        "view.dither=false",
        "camera={azimuth_deg = 3, fov_y_deg = 20}",
        "event=[{kind='prick', tick=4}]",
        "camera.keyframe=[{time_s = 1, azimuth_deg = 90}, {time_s = 2}]",
        "camera.keyframe.1.azimuth_deg=450",
    ];
    let scene = read(text, &settings).unwrap();
    assert_eq!((scene.view.exposure_ev, scene.view.dither), (2.0, false));
    assert_eq!((scene.bubbles[1].film.thickness_nm, scene.bubbles[1].radius_mm), (400.0, 3.0));
    assert_eq!(scene.bubbles[0].film.index, FilmIndexName::Named("glycerol 30%".to_owned()));
    assert_eq!(scene.light.constant, Some([1.0, 5.0, 3.0]));
    assert_eq!(scene.light.environment, Environment::File(r"C:\rooms\new.hdr".to_owned()));
    assert_eq!((scene.light.illuminant.as_str(), scene.light.patches[0].illuminant.as_str()), ("A", "3000 K"));
    assert_eq!((scene.motion.flow, scene.camera.azimuth_deg, scene.camera.fov_y_deg), (Flow::Rest, 3.0, 20.0));
    assert_eq!((scene.events.len(), scene.events[0].tick), (1, 4));
    let keyframes = scene.camera.keyframes.iter().map(|keyframe| (keyframe.time_s, keyframe.azimuth_deg));
    assert_eq!(keyframes.collect::<Vec<_>>(), [(1.0, Some(90.0)), (2.0, Some(450.0))]);
}

#[test]
fn settings_apply_to_the_default_bubble_of_a_text_without_bubbles() {
    let scene = read("version = 1", &["bubble.0.radius_mm=30"]).unwrap();
    assert_eq!((scene.bubbles.len(), scene.bubbles[0].radius_mm), (1, 30.0));
    assert_eq!(read("version = 1", &["bubble=[]"]).unwrap().bubbles.len(), 0);
}

#[test]
fn a_faulty_setting_is_named_instead_of_a_line() {
    for (setting, told) in [
        ("view.exposure=2", "unknown key `exposure` in [view]; did you mean `exposure_ev`?"),
        ("veiw.exposure_ev=2", "unknown key `veiw`; did you mean `view`?"),
        ("view.exposure_ev=99", "`exposure_ev` in [view] is 99; it must be within -20 ..= 20"),
        ("view.exposure_ev=nan", "`exposure_ev` in [view] is NaN; it must be within -20 ..= 20"),
        ("view.exposure_ev=much", "`exposure_ev` in [view] is wrong: invalid type: string \"much\", expected a number"),
        ("view.exposure_ev=", "`exposure_ev` in [view] is wrong: invalid type: string \"\", expected a number"),
        ("light.constant=[1, 2]", "`constant` in [light] is a list of 2; it must hold 3 numbers"),
        ("light.constant=[1, 2", "unclosed array, expected `]`"),
        (
            "bubble.1.radius_mm=3",
            "`bubble` is a list of 1 here; write the number of an item, counted from 0, after its name",
        ),
        (
            "bubble.film.index=2",
            "`bubble` is a list of 1 here; write the number of an item, counted from 0, after its name",
        ),
        ("bubble.0.film.indx=2", "unknown key `indx` in [bubble.film]; did you mean `index`?"),
        ("view.dither.x=2", "`dither` in [view] is one value and has no keys"),
        (
            "camera={fov_y_deg = 'x', azimuth_deg = 3}",
            "`fov_y_deg` in [camera] is wrong: invalid type: string \"x\", expected a number",
        ),
        ("version=2", "version 2 is not supported; this program reads `version = 1`"),
        (
            "motion.flow=windy",
            "`flow` in [motion] is wrong: unknown word `windy`, expected one of `free`, `rest`, `sloshing`, `draught`, `stirred`, `jets`",
        ),
    ] {
        let error = read("version = 1\n[view]\ndither = true\n", &["camera.azimuth_deg=1", setting]).unwrap_err();
        assert_eq!(error.to_string(), format!("--set {setting}: {told}"));
    }
    let line = read("version = 1\n[view]\nexposure_ev = 99", &["camera.azimuth_deg=1"]).unwrap_err().to_string();
    assert!(line.starts_with("s.toml:3: "), "{line}");
}

#[test]
fn an_invalid_setting_is_answered_with_the_syntax() {
    for wrong in ["view", "", "=3", "view..x=3", ".=3"] {
        let told = wrong.parse::<crate::scene::Setting>().unwrap_err();
        assert!(told.contains("KEY=VALUE"), "{wrong}: {told}");
    }
}
