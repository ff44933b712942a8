// Differential operators on the equiangular cubed sphere, by central differences of fourth order. The f64 truth, with the formulas'
// derivation, is src/physics/flow/operators.rs.

// Times the cell angle, the slope of values 2 and 1 cells before a cell and 1 and 2 after it.
fn first_difference(v: vec4f) -> f32 {
    return (8.0 * (v.z - v.y) - (v.w - v.x)) / 12.0;
}

// A vector given along a panel's axes f, r and u.
fn panel_vector(panel: u32, v: vec3f) -> vec3f {
    switch panel {
        case 0u: { return v; }
        case 1u: { return vec3f(-v.y, v.x, v.z); }
        case 2u: { return vec3f(-v.x, -v.y, v.z); }
        case 3u: { return vec3f(v.y, -v.x, v.z); }
        case 4u: { return vec3f(-v.z, v.y, v.x); }
        default: { return vec3f(v.z, v.y, -v.x); }
    }
}

// n x grad(psi) of a field with these slopes by alpha and beta: the velocity, if psi is the stream function.
fn turned_gradient(panel: u32, tangent: vec2f, slope: vec2f) -> vec3f {
    let s = tangent / (1.0 + tangent * tangent).yx;
    let by_alpha = vec3f(-tangent.y / (1.0 + tangent.x * tangent.x), -tangent.x * tangent.y / (1.0 + tangent.x * tangent.x), 1.0);
    let by_beta = vec3f(s.x, -1.0, s.x * tangent.y);
    return panel_vector(panel, slope.x * by_alpha + slope.y * by_beta);
}

// Solid angle of a cell over the square of the cell angle, by the metric at its center.
fn area_density(tangent: vec2f) -> f32 {
    let s = 1.0 + tangent * tangent;
    let delta2 = s.x + s.y - 1.0;
    return s.x * s.y / (delta2 * sqrt(delta2));
}

// Whether a value can be worked with: neither NaN nor infinite nor beyond 1e6 of whatever it measures. By bits, for compilers may assume
// that there is no NaN.
fn is_valid(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7fffffffu) < 0x49742400u;
}

// The value, or 0 in its place.
fn valid_or_zero(value: f32) -> f32 {
    return select(0.0, value, is_valid(value));
}
