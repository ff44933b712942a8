//! Kernels are declared as their shaders are written: bindings, what lies in them, constants, entry points.

use std::collections::BTreeSet;

use naga::{GlobalVariable, Module, ShaderStage, valid::ModuleInfo};
use soapfilm::gpu::{
    kernel::{Binding, Entries, Kernel, Layout, OverrideValues, Scalar, ScalarKind, SlotKind},
    passes::kernels,
    pipelines::SHARED_CONSTANTS,
    shaders::Library,
};

use crate::{
    passes::{entries_together, file_names, parse, validate},
    shader_kinds::kind_of,
};

/// A pass as naga sees it.
struct Reflected {
    module: Module,
    info: ModuleInfo,
}

impl Reflected {
    fn of(pass: &str) -> Result<Self, String> {
        let module = parse(pass)?;
        let info = validate(pass, &module)?;
        Ok(Self { module, info })
    }

    /// What is wrong with the kernels of a pass.
    fn all_faults(&self, pass: &str, kernels: &[Kernel]) -> Vec<String> {
        let missing = undeclared(&self.module, kernels).into_iter();
        let missing = missing.map(|entry| format!("{pass}: no kernel declares `{entry}`"));
        kernels.iter().flat_map(|kernel| self.faults(kernel)).chain(missing).collect()
    }

    /// Bindings that an entry point uses.
    fn used(&self, stage: ShaderStage, entry: &str) -> Result<Vec<&GlobalVariable>, String> {
        let mut all = self.module.entry_points.iter();
        let place = all.position(|known| known.stage == stage && known.name == entry);
        let info = self.info.get_entry_point(place.ok_or_else(|| format!("the shader has no {stage:?} `{entry}`"))?);
        let globals = self.module.global_variables.iter();
        let used = globals.filter(|(handle, global)| global.binding.is_some() && !info[*handle].is_empty());
        Ok(used.map(|(_, global)| global).collect())
    }

    /// What is wrong with a kernel.
    fn faults(&self, kernel: &Kernel) -> Vec<String> {
        let mut faults = override_faults(&self.module, kernel);
        for together in entries_together(kernel) {
            let used: Result<Vec<_>, String> = together.iter().map(|(stage, entry)| self.used(*stage, entry)).collect();
            let place = format!("{}: {}", kernel.pass, together.last().map_or("", |(_, entry)| entry));
            let found = used.map_or_else(|fault| vec![fault], |used| self.binding_faults(&used.concat(), kernel));
            faults.extend(found.into_iter().map(|fault| format!("{place}: {fault}")));
        }
        faults
    }

    fn binding_faults(&self, used: &[&GlobalVariable], kernel: &Kernel) -> Vec<String> {
        let mut faults = Vec::new();
        for global in used {
            let (number, name) = (number_of(global), global.name.as_deref().unwrap_or_default());
            match kernel.bindings.iter().find(|binding| binding.name == name) {
                None => faults.push(format!("`{name}` is not declared")),
                Some(binding) if binding.number != number => {
                    faults.push(format!("`{name}` is declared at {}, in WGSL at {number}", binding.number));
                }
                Some(binding) => faults.extend(self.kind_fault(global, binding)),
            }
        }
        let is_used = |binding: &&Binding| used.iter().any(|global| global.name.as_deref() == Some(binding.name));
        let unused = kernel.bindings.iter().filter(|binding| !is_used(binding));
        faults.extend(unused.map(|binding| format!("`{}` is declared and not used", binding.name)));
        faults
    }

    fn kind_fault(&self, global: &GlobalVariable, binding: &Binding) -> Option<String> {
        let found = match kind_of(&self.module, global) {
            Ok(found) => found,
            Err(fault) => return Some(format!("`{}`: {fault}", binding.name)),
        };
        let differ = match (&found, &binding.kind) {
            (SlotKind::Uniform(wgsl), SlotKind::Uniform(rust))
            | (SlotKind::Read(wgsl), SlotKind::Read(rust))
            | (SlotKind::ReadWrite(wgsl), SlotKind::ReadWrite(rust)) => layout_fault(wgsl, rust),
            (found, declared) if found == declared => None,
            (found, declared) => Some(format!("declared as {}, in WGSL {}", told(declared), told(found))),
        };
        differ.map(|fault| format!("`{}`: {fault}", binding.name))
    }
}

fn number_of(global: &GlobalVariable) -> u32 {
    global.binding.map_or(u32::MAX, |binding| binding.binding)
}

/// A kind in a few words.
fn told(kind: &SlotKind) -> String {
    match kind {
        SlotKind::Uniform(_) => "a uniform".to_owned(),
        SlotKind::Read(_) => "read".to_owned(),
        SlotKind::ReadWrite(_) => "read and written".to_owned(),
        other => format!("{other:?}"),
    }
}

