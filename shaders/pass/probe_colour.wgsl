// Colours of a list of films through the very functions that pictures use: what `soapfilm colour` reports.

import package::optics::film_colour::{Polarised, film_colour};
import package::optics::table::{FilmPoint, TableAxes};
import package::optics::walls::{product, sum, transmitted, unpolarised};

// Front, back and exit wall of one ray. Mirrors `ProbePoint` in src/gpu/probe_colour.rs.
struct ProbePoint {
    cos_theta: f32,
    front_nm: f32,
    back_nm: f32,
    exit_nm: f32,
    // 1: the front wall alone. 2: front and back, R0 + T0 R1 T2.
    walls: u32,
}

@group(0) @binding(0) var<uniform> axes: TableAxes;
@group(0) @binding(1) var table: texture_2d_array<f32>;
@group(0) @binding(2) var table_sampler: sampler;
@group(0) @binding(3) var<storage, read> points: array<ProbePoint>;
@group(0) @binding(4) var<storage, read_write> colours: array<vec4f>;

fn wall(cos_theta: f32, thickness_nm: f32) -> Polarised {
    return film_colour(table, table_sampler, axes, FilmPoint(cos_theta, thickness_nm));
}

@compute @workgroup_size(64)
fn probe_colour(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&points)) {
        return;
    }
    let at = points[id.x];
    var reflected = wall(at.cos_theta, at.front_nm);
    if (at.walls == 2u) {
        let back = wall(at.cos_theta, at.back_nm);
        let exit = wall(at.cos_theta, at.exit_nm);
        reflected = sum(reflected, product(product(transmitted(reflected), back), transmitted(exit)));
    }
    colours[id.x] = vec4f(unpolarised(reflected), 1.0);
}
