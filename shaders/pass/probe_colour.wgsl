// Colours of a list of films through the very functions that pictures use: what `soapfilm colour` reports.

import package::optics::quadrature::QuadratureSample;
import package::optics::film_colour::film_reflection;
import package::optics::table::{FilmPoint, TableAxes};
import package::optics::walls::{EVERYTHING, Hits, INNER, WAVELENGTHS, Walls, product_of_colours, resolved, wavelength_radiance};

// Front, back and exit wall of one ray. Mirrors `ProbePoint` in src/gpu/passes/probe_colour.rs.
struct ProbePoint {
    cos_theta: f32,
    front_nm: f32,
    back_nm: f32,
    exit_nm: f32,
    // 1: the front wall alone. 2: front and back, R0 + T0 R1 T2.
    walls: u32,
}

@group(0) @binding(0) var<uniform> axes: TableAxes;
@group(0) @binding(1) var table: texture_2d_array<u32>;
@group(0) @binding(2) var<uniform> quadrature: array<QuadratureSample, 256>;
@group(0) @binding(3) var<storage, read> points: array<ProbePoint>;
@group(0) @binding(4) var<storage, read_write> colours: array<vec4f>;

const UNPOLARISED: vec2f = vec2f(0.5, 0.5);

fn wall(cos_theta: f32, thickness_nm: f32) -> vec3f {
    return film_reflection(table, axes, FilmPoint(cos_theta, thickness_nm, 0.0), UNPOLARISED, vec3f(1.0));
}

// White light from where the outer and the first inner reflection lead, none from elsewhere: what is seen is the sum of the walls.
@compute @workgroup_size(64)
fn probe_colour(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&points)) {
        return;
    }
    let at = points[id.x];
    let both = f32(at.walls == 2u);
    let steps = mat4x3f(vec3f(1.0), vec3f(both), vec3f(-both), vec3f(0.0));
    if (WAVELENGTHS == 0u) {
        let white = quadrature[0].response * vec3f(1.0);
        let exit = wall(at.cos_theta, at.exit_nm) / white;
        let walls = mat4x3f(wall(at.cos_theta, at.front_nm) / white, wall(at.cos_theta, at.back_nm) / white, exit, exit);
        colours[id.x] = vec4f(white * product_of_colours(axes.index, at.cos_theta, walls, steps), 1.0);
        return;
    }
    var seen = vec3f(0.0);
    if (EVERYTHING == 0u) {
        seen = wall(at.cos_theta, at.front_nm) + both * wall(at.cos_theta, at.back_nm);
    }
    var walls: Walls;
    walls.first = Hits(vec4f(at.front_nm, at.back_nm, at.exit_nm, at.exit_nm), vec4f(0.0), steps);
    walls = resolved(walls, quadrature[0].gap_nm);
    for (var k = 0u; k < WAVELENGTHS; k++) {
        seen += wavelength_radiance(quadrature[k], at.cos_theta, walls, UNPOLARISED);
    }
    colours[id.x] = vec4f(seen, 1.0);
}
