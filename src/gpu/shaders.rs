//! Shader sources: embedded, composed by their imports, and reloaded from disk in debug builds.
//!
//! A pass in `shaders/pass/` names what it needs by lines like `import package::optics::airy::film_reflectances;`. Composition is
//! textual: each module that is reached stands once, whole, and import lines become blank. So a line of the composed text is a line of a
//! file, and an error of the compiler is reported with the file and line that a person can open. (A parser that prints its own syntax tree
//! loses that, and pulling one in cost a third of the build.) Names are therefore global: a test composes every pass.

use std::{borrow::Cow, collections::BTreeSet, fmt, path::PathBuf};

use include_dir::{Dir, include_dir};

/// Every file of `shaders/`, as it was when the program was built.
static EMBEDDED: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/shaders");

/// A shader that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("shader {place}: {message}")]
pub struct ShaderError {
    /// File and line, like `optics/airy.wgsl:12`.
    pub place: String,
    /// What is wrong there.
    pub message: String,
}

/// Where shader text comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Library {
    /// The text built into the program.
    #[default]
    Embedded,
    /// A directory laid out like `shaders/`, read again at each composition.
    Directory(PathBuf),
}

/// One pass with all that it imports.
#[derive(Clone, Debug)]
pub struct Composed {
    /// The WGSL text.
    pub wgsl: String,
    /// For each module its name and its first line in the text, from 0.
    modules: Vec<(String, usize)>,
}

impl Library {
    fn source(&self, name: &str) -> Result<Cow<'static, str>, ShaderError> {
        let missing = |message: String| ShaderError { place: format!("{name}.wgsl"), message };
        match self {
            Self::Embedded => EMBEDDED
                .get_file(format!("{name}.wgsl"))
                .and_then(|file| file.contents_utf8())
                .map(Cow::Borrowed)
                .ok_or_else(|| missing("no such shader file".to_owned())),
            Self::Directory(root) => std::fs::read_to_string(root.join(name).with_extension("wgsl"))
                .map(Cow::Owned)
                .map_err(|error| missing(format!("cannot be read: {error}"))),
        }
    }

    /// Composes a pass, named like `tonemap`, from `pass/tonemap.wgsl`.
    pub fn compose(&self, pass: &str) -> Result<Composed, ShaderError> {
        let mut composed = Composed { wgsl: String::new(), modules: Vec::new() };
        let mut seen = BTreeSet::new();
        self.append(&format!("pass/{pass}"), &mut composed, &mut seen)?;
        Ok(composed)
    }

    fn append(&self, name: &str, composed: &mut Composed, seen: &mut BTreeSet<String>) -> Result<(), ShaderError> {
        if !seen.insert(name.to_owned()) {
            return Ok(());
        }
        let text = self.source(name)?;
        for import in imports(&text) {
            let module = imported_module(import).ok_or_else(|| ShaderError {
                place: format!("{name}.wgsl"),
                message: format!("cannot understand `{import}`; write `import package::folder::file::name;`"),
            })?;
            self.append(&module, composed, seen)?;
        }
        composed.modules.push((name.to_owned(), composed.wgsl.lines().count()));
        for line in text.lines() {
            composed.wgsl.push_str(if line.starts_with("import ") { "" } else { line });
            composed.wgsl.push('\n');
        }
        Ok(())
    }
}

impl Composed {
    /// The file and line behind a line of the composed text, counted from 1.
    #[must_use]
    pub fn place(&self, line: usize) -> String {
        let at = line.saturating_sub(1);
        match self.modules.iter().rev().find(|(_, first)| *first <= at) {
            Some((name, first)) => format!("{name}.wgsl:{}", at - first + 1),
            None => format!("line {line}"),
        }
    }

    /// Whether the text declares an overridable constant of this name.
    #[must_use]
    pub fn declares(&self, constant: &str) -> bool {
        self.wgsl.lines().any(|line| {
            line.strip_prefix("override ")
                .and_then(|rest| rest.strip_prefix(constant))
                .is_some_and(|rest| rest.starts_with(':'))
        })
    }
}

impl fmt::Display for Composed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.wgsl)
    }
}

fn imports(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter(|line| line.starts_with("import "))
}

/// `optics/airy` of `import package::optics::airy::{cos_refracted, max_reflectance};`.
fn imported_module(import: &str) -> Option<String> {
    let path = import.strip_prefix("import package::")?.strip_suffix(';')?;
    let (module, _names) = path.rsplit_once("::")?;
    (!module.contains(['{', ' '])).then(|| module.replace("::", "/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_composition_is_a_line_of_a_file() {
        let composed = Library::Embedded.compose("tonemap").unwrap();
        let line = composed.wgsl.lines().position(|line| line.starts_with("fn encode_srgb")).unwrap() + 1;
        let source = Library::Embedded.source("colour/display").unwrap();
        let expected = source.lines().position(|line| line.starts_with("fn encode_srgb")).unwrap() + 1;
        assert_eq!(composed.place(line), format!("colour/display.wgsl:{expected}"));
    }

    #[test]
    fn an_import_that_leads_nowhere_is_named() {
        let root = std::env::temp_dir().join(format!("soapfilm-shaders-{}", std::process::id()));
        std::fs::create_dir_all(root.join("pass")).unwrap();
        std::fs::write(root.join("pass/lost.wgsl"), "import package::no::where::thing;\n").unwrap();
        let error = Library::Directory(root.clone()).compose("lost").unwrap_err();
        std::fs::remove_dir_all(root).unwrap();
        assert!(error.to_string().starts_with("shader no/where.wgsl: cannot be read"), "{error}");
    }

    #[test]
    fn overridable_constants_are_found_by_whole_name() {
        let composed = Library::Embedded.compose("trace_step").unwrap();
        assert!(composed.declares("HALO") && composed.declares("FLOW"));
        assert!(!composed.declares("HAL") && !composed.declares("SAMPLES"));
    }
}
