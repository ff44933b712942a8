//! How values lie in memory as far as shaders read them: each scalar with its offset, its kind and the member that it belongs to.

use glam::DMat3;

/// What a scalar is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScalarKind {
    /// A float of 32 bits.
    F32,
    /// An unsigned integer of 32 bits.
    U32,
}

/// One scalar of a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Scalar {
    /// Bytes from the value's start.
    pub offset: usize,
    /// What it is.
    pub kind: ScalarKind,
    /// The member that it belongs to, with those around it: `waves.phase`. Empty where the value is no struct.
    pub member: String,
}

/// What shaders read of a buffer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Bytes of the value; of one value of a list.
    pub size: usize,
    /// Whether the buffer holds a list of any length.
    pub is_list: bool,
    /// Scalars of the value, or of one value of a list, without padding.
    pub scalars: Vec<Scalar>,
}

/// A type that shaders read as it lies in memory. `shader_struct!` implements it for structs.
pub trait ShaderType {
    /// Adds the scalars of a value at an offset in bytes, which belongs to a member of the value around it.
    fn add_scalars(offset: usize, member: &str, found: &mut Vec<Scalar>);
}

/// What a buffer holds: one value, or a list of them.
pub trait Contents {
    /// How it lies in memory.
    fn layout() -> Layout;
}

impl<T: ShaderType> Contents for T {
    fn layout() -> Layout {
        let mut scalars = Vec::new();
        T::add_scalars(0, "", &mut scalars);
        Layout { size: size_of::<T>(), is_list: false, scalars }
    }
}

impl<T: ShaderType> Contents for [T] {
    fn layout() -> Layout {
        Layout { is_list: true, ..T::layout() }
    }
}

impl ShaderType for f32 {
    fn add_scalars(offset: usize, member: &str, found: &mut Vec<Scalar>) {
        found.push(Scalar { offset, kind: ScalarKind::F32, member: member.to_owned() });
    }
}

impl ShaderType for u32 {
    fn add_scalars(offset: usize, member: &str, found: &mut Vec<Scalar>) {
        found.push(Scalar { offset, kind: ScalarKind::U32, member: member.to_owned() });
    }
}

impl<T: ShaderType, const N: usize> ShaderType for [T; N] {
    fn add_scalars(offset: usize, member: &str, found: &mut Vec<Scalar>) {
        (0..N).for_each(|place| T::add_scalars(offset + place * size_of::<T>(), member, found));
    }
}

/// A matrix as buffers hold it: columns of four numbers, the fourth of which is padding.
#[repr(transparent)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Matrix([[f32; 4]; 3]);

impl From<DMat3> for Matrix {
    fn from(matrix: DMat3) -> Self {
        Self(matrix.as_mat3().to_cols_array_2d().map(|[x, y, z]| [x, y, z, 0.0]))
    }
}

impl ShaderType for Matrix {
    fn add_scalars(offset: usize, member: &str, found: &mut Vec<Scalar>) {
        (0..3).for_each(|column| <[f32; 3]>::add_scalars(offset + 16 * column, member, found));
    }
}

/// Adds the scalars of a struct's member, whose type the field tells. Members whose name begins with `pad` fill a struct up, and are none.
pub(crate) fn add_member<S, T: ShaderType>(
    _field: fn(&S) -> &T,
    offset: usize,
    (around, member): (&str, &str),
    found: &mut Vec<Scalar>,
) {
    if !member.starts_with("pad") {
        let path = if around.is_empty() { member.to_owned() } else { format!("{around}.{member}") };
        T::add_scalars(offset, &path, found);
    }
}

/// Declares a struct that Rust writes and shaders read, with the names that its members have there.
macro_rules! shader_struct {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident {
            $($(#[$doc:meta])* $visibility:vis $member:ident : $kind:ty),* $(,)?
        }
    ) => {
        $(#[$attribute])*
        #[repr(C)]
        #[derive(Clone, Copy, Debug, ::bytemuck::Pod, ::bytemuck::Zeroable)]
        pub struct $name {
            $($(#[$doc])* $visibility $member: $kind),*
        }

        $crate::gpu::kernel::shader_view! { $name { $($member),* } }
    };
}

/// Lets shaders read a struct that is declared elsewhere; all of its members are named.
macro_rules! shader_view {
    ($name:ident { $($member:ident),* $(,)? }) => {
        impl $crate::gpu::kernel::ShaderType for $name {
            fn add_scalars(offset: usize, member: &str, found: &mut Vec<$crate::gpu::kernel::Scalar>) {
                // A member that is missing above would not compile here.
                let _complete = |$name { $($member: _),* }: $name| ();
                $($crate::gpu::kernel::add_member(
                    |value: &$name| &value.$member,
                    offset + ::std::mem::offset_of!($name, $member),
                    (member, stringify!($member)),
                    found,
                );)*
            }
        }
    };
}

pub(crate) use {shader_struct, shader_view};
