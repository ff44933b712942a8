//! Colours, spectra, films and tables by command.

use std::{path::Path, process::Command};

use soapfilm::output::read_back::read_exr;

use super::*;

#[test]
fn colours_come_in_the_promised_columns() {
    let desk = Desk::new();
    desk.write("points.csv", "thickness_nm,cos_theta,back_nm,exit_nm\n320,0.8,,\n320,0.8,500,310\n0,1,,\n");
    let Some(run) = desk.done("colour --points points.csv --spectrum") else { return };
    let mut lines = run.out.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    assert_eq!(header[..10], ["thickness_nm", "cos_theta", "back_nm", "exit_nm", "X", "Y", "Z", "r", "g", "b"]);
    assert_eq!((header[10], *header.last().unwrap(), header.len()), ("R360", "R780", 10 + 85));
    let rows: Vec<_> = lines.collect();
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[0][..4], ["320", "0.8", "", ""]);
    let y = |row: usize| rows[row][5].parse::<f64>().unwrap();
    assert!(y(1) > y(0) && y(0) > 0.0 && y(2) == 0.0, "{} {} {}", y(0), y(1), y(2));
    let reference = desk.run("colour --points points.csv --quality reference");
    let truth: f64 = reference.out.lines().nth(1).unwrap().split(',').nth(5).unwrap().parse().unwrap();
    assert!((y(0) / truth - 1.0).abs() < 0.002, "{} {truth}", y(0));
}

/// Two walls by arguments give what a list gives, and light leaves through the front wall where it came in unless told otherwise.
#[test]
fn two_walls_are_given_as_arguments_too() {
    let desk = Desk::new();
    desk.write("points.csv", "thickness_nm,cos_theta,back_nm,exit_nm\n320,0.8,500,320\n320,0.8,500,310\n");
    let answer = |arguments: &str| {
        let run = desk.run(&format!("colour {arguments} --quality reference"));
        assert!(run.success, "{}", run.err);
        run.out
    };
    let list = answer("--points points.csv");
    let rows: Vec<&str> = list.lines().collect();
    let one = "--thickness 320 --cos 0.8 --back 500";
    assert_eq!(answer(one).lines().collect::<Vec<_>>(), [rows[0], rows[1]]);
    assert_eq!(answer(&format!("{one} --exit 310")).lines().nth(1), Some(rows[2]));
    for (wrong, told) in [
        ("--thickness -3 --cos 1", "between 0 and 30000 nm"),
        ("--thickness 320 --cos -0.1", "between 0 and 1"),
        ("--thickness 320 --cos 1 --exit 300", "--back"),
        ("--points points.csv --back 300", "--points"),
    ] {
        assert!(desk.refused(&format!("colour {wrong} --quality reference")).contains(told), "{wrong}");
    }
}

/// An angle is its cosine, and sRGB stands after the columns that were always there.
#[test]
fn angles_and_srgb() {
    let desk = Desk::new();
    let rows = |arguments: &str| {
        let run = desk.run(&format!("colour --thickness 320 {arguments} --quality reference"));
        assert!(run.success, "{}", run.err);
        run.out.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<_>>>()
    };
    let by_angle = rows("--angle 60");
    assert_eq!(by_angle[0], ["thickness_nm", "cos_theta", "X", "Y", "Z", "r", "g", "b", "s_r", "s_g", "s_b"]);
    let numbers = |row: &[String]| row.iter().map(|text| text.parse::<f64>().unwrap()).collect::<Vec<_>>();
    let (angle, cosine) = (numbers(&by_angle[1]), numbers(&rows("--cos 0.5")[1]));
    assert!(angle.iter().zip(&cosine).all(|(a, b)| (a - b).abs() < 1e-12), "{angle:?} {cosine:?}");
    let linear = soapfilm::physics::colour::bt2020_to_bt709() * glam::DVec3::from_slice(&angle[5..8]);
    for (encoded, linear) in angle[8..].iter().zip(linear.to_array()) {
        assert!((soapfilm::physics::colour::srgb_decode(*encoded) - linear).abs() < 1e-12, "{encoded} {linear}");
    }
    let spectrum = &rows("--angle 60 --spectrum")[0];
    assert_eq!((spectrum[8].as_str(), spectrum.len()), ("R360", 8 + 85), "scripts count columns from either end");
    for (wrong, told) in [
        ("--angle 91", "between 0 and 90 degrees"),
        ("--angle -1", "between 0 and 90 degrees"),
        ("--angle 30 --cos 1", "--cos"),
        ("", "--cos"),
    ] {
        let line = desk.refused(&format!("colour --thickness 320 {wrong} --quality reference"));
        assert!(line.contains(told), "{wrong}: {line}");
    }
}