/// What differs between what WGSL reads and what Rust writes.
fn layout_fault(wgsl: &Layout, rust: &Layout) -> Option<String> {
    if wgsl.is_list != rust.is_list {
        return Some(format!("a list: {} in Rust, {} in WGSL", rust.is_list, wgsl.is_list));
    }
    // A single value may be followed by padding that WGSL does not name; a list's may not.
    let size_fits = if wgsl.is_list { rust.size == wgsl.size } else { rust.size >= wgsl.size };
    if !size_fits {
        return Some(format!("{} bytes in Rust, {} in WGSL", rust.size, wgsl.size));
    }
    let pairs = wgsl.scalars.iter().zip(&rust.scalars);
    let different = pairs.clone().find(|(wgsl, rust)| wgsl != rust);
    match different {
        Some((wgsl, rust)) => Some(format!("{} in Rust, {} in WGSL", scalar_told(rust), scalar_told(wgsl))),
        None if wgsl.scalars.len() != rust.scalars.len() => {
            let more = wgsl.scalars.get(pairs.len()).or_else(|| rust.scalars.get(pairs.len()))?;
            Some(format!("{} is on one side alone", scalar_told(more)))
        }
        None => None,
    }
}

fn scalar_told(scalar: &Scalar) -> String {
    format!("`{}` {:?} at {}", scalar.member, scalar.kind, scalar.offset)
}

fn override_faults(module: &Module, kernel: &Kernel) -> Vec<String> {
    let shader: Vec<&str> = module.overrides.iter().filter_map(|(_, known)| known.name.as_deref()).collect();
    let is_shared = |name: &&str| SHARED_CONSTANTS.iter().any(|(shared, _)| shared == name);
    let is_declared = |name: &&str| kernel.overrides.iter().any(|declared| declared.name == *name);
    let missing = shader.iter().filter(|name| !is_shared(name) && !is_declared(name));
    let missing = missing.map(|name| format!("{}: the constant `{name}` is not declared", kernel.pass));
    let unknown = kernel.overrides.iter().filter(|declared| !shader.contains(&declared.name));
    let unknown = unknown.map(|declared| format!("{}: the shader has no constant `{}`", kernel.pass, declared.name));
    missing.chain(unknown).collect()
}

/// Entry points of a pass that no kernel declares.
fn undeclared(module: &Module, kernels: &[Kernel]) -> Vec<String> {
    let declared: BTreeSet<&str> = kernels.iter().flat_map(|kernel| kernel.entries.names()).collect();
    let entries = module.entry_points.iter().map(|entry| entry.name.clone());
    entries.filter(|entry| !declared.contains(entry.as_str())).collect()
}

