use super::*;

#[test]
fn reads_every_lossless_compression_and_sample_type() {
    use openexr::Compression::{PIZ, RLE, Uncompressed, ZIP1, ZIP16};
    for compression in [Uncompressed, RLE, ZIP1, ZIP16, PIZ] {
        for half in [false, true] {
            let environment = load("a.exr", &Exr { compression, half, ..Exr::default() }.bytes()).unwrap();
            assert_eq!((environment.width(), environment.height()), (8, 4));
            assert_pixels(&environment, BT709.to_bt2020().unwrap());
        }
    }
}

#[test]
fn reads_lossy_compressions() {
    for compression in [openexr::Compression::DWAA(None), openexr::Compression::DWAB(None)] {
        let picture = Exr { size: (64, 32), compression, half: true, ..Exr::default() };
        let environment = load("a.exr", &picture.bytes()).unwrap();
        let expected = convert(panorama(64, 32), BT709.to_bt2020().unwrap());
        for (&pixel, expected) in environment.pixels().iter().zip(expected) {
            // The compression's default level promises about 1 % of what the eye would see; dark pixels beside bright ones
            // fare worse.
            let error = Vec3::from(pixel).distance(Vec3::from(expected));
            assert!(error < 0.02 * Vec3::from(expected).length() + 2.0, "{pixel:?}, expected {expected:?}");
        }
    }
}

#[test]
fn honours_chromaticities() {
    let point = |x, y| openexr::Vec2(x, y);
    let chromaticities = openexr::attribute::Chromaticities {
        red: point(0.708, 0.292),
        green: point(0.170, 0.797),
        blue: point(0.131, 0.046),
        white: point(0.3127, 0.3290),
    };
    let environment = load("a.exr", &Exr { chromaticities: Some(chromaticities), ..Exr::default() }.bytes()).unwrap();
    assert_pixels(&environment, DMat3::IDENTITY);

    let grey =
        openexr::attribute::Chromaticities { red: chromaticities.blue, green: chromaticities.blue, ..chromaticities };
    let (environment, told) = load_told("a.exr", &Exr { chromaticities: Some(grey), ..Exr::default() }.bytes());
    assert_pixels(&environment, BT709.to_bt2020().unwrap());
    assert_eq!(told, ["has chromaticities of no valid colour space and is read as BT.709"]);
}

#[test]
fn chromaticities_of_zeros_are_not_stated_and_those_of_xyz_are() {
    let point = |x, y| openexr::Vec2(x, y);
    let zero = point(0.0, 0.0);
    let zeros = openexr::attribute::Chromaticities { red: zero, green: zero, blue: zero, white: zero };
    let third = 1.0 / 3.0;
    let xyz = openexr::attribute::Chromaticities {
        red: point(1.0, 0.0),
        green: point(0.0, 1.0),
        blue: zero,
        white: point(third, third),
    };
    for (stated, space) in [(zeros, BT709), (xyz, CIE_XYZ)] {
        let picture = Exr { chromaticities: Some(stated), ..Exr::default() };
        let (environment, _) = load_told("a.exr", &picture.bytes());
        let expected = convert(panorama(8, 4), space.to_bt2020().unwrap());
        for (&pixel, expected) in environment.pixels().iter().zip(expected) {
            let expected = Vec3::from(expected).max(Vec3::ZERO);
            assert!(Vec3::from(pixel).distance(expected) <= 1e-6 * expected.length(), "{pixel:?} {expected}");
        }
    }
}

#[test]
fn finds_colours_in_named_channels_and_later_layers() {
    let named = Exr { names: ["light.R", "light.G", "light.B"], ..Exr::default() };
    assert_pixels(&load("a.exr", &named.bytes()).unwrap(), BT709.to_bt2020().unwrap());

    let depth = Exr { names: ["X", "Y", "Z"], ..Exr::default() };
    let layers = [depth.layer(), named.layer()].into_iter().collect::<openexr::Layers<_>>();
    let image = openexr::Image::from_layers(openexr::ImageAttributes::with_size((8, 4)), layers);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    assert_pixels(&load("a.exr", &bytes.into_inner()).unwrap(), BT709.to_bt2020().unwrap());
}

