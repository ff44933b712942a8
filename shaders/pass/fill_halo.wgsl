// Fills halo cells from neighbouring panels, by the table of sources and weights that src/physics/sphere makes in f64.
// Edges are one dispatch, corners the next: corners read edges. One invocation a halo cell.

// Entry point `fill_map` serves the flow map, `fill_tracer` the tracer; values differ, the table does not.

// One halo cell, interpolated from four cells. Mirrors `HaloEntry` in src/physics/sphere/halo.rs.
struct HaloEntry {
    cell: u32,
    sources: array<u32, 4>,
    weights: array<f32, 4>,
}

@group(0) @binding(0) var<storage, read> entries: array<HaloEntry>;
@group(0) @binding(1) var<storage, read_write> map: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> tracer: array<f32>;

@compute @workgroup_size(64)
fn fill_map(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&entries)) {
        return;
    }
    var total = vec4f(0.0);
    for (var k = 0u; k < 4u; k++) {
        total += entries[id.x].weights[k] * map[entries[id.x].sources[k]];
    }
    map[entries[id.x].cell] = total;
}

@compute @workgroup_size(64)
fn fill_tracer(@builtin(global_invocation_id) id: vec3u) {
    if (id.x >= arrayLength(&entries)) {
        return;
    }
    var total = 0.0;
    for (var k = 0u; k < 4u; k++) {
        total += entries[id.x].weights[k] * tracer[entries[id.x].sources[k]];
    }
    tracer[entries[id.x].cell] = total;
}
