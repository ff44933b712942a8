// What the device itself knows of a film and decides about it. Mirrors `ControlBlock` in src/gpu/control.rs.
struct Control {
    ticks_since_remap: u32,
    remaps: u32,
    // The map's distortion over the limit, as the bits of a float that is not negative: they sort like the floats.
    distortion: atomic<u32>,
    // Values that were not finite and have been replaced.
    sanitised: atomic<u32>,
    // Ticks that the last remap came after the one before it.
    ticks_remapped: u32,
    // What evaporation has left in black film, at which it ends, as a mean over the sphere in nm.
    spared_nm: f32,
    // What has left the film at its rim, as a mean over the film in nm.
    drained_nm: f32,
}

// From a field's departure from a film's level to what is made of it: d + offset + slope d, which restores the amount of liquid, and the
// level itself where a thickness is needed. Mirrors `BalanceBlock`.
struct Balance {
    offset: f32,
    slope: f32,
    level: f32,
}

fn balanced(departure: f32, balance: Balance) -> f32 {
    return balance.level + (departure + (balance.offset + balance.slope * departure));
}

// By its bits: compilers may assume that NaN does not occur.
fn is_finite(x: f32) -> bool {
    return (bitcast<u32>(x) & 0x7f800000u) != 0x7f800000u;
}

fn all_finite(v: vec4f) -> bool {
    return all((bitcast<vec4u>(v) & vec4u(0x7f800000u)) != vec4u(0x7f800000u));
}
