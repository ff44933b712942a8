// The colour of a single wall from the table. Everything that shows or reports the colour of a single
// wall from a table goes through film_reflection().

import package::optics::airy::max_reflectance;
import package::optics::table::{FilmPoint, TableAxes, TablePlace, table_colour, table_place};

// 1: the table holds a layer for each primary of the light. 0: one for white light, and all light is white.
override COLOURED: u32;
// 1: the table holds s and p light apart. 0: their mean.
override POLARISED: u32;

// Thicknesses that a film is the mean of, over what a sample spans. 1: the sample's own alone.
override THICKNESSES: u32;

fn table_light(table: texture_2d_array<u32>, place: TablePlace, first: u32, light: vec3f) -> vec3f {
    let red = table_colour(table, place, first);
    if (COLOURED == 0u) {
        return red * light;
    }
    let green = table_colour(table, place, first + 1u);
    let blue = table_colour(table, place, first + 2u);
    return red * light.r + green * light.g + blue * light.b;
}

// What is seen of light that a film reflects, linear BT.2020. `polarisation` are the shares of s and p light, (1/2, 1/2) without a
// polariser.
fn film_reflection(
    table: texture_2d_array<u32>,
    axes: TableAxes,
    film: FilmPoint,
    polarisation: vec2f,
    light: vec3f,
) -> vec3f {
    if (THICKNESSES == 1u) {
        return reflection_at(table, axes, film, polarisation, light);
    }
    var sum = vec3f(0.0);
    for (var k = 0u; k < THICKNESSES; k++) {
        let part = (f32(k) + 0.5) / f32(THICKNESSES) - 0.5;
        // Reflectance is even in the thickness.
        let nm = abs(film.thickness_nm + part * film.spread_nm);
        let tap = FilmPoint(film.cos_theta, nm, 0.0);
        sum += reflection_at(table, axes, tap, polarisation, light);
    }
    return sum / f32(THICKNESSES);
}

fn reflection_at(
    table: texture_2d_array<u32>,
    axes: TableAxes,
    film: FilmPoint,
    polarisation: vec2f,
    light: vec3f,
) -> vec3f {
    let place = table_place(axes, film);
    let scale = max_reflectance(axes.index, film.cos_theta);
    var reflected = table_light(table, place, 0u, light);
    if (POLARISED == 1u) {
        let p = table_light(table, place, select(1u, 3u, COLOURED == 1u), light);
        reflected = polarisation.x * reflected + polarisation.y * p;
    }
    return scale * reflected;
}
