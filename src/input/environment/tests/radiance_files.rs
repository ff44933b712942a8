use super::*;

/// A Radiance picture without run lengths: (mantissas, exponent) for every pixel.
fn radiance(header: &str, width: usize, height: usize, pixel: [u8; 4]) -> Vec<u8> {
    let mut bytes = format!("{header}\n\n-Y {height} +X {width}\n").into_bytes();
    (0..width * height).for_each(|_| bytes.write_all(&pixel).unwrap());
    bytes
}

#[test]
fn reads_radiance_pictures_with_their_headers() {
    // Mantissa 128 of exponent 129 is 128/256 · 2 = 1; of 127 and 128 it is 1/4 and 1/2.
    let first = |header: &str| load("a.hdr", &radiance(header, 4, 2, [128, 128, 128, 129])).unwrap().pixels()[0];
    let white = first("#?RADIANCE\nFORMAT=32-bit_rle_rgbe");
    assert!(Vec3::from(white).distance(Vec3::ONE) < 1e-6, "{white:?}");
    assert_eq!(first("#?RGBE\nFORMAT=32-bit_rle_rgbe"), white);
    let halved = first("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.0");
    assert!(Vec3::from(halved).distance(Vec3::splat(0.5)) < 1e-6, "{halved:?}");

    let red =
        radiance("#?RADIANCE\nPRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290", 4, 2, [128, 0, 0, 129]);
    let red = load("a.hdr", &red).unwrap().pixels()[0];
    assert!(Vec3::from(red).distance(Vec3::X) < 1e-6, "{red:?}");
}

/// A picture of 4x2 pixels that tell their column by red and their row by green, its scan lines as a resolution line says.
fn oriented(resolution: &str, position: impl Fn(usize, usize) -> (u8, u8), [lines, pixels]: [usize; 2]) -> Vec<u8> {
    let mut bytes = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{resolution}\n").into_bytes();
    for (line, pixel) in (0..lines).flat_map(|line| (0..pixels).map(move |pixel| (line, pixel))) {
        let (x, y) = position(line, pixel);
        bytes.extend([x * 32, y * 32, 128, 129]);
    }
    bytes
}

#[test]
fn all_eight_orders_of_pixels_are_one_picture() {
    let flip = |k: usize, count: usize| count - 1 - k;
    let at = |x: usize, y: usize| (x as u8, y as u8);
    let expected = load("a.hdr", &oriented("-Y 2 +X 4", |line, pixel| at(pixel, line), [2, 4])).unwrap();
    assert!(Vec3::from(expected.pixels()[0]).y < Vec3::from(expected.pixels()[4]).y, "green grows downwards");
    for bytes in [
        oriented("-Y 2 -X 4", |line, pixel| at(flip(pixel, 4), line), [2, 4]),
        oriented("+Y 2 +X 4", |line, pixel| at(pixel, flip(line, 2)), [2, 4]),
        oriented("+Y 2 -X 4", |line, pixel| at(flip(pixel, 4), flip(line, 2)), [2, 4]),
        oriented("+X 4 -Y 2", at, [4, 2]),
        oriented("-X 4 -Y 2", |line, pixel| at(flip(line, 4), pixel), [4, 2]),
        oriented("+X 4 +Y 2", |line, pixel| at(line, flip(pixel, 2)), [4, 2]),
        oriented("-X 4 +Y 2", |line, pixel| at(flip(line, 4), flip(pixel, 2)), [4, 2]),
    ] {
        let resolution = String::from_utf8_lossy(&bytes[35..44]).into_owned();
        assert_eq!(load("a.hdr", &bytes).unwrap().pixels(), expected.pixels(), "{resolution}");
    }
    for wrong in ["-Y 2 +Y 4", "2 4", "-Y 2 +X four", "-Y 2", ""] {
        let message = message("a.hdr", &oriented(wrong, |_, _| (0, 0), [2, 4]));
        assert!(message.contains(&format!("its resolution line is `{wrong}`")), "{message}");
    }
}

