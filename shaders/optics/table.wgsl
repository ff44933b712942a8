// The lookup table's axes, both ways. Columns are sqrt(cos theta), which resolves grazing angles; rows follow the path d cos_t
// that interference depends on, so that fringes run along columns at every angle. Rows are three times denser at no film than in
// the middle, for there the reflectance starts as a parabola from black, and the eye sees small errors best in the dark.
// The first and last texel centers sit exactly on the ends of the range: no film is a row of exact zeros.

// What a table spans. Mirrors `TableAxes` in src/gpu/passes/bake_table.rs.
struct TableAxes {
    // Columns and rows of texels.
    size: vec2f,
    // Thickness at the last row for normal incidence, in nm.
    max_thickness_nm: f32,
    // Index of the film at 589 nm: the one number that stands for dispersion in the axes (not in the colours).
    index: f32,
}

import package::optics::airy::cos_refracted;

// How much of the rows' spacing is even: part v of the longest path is at part t of the rows with v = t (t + EVEN) / (1 + EVEN).
const EVEN: f32 = 0.5;

fn path_of_row(t: f32) -> f32 {
    return t * (t + EVEN) / (1.0 + EVEN);
}

// Inverse of path_of_row, in the form that does not cancel near zero.
fn row_of_path(v: f32) -> f32 {
    let scaled = (1.0 + EVEN) * v;
    return 2.0 * scaled / (EVEN + sqrt(EVEN * EVEN + 4.0 * scaled));
}

struct FilmPoint {
    cos_theta: f32,
    thickness_nm: f32,
    // Width of the thicknesses that a sample spans, in nm.
    spread_nm: f32,
}

// The film that a texel center stands for.
fn film_of_texel(axes: TableAxes, texel: vec2f) -> FilmPoint {
    let u = texel.x / (axes.size.x - 1.0);
    let cos_theta = u * u;
    let path_nm = axes.max_thickness_nm * path_of_row(texel.y / (axes.size.y - 1.0));
    // Light that grazes a film of index 1 goes along it: the floor only matters there, where nothing is reflected.
    return FilmPoint(cos_theta, path_nm / max(cos_refracted(axes.index, cos_theta), 1e-6), 0.0);
}

// A place between four texels: the first of them, and how much of the way to the last it is.
struct TablePlace {
    first: vec2u,
    part: vec2f,
}

// The place of a film: the inverse of film_of_texel.
fn table_place(axes: TableAxes, film: FilmPoint) -> TablePlace {
    let path_nm = film.thickness_nm * cos_refracted(axes.index, film.cos_theta);
    let last = axes.size - 1.0;
    let texel = vec2f(sqrt(film.cos_theta), row_of_path(path_nm / axes.max_thickness_nm)) * last;
    let first = clamp(floor(texel), vec2f(0.0), last - 1.0);
    return TablePlace(vec2u(first), clamp(texel - first, vec2f(0.0), vec2f(1.0)));
}

// Two rows of a table in one texel: six numbers of 21 bits, which are f32 without the last 11 bits of their mantissa. Three of a row and the first of
// the next fill the upper parts of the texel's numbers, and halves of the last two numbers the lower parts.
fn two_rows(here: vec3f, next: vec3f) -> vec4u {
    let kept = rounded(vec4f(here, next.r));
    let split = rounded(vec4f(next.gb, 0.0, 0.0)) >> vec4u(11u);
    return kept | vec4u(split.r >> 10u, split.r & 0x3ffu, split.g >> 10u, split.g & 0x3ffu);
}

// Bits of numbers rounded to 21 bits.
fn rounded(numbers: vec4f) -> vec4u {
    return (bitcast<vec4u>(numbers) + vec4u(0x400u)) & vec4u(0xfffff800u);
}

// What two rows hold part of the way to the next.
fn between_rows(texel: vec4u, part: f32) -> vec3f {
    let kept = texel & vec4u(0xfffff800u);
    let halves = texel & vec4u(0x7ffu);
    let next = vec3u(kept.a, (halves.r << 21u) | (halves.g << 11u), (halves.b << 21u) | (halves.a << 11u));
    return mix(bitcast<vec3f>(kept.rgb), bitcast<vec3f>(next), part);
}

// What a layer holds at a place, bilinearly. Not by a sampler: GPUs round its place to 1/256 of a texel, a mean
// error of CIEDE2000 0.01. And two rows to a texel, since what takes time is to fetch texels.
fn table_colour(table: texture_2d_array<u32>, place: TablePlace, layer: u32) -> vec3f {
    let here = textureLoad(table, place.first, layer, 0);
    let beside = textureLoad(table, place.first + vec2u(1u, 0u), layer, 0);
    return mix(between_rows(here, place.part.y), between_rows(beside, place.part.y), place.part.x);
}
