//! What is left of shaders, and what compilers say to it.

use std::collections::BTreeSet;

use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::*;
use crate::gpu::{passes::kernels, pipelines::SHARED_CONSTANTS, shaders::Library};

/// The words of a function that is specialised for A = 1 and B = 0.
fn folded(body: &str) -> String {
    let wgsl = format!("override A: u32;\noverride B: u32;\nconst TWO: u32 = 2u;\nfn main() {{ {body} }}\n");
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("pass")).unwrap();
    std::fs::write(folder.path().join("pass/some.wgsl"), wgsl).unwrap();
    let composed = Library::Directory(folder.path().to_owned()).compose("some").unwrap();
    let shader = specialised(&composed, "main", &[("A", 1), ("B", 0)]).unwrap();
    assert_eq!(shader.wgsl.lines().count(), 4);
    let body = shader.wgsl.lines().last().unwrap().strip_prefix(" fn main() {").unwrap().trim_end();
    body.strip_suffix('}').unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn branches_that_constants_rule_out_are_gone() {
    for (body, left) in [
        ("if (A == 1u) { one(); } two();", "{ one(); } two();"),
        ("if (A == 0u) { one(); } two();", "two();"),
        ("if A != 1u { one(); } else { two(); }", "{ two(); }"),
        ("if (B >= TWO) { one(); } else if (A < TWO) { two(); } else { three(); }", "{ two(); }"),
        ("if (A == 1u) { one(); } else if (x) { two(); } else { three(); } four();", "{ one(); } four();"),
        ("if (x) { one(); } else if (A == 1u) { two(); } else { three(); }", "if (x) { one(); } else { two(); }"),
        ("if (x) { one(); } else if (B == 1u) { two(); } three();", "if (x) { one(); } three();"),
        ("if (x) { if (B > A) { one(); } two(); }", "if (x) { two(); }"),
        (
            "for (var k = 0u; k < A; k++) { if (B == 1u) { continue; } one(); }",
            "for (var k = 0u; k < A; k++) { one(); }",
        ),
    ] {
        assert_eq!(folded(body), left, "{body}");
    }
}

#[test]
fn conditions_are_known_as_far_as_constants_decide_them() {
    for (condition, known) in [
        ("(A == 1u && x > 0.0)", None),
        ("(B == 1u && x > 0.0)", Some(false)),
        ("(f(a, b) || A == 1u)", Some(true)),
        ("((B == 1u || x) && A == 1u)", None),
        ("((B == 1u || A == 0u) && x)", Some(false)),
        ("((a + b) * c < d || A >= 1u)", Some(true)),
        ("(!(A == 1u))", None),
        ("(A == 1.0)", None),
        ("(C == 1u)", None),
    ] {
        let left = folded(&format!("if {condition} {{ one(); }}"));
        let expected = match known {
            Some(true) => "{ one(); }".to_owned(),
            Some(false) => String::new(),
            None => format!("if {condition} {{ one(); }}"),
        };
        assert_eq!(left, expected, "{condition}");
    }
}

#[test]
fn nothing_stands_after_a_jump_that_took_the_place_of_a_branch() {
    for (body, left) in [
        ("if (A == 1u) { return 1u; } return 2u;", "{ return 1u; }"),
        ("if (x) { return 1u; } return 2u;", "if (x) { return 1u; } return 2u;"),
        ("loop { if (A == 1u) { break; } one(); } two();", "loop { { break; } } two();"),
        ("{ if (x) { return 1u; } else { return 2u; } } one();", "{ if (x) { return 1u; } else { return 2u; } }"),
        (
            "switch x { case 0u: { return 1u; } default: { return 2u; } } one();",
            "switch x { case 0u: { return 1u; } default: { return 2u; } } one();",
        ),
    ] {
        assert_eq!(folded(body), left, "{body}");
    }
}

