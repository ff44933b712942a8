//! Constants that pipelines are specialised with: WGSL's `override NAME: u32;`, always without a default, so that none can be forgotten.

/// A type of which an overridable constant takes a value.
pub trait Override: Copy {
    /// The value as shaders know it.
    fn value(self) -> u32;
}

/// A type with few values.
pub trait Choice: Override + 'static {
    /// All of them.
    const ALL: &'static [Self];
}

impl Override for u32 {
    fn value(self) -> u32 {
        self
    }
}

impl Override for bool {
    fn value(self) -> u32 {
        self.into()
    }
}

impl Choice for bool {
    const ALL: &'static [Self] = &[false, true];
}

/// An overridable constant, and values that pipelines are specialised with: all that it can take, or those that stand for them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OverrideValues {
    /// Its name.
    pub name: &'static str,
    /// The values.
    pub values: Vec<u32>,
}

/// The values of all constants of one pipeline, by name.
pub type Constants = Vec<(&'static str, u32)>;

/// Constants that several kernels share.
pub trait Overrides {
    /// Adds their values.
    fn add_values(&self, constants: &mut Constants);
    /// Adds what they are.
    fn add_declared(declared: &mut Vec<OverrideValues>);
}

/// Declares an enum whose variants are the values of an overridable constant.
macro_rules! choices {
    (
        $(#[$attribute:meta])*
        pub enum $name:ident {
            $($(#[$doc:meta])* $variant:ident = $value:literal),* $(,)?
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u32)]
        pub enum $name {
            $($(#[$doc])* $variant = $value),*
        }

        impl $crate::gpu::kernel::Override for $name {
            fn value(self) -> u32 {
                self as u32
            }
        }

        impl $crate::gpu::kernel::Choice for $name {
            const ALL: &'static [Self] = &[$(Self::$variant),*];
        }
    };
}

/// The values that a test gives a constant: every value of its type, or a list.
macro_rules! override_values {
    ($kind:ident) => {
        <$kind as $crate::gpu::kernel::Choice>::ALL
    };
    ($kind:ident $values:expr) => {
        &$values
    };
}

/// Declares a struct of overridable constants that several kernels share: a field for each that is not always the same, with its name in
/// WGSL.
macro_rules! overrides {
    (
        $(#[$attribute:meta])*
        pub struct $name:ident {
            $(const $fixed:ident : $fixed_kind:ty = $fixed_value:expr;)*
            $($(#[$doc:meta])* override $constant:ident : $kind:ident $(in $values:expr)?;)*
        }
    ) => {
        $(#[$attribute])*
        #[allow(non_snake_case, reason = "constants are named as in WGSL")]
        #[derive(Clone, Copy, Debug)]
        pub struct $name {
            $($(#[$doc])* pub $constant: $kind),*
        }

        impl $crate::gpu::kernel::Overrides for $name {
            fn add_values(&self, constants: &mut $crate::gpu::kernel::Constants) {
                constants.extend([
                    $((stringify!($fixed), <$fixed_kind as $crate::gpu::kernel::Override>::value($fixed_value)),)*
                    $((stringify!($constant), $crate::gpu::kernel::Override::value(self.$constant))),*
                ]);
            }

            fn add_declared(declared: &mut Vec<$crate::gpu::kernel::OverrideValues>) {
                $(declared.push(
                    $crate::gpu::kernel::OverrideValues::of::<$fixed_kind>(stringify!($fixed), &[$fixed_value]),
                );)*
                $(declared.push($crate::gpu::kernel::OverrideValues::of::<$kind>(
                    stringify!($constant),
                    $crate::gpu::kernel::override_values!($kind $($values)?),
                ));)*
            }
        }
    };
}

pub(crate) use {choices, override_values, overrides};

impl OverrideValues {
    /// A constant that takes values of a type.
    pub(crate) fn of<T: Override>(name: &'static str, values: &[T]) -> Self {
        Self { name, values: values.iter().map(|value| value.value()).collect() }
    }
}