#[test]
fn radiance_headers_are_read_as_people_have_them() {
    let told = |header: &str, pixel| load_told("a.hdr", &radiance(header, 4, 2, pixel));
    let plain = told("#?RADIANCE\nFORMAT=32-bit_rle_rgbe", [128, 64, 32, 129]).0;
    for header in [
        "#?RADIANCE\nPRIMARIES=0 0 0 0 0 0 0 0\nFORMAT=32-bit_rle_rgbe",
        "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n# made by hand\r",
        "#?RGBE",
        "#?RADIANCE\nFORMAT = 32-bit_rle_rgbe \nGAMMA=1\nPIXASPECT=1.0\nrpict -vp 0 0 0\nSOFTWARE=a=b",
        "#?RADIANCE\nEXPOSURE=2\nEXPOSURE= 0.5 \nCOLORCORR=2 1 4\nCOLORCORR=0.5 1 0.25",
        "#?RADIANCE\n\tEXPOSURE=7\n\tFORMAT=something older",
    ] {
        let bytes = radiance(header, 4, 2, [128, 64, 32, 129]);
        let bytes = if header.ends_with('\r') { with_carriage_returns(&bytes, header) } else { bytes };
        let (environment, notes) = load_told("a.hdr", &bytes);
        assert_eq!(environment.pixels(), plain.pixels(), "{header:?}");
        assert_eq!(notes, [] as [&str; 0], "{header:?}");
    }
    for (line, reason) in [
        ("EXPOSURE=0", "is no positive number"),
        ("EXPOSURE=bright", "is no positive number"),
        ("COLORCORR=1 2", "is not three positive numbers"),
        ("PRIMARIES=0.64 0.33", "is not eight numbers"),
    ] {
        let (environment, notes) = told(&format!("#?RADIANCE\n{line}"), [128, 64, 32, 129]);
        assert_eq!(environment.pixels(), plain.pixels(), "{line}");
        assert_eq!(notes, [format!("has a line `{line}` in its header, which {reason} and is ignored")]);
    }
    let (_, notes) = told("#?RADIANCE\nPRIMARIES=1 1 1 1 1 1 1 1", [128, 64, 32, 129]);
    assert_eq!(notes, ["has chromaticities of no valid colour space and is read as BT.709"]);
    let message = message("a.hdr", &radiance("#?RADIANCE\nFORMAT=Radiance_spectra", 4, 2, [0; 4]));
    assert!(message.contains("its FORMAT is `Radiance_spectra`"), "{message}");
}

/// The bytes with `\r\n` after the resolution line too.
fn with_carriage_returns(bytes: &[u8], header: &str) -> Vec<u8> {
    let resolution = b"-Y 2 +X 4\n";
    let (header, pixels) = (header.as_bytes(), &bytes[header.len() + 2 + resolution.len()..]);
    [header, b"\n\r\n-Y 2 +X 4\r\n", pixels].concat()
}

#[test]
fn radiance_pictures_in_xyz_have_their_own_space() {
    let first = |header: &str, pixel| Vec3::from(load("a.hdr", &radiance(header, 4, 2, pixel)).unwrap().pixels()[0]);
    let xyz = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\nPRIMARIES=0.64 0.33 0.3 0.6 0.15 0.06 0.3127 0.329";
    assert!(first(xyz, [128, 128, 128, 129]).distance(Vec3::ONE) < 1e-6, "equal energy is white");
    let expected = (CIE_XYZ.to_bt2020().unwrap() * DVec3::new(1.0, 1.25, 0.5)).as_vec3().max(Vec3::ZERO);
    assert!(first(xyz, [128, 160, 64, 129]).distance(expected) < 1e-6);
    // Luminance in cd/m², as Radiance's own conversion writes it: the exposure is 1 / 179.
    let luminance = "#?RADIANCE\nFORMAT=32-bit_rle_xyze\nEXPOSURE=5.586592e-03";
    assert!(first(luminance, [128, 128, 128, 129]).distance(Vec3::ONE) < 1e-5);
}

#[test]
fn radiance_scan_lines_may_be_packed_or_flat() {
    let flat = load("a.hdr", &radiance("#?RADIANCE", 8, 4, [128, 64, 32, 129])).unwrap();
    let packed = |line: &[u8]| {
        let mut bytes = b"#?RADIANCE\n\n-Y 4 +X 8\n".to_vec();
        (0..4).for_each(|_| bytes.extend(line));
        load("a.hdr", &bytes).unwrap()
    };
    let runs = [2, 2, 0, 8, 136, 128, 136, 64, 136, 32, 136, 129];
    assert_eq!(packed(&runs).pixels(), flat.pixels());
    let old_runs = [128, 64, 32, 129, 1, 1, 1, 7];
    assert_eq!(packed(&old_runs).pixels(), flat.pixels());
}

#[test]
fn radiance_pictures_cut_short_are_damaged() {
    let bytes = radiance("#?RADIANCE\nFORMAT=32-bit_rle_rgbe", 4, 2, [128, 128, 128, 129]);
    for length in 2..bytes.len() {
        let error = load("a.hdr", &bytes[..length]).unwrap_err();
        assert!(!matches!(error, InputError::Unreadable { .. }), "{length} bytes: {error}");
    }
}