#[test]
fn pictures_without_colours_are_refused() {
    let message = message("a.exr", &Exr { names: ["X", "Y", "Z"], ..Exr::default() }.bytes());
    assert!(message.ends_with("has no layer with R, G and B channels (it has X, Y, Z): save it as RGB"), "{message}");
}

/// The level of a picture that is red (or grey) alone, in BT.709.
fn level(environment: &Equirect) -> f32 {
    let from_bt2020 = BT709.to_bt2020().unwrap().inverse().as_mat3();
    let pixel = from_bt2020 * Vec3::from(environment.pixels()[0]);
    (pixel.x * 1e4).round() / 1e4
}

#[test]
fn the_layer_that_is_the_picture_is_taken_and_told() {
    let one = ["View.AO.R", "View.AO.G", "View.AO.B", "View.Combined.R", "View.Combined.G", "View.Combined.B"];
    let (_, told) = load_told("a.exr", &parts([part("", &one, 3.0)]));
    assert_eq!(told, ["shows the layer `View.Combined`, not the layer `View.AO`"]);

    let unnamed = ["R", "G", "B", "N.R", "N.G", "N.B"];
    let (_, told) = load_told("a.exr", &parts([part("", &unnamed, 3.0)]));
    assert_eq!(told, ["shows the layer without a name, not the layer `N`"]);

    for picture in ["rgba", "RGBA", "View Layer.Combined", "beauty"] {
        let rgb = ["R", "G", "B"];
        let bytes = parts([part("normal", &rgb, 2.0), part("diffuse", &rgb, 3.0), part(picture, &rgb, 4.0)]);
        let (environment, told) = load_told("a.exr", &bytes);
        assert_eq!(level(&environment), 4.0, "{picture}");
        let expected = format!("shows the layer `{picture}`, not the layer `diffuse`, the layer `normal`");
        assert_eq!(told, [expected]);
    }
    let (environment, told) = load_told("a.exr", &parts([part("", &["R", "G", "B"], 3.0)]));
    assert_eq!((level(&environment), told.len()), (3.0, 0), "there is nothing to choose");
}

#[test]
fn channels_have_other_names_too() {
    for names in [["r", "g", "b"], ["light.red", "light.green", "light.blue"], ["Red", "Green", "Blue"]] {
        assert_eq!(level(&load("a.exr", &parts([part("", &names, 3.0)])).unwrap()), 3.0, "{names:?}");
    }
    let (grey, _) = load_told("a.exr", &parts([part("", &["Y", "Z"], 3.0)]));
    assert!(Vec3::from(grey.pixels()[0]).distance(Vec3::splat(3.0)) < 1e-5, "luminance alone is a grey picture");
    assert!(message("a.exr", &parts([part("", &["BY", "RY", "Y"], 3.0)])).contains("(it has BY, RY, Y)"));
}

/// Makes the first of two parts, named `deep`, one of deep data, whose pixels nobody here can read.
fn deepen(mut bytes: Vec<u8>) -> Vec<u8> {
    let mut replace = |old: &[u8], new: &[u8]| {
        let at = bytes.windows(old.len()).position(|window| window == old).unwrap();
        bytes.splice(at..at + old.len(), new.iter().copied());
    };
    // One name grows by the letter that the other loses: everything stays where the tables say.
    replace(b"string\0\x0d\0\0\0scanlineimage", b"string\0\x0c\0\0\0deepscanline");
    replace(b"string\0\x04\0\0\0deep", b"string\0\x05\0\0\0deep_");
    bytes[5] |= 0x08;
    bytes
}

#[test]
fn the_flat_part_beside_a_deep_one_is_taken() {
    let rgb = ["R", "G", "B"];
    let bytes = deepen(parts([part("deep", &rgb, 2.0), part("flat", &rgb, 3.0)]));
    let (environment, told) = load_told("a.exr", &bytes);
    assert_eq!(level(&environment), 3.0);
    assert_eq!(told, ["shows the layer `flat`"]);
    let message = message("a.exr", &deepen(parts([part("deep", &rgb, 2.0), part("z", &["Z"], 3.0)])));
    assert!(message.contains("(it has Z)"), "{message}");
}