#[test]
fn bindings_and_functions_without_a_use_are_left_out() {
    let wgsl = "override READS: u32;\n\
        @group(0) @binding(0) var<storage, read_write> result: array<u32>;\n\
        @group(0) @binding(7) var<storage, read> source: array<u32>;\n\
        fn plain(source: u32) -> u32 { let result = source; return result; }\n\
        fn value_of() -> u32 { if (READS == 0u) { return plain(1u); } let value = source[0]; return value; }\n\
        @compute @workgroup_size(1) fn main() { result[0] = value_of(); }\n\
        @compute @workgroup_size(1) fn other() { result[1] = value_of(); }\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("pass")).unwrap();
    std::fs::write(folder.path().join("pass/some.wgsl"), wgsl).unwrap();
    let composed = Library::Directory(folder.path().to_owned()).compose("some").unwrap();
    for (reads, bindings) in [(1, vec![0, 7]), (0, vec![0])] {
        let shader = specialised(&composed, "main", &[("READS", reads)]).unwrap();
        assert_eq!(shader.bindings, bindings);
        assert!(!shader.wgsl.contains("fn other"));
        assert_eq!(shader.wgsl.lines().count(), wgsl.lines().count(), "lines stay where they were");
        naga::front::wgsl::parse_str(&shader.wgsl).unwrap();
    }
    let error = specialised(&composed, "mian", &[]).err().unwrap();
    assert_eq!(error.to_string(), "shader pass/some.wgsl:1: there is no entry point `mian`");
    let error = specialised(&composed, "main", &[]).err().unwrap();
    assert_eq!(error.to_string(), "shader pass/some.wgsl:1: `READS` has no value");
}

/// Numbers of the bindings that the one entry point of a text uses, as naga sees it.
fn used(wgsl: &str) -> Vec<u32> {
    let module = naga::front::wgsl::parse_str(wgsl).unwrap();
    let info = Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).unwrap();
    let point = info.get_entry_point(0);
    let variables = module.global_variables.iter().filter(|(handle, _)| !point[*handle].is_empty());
    variables.filter_map(|(_, variable)| Some(variable.binding?.binding)).collect()
}

/// While a shader is being written, anything may be in its file.
#[test]
fn broken_text_is_left_to_the_compiler() {
    let composed = Library::Embedded.compose("bubble").unwrap();
    let constants: Vec<_> = ["INNER", "SAMPLES", "ON_BATH", "OUTLINE"].map(|name| (name, 1)).into();
    for cut in (0..composed.wgsl.len()).step_by(499) {
        let (before, after) = composed.wgsl.split_at(composed.wgsl.floor_char_boundary(cut));
        let lines = composed.wgsl.lines().count();
        for text in [before, after] {
            let mut broken = composed.clone();
            broken.wgsl = text.to_owned();
            let shader = specialised(&broken, "shade", &constants);
            assert!(shader.is_err() || shader.is_ok_and(|shader| shader.wgsl.lines().count() <= lines));
        }
    }
}

#[test]
fn every_kernel_has_the_bindings_that_compilers_see() {
    for kernel in kernels() {
        let composed = Library::Embedded.compose(kernel.pass).unwrap();
        let declares = |name: &str| composed.declares(name);
        let shared: Vec<_> = SHARED_CONSTANTS.iter().copied().filter(|(name, _)| declares(name)).collect();
        let entries = kernel.entries.names();
        for constants in kernel.specialisations(declares) {
            let constants: Vec<_> = constants.into_iter().chain(shared.iter().copied()).collect();
            for entry in &entries {
                let shader = specialised(&composed, entry, &constants).unwrap();
                let numbers = |list: Vec<u32>| list.into_iter().collect::<BTreeSet<_>>();
                let (own, seen) = (numbers(shader.bindings), numbers(used(&shader.wgsl)));
                assert_eq!(own, seen, "{entry} of {} with {constants:?}", kernel.pass);
            }
        }
    }
}
