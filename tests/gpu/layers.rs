//! `use` goes only downwards: the table in `src/lib.rs`, held to; and never in circles.

mod circles;

use std::path::Path;

/// What each layer may use of the crate.
const LAYERS: &[(&str, &[&str])] = &[
    ("physics", &[]),
    ("scene", &["physics"]),
    ("plan", &["scene", "physics"]),
    ("gpu", &["plan", "scene", "physics"]),
    ("verify", &["gpu", "plan", "scene", "physics"]),
    ("input", &["plan", "scene", "physics"]),
    ("output", &["plan", "scene", "physics"]),
    ("studio", &["output", "input", "verify", "gpu", "plan", "scene", "physics"]),
    ("export", &["studio", "output", "input", "verify", "gpu", "plan", "scene", "physics"]),
    ("cli", &["export", "studio", "output", "input", "verify", "gpu", "plan", "scene", "physics"]),
    ("app", &["export", "studio", "output", "input", "verify", "gpu", "plan", "scene", "physics"]),
    ("web", &["app", "input", "gpu", "scene"]),
];

/// The top modules that a text names by `crate::…`, with their lines from 1; comments do not count.
fn crate_uses(text: &str) -> Vec<(usize, String)> {
    let code: String = text.lines().map(|line| line.split("//").next().unwrap_or("").to_owned() + "\n").collect();
    let mut uses = Vec::new();
    for (at, found) in code.match_indices("crate::") {
        // `$crate::` and the like name the same crate; a longer word does not.
        if code[..at].ends_with(|before: char| before.is_alphanumeric() || before == '_') {
            continue;
        }
        let line = 1 + code[..at].matches('\n').count();
        let rest = &code[at + found.len()..];
        let names = if let Some(list) = rest.strip_prefix('{') { top_names(list) } else { vec![word(rest)] };
        uses.extend(names.into_iter().map(|name| (line, name)));
    }
    uses
}

/// First words of the items of a braced list, up to its closing brace.
fn top_names(list: &str) -> Vec<String> {
    let (mut depth, mut start, mut names) = (1, true, Vec::new());
    for (at, character) in list.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 1 => start = true,
            _ if start && (character.is_alphanumeric() || character == '_') => {
                names.push(word(&list[at..]));
                start = false;
            }
            _ => {}
        }
        if depth == 0 {
            break;
        }
    }
    names
}

fn word(text: &str) -> String {
    text.chars().take_while(|character| character.is_alphanumeric() || *character == '_').collect()
}

/// Uses in a file of a layer that its row of the table does not allow.
fn violations(layer: &str, file: &str, text: &str) -> Vec<String> {
    let Some((_, allowed)) = LAYERS.iter().find(|(name, _)| *name == layer) else {
        return vec![format!("{file}: `{layer}` is no layer of the table")];
    };
    let upward = |name: &String| name != layer && !allowed.contains(&name.as_str());
    // Macros of the crate stand at its root and belong to no layer.
    let uses = crate_uses(text).into_iter().filter(|(_, name)| LAYERS.iter().any(|(known, _)| known == name));
    uses.filter(|(_, name)| upward(name)).map(|(line, name)| format!("{file}:{line}: {layer} uses {name}")).collect()
}

fn rust_files(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
}

/// Paths in backticks that a document names in the folders of the program, but for patterns.
fn named_paths(document: &str) -> Vec<&str> {
    let folders = ["src/", "shaders/", "tests/", "assets/", "benches/", "examples/"];
    let is_path =
        |text: &&str| folders.iter().any(|folder| text.starts_with(folder)) && !text.contains([' ', '*', '<']);
    document.split('`').skip(1).step_by(2).filter(is_path).filter(|path| !path.contains("NAME")).collect()
}

#[test]
fn documents_name_files_that_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    assert_eq!(named_paths("in `src/a.rs` and `b`, not `src/NAME.rs`"), ["src/a.rs"]);
    for name in ["ARCHITECTURE.md", "CONTRIBUTING.md", "GLOSSARY.md", "README.md"] {
        let document = std::fs::read_to_string(root.join(name)).unwrap();
        let missing = |path: &&str| !root.join(path).exists() && !root.join(path).with_extension("rs").exists();
        let missing: Vec<_> = named_paths(&document).into_iter().filter(missing).collect();
        assert!(missing.is_empty(), "{name} names what is not there: {missing:?}");
    }
}

#[test]
fn uses_go_downwards() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&root, &mut files);
    let (mut wrong, mut checked) = (Vec::new(), 0);
    for path in files {
        let inside = path.strip_prefix(&root).unwrap();
        // `lib.rs` and `main.rs` join the layers.
        if inside.components().count() < 2 {
            continue;
        }
        let layer = inside.components().next().unwrap().as_os_str().to_str().unwrap();
        wrong.extend(violations(layer, &inside.display().to_string(), &std::fs::read_to_string(&path).unwrap()));
        checked += 1;
    }
    assert!(checked > 50, "only {checked} files were found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_planted_violation_is_found() {
    let text = "use crate::{\n    physics::film,\n    gpu::{Gpu, film::Field},\n};\nfn f() { crate::scene::g() }\n";
    assert_eq!(violations("plan", "a.rs", text), ["a.rs:1: plan uses gpu"]);
    assert_eq!(violations("gpu", "a.rs", text), [] as [String; 0]);
    assert_eq!(violations("physics", "a.rs", text), ["a.rs:1: physics uses gpu", "a.rs:5: physics uses scene"]);
    assert_eq!(violations("scene", "a.rs", "// use crate::gpu::Gpu;\nlet x = mycrate::gpu;"), [] as [String; 0]);
    assert_eq!(violations("app", "a.rs", "use crate::cli::main;"), ["a.rs:1: app uses cli"]);
    assert_eq!(violations("attic", "a.rs", ""), ["a.rs: `attic` is no layer of the table"]);
}