/// A spectrum in rows is that in columns, and what is not reflected passes.
#[test]
fn spectra_come_in_rows_too() {
    let desk = Desk::new();
    let answer = |arguments: &str| {
        let run = desk.run(&format!("colour {arguments} --quality reference"));
        assert!(run.success, "{}", run.err);
        run.out
    };
    let rows = answer("--thickness 320 --cos 0.8 --spectrum rows");
    assert!(rows.starts_with("wavelength_nm,R,T\n360,") && rows.lines().count() == 86, "{rows}");
    let columns = answer("--thickness 320 --cos 0.8 --spectrum");
    let columns: Vec<&str> = columns.lines().nth(1).unwrap().split(',').skip(8).collect();
    for (row, column) in rows.lines().skip(1).zip(columns) {
        let parts: Vec<&str> = row.split(',').collect();
        assert_eq!(parts[1], column);
        let [r, t] = [parts[1], parts[2]].map(|text| text.parse::<f64>().unwrap());
        assert!((r + t - 1.0).abs() < 1e-15, "{row}");
    }
    assert_eq!(answer("--thickness 320 --cos 0.8 --spectrum columns").lines().count(), 2);
    desk.write("points.csv", "thickness_nm,cos_theta\n320,0.8\n320,0.9\n");
    let line = desk.refused("colour --points points.csv --spectrum rows");
    assert!(line.contains("one film"), "{line}");
}

/// A mistake in a list of films is told with its file and line.
#[test]
fn broken_points_are_refused_by_file_and_line() {
    let desk = Desk::new();
    for (text, told) in [
        ("thickness_nm\n300\n", "points.csv:1: no column `cos_theta`"),
        ("thickness_nm,cos_theta\n", "points.csv: no points"),
        ("thickness_nm,cos_theta\n300,nan\n", "points.csv:2: cos_theta `nan`"),
        ("thickness_nm,cos_theta\n300,0.5\n\n-3,0.5\n", "points.csv:4: thickness_nm `-3`"),
        ("thickness_nm,cos_theta\n300,0.5\n300,0.5,7\n", "points.csv:3: 3 values for 2 columns"),
        ("thickness_nm,cos_theta,back_nm\n300,0.5,200\n", "points.csv:2: exit_nm is missing"),
    ] {
        desk.write("points.csv", text);
        let line = desk.refused("colour --points points.csv");
        assert!(line.contains(told), "{text}: {line}");
    }
}

/// A mistake in a spectrum is told with its file and line, and nothing is written.
#[test]
fn broken_spectra_are_refused_by_file_and_line() {
    let desk = Desk::new();
    for (file, text, told) in [
        ("nan.csv", "360,1\n500,nan\n780,1\n", "nan.csv, line 2: `nan`"),
        ("negative.csv", "nm,power\n360,1\n500,-2\n780,1\n", "negative.csv, line 3: -2 is negative"),
        ("order.csv", "360,1\n700,1\n500,1\n780,1\n", "order.csv, line 3: 500 nm follows 700 nm"),
        ("short.csv", "400,1\n700,1\n", "short.csv: covers 400 to 700 nm"),
        ("zero.csv", "360,0\n780,0\n", "zero.csv: has no usable power"),
        ("ultraviolet.csv", "360,1\n366,0\n780,0\n", "ultraviolet.csv: cannot be seen"),
        ("empty.csv", "", "empty.csv: has no data"),
    ] {
        desk.write(file, text);
        let line = desk.refused(&format!("colour --thickness 300 --cos 1 --illuminant {file}"));
        assert!(line.contains(told), "{file}: {line}");
        desk.write("scene.toml", format!("version = 1\n[light]\nilluminant = \"{file}\"\n"));
        let line = desk.refused("render scene.toml -o a.png --size 16x9");
        assert!(line.contains(told), "{file}: {line}");
    }
    desk.write("n.csv", "360,1.4\n500,0.5\n780,1.3\n");
    assert!(desk.refused("colour --thickness 300 --cos 1 --film n.csv").contains("n.csv, line 2"));
}

