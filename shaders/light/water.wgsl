// The surface of a bath, a level mirror at the height of the bubbles' centers. It turns up what would go down, and dims it: a ray that goes
// on straight into the mirrored world sees the same. The water itself is dark. The f64 truth is src/physics/picture/bath.rs.

import package::optics::airy::surface_reflectance;

// 1: there is a bath.
override ON_BATH: u32;

// Refractive index of the water.
const WATER_INDEX: f32 = 1.333;

// What is left of light that goes from one height to another along a direction, both counted from the bath's level. Of both polarisations
// alike.
fn crossing(from_z: f32, to_z: f32, direction: vec3f) -> f32 {
    if (ON_BATH == 0u || from_z * to_z >= 0.0) {
        return 1.0;
    }
    return 0.5 * dot(surface_reflectance(WATER_INDEX, abs(direction.z)), vec2f(1.0));
}

// The direction of the world that one of the mirrored world is.
fn upward(direction: vec3f) -> vec3f {
    if (ON_BATH == 0u) {
        return direction;
    }
    return vec3f(direction.xy, abs(direction.z));
}

// Height that water climbs at a wall, sqrt(2 gamma / (rho g)), m, and the fraction of light that remains after passing its foot.
const MENISCUS_M: f32 = 0.00226;
const MENISCUS_LEFT: f32 = 0.2;

// What the meniscus leaves of light at a height over the radius, for a radius in m.
fn past_meniscus(z: f32, radius_m: f32) -> f32 {
    if (ON_BATH == 0u) {
        return 1.0;
    }
    return mix(MENISCUS_LEFT, 1.0, smoothstep(0.0, MENISCUS_M / radius_m, abs(z)));
}
