// One wavelength of a sum over a spectrum, all of its wavelengths or a few that were fitted to stand for it. Mirrors `BandSample` in src/gpu/bands.rs.
struct Band {
    // From light to what is seen of it, both linear BT.2020.
    response: mat3x3f,
    wavelength_nm: f32,
    // Refractive index of the film's liquid.
    index: f32,
    // Thickness from which on the bands are too few to resolve the film's fringes; read where THICK is 1.
    coherent_nm: f32,
}