#[test]
fn films_and_lights_from_files_are_used() {
    let desk = Desk::new();
    desk.write("n.csv", "nm,n\n360,1.33\n780,1.33\n");
    desk.write("light.csv", "nm,power\n360,1\n780,1\n");
    let y = |arguments: &str| {
        let run = desk.run(&format!("colour --thickness 300 --cos 0.8 --quality reference {arguments}"));
        assert!(run.success, "{}", run.err);
        run.out.lines().nth(1).unwrap().split(',').nth(3).unwrap().parse::<f64>().unwrap()
    };
    assert!((y("--film n.csv --illuminant light.csv") - y("--film 1.33 --illuminant E")).abs() < 1e-15);
    assert!((y("--illuminant sodium") - y("--illuminant D65")).abs() > 1e-3);
    assert!((y("--film water") - y("--skin 2")).abs() > 1e-5);
}

/// The table is a picture with its axes in the header, and the functions beside it are shaders.
#[test]
fn tables_come_with_shaders_that_compile() {
    let desk = Desk::new();
    let run = desk.run("lut -o film.exr --size 8x32 --film 1.4 --illuminant A");
    assert!(run.success, "{}", run.err);
    let table = read_exr(&desk.path("film.exr")).unwrap();
    assert_eq!((table.width, table.height), (8, 32));
    assert!(table.metadata.get("Columns").unwrap().starts_with("8, "));
    assert!(table.channel("G").unwrap()[..8].iter().all(|value| *value == 0.0), "no film is black");
    let text = std::fs::read_to_string(desk.path("film.txt")).unwrap();
    let snippet = |language: &str| {
        let start = text.split(&format!("---- {language} ----\n")).nth(1).unwrap();
        start.split("\n----").next().unwrap().to_owned()
    };
    let wgsl = snippet("WGSL")
        + "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;\n\
           @fragment fn main() -> @location(0) vec4f { return vec4f(film_reflection(t, s, 0.5, 300.0), 1.0); }\n";
    validate(&naga::front::wgsl::parse_str(&wgsl).unwrap());
    let glsl = format!(
        "#version 450\nlayout(set = 0, binding = 0) uniform sampler2D t;\nlayout(location = 0) out vec4 o;\n{}\
         void main() {{ o = vec4(film_reflection(t, 0.5, 300.0), 1.0); }}\n",
        snippet("GLSL")
    );
    let hlsl = snippet("HLSL")
        + "Texture2D<float4> t : register(t0);\nSamplerState s : register(s1);\n\
           float4 main() : SV_Target { return float4(film_reflection(t, s, 0.5, 300.0), 1.0); }\n";
    let nowhere = Path::new("/dev/null");
    glslang(&desk, "film.frag", &glsl, &[], nowhere);
    glslang(&desk, "film.hlsl", &hlsl, &["-D", "-S", "frag", "-e", "main"], nowhere);
}

fn validate(module: &naga::Module) {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(module).unwrap();
}

/// Where the tool is there, or must be, a shader must compile: to SPIR-V for Vulkan in a file, or for OpenGL to nothing where none is named.
/// Whether it was there.
pub fn glslang(desk: &Desk, file: &str, text: &str, options: &[&str], spirv: &Path) -> bool {
    if !support::has_tools(&["glslangValidator"], support::REQUIRE_TOOLS) {
        return false;
    }
    desk.write(file, text);
    let mut command = Command::new("glslangValidator");
    if !spirv.as_os_str().is_empty() {
        command.arg("-V").arg("-o").arg(spirv);
    }
    let run = command.args(options).arg(desk.path(file)).output().unwrap();
    assert!(run.status.success(), "{file}: {}", String::from_utf8_lossy(&run.stdout));
    true
}
