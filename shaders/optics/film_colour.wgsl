// What the table says of a film: its reflectance as linear BT.2020 colour, s and p light apart.
// Everything that shows or reports a film's colour goes through film_colour().

import package::optics::airy::max_reflectance;
import package::optics::table::{FilmPoint, TableAxes, table_coordinates};

// Reflected colour for s and p light; a perfect mirror has the colour of the illuminant's white.
struct Polarised {
    s: vec3f,
    p: vec3f,
}

fn film_colour(table: texture_2d_array<f32>, table_sampler: sampler, axes: TableAxes, film: FilmPoint) -> Polarised {
    let uv = table_coordinates(axes, film);
    let scale = max_reflectance(axes.index, film.cos_theta);
    return Polarised(
        scale * textureSampleLevel(table, table_sampler, uv, 0, 0.0).rgb,
        scale * textureSampleLevel(table, table_sampler, uv, 1, 0.0).rgb,
    );
}
