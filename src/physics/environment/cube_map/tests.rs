use super::super::{MAX_RADIANCE, direction_of_uv};
use super::*;

/// Directions spread evenly over the sphere (a Fibonacci spiral), none on a face's edge.
fn directions(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let azimuth = i as f64 * 2.399_963_229_728_653;
        DVec3::new(azimuth.cos() * (1.0 - z * z).sqrt(), azimuth.sin() * (1.0 - z * z).sqrt(), z)
    })
}

#[test]
fn a_direction_finds_its_own_radiance() {
    let source = |direction: DVec3| direction.normalize() + 1.0;
    let map = CubeMap::from_fn(64, 2, source);
    for direction in directions(5000) {
        // A texel holds values below 2 to 2⁻⁹; the source bends by half of what a texel 2/64 wide, squared, holds; across an
        // edge the nearest neighbour may lie half a texel, 1/64, along it, weighed by a half at most.
        let error = (map.sample(direction) - source(direction)).abs().max_element();
        let on_edge = CubeFace::of_direction(direction).1.abs().max_element() > 1.0 - 1.0 / 64.0;
        assert!(error < if on_edge { 8e-3 } else { 0.5e-3 + 0.5f64.powi(9) }, "{direction}: {error}");
    }
}

#[test]
fn one_bright_texel_lies_where_the_gpu_would_find_it() {
    // Vulkan, +Y face (layer 2): s along +x, t along +z.
    let target = DVec3::new(0.375, 1.0, -0.625);
    let map = CubeMap::from_fn(8, 1, |direction| if direction == target { DVec3::ONE } else { DVec3::ZERO });
    let (column, row) = (5, 1); // s = (5 + ½)/4 − 1, t = (1 + ½)/4 − 1
    let lit: Vec<_> = (0..6).flat_map(|layer| (0..64).map(move |index| (layer, index))).collect();
    let lit: Vec<_> = lit.into_iter().filter(|&(layer, index)| map.mips[0].radiance(layer, index).x > 0.0).collect();
    assert_eq!(lit, [(2, row * 8 + column)]);
    assert_eq!(map.sample(target), DVec3::ONE);
}

#[test]
fn a_bright_pixel_of_a_panorama_shines_from_its_direction() {
    let (width, height) = (64, 32);
    for (column, row) in [(0, 16), (63, 10), (20, 2), (40, 30), (48, 16)] {
        let mut pixels = vec![[0.0; 3]; width * height];
        pixels[row * width + column] = [1.0; 3];
        let map = CubeMap::from_equirect(&Equirect::new(width, height, pixels).unwrap());
        let uv = DVec2::new((column as f64 + 0.5) / width as f64, (row as f64 + 0.5) / height as f64);
        let shown = direction_of_uv(uv);
        let brightest = directions(20000).max_by(|a, b| map.sample(*a).x.total_cmp(&map.sample(*b).x)).unwrap();
        // The pixel is 0.1 wide, and the directions tried lie 0.025 apart.
        assert!(shown.distance(brightest) < 0.08, "pixel ({column}, {row}) shines from {brightest}, not {shown}");
    }
}

#[test]
fn interpolation_is_continuous_across_faces() {
    let map = CubeMap::from_fn(8, 1, |direction| DVec3::splat((7.0 * direction.normalize()).sin().element_sum() + 3.0));
    for t in (0..100).map(|i| f64::from(i) / 50.0 - 0.99) {
        let [near, far] = [1e-9, -1e-9].map(|offset| map.sample(DVec3::new(1.0 + offset, t, 1.0)));
        // Neighbouring texels differ by about 1; a seam would show as a jump of that order. Half a texel's shift along the
        // edge is what nearest neighbours across it may cost.
        assert!(near.distance(far) < 0.5, "t = {t}: {near} and {far}");
    }
}

#[test]
fn mips_have_gpu_sizes_and_keep_the_mean() {
    for size in [1, 16, 48, 176] {
        let map = CubeMap::from_fn(size, 1, |direction| direction.normalize() * 0.5 + 1.0);
        let sizes: Vec<_> = map.mips().iter().map(|level| level.size).collect();
        assert_eq!(sizes.len(), size.ilog2() as usize + 1);
        assert!(sizes.windows(2).all(|pair| pair[1] == pair[0] / 2));
        for layer in 0..6 {
            let mean = |level: &CubeLevel| {
                let texels = level.size * level.size;
                (0..texels).map(|index| level.radiance(layer, index)).sum::<DVec3>() / texels as f64
            };
            for level in map.mips() {
                // A texel holds values below 2 to 2⁻⁹, in each of three components.
                assert!(mean(level).distance(mean(&map.mips()[0])) < 2e-3, "size {size}, level {}", level.size);
            }
        }
    }
}

