//! Kernels: shader entry points, each declared once. From the declaration follow the call, which names each binding and each constant, the layout
//! of its pipelines, and what tests hold against the shader: numbers, names, types and uses of bindings, and the constants. A kernel reads like its shader:
//!
//! ```text
//! kernels! {
//!     pass diffuse;                                // shaders/pass/diffuse.wgsl
//!
//!     /// One stage of a film's diffusion.
//!     struct DiffuseStage {
//!         const TAPS: u32 = 4;                     // an override that is always the same here
//!         override HAS_MAP: bool;                  // one that the caller gives
//!         override INNER: u32 in [3, 7, 11];       // one of many values: those that stand for them in tests
//!         overrides table: TableOverrides;         // some that other kernels have too
//!         @0 diffuse: Uniform<DiffuseUniform>;     // @group(0) @binding(0) var<uniform> diffuse: Diffuse;
//!         @1 tangents: Read<[f32]>;                // @group(0) @binding(1) var<storage, read> tangents: array<f32>;
//!     }
//!     compute diffuse_stage;                       // entry points that take these bindings, each a method
//! }
//!
//! DiffuseStage { HAS_MAP: true, …, tangents: &grid.tangents }.diffuse_stage(recorder, STEP_FIELD, groups)?;
//! ```
//!
//! A kernel that draws names its vertex shaders, each a method, and its fragment shader: `draw cover as tonemapped;`.

mod layout;
mod overrides;
mod slots;

pub use layout::{Contents, Layout, Matrix, Scalar, ScalarKind, ShaderType};
pub(crate) use layout::{add_member, shader_struct, shader_view};
pub use overrides::{Choice, Constants, Override, OverrideValues, Overrides};
pub(crate) use overrides::{choices, override_values, overrides};
pub use slots::{
    PointSampler, R32Float, Read, ReadWrite, Rgba32Float, Rgba32Uint, Sampler, Slot, SlotKind, Texture2d,
    Texture2dArray, TextureCube, Uint2d, Uint2dArray, Uniform, Written2dArray, WrittenFormat,
};

use std::collections::BTreeMap;

use super::{
    device::{Gpu, GpuError},
    pipelines::{ComputeKey, RenderKey, SourceKey},
    timing::{Groups, Recorder},
};

/// A kernel as it is declared.
#[derive(Clone, Debug)]
pub struct Kernel {
    /// File in `shaders/pass/`, without the ending.
    pub pass: &'static str,
    /// Its entry points.
    pub entries: Entries,
    /// All that they use of the file's bindings.
    pub bindings: Vec<Binding>,
    /// Constants, but for those that all passes share.
    pub overrides: Vec<OverrideValues>,
}

impl Kernel {
    /// Values for those of its constants that a shader declares: each value of a constant, beside the first values of all others and beside the
    /// last. Constants that all passes share are not among them.
    #[must_use]
    pub fn specialisations(&self, declares: impl Fn(&str) -> bool) -> Vec<BTreeMap<&'static str, u32>> {
        let own: Vec<&OverrideValues> =
            self.overrides.iter().filter(|constant| declares(constant.name) && !constant.values.is_empty()).collect();
        let ends = [0, usize::MAX].map(|end| {
            let value = |values: &[u32]| values[end.min(values.len() - 1)];
            own.iter().map(|constant| (constant.name, value(&constant.values))).collect::<BTreeMap<_, _>>()
        });
        let changes = own.iter().flat_map(|constant| constant.values.iter().map(|value| (constant.name, *value)));
        let changed = |all: &BTreeMap<_, _>| {
            let all = all.clone();
            changes.clone().map(move |change| all.clone().into_iter().chain([change]).collect())
        };
        let mut every = Vec::new();
        for constants in ends.iter().cloned().chain(ends.iter().flat_map(changed)) {
            // Some changes of an end give the end itself.
            if !every.contains(&constants) {
                every.push(constants);
            }
        }
        every
    }
}

