//! What shaders declare of their bindings, in the words of kernels.

use naga::{
    AddressSpace, ArraySize, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ScalarKind as NagaKind,
    StorageAccess, StorageFormat, Type, TypeInner,
};
use soapfilm::gpu::kernel::{Layout, Scalar, ScalarKind, SlotKind};

/// What a shader declares of a binding.
pub fn kind_of(module: &Module, global: &GlobalVariable) -> Result<SlotKind, String> {
    let layout = || layout_of(module, global.ty);
    match (global.space, &module.types[global.ty].inner) {
        (AddressSpace::Uniform, _) => Ok(SlotKind::Uniform(layout()?)),
        (AddressSpace::Storage { access }, _) if access == StorageAccess::LOAD => Ok(SlotKind::Read(layout()?)),
        (AddressSpace::Storage { .. }, _) => Ok(SlotKind::ReadWrite(layout()?)),
        (AddressSpace::Handle, TypeInner::Sampler { comparison: false }) => Ok(SlotKind::Sampler),
        (AddressSpace::Handle, TypeInner::Image { dim, arrayed, class }) => image_kind(*dim, *arrayed, *class),
        (_, inner) => Err(format!("no kernel can declare {inner:?}")),
    }
}

fn image_kind(dim: ImageDimension, arrayed: bool, class: ImageClass) -> Result<SlotKind, String> {
    use wgpu::TextureViewDimension as Dimension;
    let dimension = match (dim, arrayed) {
        (ImageDimension::D2, false) => Dimension::D2,
        (ImageDimension::D2, true) => Dimension::D2Array,
        (ImageDimension::Cube, false) => Dimension::Cube,
        other => return Err(format!("no kernel can declare {other:?}")),
    };
    match class {
        ImageClass::Sampled { kind: NagaKind::Float, multi: false } => Ok(SlotKind::Texture(dimension)),
        ImageClass::Sampled { kind: NagaKind::Uint, multi: false } => Ok(SlotKind::UintTexture(dimension)),
        ImageClass::Storage { format: StorageFormat::R32Float, access: StorageAccess::STORE } if arrayed => {
            Ok(SlotKind::Written(wgpu::TextureFormat::R32Float))
        }
        ImageClass::Storage { format: StorageFormat::Rgba32Uint, access: StorageAccess::STORE } if arrayed => {
            Ok(SlotKind::Written(wgpu::TextureFormat::Rgba32Uint))
        }
        ImageClass::Storage { format: StorageFormat::Rgba32Float, access: StorageAccess::STORE } if arrayed => {
            Ok(SlotKind::Written(wgpu::TextureFormat::Rgba32Float))
        }
        other => Err(format!("no kernel can declare {other:?}")),
    }
}

fn layout_of(module: &Module, ty: Handle<Type>) -> Result<Layout, String> {
    let (ty, size, is_list) = match module.types[ty].inner {
        TypeInner::Array { base, size: ArraySize::Dynamic, stride } => (base, stride, true),
        ref inner => (ty, inner.size(module.to_ctx()), false),
    };
    let mut scalars = Vec::new();
    add_scalars(module, ty, (0, ""), &mut scalars)?;
    Ok(Layout { size: size as usize, is_list, scalars })
}

/// Adds the scalars of a type at an offset, which belongs to a member.
fn add_scalars(
    module: &Module,
    ty: Handle<Type>,
    (offset, member): (u32, &str),
    found: &mut Vec<Scalar>,
) -> Result<(), String> {
    let mut add = |scalar: naga::Scalar, places: &mut dyn Iterator<Item = u32>| {
        let kind = match (scalar.kind, scalar.width) {
            (NagaKind::Float, 4) => ScalarKind::F32,
            (NagaKind::Uint, 4) => ScalarKind::U32,
            _ => return Err(format!("no kernel can declare {scalar:?}")),
        };
        found.extend(places.map(|at| Scalar { offset: (offset + at) as usize, kind, member: member.to_owned() }));
        Ok(())
    };
    match &module.types[ty].inner {
        TypeInner::Scalar(scalar) | TypeInner::Atomic(scalar) => add(*scalar, &mut std::iter::once(0)),
        TypeInner::Vector { size, scalar } => add(*scalar, &mut (0..*size as u32).map(|k| 4 * k)),
        TypeInner::Matrix { columns, rows, scalar } => {
            let stride = 4 * (*rows as u32).next_multiple_of(2);
            let places =
                (0..*columns as u32).flat_map(|column| (0..*rows as u32).map(move |row| stride * column + 4 * row));
            add(*scalar, &mut places.collect::<Vec<_>>().into_iter())
        }
        TypeInner::Array { base, size: ArraySize::Constant(count), stride } => {
            (0..count.get()).try_for_each(|k| add_scalars(module, *base, (offset + k * stride, member), found))
        }
        TypeInner::Struct { members, .. } => members.iter().try_for_each(|inner| {
            let name = inner.name.as_deref().unwrap_or_default();
            let path = if member.is_empty() { name.to_owned() } else { format!("{member}.{name}") };
            if name.starts_with("pad") {
                return Ok(());
            }
            add_scalars(module, inner.ty, (offset + inner.offset, &path), found)
        }),
        other => Err(format!("no kernel can declare {other:?}")),
    }
}
