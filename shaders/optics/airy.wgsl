// Reflectance of a free film, air | film | air, for s and p light. The f64 truth is src/physics/optics/airy.rs.
//
// Phases are counted in turns and reduced before any trigonometry: WGSL promises sin() only to 2^-11, which would cost
// up to 0.1 of a colour difference; the polynomial below keeps the whole reflectance at f32 rounding.

// n times the cosine of the refracted angle inside a film of index n, from the cosine of the angle outside (Snell). This form keeps its digits
// near grazing, and is cos theta for n = 1.
fn n_cos_refracted(n: f32, cos_theta: f32) -> f32 {
    return sqrt((n - 1.0) * (n + 1.0) + cos_theta * cos_theta);
}

// Cosine of the refracted angle.
fn cos_refracted(n: f32, cos_theta: f32) -> f32 {
    return n_cos_refracted(n, cos_theta) / n;
}

// Squared Fresnel amplitudes (r_s^2, r_p^2) of one surface, air to film.
fn surface_reflectance(n: f32, cos_theta: f32) -> vec2f {
    let inside = n_cos_refracted(n, cos_theta);
    let outside = vec2f(cos_theta, n * n * cos_theta);
    // The floor only matters at exactly grazing incidence on index 1, which is no surface.
    let r = (outside - inside) / max(outside + inside, vec2f(1e-30));
    return r * r;
}

// Greatest reflectances of s and p light that interference can give at this angle.
fn peak_reflectances(n: f32, cos_theta: f32) -> vec2f {
    let r2 = surface_reflectance(n, cos_theta);
    let peak = 2.0 / (1.0 + r2);
    return r2 * peak * peak;
}

// Their mean: 1 at grazing, 0.08 at the normal for water.
fn max_reflectance(n: f32, cos_theta: f32) -> f32 {
    let peak = peak_reflectances(n, cos_theta);
    return 0.5 * (peak.x + peak.y);
}

// Reflectances of four films for s and p light.
struct Reflectances {
    s: vec4f,
    p: vec4f,
}

// sin(pi x) for |x| <= 1/2; absolute error below 7e-9 before rounding (Chebyshev fit).
fn sin_pi(x: vec4f) -> vec4f {
    let y = x * x;
    return x * (3.14159264 + y * (-5.16771008 + y * (2.55007752 + y * (-0.598291286 + y * 0.0776576603))));
}

// Airy reflectance of four films that light of one wavelength meets at one angle. With s = sin(delta/2),
// R = 4 r^2 s^2 / ((1 - r^2)^2 + 4 r^2 s^2): this form has no cancellation, so that a black film comes out right by itself.
fn film_reflectances(n: f32, cos_theta: f32, thickness_nm: vec4f, wavelength_nm: f32) -> Reflectances {
    let r2 = surface_reflectance(n, cos_theta);
    let half_turns = (2.0 * n_cos_refracted(n, cos_theta) / wavelength_nm) * thickness_nm;
    let sine = sin_pi(half_turns - round(half_turns));
    let interference = 4.0 * sine * sine;
    let gap = (1.0 - r2) * (1.0 - r2);
    let s = r2.x * interference;
    let p = r2.y * interference;
    // The floor only matters at exactly grazing incidence on no film, where 0/0 stands for "nothing there".
    return Reflectances(s / max(gap.x + s, vec4f(1e-30)), p / max(gap.y + p, vec4f(1e-30)));
}

// The mean reflectances of four films whose fringes keep a part of their contrast: `coherence`, 1 for all, 0 for the incoherent limit
// 2 r^2 / (1 + r^2). See `Incidence::damped_reflectance` for the formula.
fn damped_reflectances(
    n: f32,
    cos_theta: f32,
    thickness_nm: vec4f,
    wavelength_nm: f32,
    coherence: vec4f,
) -> Reflectances {
    let r2 = surface_reflectance(n, cos_theta);
    let half_turns = (2.0 * n_cos_refracted(n, cos_theta) / wavelength_nm) * thickness_nm;
    let sine = sin_pi(half_turns - round(half_turns));
    let interference = 4.0 * sine * sine;
    return Reflectances(damped(r2.x, interference, coherence), damped(r2.y, interference, coherence));
}

fn damped(r2: f32, interference: vec4f, coherence: vec4f) -> vec4f {
    let q = coherence * r2;
    let fringes = q * interference;
    let gap = 1.0 - q;
    let reflected = 2.0 * r2 * (1.0 - coherence) * gap + (1.0 + r2) * fringes;
    return reflected / max((1.0 + r2) * (gap * gap + fringes), vec4f(1e-30));
}
