//! Lists whose items must stand in an order: points of a spectrum, keyframes.

use super::{
    refusals::{assert_refused, refusal},
    with_version,
};
use crate::scene::Scene;

#[test]
fn a_spectrum_has_its_points_in_order_and_some_power() {
    let many = vec!["400"; 1001].join(", ");
    let cases = [
        ("400", "1", "3: `wavelengths_nm` in [light.spectrum] is a list of 1; it must hold 2 to 1000 numbers"),
        (&many, "1", "3: `wavelengths_nm` in [light.spectrum] is a list of 1001; it must hold 2 to 1000 numbers"),
        (
            "400, 500",
            "1, 1, 1",
            "4: `power` in [light.spectrum] is a list of 3; it must hold as many numbers as `wavelengths_nm`, 2",
        ),
        (
            "350, 500",
            "1, 1",
            "3: `wavelengths_nm` in [light.spectrum] holds a number that is 350; it must be within 360 ..= 780",
        ),
        ("nan, 500", "1, 1", "3: `wavelengths_nm` in [light.spectrum] is NaN; it must be a finite number"),
        (
            "500, 500",
            "1, 1",
            "3: `wavelengths_nm` in [light.spectrum] has 500 after 500; sort the points by wavelength, each once",
        ),
        (
            "400, 500",
            "1, -1",
            "4: `power` in [light.spectrum] holds a number that is -1; it must be within 0 ..= 1000000000000",
        ),
        ("400, 500", "0, 0", "4: `power` in [light.spectrum] is 0 everywhere; give one of the points some power"),
        (
            "400, 500",
            "1, 'x'",
            "4: `power` in [light.spectrum] is wrong: invalid type: string \"x\", expected a number",
        ),
    ];
    for (nm, power, message) in cases {
        let text = with_version(&format!("[light.spectrum]\nwavelengths_nm = [{nm}]\npower = [{power}]"));
        assert_eq!(refusal(&text), format!("s.toml:{message}"), "{nm} {power}");
    }
    assert_refused(&[
        (
            "[light]\nspectrum = 'D65'",
            "3: `spectrum` in [light] is wrong: invalid type: string \"D65\", expected the table LightSpectrum",
        ),
        ("[light.spectrum]\npowers = [1, 1]", "3: unknown key `powers` in [light.spectrum]; did you mean `power`?"),
    ]);
}

#[test]
fn keyframes_have_times_in_order_and_the_ranges_of_the_camera() {
    assert_refused(&[
        (
            "[[camera.keyframe]]\ntime_s = 2\n[[camera.keyframe]]\ntime_s = 1",
            "5: `time_s` in [[camera.keyframe]] number 2 is 1 after a keyframe at 2 s; sort the keyframes, and give each a time of its own",
        ),
        (
            "[[camera.keyframe]]\n[[camera.keyframe]]\nazimuth_deg = 3",
            "3: `time_s` in [[camera.keyframe]] number 2 is 0 after a keyframe at 0 s; sort the keyframes, and give each a time of its own",
        ),
        (
            "[[camera.keyframe]]\nelevation_deg = 91",
            "3: `elevation_deg` in [[camera.keyframe]] is 91; it must be within -90 ..= 90",
        ),
        (
            "[[camera.keyframe]]\nazimuth = 91",
            "3: unknown key `azimuth` in [[camera.keyframe]]; did you mean `azimuth_deg`?",
        ),
        (
            "[[camera.keyframe]]\nease = \"fast\"",
            "3: `ease` in [[camera.keyframe]] is wrong: unknown word `fast`, expected one of `smooth`, `linear`, `hold`",
        ),
        ("[camera.keyframe]\ntime_s = 3", "2: `keyframe` in [camera] has the wrong kind of table; write [[keyframe]]"),
        (
            "[camera]\nfocal_mm = 50\n[[camera.keyframe]]\nfov_y_deg = 30",
            "5: `fov_y_deg` in [[camera.keyframe]] has no effect, because `focal_mm` takes its place; give `focal_mm` in each of them",
        ),
    ]);
    let many = |count| {
        let keyframes = (0..count).map(|time_s| format!("[[camera.keyframe]]\ntime_s = {time_s}\n"));
        with_version(&keyframes.collect::<String>())
    };
    assert!(Scene::from_toml(&many(1000), "s").is_ok());
    let message = "s.toml:2: `keyframe` in [camera] is a list of 1001; at most 1000 are allowed";
    assert_eq!(refusal(&many(1001)), message);
}
