// What the passes of one step of the flow share. Films that step together are stored one after the other.

// Mirrors `FlowUniform` in src/gpu/passes/flow_measure.rs.
struct Flow {
    dt_s: f32,
    // Slowest speed that the drag of air is reckoned with.
    min_air_speed: f32,
    cell_angle: f32,
    // Cells along a panel's edge.
    cells: u32,
}

// What acts on one film. Mirrors `FilmForces` in src/gpu/passes/flow_force.rs.
struct Forces {
    // Gravity over the radius, 1/s2.
    gravity: vec3f,
    // Drag that is the same everywhere, 1/s.
    drag: f32,
    // Drag of air over the root of the speed, times the thickness, nm / sqrt(s).
    air_drag: f32,
}

// Mirrors `FlowMeasures` in src/gpu/passes/flow_measure.rs.
struct Measures {
    // Mean vorticity, 1/s.
    zeta_mean: f32,
    // Mean of 2 psi - psi_before.
    guess_mean: f32,
    // Fastest flow, rad/s.
    max_speed: f32,
    // Values that could not be used, since the film was seeded.
    invalid: u32,
}