/// Entry points of a kernel.
#[derive(Clone, Debug)]
pub enum Entries {
    /// Compute shaders; each uses all bindings.
    Compute(Vec<&'static str>),
    /// Vertex shaders and a fragment shader; one of the former and the latter together use all bindings.
    Draw {
        /// The vertex shaders.
        vertices: Vec<&'static str>,
        /// The fragment shader.
        fragment: &'static str,
    },
}

impl Entries {
    /// Names of all of them.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        match self {
            Self::Compute(names) => names.clone(),
            Self::Draw { vertices, fragment } => vertices.iter().copied().chain([*fragment]).collect(),
        }
    }
}

/// A binding of a kernel.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// Its number in group 0.
    pub number: u32,
    /// Its name.
    pub name: &'static str,
    /// What is bound.
    pub kind: SlotKind,
}

/// A kernel with its constants, and with a resource for each of its bindings.
pub(crate) trait Bound {
    /// File in `shaders/pass/`, without the ending.
    const PASS: &'static str;
    /// Numbers of its bindings, and what each takes.
    const BINDINGS: &'static [(u32, wgpu::BindingType)];
    /// Values of its constants.
    fn constants(&self) -> Constants;
    /// What is bound, each with its number.
    fn resources(&self) -> Vec<(u32, wgpu::BindingResource<'_>)>;
}

/// Records one dispatch of a kernel; its time counts under a name.
pub(crate) fn dispatch<'a>(
    kernel: &impl Bound,
    entry: &'static str,
    recorder: &mut Recorder<'_>,
    name: &'static str,
    groups: impl Into<Groups<'a>>,
) -> Result<(), GpuError> {
    let key = ComputeKey { source: source_of(kernel), entry };
    recorder.compute(name, &key, &kernel.resources(), groups.into())
}

/// The text of a kernel, with its constants.
fn source_of<K: Bound>(kernel: &K) -> SourceKey {
    SourceKey { pass: K::PASS, bindings: K::BINDINGS, constants: kernel.constants() }
}

/// A kernel that is ready to be drawn with, as often as one likes.
pub(crate) struct Drawable {
    pipeline: wgpu::RenderPipeline,
    bindings: wgpu::BindGroup,
}

impl Drawable {
    /// Makes a kernel ready for targets of some formats.
    pub fn of(
        kernel: &impl Bound,
        [vertex, fragment]: [&'static str; 2],
        gpu: &Gpu,
        formats: &[wgpu::TextureFormat],
    ) -> Result<Self, GpuError> {
        let key = RenderKey { source: source_of(kernel), vertex, fragment, formats: formats.to_vec() };
        let ready = gpu.pipelines.render(&gpu.device, &key)?;
        let bindings = ready.bind(&gpu.device, &kernel.resources());
        Ok(Self { pipeline: ready.pipeline, bindings })
    }

    /// Draws a number of vertices.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, vertices: u32) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.draw(0..vertices, 0..1);
    }
}

