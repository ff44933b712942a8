//! The keys of a scene file: each section is one table of names, types, defaults, ranges, units and sentences, from which the struct, its
//! TOML, its checks, the panels and the tables of the format's page follow.

use super::check::{self, Checked};
use crate::words::Words;

/// A key of a section.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Its name in files; a unit stands at the end.
    pub name: &'static str,
    /// Its name in panels.
    pub label: &'static str,
    /// The unit of its values as panels show it; empty for plain numbers.
    pub unit: &'static str,
    /// What it may be.
    pub range: Range,
    /// What it means, as the format's page says it.
    pub help: &'static str,
    /// Its default as TOML; `None` where that is no value.
    pub normal: fn() -> Option<toml::Value>,
}

/// What a key may be.
#[derive(Clone, Copy, Debug)]
pub enum Range {
    /// A number, or each of three, from the first to the last.
    Within(f64, f64),
    /// Any finite number.
    Finite,
    /// Any whole number from 0 on.
    Whole,
    /// One of these words, with what each means.
    Word(&'static [&'static str], &'static [&'static str]),
    /// True or false.
    Flag,
    /// What the text says; the value checks itself.
    Other(&'static str),
}

/// A value that a key can have.
pub(super) trait Value {
    /// Refuses what lies outside of a key's range.
    fn check(&self, key: &Key) -> Checked;
}

impl Value for f64 {
    fn check(&self, key: &Key) -> Checked {
        match key.range {
            Range::Within(low, high) => check::in_range(key.name, *self, low..=high),
            _ => check::finite(key.name, *self),
        }
    }
}

impl Value for [f64; 3] {
    fn check(&self, key: &Key) -> Checked {
        match key.range {
            Range::Within(low, high) => check::all_in_range(key.name, self, low..=high),
            _ => self.iter().try_for_each(|number| check::finite(key.name, *number)),
        }
    }
}

/// Whole numbers.
macro_rules! whole {
    ($($type:ty),+) => {
        $(impl Value for $type {
            fn check(&self, key: &Key) -> Checked {
                match key.range {
                    // Ends of such ranges are whole.
                    Range::Within(low, high) => check::in_range(key.name, *self, low as $type..=high as $type),
                    _ => Ok(()),
                }
            }
        })+
    };
}
whole!(u32, u64, usize);

impl Value for bool {
    fn check(&self, _: &Key) -> Checked {
        Ok(())
    }
}

impl Value for String {
    fn check(&self, key: &Key) -> Checked {
        check::plain_text(key.name, self)
    }
}

/// A list whose length is checked by the table that holds it.
impl Value for Vec<f64> {
    fn check(&self, key: &Key) -> Checked {
        self.iter().try_for_each(|number| check::finite(key.name, *number))
    }
}

impl Value for Vec<String> {
    fn check(&self, key: &Key) -> Checked {
        self.iter().try_for_each(|text| text.check(key))
    }
}

impl<T: Value> Value for Option<T> {
    fn check(&self, key: &Key) -> Checked {
        self.as_ref().map_or(Ok(()), |value| value.check(key))
    }
}

impl<T: Words> Value for T {
    fn check(&self, _: &Key) -> Checked {
        Ok(())
    }
}

/// A [`Range`] as the tables write it.
macro_rules! range {
    ($type:ty, $low:literal ..= $high:literal) => {
        $crate::scene::section::Range::Within($low as f64, $high as f64)
    };
    ($type:ty, finite) => {
        $crate::scene::section::Range::Finite
    };
    ($type:ty, whole) => {
        $crate::scene::section::Range::Whole
    };
    ($type:ty, word) => {
        $crate::scene::section::Range::Word(
            <$type as $crate::words::Words>::NAMES,
            <$type as $crate::words::Words>::HELP,
        )
    };
    ($type:ty, flag) => {
        $crate::scene::section::Range::Flag
    };
    ($type:ty, $other:literal) => {
        $crate::scene::section::Range::Other($other)
    };
}
pub(super) use range;

/// Declares a section: its keys as `name: type = default, [range], "Label", "unit", "what it means";`, after the tables in it, if any, as
/// `name: type = default, "what it means";` between brackets.
macro_rules! section {
    (
        $(#[$meta:meta])*
        pub struct $Section:ident, $Keys:ident: $([
            $($(#[$attribute:meta])* $table:ident: $inner:ty = $start:expr, $about:literal;)+
        ])?
        $($name:ident: $type:ty = $default:expr, [$($range:tt)+], $label:literal, $unit:literal, $help:literal;)+
    ) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct $Section {
            $(
                #[doc = concat!($help, ". Range: ", stringify!($($range)+), ". Default: `", stringify!($default), "`.")]
                pub $name: $type,
            )+
            $($(#[doc = concat!($about, ".")] $(#[$attribute])* pub $table: $inner,)+)?
        }

        impl Default for $Section {
            fn default() -> Self {
                Self { $($name: $default,)+ $($($table: $start,)+)? }
            }
        }

        #[doc = concat!("The keys of a [`", stringify!($Section), "`] by their names.")]
        #[derive(Clone, Copy, Debug)]
        pub struct $Keys {
            $(#[doc = concat!("The key of [`", stringify!($Section), "::", stringify!($name), "`].")] pub $name: $crate::scene::Key,)+
        }

        impl $Section {
            /// What is known of each key.
            pub const KEYS: $Keys = $Keys {
                $($name: $crate::scene::Key {
                    name: stringify!($name),
                    label: $label,
                    unit: $unit,
                    range: $crate::scene::section::range!($type, $($range)+),
                    help: $help,
                    normal: || {
                        let normal: $type = $default;
                        toml::Value::try_from(normal).ok()
                    },
                },)+
            };

            /// All keys, in the order of the format's page.
            pub const ALL_KEYS: &'static [$crate::scene::Key] = &[$(Self::KEYS.$name),+];

            /// Refuses the first value that is out of its key's range.
            pub(in crate::scene) fn check_ranges(&self) -> $crate::scene::check::Checked {
                use $crate::scene::section::Value;
                $(self.$name.check(&Self::KEYS.$name)?;)+
                Ok(())
            }
        }
    };
}
pub(super) use section;
