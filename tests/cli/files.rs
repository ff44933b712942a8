//! Environments and tables as other programs write them.

use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage};
use soapfilm::output::read_back::read_exr;

use super::*;

/// What stderr says of files.
fn notes(run: &Run) -> Vec<&str> {
    assert!(run.success, "{}", run.err);
    run.err.lines().filter_map(|line| line.strip_prefix("note: ")).collect()
}

/// A picture of an environment's file alone, in EXR, and what was told.
fn shown(desk: &Desk, file: &str) -> (Vec<f32>, Vec<String>) {
    let scene = "version = 1\nbubble = []\n[light]\nenvironment = \"FILE\"\n[view]\nbackdrop = \"environment\"\n";
    desk.write("scene.toml", scene.replace("FILE", file));
    let run = desk.run("render scene.toml -o a.exr --size 16x9 --quality reference");
    let told = notes(&run).into_iter().map(str::to_owned).collect();
    let picture = read_exr(&desk.path("a.exr")).unwrap();
    (["R", "G", "B"].iter().flat_map(|name| picture.channel(name).unwrap().to_vec()).collect(), told)
}

fn radiance(header: &str) -> Vec<u8> {
    let pixels = (0..32u8).flat_map(|i| [128 + i, 200 - i, 64 + 4 * i, 128]);
    header.bytes().chain(pixels).collect()
}

#[test]
fn headers_of_radiance_pictures_are_read_as_people_have_them() {
    let desk = Desk::new();
    desk.write("plain.hdr", radiance("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n"));
    desk.write("zero.hdr", radiance("#?RADIANCE\nPRIMARIES=0 0 0 0 0 0 0 0\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n"));
    desk.write("crlf.hdr", radiance("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 4 +X 8\r\n"));
    let plain = shown(&desk, "plain.hdr");
    assert!(plain.0.iter().any(|value| *value > 0.3) && plain.1.is_empty());
    assert_eq!(shown(&desk, "zero.hdr"), plain);
    assert_eq!(shown(&desk, "crlf.hdr"), plain);
}

#[test]
fn layers_and_repairs_are_told() {
    let desk = Desk::new();
    let channel = |name: &str, value: f32| AnyChannel::new(name, FlatSamples::F32(vec![value; 32]));
    let mut channels: Vec<_> =
        ["AO.R", "AO.G", "AO.B"].iter().map(|name| channel(&format!("View.{name}"), 1.0)).collect();
    channels.extend(["R", "G", "B"].iter().map(|name| channel(&format!("View.Combined.{name}"), 0.5)));
    let FlatSamples::F32(red) = &mut channels[3].sample_data else { panic!() };
    red[0] = f32::NAN;
    let channels = AnyChannels::sort(channels.into());
    let layer = Layer::new((8, 4), LayerAttributes::default(), Encoding::FAST_LOSSLESS, channels);
    Image::from_layer(layer).write().to_file(desk.path("layers.exr")).unwrap();
    let (values, told) = shown(&desk, "layers.exr");
    assert!(values.iter().all(|value| *value < 0.6), "ambient occlusion is 1");
    assert_eq!(
        told,
        [
            "layers.exr shows the layer `View.Combined`, not the layer `View.AO`",
            "layers.exr has pixels that no light can have: 1 NaN (made black)"
        ]
    );
}

#[test]
fn tables_are_read_as_people_have_them() {
    let desk = Desk::new();
    let answer = |arguments: &str| {
        let run = desk.run(&format!("colour --thickness 300 --cos 0.8 --quality reference {arguments}"));
        let told = notes(&run).len();
        (run.out, told)
    };
    desk.write("nm.csv", "nm,n\n300,1.3533\n450,1.3348\n600,1.3283\n800,1.3247\n");
    desk.write("um.csv", "wl,n\n0.3,1.3533\n0.45,1.3348\n0.6,1.3283\n0.8,1.3247\n\nwl,k\n0.3,1e-8\n0.8,1e-7\n");
    desk.write("semicolon.csv", "nm;n\r\n300;1,3533\r\n450;1,3348\r\n600;1,3283\r\n800;1,3247\r\n");
    let (plain, told) = answer("--film nm.csv");
    assert_eq!(told, 0);
    assert_eq!(answer("--film um.csv"), (plain.clone(), 2));
    assert_eq!(answer("--film semicolon.csv"), (plain, 0));
    desk.write("cie.csv", "380,0.2\n580,0.7\n780,1.2\n");
    desk.write("whole.csv", "360,0.2\n380,0.2\n580,0.7\n780,1.2\n");
    let (whole, told) = answer("--illuminant whole.csv");
    assert_eq!(told, 0);
    assert_eq!(answer("--illuminant cie.csv"), (whole, 1));
    desk.write("comma.csv", "300,1,3533\n800,1,3247\n");
    let line = desk.refused("colour --thickness 300 --cos 1 --film comma.csv");
    assert!(line.contains("comma.csv, line 1") && line.contains("decimal marks"), "{line}");
}

#[test]
fn points_are_read_like_other_tables() {
    let desk = Desk::new();
    let answer = |text: &str| {
        desk.write("points.csv", text);
        let run = desk.run("colour --points points.csv --quality reference");
        assert!(run.success, "{}", run.err);
        run.out
    };
    let plain = answer("thickness_nm,cos_theta,name\n300.5,0.8,a\n400,0.5,b\n");
    assert_eq!(answer("thickness_nm;cos_theta;name\r\n300,5;0,8;a\r\n# more\r\n400;0,5;b\r\n"), plain);
    assert_eq!(answer("\u{feff}\"thickness_nm\"\t\"cos_theta\"\t\"name\"\n300.5\t0.8\ta\n400\t0.5\tb\n"), plain);
    for (text, told) in [
        ("300,0.8\n", "points.csv:1: no column `thickness_nm`"),
        ("thickness_nm,cos_theta\n300,0,8\n", "points.csv:2: 3 values for 2 columns (columns are separated by commas"),
        ("thickness_nm,cos_theta\n300,0.8\nx,y\n400,0.5\n", "points.csv:3: no numbers, but a heading"),
    ] {
        desk.write("points.csv", text);
        let line = desk.refused("colour --points points.csv --quality reference");
        assert!(line.contains(told), "{line}");
    }
}
