//! `--alpha`, `--layers`, `--samples` and plates: what a compositor gets adds up to the picture.

use soapfilm::output::read_back::{ExrContents, read_exr, read_png};

use crate::{Desk, support};

/// Two bubbles, one before the other, before a coloured card.
const SCENE: &str = "version = 1\n[view]\nbackdrop = [0.5, 0.25, 0.1]\ndither = false\n[camera]\ndistance_m = 0.5\n\
    [[bubble]]\n[bubble.film]\nstate = 'uniform'\nthickness_nm = 400\n\
    [[bubble]]\ncenter_m = [0.12, 0.06, 0.02]\nradius_mm = 25\n[bubble.film]\nstate = 'uniform'\nthickness_nm = 250\n";

fn colour(picture: &ExrContents, prefix: &str) -> Vec<[f32; 3]> {
    let [r, g, b] = ["R", "G", "B"].map(|name| picture.channel(&format!("{prefix}{name}")).unwrap());
    (0..r.len()).map(|k| [r[k], g[k], b[k]]).collect()
}

/// transmission × background + reflection.
fn composed(layers: &ExrContents, background: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let [left, added] = ["transmission.", "reflection."].map(|prefix| colour(layers, prefix));
    let pixels = left.iter().zip(&added).zip(background);
    pixels.map(|((left, added), behind)| std::array::from_fn(|k| left[k] * behind[k] + added[k])).collect()
}

