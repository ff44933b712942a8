// How a halo cell gets its value: see src/physics/sphere/halo.rs.

// Mirrors `HaloEntry` there.
struct HaloEntry {
    cell: u32,
    sources: array<u32, 4>,
    weights: array<f32, 4>,
}