#[test]
fn an_unsupported_file_is_not_called_damaged() {
    let bytes = Exr { compression: openexr::Compression::ZIP16, ..Exr::default() }.bytes();
    let compression = b"compression\0compression\0\x01\0\0\0";
    let at = compression.len() + bytes.windows(compression.len()).position(|window| window == compression).unwrap();
    for (code, told) in
        [(10, "its compression is HTJ2K"), (11, "its compression is HTJ2K"), (12, "unknown compression")]
    {
        let mut changed = bytes.clone();
        changed[at] = code;
        let message = message("a.exr", &changed);
        assert!(message.contains(told) && message.contains("ZIP or PIZ"), "{message}");
    }
    // The channel `B`: kind, three bytes of reserve, and its sampling in x and y.
    let channel = b"B\0\x02\0\0\0\0\0\0\0\x01\0\0\0\x01";
    let at = bytes.windows(channel.len()).position(|window| window == channel).unwrap();
    let mut changed = bytes.clone();
    (changed[at + channel.len() - 5], changed[at + channel.len() - 1]) = (2, 2);
    let message = message("a.exr", &changed);
    assert!(message.contains("its channels are subsampled"), "{message}");
}

/// The stored pixels of [`Exr`] at a place in a picture of some size.
fn windowed(position: (i32, i32), size: (usize, usize)) -> Vec<u8> {
    let mut image = openexr::Image::from_layer(Exr::default().layer());
    image.layer_data.attributes.layer_position = openexr::Vec2(position.0, position.1);
    image.attributes.display_window = openexr::IntegerBounds::new((0, 0), size);
    let mut bytes = Cursor::new(Vec::new());
    image.write().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

#[test]
fn stored_pixels_have_their_place_in_the_picture() {
    let to_bt2020 = BT709.to_bt2020().unwrap();
    let stored = convert(panorama(8, 4), to_bt2020);
    // The same size is the same window, wherever it lies.
    for position in [(0, 0), (100, 50), (-3, 2)] {
        let (environment, told) = load_told("a.exr", &windowed(position, (8, 4)));
        assert_pixels(&environment, to_bt2020);
        assert_eq!(told.len(), 0);
    }
    let (environment, told) = load_told("a.exr", &windowed((5, 2), (16, 8)));
    assert_eq!(told, ["holds only 8x4 of its 16x8 pixels; the others are black"]);
    for (index, pixel) in environment.pixels().iter().enumerate() {
        let (x, y) = ((index % 16).wrapping_sub(5), (index / 16).wrapping_sub(2));
        let expected = if x < 8 && y < 4 { stored[y * 8 + x] } else { [0.0; 3] };
        assert_eq!(*pixel, expected, "{index}");
    }
    let (environment, told) = load_told("a.exr", &windowed((-2, -1), (4, 2)));
    assert_eq!(environment.pixels()[..4], stored[10..14]);
    assert_eq!((environment.width(), environment.height(), told.len()), (4, 2, 0));
    let outside = windowed((16, 0), (16, 8));
    assert!(
        message("a.exr", &outside).contains("its data window, 8x4 pixels at 16,0, is outside of its display window")
    );
}

#[test]
fn a_file_cut_short_anywhere_is_damaged() {
    for compression in [openexr::Compression::ZIP16, openexr::Compression::PIZ, openexr::Compression::Uncompressed] {
        let bytes = Exr { size: (64, 32), compression, ..Exr::default() }.bytes();
        for length in (4..bytes.len()).step_by(97) {
            let error = load("a.exr", &bytes[..length]).unwrap_err();
            assert!(matches!(error, InputError::Damaged { .. }), "{length} bytes of {}: {error}", bytes.len());
        }
    }
}

#[test]
fn no_flipped_byte_panics() {
    for compression in [openexr::Compression::ZIP16, openexr::Compression::PIZ, openexr::Compression::DWAA(None)] {
        let bytes = Exr { size: (16, 8), compression, half: true, ..Exr::default() }.bytes();
        for position in 4..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[position] ^= [0xff, 0x80, 0x01][position % 3];
            // Flips in pixels, names or comments may leave a good file: an error or a picture, both are fine.
            let _ = load("a.exr", &damaged);
        }
    }
}
