// Film that ends at a circle of latitude, and the image that stands for what is beyond. The f64 truth, with what images are good for, is
// `Cap` in src/physics/film/cap.rs.

struct Cap {
    // Cosine of the rim's colatitude.
    rim_z: f32,
    // Squared tangent of half of it.
    inversion: f32,
}

// The other of two directions that are each other's images.
fn image(cap: Cap, x: vec3f) -> vec3f {
    let t = cap.inversion;
    let below = 1.0 - x.z;
    let above = 1.0 + x.z;
    return vec3f(2.0 * t * x.xy, below - t * t * above) / (below + t * t * above);
}

// How much longer a short line at a direction is in the image.
fn stretch(cap: Cap, x: vec3f) -> f32 {
    let t = cap.inversion;
    return 2.0 * t / ((1.0 - x.z) + t * t * (1.0 + x.z));
}
