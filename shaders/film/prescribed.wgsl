// Flows in closed form: sums of waves and vortices of the stream function. The f64 truth is src/physics/film/flow.rs.

const MAX_WAVES: u32 = 32u;
const MAX_VORTICES: u32 = 64u;

// Stream function amplitude sin(k . x + phase).
struct Wave {
    k: vec3f,
    phase: f32,
    amplitude: f32,
}

// Stream function strength exp(sharpness (center . x - 1)).
struct Vortex {
    center: vec3f,
    sharpness: f32,
    strength: f32,
}

// Gradient in space of a wave's stream function at x.
fn wave_gradient(wave: Wave, x: vec3f) -> vec3f {
    return wave.amplitude * cos(dot(wave.k, x) + wave.phase) * wave.k;
}

// Gradient in space of a vortex's stream function at x.
fn vortex_gradient(vortex: Vortex, x: vec3f) -> vec3f {
    let center = vortex.center;
    let sharpness = vortex.sharpness;
    return vortex.strength * sharpness * exp(sharpness * (dot(center, x) - 1.0)) * center;
}

// Vorticity of a wave at unit vector x: the Laplacian on the sphere of its stream function, which is that in space less the second
// derivative along x and twice the first.
fn wave_vorticity(wave: Wave, x: vec3f) -> f32 {
    let k = wave.k;
    let along = dot(k, x);
    let phase = along + wave.phase;
    return -wave.amplitude * ((dot(k, k) - along * along) * sin(phase) + 2.0 * along * cos(phase));
}

// Vorticity of a vortex at unit vector x.
fn vortex_vorticity(vortex: Vortex, x: vec3f) -> f32 {
    let sharpness = vortex.sharpness;
    let along = dot(vortex.center, x);
    let value = vortex.strength * exp(sharpness * (along - 1.0));
    return value * sharpness * (sharpness * (1.0 - along * along) - 2.0 * along);
}
