// The equiangular cubed sphere: six panels of cells x cells values at cell centers, stored with a halo around each panel.
// The f64 truth, and the table of panel axes that this file mirrors, is src/physics/sphere.

// Cells of halo on each side of a panel: a quintic stencil reaches three beyond the edge.
override HALO: u32;

const QUARTER_PI: f32 = 0.785398163;

// Place of a direction on the cube: panel, and cell coordinates in which cell (i, j) has its center at (i, j).
struct CubePoint {
    panel: u32,
    cell: vec2f,
}

// atan on [-1, 1], absolute error 1.1e-7 with rounding (Chebyshev fit). WGSL's own atan may be off by 4096 ulp.
fn atan_unit(x: f32) -> f32 {
    let y = x * x;
    return x * (0.99999998 + y * (-0.33333067 + y * (0.19992484 + y * (-0.14202571 + y * (0.10636754 +
        y * (-0.074954454 + y * (0.042587607 + y * (-0.01600503 + y * 0.0028340643))))))));
}

// Cell coordinate of a tangent in [-1, 1].
fn cell_coordinate(tangent: f32, cells: u32) -> f32 {
    return (atan_unit(tangent) * (1.0 / QUARTER_PI) + 1.0) * 0.5 * f32(cells) - 0.5;
}

// The panel whose face the direction pierces, and where. `direction` need not be a unit vector but must not be zero.
fn locate(direction: vec3f, cells: u32) -> CubePoint {
    let d = direction;
    let a = abs(d);
    var panel: u32;
    var rd: vec2f;
    var forward: f32;
    if (a.x >= a.y && a.x >= a.z) {
        forward = a.x;
        panel = select(2u, 0u, d.x > 0.0);
        rd = vec2f(select(-d.y, d.y, d.x > 0.0), d.z);
    } else if (a.y >= a.z) {
        forward = a.y;
        panel = select(3u, 1u, d.y > 0.0);
        rd = vec2f(select(d.x, -d.x, d.y > 0.0), d.z);
    } else {
        forward = a.z;
        panel = select(5u, 4u, d.z > 0.0);
        rd = vec2f(d.y, select(d.x, -d.x, d.z > 0.0));
    }
    let tangent = rd * (1.0 / forward);
    return CubePoint(panel, vec2f(cell_coordinate(tangent.x, cells), cell_coordinate(tangent.y, cells)));
}

// The cell of a direction in storage that holds many films, one after the other. Film 1 begins with panel 6.
fn locate_in(film: u32, direction: vec3f, cells: u32) -> CubePoint {
    let at = locate(direction, cells);
    return CubePoint(6u * film + at.panel, at.cell);
}

// Direction (not normalised) of tangents (tan alpha, tan beta) on a panel.
fn panel_direction(panel: u32, tangent: vec2f) -> vec3f {
    switch panel {
        case 0u: { return vec3f(1.0, tangent.x, tangent.y); }
        case 1u: { return vec3f(-tangent.x, 1.0, tangent.y); }
        case 2u: { return vec3f(-1.0, -tangent.x, tangent.y); }
        case 3u: { return vec3f(tangent.x, -1.0, tangent.y); }
        case 4u: { return vec3f(-tangent.y, tangent.x, 1.0); }
        default: { return vec3f(tangent.y, tangent.x, -1.0); }
    }
}

// a / b, rounded down, of numbers whose quotient is below 2^22. Software rasterisers divide integers one by one.
fn quotient(a: u32, b: u32) -> u32 {
    let near = i32(f32(a) / f32(b));
    let rest = i32(a) - near * i32(b);
    return u32(near + select(0, 1, rest >= i32(b)) - select(0, 1, rest < 0));
}

// Place of cell (i, j) of a panel in padded storage; i and j may reach HALO cells beyond the panel. Where films are stored one after the
// other, their panels are numbered on.
fn padded_index(panel: u32, i: i32, j: i32, cells: u32) -> u32 {
    let side = cells + 2u * HALO;
    return (panel * side + u32(j + i32(HALO))) * side + u32(i + i32(HALO));
}

// Whether an invocation of a pass over all cells, halo included, has a cell: workgroups are tiles of 8 x 8.
fn is_cell(id: vec3u, cells: u32) -> bool {
    return all(id.xy < vec2u(cells + 2u * HALO));
}

// Place in padded storage of an invocation of a pass over all cells, halo included.
fn cell_place(id: vec3u, cells: u32) -> u32 {
    let side = cells + 2u * HALO;
    return (id.z * side + id.y) * side + id.x;
}

// Whether two by two cells have any that is stored.
fn is_quad(first: vec2i, cells: u32) -> bool {
    return all(first < vec2i(i32(cells + 2u * HALO)));
}

// The k-th of two by two cells, numbered like an invocation. The first may lie before storage does: its number is then too large to be
// a cell's.
fn quad_cell(first: vec2i, k: u32, panel: u32) -> vec3u {
    return vec3u(vec2u(first) + vec2u(k & 1u, k >> 1u), panel);
}

// Weights of the four-point Lagrange interpolation at -1, 0, 1, 2 for a fraction t in [0, 1].
fn cubic_weights(t: f32) -> vec4f {
    let a = t + 1.0;
    let b = t - 1.0;
    let c = t - 2.0;
    return vec4f(t * b * c * (-1.0 / 6.0), a * b * c * 0.5, a * t * c * -0.5, a * t * b * (1.0 / 6.0));
}

// The 4 x 4 cells around a point: padded index of the first, and weights along i and j.
struct CubicStencil {
    first: u32,
    stride: u32,
    wi: vec4f,
    wj: vec4f,
}

fn cubic_stencil(at: CubePoint, cells: u32) -> CubicStencil {
    // Rounding must not carry a point on the panel's edge past the halo.
    let cell = clamp(at.cell, vec2f(-0.5), vec2f(f32(cells) - 0.5));
    let base = floor(cell);
    let t = cell - base;
    let first = padded_index(at.panel, i32(base.x) - 1, i32(base.y) - 1, cells);
    return CubicStencil(first, cells + 2u * HALO, cubic_weights(t.x), cubic_weights(t.y));
}
