//! What can be bound to a kernel: each kind of resource, with the type of what lies in it.

use std::marker::PhantomData;

use wgpu::{
    BindingResource, BindingType, Buffer, BufferBindingType, SamplerBindingType, TextureSampleType, TextureView,
    TextureViewDimension as Dimension,
};

use super::{
    super::uniform_buffer::UniformBuffer,
    layout::{Contents, Layout, ShaderType},
};

/// What a kernel declares of one of its bindings.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SlotKind {
    /// A uniform buffer.
    Uniform(Layout),
    /// A storage buffer that is read.
    Read(Layout),
    /// A storage buffer that is read and written.
    ReadWrite(Layout),
    /// A texture of floats that is sampled or loaded from.
    Texture(Dimension),
    /// A texture of unsigned integers that is loaded from.
    UintTexture(Dimension),
    /// A texture array that is written, and its format.
    Written(wgpu::TextureFormat),
    /// A sampler.
    Sampler,
}

/// A kind of binding.
pub trait Slot {
    /// What is bound there.
    type Resource<'a>: Copy;
    /// What a pipeline's layout says of it.
    const TYPE: BindingType;
    /// What a shader must declare.
    fn kind() -> SlotKind;
    /// The resource as wgpu binds it.
    fn bound(resource: Self::Resource<'_>) -> BindingResource<'_>;
}

/// A uniform buffer that holds a `T`.
pub struct Uniform<T>(PhantomData<T>);
/// A storage buffer that is read: a `T`, or a list where `T` is a slice.
pub struct Read<T: ?Sized>(PhantomData<T>);
/// A storage buffer that is read and written.
pub struct ReadWrite<T: ?Sized>(PhantomData<T>);
/// A texture.
pub struct Texture2d;
/// An array of textures.
pub struct Texture2dArray;
/// A texture of unsigned integers.
pub struct Uint2d;
/// An array of textures of unsigned integers.
pub struct Uint2dArray;
/// A cube map.
pub struct TextureCube;
/// An array of textures that is written.
pub struct Written2dArray<F>(PhantomData<F>);
/// A sampler that filters.
pub struct Sampler;
/// A sampler that filters nothing, for textures that no hardware need filter: shaders gather their texels, four at a time.
pub struct PointSampler;

/// A format of textures that are written.
pub trait WrittenFormat {
    /// The format.
    const FORMAT: wgpu::TextureFormat;
}

/// Four floats a texel.
pub struct Rgba32Float;
/// One float a texel.
pub struct R32Float;
/// Four unsigned integers a texel.
pub struct Rgba32Uint;

impl WrittenFormat for Rgba32Float {
    const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
}

impl WrittenFormat for R32Float {
    const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;
}

impl WrittenFormat for Rgba32Uint {
    const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;
}

/// Makes a type a kind of binding: what is bound, what a shader must declare, what a layout says, and how wgpu takes it.
macro_rules! slot {
    ($({ $($parameter:tt)* })? $slot:ty = $resource:ty, $kind:expr, $type:expr, $bound:expr) => {
        impl $(<$($parameter)*>)? Slot for $slot {
            type Resource<'a> = &'a $resource;

            const TYPE: BindingType = $type;

            fn kind() -> SlotKind {
                $kind
            }

            fn bound(resource: Self::Resource<'_>) -> BindingResource<'_> {
                $bound(resource)
            }
        }
    };
}

/// A texture that is loaded from, of any float format.
const LOADED: TextureSampleType = TextureSampleType::Float { filterable: false };
/// A texture that a sampler filters.
const FILTERED: TextureSampleType = TextureSampleType::Float { filterable: true };

const fn buffer(ty: BufferBindingType) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

const fn written(format: wgpu::TextureFormat) -> BindingType {
    let access = wgpu::StorageTextureAccess::WriteOnly;
    BindingType::StorageTexture { access, format, view_dimension: Dimension::D2Array }
}

slot!(
    { T: ShaderType + 'static } Uniform<T> = UniformBuffer<T>,
    SlotKind::Uniform(T::layout()), buffer(BufferBindingType::Uniform), whole
);
slot!(
    { T: Contents + ?Sized } Read<T> = Buffer,
    SlotKind::Read(T::layout()), buffer(BufferBindingType::Storage { read_only: true }), whole
);
slot!(
    { T: Contents + ?Sized } ReadWrite<T> = Buffer,
    SlotKind::ReadWrite(T::layout()), buffer(BufferBindingType::Storage { read_only: false }), whole
);
/// Makes a type a texture that is read, of a kind, a way to read it and a shape.
macro_rules! texture_slot {
    ($slot:ty, $kind:ident, $read:expr, $dimension:ident) => {
        slot!(
            $slot = TextureView,
            SlotKind::$kind(Dimension::$dimension),
            BindingType::Texture { sample_type: $read, view_dimension: Dimension::$dimension, multisampled: false },
            BindingResource::TextureView
        );
    };
}

texture_slot!(Texture2d, Texture, LOADED, D2);
texture_slot!(Texture2dArray, Texture, LOADED, D2Array);
texture_slot!(TextureCube, Texture, FILTERED, Cube);
texture_slot!(Uint2d, UintTexture, TextureSampleType::Uint, D2);
texture_slot!(Uint2dArray, UintTexture, TextureSampleType::Uint, D2Array);
slot!(
    { F: WrittenFormat } Written2dArray<F> = TextureView,
    SlotKind::Written(F::FORMAT), written(F::FORMAT), BindingResource::TextureView
);
slot!(
    Sampler = wgpu::Sampler,
    SlotKind::Sampler,
    BindingType::Sampler(SamplerBindingType::Filtering),
    BindingResource::Sampler
);
slot!(
    PointSampler = wgpu::Sampler,
    SlotKind::Sampler,
    BindingType::Sampler(SamplerBindingType::NonFiltering),
    BindingResource::Sampler
);

fn whole(buffer: &Buffer) -> BindingResource<'_> {
    buffer.as_entire_binding()
}
