// How a halo cell gets its value: see src/physics/sphere/halo.rs.

// Mirrors `HaloEntry` there.
struct HaloEntry {
    weights: vec4f,
    cell: u32,
    first: u32,
    step: u32,
}
