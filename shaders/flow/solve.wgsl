// What the passes of one multigrid solution of (laplacian - k) psi = f share on the finest grid.

// Mirrors `FilmSystem` in src/gpu/passes/flow_residual.rs.
struct FilmSystem {
    // Of each sweep after a correction.
    weights: vec3f,
    // k.
    shift: f32,
    // f over the source.
    gain: f32,
}

// Mirrors `SolveUniform` in src/gpu/passes/flow_residual.rs.
struct Solve {
    // 1 over the square of the cell angle, 1/rad2.
    per_angle2: f32,
    // Cells along a panel's edge, here and on the next grid.
    cells: u32,
    coarse_cells: u32,
    // Where the next grid's corrections start.
    coarse_field: u32,
    // Of each film.
    systems: array<FilmSystem, 64>,
}
