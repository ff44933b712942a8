// Within a drop at the bottom of a film nothing flows: its stream function is the mean over its rim, and its vorticity is zero. One
// workgroup for each film, for the mean comes first.

import package::flow::operators::{area_density, valid_or_zero};
import package::sphere::cubed::{HALO, padded_index, panel_direction};

const LANES: u32 = 256u;

// Mirrors `PinUniform` in src/gpu/passes/flow_pin.rs.
struct Pin {
    // Cells along a panel's edge.
    cells: u32,
    // Angle from the bottom at which the drop begins, and that within which it holds the film fast.
    rim: f32,
    inner: f32,
}

@group(0) @binding(0) var<uniform> pin: Pin;
// tan(alpha) of each cell coordinate, halo included.
@group(0) @binding(1) var<storage, read> tangents: array<f32>;
@group(0) @binding(2) var<storage, read_write> zeta: array<f32>;
@group(0) @binding(3) var<storage, read_write> psi: array<f32>;

// Weights, and the stream function times them.
var<workgroup> shares: array<vec2f, 256>;

struct Place {
    at: u32,
    tangent: vec2f,
    // How firmly it is pinned.
    firm: f32,
}

fn place_of(film: u32, cell: u32) -> Place {
    let ij = vec2u(cell % pin.cells, (cell / pin.cells) % pin.cells);
    let panel = cell / (pin.cells * pin.cells);
    let tangent = vec2f(tangents[ij.x + HALO], tangents[ij.y + HALO]);
    let x = normalize(panel_direction(panel, tangent));
    // The angle from the bottom, near it.
    let angle = select(4.0, 2.0 * asin(min(0.5 * distance(x, vec3f(0.0, 0.0, -1.0)), 1.0)), x.z < 0.0);
    let firm = 1.0 - smoothstep(pin.inner, pin.rim, angle);
    return Place(padded_index(6u * film + panel, i32(ij.x), i32(ij.y), pin.cells), tangent, firm);
}

@compute @workgroup_size(256)
fn flow_pin(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    var share = vec2f(0.0);
    for (var cell = lane; cell < 6u * pin.cells * pin.cells; cell += LANES) {
        let place = place_of(group.x, cell);
        let weight = area_density(place.tangent) * place.firm * (1.0 - place.firm);
        share += weight * vec2f(1.0, valid_or_zero(psi[place.at]));
    }
    shares[lane] = share;
    for (var half = LANES / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (lane < half) {
            shares[lane] += shares[lane + half];
        }
    }
    workgroupBarrier();
    let at_rim = shares[0].y / max(shares[0].x, 1e-20);
    for (var cell = lane; cell < 6u * pin.cells * pin.cells; cell += LANES) {
        let place = place_of(group.x, cell);
        psi[place.at] = mix(psi[place.at], at_rim, place.firm);
        zeta[place.at] *= 1.0 - place.firm;
    }
}
