// The test winds of the transport literature, in radians per second on the unit sphere. The f64 truth is src/physics/transport.

// Which velocity field a pipeline is made for: see `FlowKind` in src/gpu/passes/trace_step.rs.
override FLOW: u32;
const FLOW_PRESCRIBED: u32 = 0u;
const FLOW_SOLID_BODY: u32 = 1u;
const FLOW_NON_DIVERGENT: u32 = 2u;
const FLOW_DIVERGENT: u32 = 3u;

// sin and cos of one moment's zonal shift 2 pi t / T of the test winds, and their reversal factor cos(pi t / T).
struct WindMoment {
    shift_sin: f32,
    shift_cos: f32,
    reversal: f32,
    pad: f32,
}

// Velocity of a test wind at x in its own frame, whose z axis the background turns about. The deformations (Nair & Lauritzen 2010,
// T = 5) are written in the frame that turns with that background, as vectors, so that nothing is singular at the poles.
fn wind_velocity(x: vec3f, moment: WindMoment, turn_rad_s: f32) -> vec3f {
    let background = turn_rad_s * vec3f(-x.y, x.x, 0.0);
    if (FLOW == FLOW_SOLID_BODY) {
        return background;
    }
    let p = turned(x, moment);
    let rho = length(p.xy);
    var d: vec3f;
    if (FLOW == FLOW_NON_DIVERGENT) {
        // x cross grad(psi) with psi = (10 / T) y^2 cos(pi t / T).
        d = 4.0 * p.y * vec3f(-p.z, 0.0, p.x);
    } else {
        d = -p.z * rho * (rho - p.x) * vec3f(-p.y, p.x, 0.0) + 0.5 * p.y * rho * vec3f(-p.z * p.x, -p.z * p.y, rho * rho);
    }
    d *= moment.reversal;
    return background + vec3f(
        moment.shift_cos * d.x - moment.shift_sin * d.y,
        moment.shift_cos * d.y + moment.shift_sin * d.x,
        d.z,
    );
}

// The position in the frame that turns with the background wind.
fn turned(x: vec3f, moment: WindMoment) -> vec3f {
    return vec3f(moment.shift_cos * x.x + moment.shift_sin * x.y, moment.shift_cos * x.y - moment.shift_sin * x.x, x.z);
}

// Divergence of a test wind at x in its own frame, 1/s: only the divergent wind has any.
fn wind_divergence(x: vec3f, moment: WindMoment) -> f32 {
    if (FLOW != FLOW_DIVERGENT) {
        return 0.0;
    }
    let p = turned(x, moment);
    return -3.0 * p.y * p.z * length(p.xy) * moment.reversal;
}
