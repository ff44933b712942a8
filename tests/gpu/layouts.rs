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
        drain::{DrainUniform, PatchValue},
        draw::{BubbleUniform, LightUniform, ViewUniform},
        film::{BalanceBlock, ControlBlock, GustsUniform, PushesUniform, RemapArguments, ThicknessUniform},
        flow::{
            CoarseLevel, CoarseUniform, CombineUniform, FlowMeasures, FlowUniform, HoldUniform, ImageUniform,
            SolveUniform,
        },
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
#[derive(Clone)]
struct Mirror {
    name: &'static str,
    size: usize,
    offsets: Vec<(&'static str, usize)>,
}

/// `Name = Rust { member, other as field }`: each member of the WGSL struct, and the Rust field where its name is another.
macro_rules! mirror {
    ($name:ident = $rust:ty { $($member:ident $(as $field:ident)?),+ }) => {
        Mirror {
            name: stringify!($name),
            size: size_of::<$rust>(),
            offsets: vec![$((stringify!($member), mirror!(@offset $rust, $member $(, $field)?))),+],
        }
    };
    (@offset $rust:ty, $member:ident, $field:ident) => { offset_of!($rust, $field) };
    (@offset $rust:ty, $member:ident) => { offset_of!($rust, $member) };
}

/// What pictures and their colours are made from.
fn picture_mirrors() -> Vec<Mirror> {
    vec![
        mirror! { View = ViewUniform { forward, pixel_height, right, width, up, height } },
        mirror! { Light = LightUniform {
            gain, texel_angle, backdrop, backdrop_is_environment, scale, turn_cos, polariser, turn_sin, seen
        } },
        mirror! { Bubble = BubbleUniform {
            to_centre_m, radius_m, inner, outer, thickness_nm, cells, tracer_cells, thinned_nm, to_film,
            stretch, unstretch, black_nm, extra_nm, skins_nm, map_cells, rim_z
        } },
        mirror! { TableAxes = TableAxes { size, max_thickness_nm, index } },
        mirror! { Bake = BakeUniform { axes, first_row } },
        mirror! { Band = BandSample { response, wavelength_nm, index, gap_nm, width_nm } },
        mirror! { ProbePoint = ProbePoint { cos_theta, front_nm, back_nm, exit_nm, walls } },
        mirror! { Tonemap = TonemapUniform {
            balance, to_display, to_xyz, from_xyz, exposure, dither_seed, dither_steps
        } },
        mirror! { OpenHole = OpenHoleUniform {
            middle, seconds, delay, radius_nm, cells, thickness_nm, thinned_nm, black_nm, seeks
        } },
        mirror! { Rim = RimValue { outer_rad, inner_rad, thickness_nm, padding } },
    ]
}

/// What moves a film.
fn film_mirrors() -> Vec<Mirror> {
    vec![
        mirror! { Patch = PatchValue { middle_thickness, age } },
        mirror! { Drain = DrainUniform {
            gravity, flux, cells, thinned_level_nm, black_nm, drop_cos, rim_z, inversion, patch_radius,
            patches_count, patches
        } },
        mirror! { Compose = ComposeUniform { cells, step_cells, quad_skew } },
        mirror! { Sample = SampleUniform { cells, map_cells, tracer_cells, rim_z, inversion, quad_skew } },
        mirror! { Blacken = BlackenUniform { cells, level_nm, thinned_level_nm, black_nm, onset_nm, rate } },
        mirror! { Conserve = ConserveUniform { cells, parts, mean, mean_rest, low, high, bounded, level, film_area } },
        mirror! { Decide = DecideUniform {
            cells, cell_angle, error_limit, ticks, latest_ticks, tracer_groups, sum_groups, map_groups, quad_groups
        } },
        mirror! { Arguments = RemapArguments { tracer_groups, sum_groups, one_group, map_groups, quad_groups } },
        mirror! { Control = ControlBlock { ticks_since_remap, remaps, distortion, healed, ticks_remapped, spared_nm, drained_nm } },
        mirror! { Balance = BalanceBlock { offset, slope, level } },
        mirror! { Diffuse = DiffuseUniform { cells, stage, rate, most, before, earlier } },
        mirror! { Thickness = ThicknessUniform { cells, map_cells, tracer_cells, reference_nm, offset_nm, level_nm, black_nm, rim_z, inversion } },
        mirror! { Step = StepUniform {
            frame, moments, turn_rad_s, dt_s, cells, waves_count, vortices_count, traces, waves, vortices
        } },
        mirror! { Solved = SolvedUniform { dt_s, cells } },
        mirror! { WindMoment = WindMoment { shift_sin, shift_cos, reversal } },
        mirror! { Wave = FrozenWave { k_phase as k, gain as amplitude } },
        mirror! { Vortex = FrozenVortex { centre_sharpness as center, gain as strength } },
    ]
}

/// What solves its flow, and what drives it.
fn flow_mirrors() -> Vec<Mirror> {
    vec![
        mirror! { Hold = HoldUniform { cells, rim, inner } },
        mirror! { Image = ImageUniform { rim_z, inversion, cells } },
        mirror! { Flow = FlowUniform { gravity, dt_s, drag, air_drag, min_air_speed, cell_angle, cells } },
        mirror! { Measures = FlowMeasures { zeta_mean, guess_mean, max_speed, unusable } },
        mirror! { Combine = CombineUniform { first, second, third, mean } },
        mirror! { Solve = SolveUniform { weights, shift, gain, cell_angle, cells, coarse_cells, coarse_field } },
        mirror! { Coarse = CoarseUniform { levels, values, shift, sweeps, level, coarsest } },
        mirror! { Level = CoarseLevel { weights, cell_angle, cells, field, tangent, halo } },
        mirror! { HaloEntry = HaloEntry { cell as target, sources as source, weights } },
        mirror! { Gusts = GustsUniform { cells, waves_count, vortices_count, rate, waves, vortices } },
        mirror! { Pushes = PushesUniform { cells, count, pushes } },
        mirror! { Push = FrozenPush { centre_sharpness as centre, velocity_rate as velocity } },
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
    let mirrors = [picture_mirrors(), film_mirrors(), flow_mirrors()].concat();
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
