// The camera: rays through pixels. Places are relative to the eye: far from the origin, f32 would round the distance between a place and
// the eye.

// Mirrors `ViewUniform` in src/gpu/passes/backdrop.rs.
struct View {
    // Unit vector along the line of sight.
    forward: vec3f,
    // Height of a pixel on the plane one metre before the eye.
    pixel_height: f32,
    right: vec3f,
    // Width and height of the picture in pixels.
    width: f32,
    up: vec3f,
    height: f32,
    // Where the line of sight meets the picture, in pixels: its middle, unless the picture is a part of a larger one.
    axis: vec2f,
}

// Point on the plane one metre before the eye, relative to the eye, that a picture position (pixels, y down) looks through.
fn view_plane(view: View, position: vec2f) -> vec3f {
    let offset = (position - view.axis) * view.pixel_height;
    return view.forward + offset.x * view.right - offset.y * view.up;
}

fn view_ray(view: View, position: vec2f) -> vec3f {
    return normalize(view_plane(view, position));
}

// Where a direction from the eye is in the picture.
fn clip_position(view: View, ray: vec3f) -> vec4f {
    let size = vec2f(view.width, view.height);
    let half = 0.5 * view.pixel_height * size;
    let depth = dot(ray, view.forward);
    let aside = depth * (2.0 * view.axis / size - 1.0);
    return vec4f(dot(ray, view.right) / half.x + aside.x, dot(ray, view.up) / half.y - aside.y, 0.5 * depth, depth);
}

// Angle that one pixel spans along a ray: the geometric mean of its two directions.
fn pixel_angle(view: View, ray: vec3f) -> f32 {
    let cosine = dot(ray, view.forward);
    return view.pixel_height * cosine * sqrt(cosine);
}