/// Declares the kernels of a pass, and a function `kernels` that lists them: see the [module](self).
macro_rules! kernels {
    (
        pass $pass:ident;
        $(
            $(#[$attribute:meta])*
            struct $name:ident {
                $(const $fixed:ident : $fixed_kind:ty = $fixed_value:expr;)*
                $(override $constant:ident : $constant_kind:ident $(in $values:expr)?;)*
                $(overrides $shared:ident : $shared_kind:ty;)*
                $(@ $number:literal $binding:ident : $slot:ty;)*
            }
            $stage:ident $($entry:ident),+ $(as $fragment:ident)?;
        )*
    ) => {
        $(
            $(#[$attribute])*
            #[allow(non_snake_case, reason = "constants are named as in WGSL")]
            pub(crate) struct $name<'a> {
                $(pub $constant: $constant_kind,)*
                $(pub $shared: $shared_kind,)*
                $(pub $binding: <$slot as $crate::gpu::kernel::Slot>::Resource<'a>,)*
            }

            impl $crate::gpu::kernel::Bound for $name<'_> {
                const PASS: &'static str = stringify!($pass);

                const BINDINGS: &'static [(u32, wgpu::BindingType)] =
                    &[$(($number, <$slot as $crate::gpu::kernel::Slot>::TYPE),)*];

                #[allow(unused_mut, reason = "few kernels share constants")]
                fn constants(&self) -> $crate::gpu::kernel::Constants {
                    let mut constants = vec![
                        $((stringify!($fixed), <$fixed_kind as $crate::gpu::kernel::Override>::value($fixed_value)),)*
                        $((stringify!($constant), $crate::gpu::kernel::Override::value(self.$constant)),)*
                    ];
                    $(<$shared_kind as $crate::gpu::kernel::Overrides>::add_values(&self.$shared, &mut constants);)*
                    constants
                }

                fn resources(&self) -> Vec<(u32, wgpu::BindingResource<'_>)> {
                    vec![$(($number, <$slot as $crate::gpu::kernel::Slot>::bound(self.$binding)),)*]
                }
            }

            impl $name<'_> {
                #[allow(unused_mut, reason = "few kernels share constants")]
                fn declared() -> $crate::gpu::kernel::Kernel {
                    let mut overrides = vec![
                        $($crate::gpu::kernel::OverrideValues::of::<$fixed_kind>(stringify!($fixed), &[$fixed_value]),)*
                        $($crate::gpu::kernel::OverrideValues::of::<$constant_kind>(
                            stringify!($constant),
                            $crate::gpu::kernel::override_values!($constant_kind $($values)?),
                        ),)*
                    ];
                    $(<$shared_kind as $crate::gpu::kernel::Overrides>::add_declared(&mut overrides);)*
                    $crate::gpu::kernel::Kernel {
                        pass: stringify!($pass),
                        entries: $crate::gpu::kernel::entry_names!($stage $($entry),+ $(as $fragment)?),
                        bindings: vec![$($crate::gpu::kernel::Binding {
                            number: $number,
                            name: stringify!($binding),
                            kind: <$slot as $crate::gpu::kernel::Slot>::kind(),
                        },)*],
                        overrides,
                    }
                }

                $crate::gpu::kernel::entry_methods!($stage $($entry),+ $(as $fragment)?);
            }
        )*

        /// The kernels of this pass.
        pub(super) fn kernels() -> Vec<$crate::gpu::kernel::Kernel> {
            vec![$($name::declared()),*]
        }
    };
}

/// The entry points of a kernel.
macro_rules! entry_names {
    (compute $($entry:ident),+) => { $crate::gpu::kernel::Entries::Compute(vec![$(stringify!($entry)),+]) };
    (draw $($vertex:ident),+ as $fragment:ident) => {
        $crate::gpu::kernel::Entries::Draw {
            vertices: vec![$(stringify!($vertex)),+],
            fragment: stringify!($fragment),
        }
    };
}

/// A method for each compute or vertex shader.
macro_rules! entry_methods {
    (compute $($entry:ident),+) => {
        $(
            /// Records a dispatch of this entry point; its time counts under a name.
            pub fn $entry<'a>(
                &self,
                recorder: &mut $crate::gpu::timing::Recorder<'_>,
                name: &'static str,
                groups: impl Into<$crate::gpu::timing::Groups<'a>>,
            ) -> Result<(), $crate::gpu::device::GpuError> {
                $crate::gpu::kernel::dispatch(self, stringify!($entry), recorder, name, groups)
            }
        )+
    };
    (draw $($vertex:ident),+ as $fragment:ident) => {
        $(
            /// Makes ready to draw with this vertex shader into targets of some formats.
            pub fn $vertex(
                &self,
                gpu: &$crate::gpu::device::Gpu,
                formats: &[wgpu::TextureFormat],
            ) -> Result<$crate::gpu::kernel::Drawable, $crate::gpu::device::GpuError> {
                $crate::gpu::kernel::Drawable::of(self, [stringify!($vertex), stringify!($fragment)], gpu, formats)
            }
        )+
    };
}

pub(crate) use {entry_methods, entry_names, kernels};