#[test]
fn kernels_are_declared_as_their_shaders_are_written() {
    let all = kernels();
    let files = file_names("pass");
    let lost = all.iter().filter(|kernel| !files.iter().any(|file| file == kernel.pass));
    let mut faults: Vec<String> = lost.map(|kernel| format!("{}: no such file", kernel.pass)).collect();
    for pass in &files {
        let kernels: Vec<_> = all.iter().filter(|kernel| kernel.pass == pass).cloned().collect();
        let found = Reflected::of(pass).map(|reflected| reflected.all_faults(pass, &kernels));
        faults.extend(found.unwrap_or_else(|fault| vec![fault]));
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_shader_file_is_part_of_a_pass() {
    let mut reached = BTreeSet::new();
    for pass in file_names("pass") {
        let composed = Library::Embedded.compose(&pass).unwrap();
        let lines = 1..=composed.wgsl.lines().count();
        reached.extend(lines.filter_map(|line| Some(composed.place(line).split_once(".wgsl")?.0.to_owned())));
    }
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let folders = std::fs::read_dir(root).unwrap().map(|folder| folder.unwrap().file_name().into_string().unwrap());
    let all: BTreeSet<String> = folders
        .flat_map(|folder| file_names(&folder).into_iter().map(move |file| format!("{folder}/{file}")))
        .collect();
    assert!(all.len() > 50, "only {} files were found", all.len());
    assert_eq!(reached, all);
}

/// A shader with one of each that can be mistaken.
const PLANTED: &str = "
    struct Light { a: f32, b: vec3u, c: mat3x3f }
    override N: u32;
    @group(0) @binding(0) var<uniform> light: Light;
    @group(0) @binding(1) var<storage, read> from_: array<vec2f>;
    @group(0) @binding(2) var<storage, read_write> to: array<f32>;
    @group(0) @binding(3) var film: texture_2d_array<f32>;
    @compute @workgroup_size(1) fn work() {
        to[N] = light.a + from_[0].x + textureLoad(film, vec2u(0u), 0u, 0).x;
    }";

fn scalars(list: &[(usize, ScalarKind, &str)]) -> Vec<Scalar> {
    list.iter().map(|&(offset, kind, member)| Scalar { offset, kind, member: member.to_owned() }).collect()
}

/// The kernel as that shader is written.
fn right() -> Kernel {
    use ScalarKind::{F32, U32};
    let mut light = vec![(0, F32, "a"), (16, U32, "b"), (20, U32, "b"), (24, U32, "b")];
    light.extend([32, 36, 40, 48, 52, 56, 64, 68, 72].map(|offset| (offset, F32, "c")));
    let list = |size, places: &[(usize, ScalarKind, &str)]| Layout { size, is_list: true, scalars: scalars(places) };
    let binding = |(number, (name, kind))| Binding { number, name, kind };
    let kinds = [
        ("light", SlotKind::Uniform(Layout { size: 80, is_list: false, scalars: scalars(&light) })),
        ("from_", SlotKind::Read(list(8, &[(0, F32, ""), (4, F32, "")]))),
        ("to", SlotKind::ReadWrite(list(4, &[(0, F32, "")]))),
        ("film", SlotKind::Texture(wgpu::TextureViewDimension::D2Array)),
    ];
    Kernel {
        pass: "planted",
        entries: Entries::Compute(vec!["work"]),
        bindings: (0..).zip(kinds).map(binding).collect(),
        overrides: vec![OverrideValues { name: "N", values: vec![0] }],
    }
}

/// What is wrong with a kernel that a mistake was planted in.
fn faults_with(plant: impl FnOnce(&mut Kernel)) -> String {
    let module = naga::front::wgsl::parse_str(PLANTED).unwrap();
    let info = validate("tonemap", &module).unwrap();
    let mut kernel = right();
    plant(&mut kernel);
    Reflected { module, info }.all_faults("planted", &[kernel]).join("; ")
}

fn light(kernel: &mut Kernel) -> &mut Layout {
    match &mut kernel.bindings[0].kind {
        SlotKind::Uniform(layout) => layout,
        other => panic!("{other:?}"),
    }
}

#[test]
fn mistakes_in_a_layout_are_noticed() {
    let told = |plant: fn(&mut Layout)| faults_with(|kernel| plant(light(kernel)));
    assert_eq!(faults_with(|_| ()), "");
    assert_eq!(told(|light| light.size = 96), "", "padding behind a single value");
    assert!(told(|light| light.scalars[1].offset = 4).contains("`b` U32 at 4 in Rust, `b` U32 at 16 in WGSL"));
    assert!(told(|light| light.scalars[0].kind = ScalarKind::U32).contains("`a` U32 at 0 in Rust"));
    assert!(told(|light| light.scalars[0].member = "d".to_owned()).contains("`d` F32 at 0 in Rust"));
    assert!(told(|light| light.scalars.truncate(12)).contains("`c` F32 at 72 is on one side alone"));
    assert!(told(|light| light.scalars.extend(scalars(&[(76, ScalarKind::F32, "more")]))).contains("`more` F32 at 76"));
    assert!(told(|light| light.size = 64).contains("64 bytes in Rust, 80 in WGSL"));
    assert!(told(|light| light.is_list = true).contains("a list: true in Rust"));
}

#[test]
fn mistakes_in_a_kernel_are_noticed() {
    let told = |plant: fn(&mut Kernel)| faults_with(plant);
    let dimension = SlotKind::Texture(wgpu::TextureViewDimension::D2);
    assert!(faults_with(|kernel| kernel.bindings[3].kind = dimension).contains("`film`: declared as Texture(D2)"));
    assert!(told(|kernel| kernel.bindings.swap_remove(1).number = 0).contains("`from_` is not declared"));
    assert!(told(|kernel| kernel.bindings[1].number = 7).contains("`from_` is declared at 7, in WGSL at 1"));
    assert!(told(|kernel| kernel.bindings[1].name = "other").contains("`other` is declared and not used"));
    assert!(told(|kernel| kernel.bindings[1].kind = kernel.bindings[2].kind.clone()).contains("read and written"));
    assert!(told(|kernel| kernel.overrides.clear()).contains("the constant `N` is not declared"));
    assert!(told(|kernel| kernel.overrides[0].name = "M").contains("the shader has no constant `M`"));
    let renamed = told(|kernel| kernel.entries = Entries::Compute(vec!["rest"]));
    assert!(renamed.contains("no Compute `rest`") && renamed.contains("no kernel declares `work`"), "{renamed}");
}
