// The camera: rays through pixels.

// Mirrors `ViewUniform` in src/gpu/draw.rs.
struct View {
    eye_m: vec3f,
    // Height of a pixel on the plane one metre before the eye.
    pixel_height: f32,
    // Unit vector along the line of sight.
    forward: vec3f,
    // Width and height of the picture in pixels.
    width: f32,
    right: vec3f,
    height: f32,
    up: vec3f,
    pad: f32,
}

// Point on the plane one metre before the eye, relative to the eye, that a picture position (pixels, y down) looks through.
fn view_plane(view: View, position: vec2f) -> vec3f {
    let offset = (position - 0.5 * vec2f(view.width, view.height)) * view.pixel_height;
    return view.forward + offset.x * view.right - offset.y * view.up;
}

fn view_ray(view: View, position: vec2f) -> vec3f {
    return normalize(view_plane(view, position));
}

// Angle that one pixel spans along a ray: the geometric mean of its two directions.
fn pixel_angle(view: View, ray: vec3f) -> f32 {
    let cosine = dot(ray, view.forward);
    return view.pixel_height * cosine * sqrt(cosine);
}
