// One wavelength of a sum over a spectrum, all of its wavelengths or a few that were fitted to stand for it. Mirrors `QuadratureSample` in
// src/gpu/quadrature.rs.
struct QuadratureSample {
    // Matrix from light to its colour, both linear BT.2020.
    response: mat3x3f,
    wavelength_nm: f32,
    // Refractive index of the film's liquid.
    index: f32,
    // The widest step from one thickness to the next that is told from wider ones, in nm; read where THICK is 1.
    gap_nm: f32,
    // Width of the part of the spectrum that it is a sample of, 0 for a line; read by the table's bake.
    width_nm: f32,
}