fn max_difference(a: &[[f32; 3]], b: &[[f32; 3]]) -> f32 {
    assert_eq!(a.len(), b.len());
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn layers_add_up_to_the_picture() {
    let desk = Desk::new();
    desk.write("scene.toml", SCENE);
    let Some(_) = desk.done("render scene.toml -o layers.exr --size 96x64 --layers") else { return };
    desk.done("render scene.toml -o plain.exr --size 96x64");
    let [layers, plain] = ["layers.exr", "plain.exr"].map(|name| read_exr(&desk.path(name)).unwrap());
    let background = colour(&layers, "background.");
    // The white of daylight's spectrum differs from its rounded chromaticity by 2e-4.
    assert!(max_difference(&background, &vec![[0.5, 0.25, 0.1]; 96 * 64]) < 2e-4);
    assert!(max_difference(&composed(&layers, &background), &colour(&layers, "")) < 1e-5);
    assert_eq!(colour(&layers, ""), colour(&plain, ""));
    let channel = |name: &str| layers.channel(name).unwrap();
    // The near bubble is in the middle of nothing; the far one shows its own thickness.
    for (id, thickness_nm) in [(1.0, 400.0), (2.0, 250.0)] {
        let own = (0..96 * 64).filter(|k| channel("id.X")[*k] == id);
        assert!(own.clone().count() > 100, "bubble {id}");
        assert!(own.clone().all(|k| (channel("thickness_nm")[k] - thickness_nm).abs() < 1e-3));
        assert!(own.clone().all(|k| (0.0..=1.0).contains(&channel("cos_theta")[k])));
        let unit =
            |k: usize| ["X", "Y", "Z"].map(|axis| channel(&format!("normal.{axis}"))[k].powi(2)).iter().sum::<f32>();
        assert!(own.clone().all(|k| (unit(k) - 1.0).abs() < 1e-5));
    }
    assert!((0..96 * 64).all(|k| (channel("id.A")[k] > 0.0) == (channel("depth")[k] < 1e9)));
    assert_eq!(channel("depth"), channel("Z"));
}

#[test]
fn alpha_leaves_out_what_stands_behind() {
    let desk = Desk::new();
    desk.write("scene.toml", SCENE);
    let Some(_) = desk.done("render scene.toml -o alone.exr --size 96x64 --alpha") else { return };
    let black = "--set view.backdrop=[0,0,0]";
    desk.done(&format!("render scene.toml -o black.exr --size 96x64 {black}"));
    desk.done("render scene.toml -o alone.png --size 96x64 --alpha");
    desk.done(&format!("render scene.toml -o black.png --size 96x64 {black}"));
    let [alone, black] = ["alone.exr", "black.exr"].map(|name| read_exr(&desk.path(name)).unwrap());
    assert_eq!(colour(&alone, ""), colour(&black, ""), "premultiplied colours are what bubbles add");
    let alpha = alone.channel("A").unwrap();
    assert_eq!(alpha[0], 0.0);
    assert!(alpha.iter().all(|alpha| (-0.05..=1.05).contains(alpha)) && alpha.iter().any(|alpha| *alpha > 0.05));
    let [alone, black] = ["alone.png", "black.png"].map(|name| read_png(&desk.path(name)).unwrap().rgba);
    for (alone, black) in alone.chunks(4).zip(black.chunks(4)) {
        for k in 0..3 {
            let over = f64::from(alone[k]) * f64::from(alone[3]) / 255.0;
            // Each of the three is rounded, and the device's tone curve is of f32.
            assert!((over - f64::from(black[k])).abs() <= 2.0, "{alone:?} over black is not {black:?}");
        }
    }
}

#[test]
fn a_plate_is_seen_through_the_bubbles_as_compositors_lay_it() {
    let desk = Desk::new();
    desk.write("scene.toml", SCENE.replace("backdrop = [0.5, 0.25, 0.1]", "plate = 'plate.png'"));
    let plate =
        image::RgbImage::from_fn(50, 50, |x, y| image::Rgb([5 * x as u8, 255 - 5 * y as u8, ((x ^ y) * 4) as u8]));
    plate.save(desk.path("plate.png")).unwrap();
    let Some(_) = desk.done("render scene.toml -o plated.exr --size 96x64") else { return };
    desk.done("render scene.toml -o layers.exr --size 96x64 --layers");
    desk.done("render scene.toml -o alone.exr --size 96x64 --layers --alpha");
    let [plated, layers, alone] =
        ["plated.exr", "layers.exr", "alone.exr"].map(|name| read_exr(&desk.path(name)).unwrap());
    let background = colour(&layers, "background.");
    for layers in [&layers, &alone] {
        let difference = max_difference(&composed(layers, &background), &colour(&plated, ""));
        assert!(difference < 1e-5, "{difference}");
    }
    // 96 columns show all 50 of the photograph, 64 rows the middle 33; the corner is in its first column.
    assert!(background[0][0] < 0.01 && background[95][0] > 0.8);
    let told = desk.refused("render scene.toml -o a.exr --set view.plate=none.png");
    assert!(told.contains("plate") && told.contains("none.png"), "{told}");
}

#[test]
fn more_samples_come_nearer_to_the_limit() {
    let desk = Desk::new();
    desk.write("scene.toml", SCENE);
    if support::gpu().is_none() {
        return;
    }
    let drawn = |samples: u32, name: &str| {
        desk.done(&format!("render scene.toml -o {name}.exr --size 48x32 --samples {samples}"));
        colour(&read_exr(&desk.path(&format!("{name}.exr"))).unwrap(), "")
    };
    let limit = drawn(48, "limit");
    let error = |picture: &[[f32; 3]]| {
        let squares = picture.as_flattened().iter().zip(limit.as_flattened()).map(|(a, b)| f64::from(a - b).powi(2));
        (squares.sum::<f64>() / (3.0 * limit.len() as f64)).sqrt()
    };
    let errors = [(1, "a"), (4, "b"), (16, "c")].map(|(samples, name)| error(&drawn(samples, name)));
    eprintln!("measured: rms error of 1, 16 and 256 samples per pixel: {errors:?}");
    assert!(errors[1] < 0.5 * errors[0] && errors[2] < 0.5 * errors[1], "{errors:?}");
    assert_eq!(drawn(16, "again"), drawn(16, "c"), "equal runs give equal bits");
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let desk = Desk::new();
    assert!(desk.refused("render default -o a.png --layers").contains("EXR"));
    assert!(desk.refused("render default -o a.png --alpha --repeat 2").contains("--alpha"));
}

/// A bubble in a room with windows, out of focus, and a camera that turns while the shutter is open.
const LENS: &str = "version = 1\n[light]\nenvironment = 'windows'\n[view]\nbackdrop = [0.2, 0.1, 0.05]\ndither = false\n\
    [camera]\ndistance_m = 0.3\n[[camera.keyframe]]\nazimuth_deg = 0\nease = 'linear'\n[[camera.keyframe]]\ntime_s = 1\nazimuth_deg = 12\n\
    [lens]\naperture_mm = 12\nfocus_m = 0.2\nblades = 6\nshutter_s = 1\n[[bubble]]\n[bubble.film]\nstate = 'uniform'\nthickness_nm = 400\n";

#[test]
fn stills_are_blurred_by_lens_and_shutter_and_lose_no_light() {
    let desk = Desk::new();
    desk.write("lens.toml", LENS);
    let render = |name: &str, more: &str| {
        desk.done(&format!("render lens.toml -o {name} --size 48x32 {more}"))?;
        Some(colour(&read_exr(&desk.path(name)).unwrap(), ""))
    };
    let Some(few) = render("few.exr", "--samples 4") else { return };
    let other = |name: &str, more: &str| render(name, more).unwrap();
    let many = other("many.exr", "--samples 10");
    let sharp = other("sharp.exr", "--samples 4 --set lens.aperture_mm=0 --set lens.shutter_s=0");
    let still = other("still.exr", "--samples 4 --set lens.shutter_s=0");
    let mean = |a: &[[f32; 3]], b: &[[f32; 3]]| {
        let pairs = a.as_flattened().iter().zip(b.as_flattened());
        pairs.map(|(a, b)| (a - b).abs()).sum::<f32>() / a.as_flattened().len() as f32
    };
    let [error, lens, shutter] = [mean(&few, &many), mean(&still, &sharp), mean(&few, &still)];
    eprintln!("measured: error {error:.5}, lens {lens:.5}, shutter {shutter:.5}");
    // 16 samples against 100: a quarter of the blur is left of single samples.
    assert!(lens > 0.003 && shutter > 0.003 && error < 0.5 * lens.min(shutter), "{error} {lens} {shutter}");
    let white = other("white.exr", "--samples 3 --set light.constant=[1,1,1] --set view.backdrop=\"environment\"");
    assert!(max_difference(&white, &vec![[1.0; 3]; 48 * 32]) < 1e-3);
}
