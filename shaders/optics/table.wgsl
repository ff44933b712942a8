// The lookup table's axes, both ways. Columns are sqrt(cos theta), which resolves grazing angles; rows are
// v = d cos_t, the path that interference depends on, so that fringes run along columns at every angle.
// The first and last texel centres sit exactly on the ends of the range: no film (v = 0) is a row of exact zeros.

// What a table spans. Mirrors `TableAxes` in src/gpu/bake_table.rs.
struct TableAxes {
    // Columns and rows of texels.
    size: vec2f,
    // Thickness at the last row for normal incidence, in nm.
    max_thickness_nm: f32,
    // Index of the film at 589 nm: the one number that stands for dispersion in the axes (not in the colours).
    index: f32,
}

import package::optics::airy::cos_refracted;

struct FilmPoint {
    cos_theta: f32,
    thickness_nm: f32,
}

// The film that a texel centre stands for.
fn film_of_texel(axes: TableAxes, texel: vec2f) -> FilmPoint {
    let u = texel.x / (axes.size.x - 1.0);
    let cos_theta = u * u;
    let path_nm = axes.max_thickness_nm * texel.y / (axes.size.y - 1.0);
    return FilmPoint(cos_theta, path_nm / cos_refracted(axes.index, cos_theta));
}

// Texture coordinates of a film: the inverse of film_of_texel.
fn table_coordinates(axes: TableAxes, film: FilmPoint) -> vec2f {
    let path_nm = film.thickness_nm * cos_refracted(axes.index, film.cos_theta);
    let texel = vec2f(sqrt(film.cos_theta), path_nm / axes.max_thickness_nm) * (axes.size - 1.0);
    return (texel + 0.5) / axes.size;
}