#[test]
fn mean_radiance_weighs_by_solid_angle() {
    let white = CubeMap::constant(DVec3::new(0.25, 0.5, 2.0));
    assert!(white.mean_radiance().distance(DVec3::new(0.25, 0.5, 2.0)) < 1e-12);
    // The mean of z² over the sphere is 1/3; weighing texels equally would give (1/3)(1 + 2 (π/4 − ...)), several per cent off.
    let lobe = CubeMap::from_fn(128, 1, |direction| DVec3::splat(direction.normalize().z.powi(2)));
    assert!((lobe.mean_radiance().x - 1.0 / 3.0).abs() < 1e-4, "{}", lobe.mean_radiance());
}

#[test]
fn values_beyond_what_texels_hold_are_repaired_and_counted() {
    let map = CubeMap::from_fn(2, 1, |direction| match CubeFace::of_direction(direction).0 {
        CubeFace::PositiveX => DVec3::splat(1e30),
        CubeFace::NegativeY => DVec3::splat(f64::NAN),
        CubeFace::NegativeZ => DVec3::splat(-1.0),
        _ => DVec3::ONE,
    });
    assert_eq!(map.repairs(), Repairs { not_a_number: 4, negative: 4, too_bright: 4 });
    assert!((map.sample(DVec3::X).x - f64::from(MAX_RADIANCE)).abs() < 32.0, "the nearest texel holds 65024");
    assert_eq!(map.sample(DVec3::NEG_Z), DVec3::ZERO);
    assert!(map.mips().iter().flat_map(|level| level.faces.iter().flatten()).all(|texel| texel.radiance().is_finite()));
}

#[test]
fn repairs_of_a_panorama_are_reported() {
    let mut pixels = vec![[1.0; 3]; 32 * 16];
    pixels[7] = [f32::NAN; 3];
    let panorama = Equirect::new(32, 16, pixels).unwrap();
    assert_eq!(CubeMap::from_equirect(&panorama).repairs().not_a_number, 1);
}

#[test]
fn ids_tell_contents_apart() {
    let map =
        |value: f64| CubeMap::from_fn(4, 1, |direction| DVec3::splat(if direction.x > 0.9 { value } else { 1.0 }));
    assert_eq!(map(2.0).id(), map(2.0).id());
    assert_ne!(map(2.0).id(), map(2.01).id());
    assert_ne!(CubeMap::constant(DVec3::ONE).id(), CubeMap::from_fn(2, 1, |_| DVec3::ONE).id());
    // Pinned: the same on every machine and with every compiler.
    assert_eq!(CubeMap::constant(DVec3::ONE).id(), 10_946_849_680_655_195_645);
}

#[test]
fn panoramas_get_matching_sizes() {
    for (width, size) in [(2, 16), (50, 16), (512, 176), (4096, 1312), (8192, 2048), (40000, 2048)] {
        assert_eq!(size_for_panorama(width), size, "width {width}");
    }
}

#[test]
fn contrast_tells_lamps_in_the_dark_from_cloth() {
    use super::super::Procedural;

    assert_eq!(CubeMap::constant(DVec3::ONE).contrast(), 1.0);
    assert_eq!(CubeMap::constant(DVec3::ZERO).contrast(), 1.0);
    let contrast = |environment: Procedural| environment.map().contrast();
    assert!(contrast(Procedural::Tent) < 10.0);
    for environment in [Procedural::Windows, Procedural::Park, Procedural::Studio] {
        assert!((100.0..300.0).contains(&contrast(environment)), "{environment:?}: {}", contrast(environment));
    }
    // Half of a sphere is a hundred times as bright as the rest: ten times as bright as the geometric mean.
    let map = CubeMap::from_fn(128, 1, |direction| DVec3::splat(if direction.z > 0.0 { 100.0 } else { 1.0 }));
    assert!((map.contrast() - 10.0).abs() < 0.1, "{}", map.contrast());
}
