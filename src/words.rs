//! Words that files, commands and panels use for a choice, each declared once with a sentence for people.

/// A choice between words.
pub trait Words: Copy + PartialEq + 'static {
    /// All choices, in the order in which people see them.
    const CHOICES: &'static [Self];
    /// Their words, in that order.
    const NAMES: &'static [&'static str];
    /// What they mean, each a sentence without a full stop, in that order.
    const HELP: &'static [&'static str];

    /// The word, as scene files and the command line have it.
    fn name(self) -> &'static str;

    /// What it means, in a sentence without a full stop.
    fn help(self) -> &'static str;

    /// The choice of a word, if there is one.
    fn of_name(name: &str) -> Option<Self> {
        Self::CHOICES.iter().copied().find(|choice| choice.name() == name)
    }
}

/// A word that stands for no choice.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown {what} \"{name}\": use one of {}", known.join(", "))]
pub struct UnknownWord {
    /// What was to be chosen.
    pub what: &'static str,
    /// The word given.
    pub name: String,
    /// The words there are.
    pub known: &'static [&'static str],
}

/// Declares an enum of words: what is chosen, then `Variant = "word", "What it means";`. TOML, the command line, panels, help and the page
/// of the scene format follow from it.
macro_rules! words {
    (
        $(#[$meta:meta])*
        pub enum $Choice:ident: $what:literal {
            $($(#[$attribute:meta])* $Variant:ident = $word:literal, $help:literal;)+
        }
    ) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        pub enum $Choice {
            $(#[doc = concat!("`", $word, "`: ", $help, ".")] $(#[$attribute])* #[serde(rename = $word)] $Variant,)+
        }

        impl $Choice {
            /// All choices, in the order in which people see them.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$Variant),+];

            /// The word, as scene files and the command line have it.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$Variant => $word,)+
                }
            }
        }

        impl std::str::FromStr for $Choice {
            type Err = $crate::words::UnknownWord;

            fn from_str(name: &str) -> Result<Self, Self::Err> {
                use $crate::words::{UnknownWord, Words};
                Self::of_name(name).ok_or_else(|| UnknownWord { what: $what, name: name.to_owned(), known: Self::NAMES })
            }
        }

        impl $crate::words::Words for $Choice {
            const CHOICES: &'static [Self] = &Self::ALL;
            const NAMES: &'static [&'static str] = &[$($word),+];
            const HELP: &'static [&'static str] = &[$($help),+];

            fn name(self) -> &'static str {
                self.name()
            }

            fn help(self) -> &'static str {
                match self {
                    $(Self::$Variant => $help,)+
                }
            }
        }
    };
}
pub(crate) use words;

#[cfg(test)]
mod tests {
    use super::*;

    words! {
        /// Sides.
        pub enum Side: "side" {
            Left = "left", "Where the heart is";
            Right = "far-right", "The other one";
        }
    }

    #[test]
    fn a_word_is_read_by_its_name_and_has_a_sentence() {
        assert_eq!(Side::of_name("far-right"), Some(Side::Right));
        let error = "right".parse::<Side>().unwrap_err();
        assert_eq!(error.to_string(), "unknown side \"right\": use one of left, far-right");
        assert_eq!((Side::NAMES, Side::Left.help()), (["left", "far-right"].as_slice(), "Where the heart is"));
        assert_eq!(toml::Value::try_from(Side::Right), Ok(toml::Value::String("far-right".to_owned())));
    }
}
