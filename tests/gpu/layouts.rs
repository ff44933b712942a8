//! Structs that Rust writes and WGSL reads lie in memory alike.

use std::mem::offset_of;

use naga::{AddressSpace, Handle, Module, Type, TypeInner};
use soapfilm::{
    gpu::{
        bake_table::{BakeUniform, TableAxes},
        bands::BandSample,
        blacken::BlackenUniform,
        compose_map::ComposeUniform,
        conserve::ConserveUniform,
        decide_remap::DecideUniform,
        diffuse::DiffuseUniform,
        draw::{BubbleUniform, LightUniform, ViewUniform},
        film::{BalanceBlock, ControlBlock, GustsUniform, PushesUniform, RemapArguments, ThicknessUniform},
        flow::{CoarseLevel, CoarseUniform, CombineUniform, FlowMeasures, FlowUniform, SolveUniform},
        open_hole::{OpenHoleUniform, RimValue},
        probe_colour::ProbePoint,
        sample_tracer::SampleUniform,
        tonemap::TonemapUniform,
        trace_step::{SolvedUniform, StepUniform, WindMoment},
    },
    physics::{
        film::{FrozenPush, FrozenVortex, FrozenWave},
        sphere::HaloEntry,
    },
};

use crate::passes::{names, parse};

/// A Rust struct by the name that it has in WGSL, and the offsets of its fields by theirs.
struct Mirror {
    name: &'static str,
    size: usize,
    offsets: Vec<(&'static str, usize)>,
}

macro_rules! mirror {
    ($name:literal, $rust:ty, $($member:ident = $field:ident),+ $(,)?) => {
        Mirror {
            name: $name,
            size: size_of::<$rust>(),
            offsets: vec![$((stringify!($member), offset_of!($rust, $field))),+],
        }
    };
}

fn mirrors() -> Vec<Mirror> {
    vec![
        mirror!(
            "View",
            ViewUniform,
            eye_m = eye_m,
            pixel_height = pixel_height,
            forward = forward,
            width = width,
            right = right,
            height = height,
            up = up
        ),
        mirror!(
            "Light",
            LightUniform,
            gain = gain,
            texel_angle = texel_angle,
            backdrop = backdrop,
            backdrop_is_environment = backdrop_is_environment,
            scale = scale,
            turn_cos = turn_cos,
            polariser = polariser,
            turn_sin = turn_sin,
            seen = seen
        ),
        mirror!(
            "Bubble",
            BubbleUniform,
            centre_m = centre_m,
            radius_m = radius_m,
            inner = inner,
            outer = outer,
            thickness_nm = thickness_nm,
            cells = cells,
            tracer_cells = tracer_cells,
            thinned_nm = thinned_nm,
            to_film = to_film,
            stretch = stretch,
            unstretch = unstretch,
            black_nm = black_nm,
            extra_nm = extra_nm,
            skins_nm = skins_nm,
            map_cells = map_cells
        ),
        mirror!("TableAxes", TableAxes, size = size, max_thickness_nm = max_thickness_nm, index = index),
        mirror!("Bake", BakeUniform, axes = axes, first_row = first_row),
        mirror!(
            "Band",
            BandSample,
            response = response,
            wavelength_nm = wavelength_nm,
            index = index,
            gap_nm = gap_nm,
            width_nm = width_nm
        ),
        mirror!(
            "ProbePoint",
            ProbePoint,
            cos_theta = cos_theta,
            front_nm = front_nm,
            back_nm = back_nm,
            exit_nm = exit_nm,
            walls = walls
        ),
        mirror!(
            "Tonemap",
            TonemapUniform,
            balance = balance,
            to_display = to_display,
            to_xyz = to_xyz,
            from_xyz = from_xyz,
            exposure = exposure,
            dither_seed = dither_seed,
            dither_steps = dither_steps
        ),
        mirror!("Compose", ComposeUniform, cells = cells, step_cells = step_cells),
        mirror!("Sample", SampleUniform, cells = cells, map_cells = map_cells, tracer_cells = tracer_cells),
        mirror!(
            "OpenHole",
            OpenHoleUniform,
            middle = middle,
            seconds = seconds,
            delay = delay,
            radius_nm = radius_nm,
            cells = cells,
            thickness_nm = thickness_nm,
            thinned_nm = thinned_nm,
            black_nm = black_nm,
            seeks = seeks
        ),
        mirror!(
            "Rim",
            RimValue,
            outer_rad = outer_rad,
            inner_rad = inner_rad,
            thickness_nm = thickness_nm,
            padding = padding
        ),
        mirror!(
            "Blacken",
            BlackenUniform,
            cells = cells,
            level_nm = level_nm,
            thinned_level_nm = thinned_level_nm,
            black_nm = black_nm,
            onset_nm = onset_nm,
            rate = rate
        ),
        mirror!(
            "Conserve",
            ConserveUniform,
            cells = cells,
            parts = parts,
            mean = mean,
            mean_rest = mean_rest,
            low = low,
            high = high,
            bounded = bounded,
            level = level
        ),
        mirror!(
            "Decide",
            DecideUniform,
            cells = cells,
            cell_angle = cell_angle,
            error_limit = error_limit,
            ticks = ticks,
            latest_ticks = latest_ticks,
            tracer_groups = tracer_groups,
            sum_groups = sum_groups,
            map_groups = map_groups
        ),
        mirror!(
            "Arguments",
            RemapArguments,
            tracer_groups = tracer_groups,
            sum_groups = sum_groups,
            one_group = one_group,
            map_groups = map_groups
        ),
        mirror!(
            "Control",
            ControlBlock,
            ticks_since_remap = ticks_since_remap,
            remaps = remaps,
            distortion = distortion,
            healed = healed,
            ticks_remapped = ticks_remapped,
            spared_nm = spared_nm
        ),
        mirror!("Balance", BalanceBlock, offset = offset, slope = slope, level = level),
        mirror!(
            "Flow",
            FlowUniform,
            gravity = gravity,
            dt_s = dt_s,
            drag = drag,
            air_drag = air_drag,
            min_air_speed = min_air_speed,
            cell_angle = cell_angle,
            cells = cells
        ),
        mirror!(
            "Measures",
            FlowMeasures,
            zeta_mean = zeta_mean,
            guess_mean = guess_mean,
            max_speed = max_speed,
            unusable = unusable
        ),
        mirror!("Combine", CombineUniform, first = first, second = second, mean = mean),
        mirror!(
            "Solve",
            SolveUniform,
            weights = weights,
            shift = shift,
            gain = gain,
            cell_angle = cell_angle,
            cells = cells,
            coarse_cells = coarse_cells,
            coarse_field = coarse_field
        ),
        mirror!(
            "Coarse",
            CoarseUniform,
            levels = levels,
            values = values,
            shift = shift,
            sweeps = sweeps,
            level = level,
            coarsest = coarsest
        ),
        mirror!(
            "Level",
            CoarseLevel,
            weights = weights,
            cell_angle = cell_angle,
            cells = cells,
            field = field,
            tangent = tangent,
            halo = halo
        ),
        mirror!("HaloEntry", HaloEntry, cell = target, sources = source, weights = weights),
        mirror!(
            "Step",
            StepUniform,
            frame = frame,
            moments = moments,
            turn_rad_s = turn_rad_s,
            dt_s = dt_s,
            cells = cells,
            waves_count = waves_count,
            vortices_count = vortices_count,
            waves = waves,
            vortices = vortices
        ),
        mirror!("Solved", SolvedUniform, dt_s = dt_s, cells = cells),
        mirror!(
            "Diffuse",
            DiffuseUniform,
            cells = cells,
            stage = stage,
            rate = rate,
            most = most,
            before = before,
            earlier = earlier
        ),
        mirror!(
            "Thickness",
            ThicknessUniform,
            cells = cells,
            map_cells = map_cells,
            tracer_cells = tracer_cells,
            reference_nm = reference_nm,
            offset_nm = offset_nm,
            level_nm = level_nm,
            black_nm = black_nm
        ),
        mirror!(
            "Gusts",
            GustsUniform,
            cells = cells,
            waves_count = waves_count,
            vortices_count = vortices_count,
            rate = rate,
            waves = waves,
            vortices = vortices
        ),
        mirror!("Pushes", PushesUniform, cells = cells, count = count, pushes = pushes),
        mirror!("Push", FrozenPush, centre_sharpness = centre, velocity_rate = velocity),
        mirror!("WindMoment", WindMoment, shift_sin = shift_sin, shift_cos = shift_cos, reversal = reversal),
        mirror!("Wave", FrozenWave, k_phase = k, gain = amplitude),
        mirror!("Vortex", FrozenVortex, centre_sharpness = center, gain = strength),
    ]
}

/// Structs reachable from a module's buffers, and whether a list of them is read, so that the size counts to the byte.
fn buffer_structs(module: &Module) -> Vec<(Handle<Type>, bool)> {
    let in_buffers = module
        .global_variables
        .iter()
        .filter(|(_, variable)| matches!(variable.space, AddressSpace::Uniform | AddressSpace::Storage { .. }));
    let mut found = Vec::new();
    in_buffers.for_each(|(_, variable)| collect(module, variable.ty, false, &mut found));
    found
}

fn collect(module: &Module, ty: Handle<Type>, in_array: bool, found: &mut Vec<(Handle<Type>, bool)>) {
    match &module.types[ty].inner {
        TypeInner::Array { base, .. } => collect(module, *base, true, found),
        TypeInner::Struct { members, .. } => {
            found.push((ty, in_array));
            members.iter().for_each(|member| collect(module, member.ty, false, found));
        }
        _ => {}
    }
}

/// What differs between a struct of a module and its mirror.
fn differences(module: &Module, ty: Handle<Type>, in_array: bool, mirrors: &[Mirror]) -> Vec<String> {
    let name = module.types[ty].name.clone().unwrap_or_default();
    let TypeInner::Struct { members, span } = &module.types[ty].inner else { return vec![] };
    let Some(mirror) = mirrors.iter().find(|mirror| mirror.name == name) else {
        return vec![format!("{name}: no Rust struct is compared with it")];
    };
    let mut wrong = Vec::new();
    // A single uniform may be followed by padding that WGSL does not name.
    let size_fits = if in_array { mirror.size == *span as usize } else { mirror.size >= *span as usize };
    if !size_fits {
        wrong.push(format!("{name}: {} bytes in Rust, {span} in WGSL", mirror.size));
    }
    let named = members.iter().filter_map(|member| Some((member.name.as_deref()?, member.offset)));
    for (member, offset) in named.filter(|(member, _)| *member != "pad") {
        match mirror.offsets.iter().find(|(known, _)| *known == member) {
            None => wrong.push(format!("{name}.{member}: not compared")),
            Some((_, rust)) if *rust != offset as usize => {
                wrong.push(format!("{name}.{member}: at {rust} in Rust, at {offset} in WGSL"));
            }
            Some(_) => {}
        }
    }
    wrong
}

#[test]
fn every_struct_in_a_buffer_lies_like_its_rust_mirror() {
    let mirrors = mirrors();
    let (mut wrong, mut seen) = (Vec::new(), Vec::new());
    for pass in names() {
        let module = parse(pass).unwrap();
        for (ty, in_array) in buffer_structs(&module) {
            seen.extend(module.types[ty].name.clone());
            let found = differences(&module, ty, in_array, &mirrors);
            wrong.extend(found.into_iter().map(|text| format!("{pass}: {text}")));
        }
    }
    for mirror in &mirrors {
        assert!(seen.iter().any(|name| name == mirror.name), "no pass reads a {}", mirror.name);
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_moved_or_missing_member_would_be_noticed() {
    let source = "struct Light { a: f32, b: vec3f, c: f32 } @group(0) @binding(0) var<storage> x: array<Light>;";
    let module = naga::front::wgsl::parse_str(source).unwrap();
    let [(ty, in_array)] = buffer_structs(&module)[..] else { panic!("one struct") };
    let planted = |size, offsets| [Mirror { name: "Light", size, offsets }];
    let told = |mirror: &[Mirror]| differences(&module, ty, in_array, mirror);
    assert!(told(&planted(32, vec![("a", 0), ("b", 16), ("c", 28)])).is_empty());
    assert_eq!(told(&planted(32, vec![("a", 0), ("b", 4), ("c", 28)])), ["Light.b: at 4 in Rust, at 16 in WGSL"]);
    assert_eq!(told(&planted(32, vec![("a", 0), ("b", 16)])), ["Light.c: not compared"]);
    assert_eq!(told(&planted(48, vec![("a", 0), ("b", 16), ("c", 28)])), ["Light: 48 bytes in Rust, 32 in WGSL"]);
    assert!(told(&[])[0].contains("no Rust struct"));
}
