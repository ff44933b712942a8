//! Shader sources: embedded, composed by their imports, and reloaded from disk in debug builds.
//!
//! A pass in `shaders/pass/` names what it needs by lines like `import package::optics::airy::film_reflectance;`. Composition is
//! textual: each module that is reached stands once, whole, and import lines become blank. So a line of the composed text is a line of a
//! file, and an error of the compiler is reported with the file and line that a person can open. (A parser that prints its own syntax tree
//! loses that, and pulling one in cost a third of the build.) Names are therefore global: a test composes every pass.

use std::{borrow::Cow, collections::BTreeSet, fmt, path::PathBuf};

macro_rules! sources {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders/", $name, ".wgsl")))),*]
    };
}

/// Every shader file, by its path below `shaders/` without the ending.
pub const SOURCES: &[(&str, &str)] = sources![
    "camera/view",
    "colour/display",
    "film/control",
    "film/hole",
    "film/prescribed",
    "film/shown",
    "film/wind",
    "flow/backtrace",
    "flow/laplacian",
    "flow/operators",
    "flow/solve",
    "flow/step",
    "light/environment",
    "light/stored",
    "light/water",
    "optics/airy",
    "optics/band",
    "optics/film_colour",
    "optics/table",
    "optics/walls",
    "pass/add_light",
    "pass/backdrop",
    "pass/bake_table",
    "pass/blacken",
    "pass/bubble",
    "pass/compose_map",
    "pass/conserve",
    "pass/correct_error",
    "pass/decide_remap",
    "pass/diffuse",
    "pass/drain",
    "pass/flow_coarse",
    "pass/flow_combine",
    "pass/flow_correct",
    "pass/flow_force",
    "pass/flow_gusts",
    "pass/flow_halo",
    "pass/flow_hold",
    "pass/flow_image",
    "pass/flow_measure",
    "pass/flow_push",
    "pass/flow_residual",
    "pass/flow_sweep",
    "pass/flow_thickness",
    "pass/flow_trace",
    "pass/flow_velocity",
    "pass/open_hole",
    "pass/probe_colour",
    "pass/read_film",
    "pass/reset_map",
    "pass/sample_tracer",
    "pass/settle_tracer",
    "pass/show_film",
    "pass/tonemap",
    "pass/trace_flow",
    "pass/trace_step",
    "sphere/axes",
    "sphere/cap",
    "sphere/cubed",
    "sphere/halo",
    "sphere/lookup",
    "sphere/path",
    "sphere/silhouette",
];

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
    /// A directory laid out like `shaders/`, read anew at each composition.
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
            Self::Embedded => SOURCES
                .iter()
                .find(|(known, _)| *known == name)
                .map(|(_, text)| Cow::Borrowed(*text))
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
    fn every_file_of_the_folder_is_embedded() {
        let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/shaders"));
        let mut found = Vec::new();
        for folder in std::fs::read_dir(&root).unwrap() {
            for file in std::fs::read_dir(folder.unwrap().path()).unwrap() {
                let path = file.unwrap().path().with_extension("");
                found.push(path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/"));
            }
        }
        found.sort();
        assert!(!found.is_empty());
        assert_eq!(found, SOURCES.iter().map(|(name, _)| (*name).to_owned()).collect::<Vec<_>>());
    }

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
