// Directions across others.

// A unit vector at right angles to a vector that is not zero.
fn perpendicular(vector: vec3f) -> vec3f {
    let helper = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(vector.x) > 0.7 * length(vector));
    return normalize(cross(vector, helper));
}
