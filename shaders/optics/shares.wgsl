// Colours of walls stand for the mean of s and p light, which films share out differently: how much of a colour is s light.

import package::optics::airy::{peak_reflectances, surface_reflectance};

// How much of what a wall reflects is s light, as a factor on its colour: 1 for half, 2 for all. Films that reflect next to nothing and films that
// reflect most share it differently between s and p.
struct ShareOfS {
    black: f32,
    bright: f32,
    // The most that a film reflects at this angle, mean of s and p.
    max_reflectance: f32,
}

fn share_of_s(n: f32, cos_theta: f32) -> ShareOfS {
    let r2 = surface_reflectance(n, cos_theta);
    let thin = r2 * (1.0 - r2.yx) * (1.0 - r2.yx);
    let peak = peak_reflectances(n, cos_theta);
    // Nothing is reflected by index 1.
    let black = 2.0 * thin.x / max(thin.x + thin.y, 1e-30);
    return ShareOfS(black, 2.0 * peak.x / max(peak.x + peak.y, 1e-30), max(0.5 * (peak.x + peak.y), 1e-30));
}

fn s_part(colour: vec3f, share: ShareOfS) -> vec3f {
    let brightness = clamp(colour / share.max_reflectance, vec3f(0.0), vec3f(1.0));
    return mix(vec3f(share.black), vec3f(share.bright), brightness);
}

fn s_of_colour(colour: vec3f, share: ShareOfS) -> vec3f {
    return colour * s_part(colour, share);
}

// What light keeps on its way between walls, as factors on the colour that the second wall reflects.
struct Between {
    // After it has passed the first wall.
    passed: vec3f,
    // And after a third wall has reflected it, too.
    reflected: vec3f,
}

// From the colours of three walls over white. s light passes less than p light, and is reflected more.
fn between_walls(n: f32, cos_theta: f32, first: vec3f, second: vec3f, third: vec3f) -> Between {
    let share = share_of_s(n, cos_theta);
    let s_first = s_of_colour(first, share);
    let s_second = s_part(second, share);
    let s_third = s_part(third, share);
    let s = max(1.0 - s_first, vec3f(0.0)) * s_second;
    let p = max(1.0 - 2.0 * first + s_first, vec3f(0.0)) * (2.0 - s_second);
    return Between(0.5 * (s + p), 0.5 * third * (s * s_third + p * (2.0 - s_third)));
}
