// What is polarised of the picture, kept for the bubbles in front: see light/stokes.wgsl. Its axis is that of `picture_axis`.
//
// The pass that draws bubbles declares what this reads: `light`, `polarised_behind`, `quadrature` and `view`.

import package::light::stokes::{Stokes, turned, unpacked};
import package::optics::walls::{TRACKS_POLARISATION, WAVELENGTHS, Walls, wavelength_polarisation};
import package::sphere::path::Path;

// What is polarised of the picture behind the last sample and at it, and the sum over a pixel's samples, with their number.
var<private> sample_behind: Stokes;
var<private> sample_polarisation: Stokes;
var<private> polarisation: Stokes;
var<private> polarisation_samples: f32;

// The axis that what is polarised of the picture refers to.
fn picture_axis(direction: vec3f) -> vec3f {
    return normalize(cross(direction, view.up));
}

fn polarisation_behind(position: vec2f) -> Stokes {
    return unpacked(textureLoad(polarised_behind, vec2u(position), 0));
}

// Counts what is polarised at a sample of which the bubble covers a part.
fn count_polarisation(coverage: f32) {
    if (TRACKS_POLARISATION == 1u) {
        polarisation.q += mix(sample_behind.q, sample_polarisation.q, coverage);
        polarisation.u += mix(sample_behind.u, sample_polarisation.u, coverage);
        polarisation_samples += 1.0;
    }
}

// What is polarised along a path: what is polarised behind, of which walls leave a part, and what they add.
fn path_polarisation(path: Path, walls: Walls, behind: Stokes, turn: vec2f) -> Stokes {
    var change = mat2x3f();
    let of_light = light.unseen * behind.u;
    for (var k = 0u; k < WAVELENGTHS; k++) {
        change += wavelength_polarisation(quadrature[k], path.cos_theta, walls, of_light);
    }
    let found = Stokes(vec3f(0.0), behind.q + light.scale * change[0], behind.u + light.scale * change[1]);
    return turned(found, vec2f(turn.x, -turn.y));
}

// The mean over a pixel's samples.
fn mean_polarisation() -> Stokes {
    let part = 1.0 / max(polarisation_samples, 1.0);
    return Stokes(vec3f(0.0), part * polarisation.q, part * polarisation.u);
}
