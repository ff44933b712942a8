// Flows in closed form: sums of waves and vortices of the stream function. The f64 truth is src/physics/film/flow.rs.

const MAX_WAVES: u32 = 32u;
const MAX_VORTICES: u32 = 64u;

// Stream function gain.x sin(k . x + phase), with k in xyz and the phase in w.
struct Wave {
    k_phase: vec4f,
    gain: vec4f,
}

// Stream function gain.x exp(sharpness (centre . x - 1)), with the centre in xyz and the sharpness in w.
struct Vortex {
    centre_sharpness: vec4f,
    gain: vec4f,
}

// Gradient in space of a wave's stream function at x.
fn wave_gradient(wave: Wave, x: vec3f) -> vec3f {
    return wave.gain.x * cos(dot(wave.k_phase.xyz, x) + wave.k_phase.w) * wave.k_phase.xyz;
}

// The same of a vortex.
fn vortex_gradient(vortex: Vortex, x: vec3f) -> vec3f {
    let centre = vortex.centre_sharpness.xyz;
    let sharpness = vortex.centre_sharpness.w;
    return vortex.gain.x * sharpness * exp(sharpness * (dot(centre, x) - 1.0)) * centre;
}

// Vorticity of a wave at unit vector x: the Laplacian on the sphere of its stream function, which is that in space less the second
// derivative along x and twice the first.
fn wave_vorticity(wave: Wave, x: vec3f) -> f32 {
    let k = wave.k_phase.xyz;
    let along = dot(k, x);
    let phase = along + wave.k_phase.w;
    return -wave.gain.x * ((dot(k, k) - along * along) * sin(phase) + 2.0 * along * cos(phase));
}

// The same of a vortex.
fn vortex_vorticity(vortex: Vortex, x: vec3f) -> f32 {
    let sharpness = vortex.centre_sharpness.w;
    let along = dot(vortex.centre_sharpness.xyz, x);
    let value = vortex.gain.x * exp(sharpness * (along - 1.0));
    return value * sharpness * (sharpness * (1.0 - along * along) - 2.0 * along);
}
