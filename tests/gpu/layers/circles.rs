//! Modules do not use each other in circles: of the modules of a folder, each with all that it holds, none uses itself through others. A
//! module and those that it holds are one in this, and may use each other. What a module only hands on by `pub use` is used by those who
//! take it.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

use super::rust_files;

/// A module's path from the crate's root, or one as it is written: `gpu::film` is `["gpu", "film"]`.
type Name = Vec<String>;

/// The modules that each of some modules uses, and what of the one uses what of the other: lines like `gpu::film::free -> gpu::flow`.
type Uses = BTreeMap<Name, BTreeMap<Name, BTreeSet<String>>>;

/// A module as its file has it, without comments and tests.
struct Module {
    /// The file without its `use` declarations.
    code: String,
    imports: Vec<Import>,
}

/// A name that a `use` declaration binds, the path that it stands for, and whether it is handed on.
struct Import {
    name: String,
    path: Name,
    is_handed_on: bool,
}

impl Module {
    fn of(text: &str) -> Self {
        let (mut code, mut imports) = (String::new(), Vec::new());
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            if line.trim() == "#[cfg(doc)]" {
                // What only the documentation names.
                lines.next();
            } else if let Some((visibility, tree)) = use_declaration(line) {
                let mut tree = tree.to_owned();
                while !tree.contains(';') {
                    let Some(line) = lines.next() else { break };
                    tree.push_str(line);
                }
                let is_handed_on = !visibility.is_empty();
                let paths = use_paths(tree.trim_end_matches(';')).into_iter();
                imports.extend(paths.map(|(name, path)| Import { name, path, is_handed_on }));
            } else {
                code.push_str(line);
                code.push('\n');
            }
        }
        Self { code, imports }
    }

    /// Whether a word stands in the code.
    fn names(&self, word: &str) -> bool {
        self.code.split(|character: char| !is_part(character)).any(|found| found == word)
    }

    /// Paths that the module takes something from.
    fn paths(&self) -> impl Iterator<Item = Name> {
        let taken = self.imports.iter().filter(|import| !import.is_handed_on || self.names(&import.name));
        let inline = self.code.split(|character: char| !is_part(character) && character != ':');
        let inline =
            inline.filter(|path| path.contains("::")).map(|path| path.split("::").map(str::to_owned).collect());
        taken.map(|import| import.path.clone()).chain(inline)
    }
}

fn is_part(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// The visibility and the tree of a `use` declaration that begins on a line.
fn use_declaration(line: &str) -> Option<(&str, &str)> {
    let (visibility, tree) = line.trim().split_once("use ").map(|(before, tree)| (before.trim(), tree))?;
    let is_one = visibility.is_empty() || visibility == "pub" || visibility.starts_with("pub(");
    is_one.then_some((visibility, tree))
}

/// All paths of a use tree, each after the name that it binds.
fn use_paths(tree: &str) -> Vec<(String, Name)> {
    let tree = tree.trim();
    let Some((prefix, list)) = tree.split_once('{') else {
        let (path, alias) = tree.split_once(" as ").unwrap_or((tree, ""));
        let path: Name = path.split("::").map(|part| part.trim().to_owned()).collect();
        let name = if alias.is_empty() { path.last().cloned().unwrap_or_default() } else { alias.trim().to_owned() };
        return if tree.is_empty() { vec![] } else { vec![(name, path)] };
    };
    let prefix: Name = prefix.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned).collect();
    let list = &list[..list.rfind('}').unwrap_or(list.len())];
    let inner = split_list(list).into_iter().flat_map(use_paths);
    let joined = inner.map(|(name, path)| match name.as_str() {
        "self" => (prefix.last().cloned().unwrap_or_default(), prefix.clone()),
        _ => (name, [prefix.as_slice(), &path].concat()),
    });
    joined.collect()
}

/// Items of a list, by the commas outside of braces.
fn split_list(list: &str) -> Vec<&str> {
    let mut depth = 0;
    let is_comma = |character| {
        depth += i32::from(character == '{') - i32::from(character == '}');
        character == ',' && depth == 0
    };
    list.split(is_comma).collect()
}

/// The crate's modules by name.
struct Modules(BTreeMap<Name, Module>);

impl Modules {
    /// From pairs of a file, like `gpu/film/mod.rs`, and its text. Modules of tests are left out.
    fn of(files: &[(String, String)]) -> Self {
        let texts: Vec<_> = files.iter().map(|(file, text)| (module_name(file), without_comments(text))).collect();
        let tests: BTreeSet<Name> = texts.iter().flat_map(|(name, code)| test_modules(name, code)).collect();
        let is_test = |name: &Name| (1..=name.len()).any(|length| tests.contains(&name[..length]));
        let modules = texts.into_iter().filter(|(name, _)| !is_test(name));
        Self(modules.map(|(name, code)| (name, Module::of(without_tests(&code)))).collect())
    }

    /// The module that defines what a path of a module leads to; `None` for a path out of the crate.
    fn resolve(&self, from: &Name, path: &[String]) -> Option<Name> {
        let ups = path.iter().take_while(|part| *part == "super").count();
        let (mut at, rest) = match path.first()?.as_str() {
            "crate" => (vec![], &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => (from[..from.len().saturating_sub(ups)].to_vec(), &path[ups..]),
            child if self.0.contains_key(&inside(from, child)) => (from.clone(), path),
            _ => return None,
        };
        for (place, part) in rest.iter().enumerate() {
            let deeper = inside(&at, part);
            if self.0.contains_key(&deeper) {
                at = deeper;
                continue;
            }
            // A name that the module has from elsewhere leads on there.
            let import = self.0.get(&at)?.imports.iter().find(|import| import.name == *part);
            return match import {
                Some(import) => self.resolve(&at, &[&import.path, &rest[place + 1..]].concat()),
                None => Some(at),
            };
        }
        Some(at)
    }

    /// Uses between the modules of each folder.
    fn uses(&self) -> BTreeMap<Name, Uses> {
        let mut folders: BTreeMap<Name, Uses> = BTreeMap::new();
        for (from, module) in &self.0 {
            for to in module.paths().filter_map(|path| self.resolve(from, &path)) {
                let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
                if shared == from.len() || shared == to.len() {
                    continue;
                }
                let [near, far] = [from, &to].map(|name| name[..=shared].to_vec());
                let folder = folders.entry(from[..shared].to_vec()).or_default();
                let by = format!("{} -> {}", from.join("::"), to.join("::"));
                folder.entry(near).or_default().entry(far).or_default().insert(by);
            }
        }
        folders
    }

    /// The uses that make each circle, a line each.
    fn circles(&self) -> Vec<String> {
        let mut circles = Vec::new();
        for uses in self.uses().values() {
            let reach: BTreeMap<&Name, BTreeSet<&Name>> = uses.keys().map(|name| (name, reached(uses, name))).collect();
            let meet = |a: &Name, b: &Name| reach[a].contains(b) && reach.get(b).is_some_and(|back| back.contains(a));
            let mut seen = BTreeSet::new();
            for name in uses.keys().filter(|name| meet(name, name)) {
                if seen.contains(name) {
                    continue;
                }
                let together: Vec<&Name> = uses.keys().filter(|other| meet(name, other)).collect();
                let inner = together.iter().flat_map(|from| &uses[*from]).filter(|(to, _)| together.contains(to));
                let lines: Vec<&str> = inner.flat_map(|(_, by)| by.iter().map(String::as_str)).collect();
                circles.push(format!("a circle of {} modules:\n  {}", together.len(), lines.join("\n  ")));
                seen.extend(together);
            }
        }
        circles
    }
}

fn inside(name: &[String], child: &str) -> Name {
    [name, &[child.to_owned()]].concat()
}

/// All modules that one uses, directly or through others.
fn reached<'u>(uses: &'u Uses, from: &'u Name) -> BTreeSet<&'u Name> {
    let (mut found, mut next) = (BTreeSet::new(), vec![from]);
    while let Some(name) = next.pop() {
        let used = uses.get(name).into_iter().flat_map(BTreeMap::keys);
        next.extend(used.filter(|used| found.insert(*used)));
    }
    found
}

fn module_name(file: &str) -> Name {
    let mut parts: Name = file.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    if parts.last().is_some_and(|last| last == "mod" || last == "lib") {
        parts.pop();
    }
    parts
}

fn without_comments(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("").to_owned() + "\n").collect()
}

/// Modules that a file declares for tests alone.
fn test_modules(name: &Name, code: &str) -> Vec<Name> {
    let declared = code.split("#[cfg(test)]").skip(1).filter_map(|after| after.trim_start().strip_prefix("mod "));
    declared.map(|rest| inside(name, rest.split([';', ' ', '{']).next().unwrap_or_default())).collect()
}

/// A file without the module of tests at its end.
fn without_tests(code: &str) -> &str {
    code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default()
}

#[test]
fn no_module_uses_itself_through_others() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    rust_files(&root, &mut paths);
    let named = |path: &std::path::PathBuf| {
        let inside = path.strip_prefix(&root).unwrap().to_str().unwrap().replace('\\', "/");
        (inside, std::fs::read_to_string(path).unwrap())
    };
    // The binary is a crate of its own.
    let files: Vec<_> = paths.iter().map(named).filter(|(file, _)| file != "main.rs").collect();
    let modules = Modules::of(&files);
    let uses: usize = modules.uses().values().flat_map(BTreeMap::values).map(BTreeMap::len).sum();
    assert!(uses > 200, "only {uses} uses were found");
    let circles = modules.circles();
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

/// Circles in a crate of files.
fn circles_of(files: &[(&str, &str)]) -> String {
    let files: Vec<_> = files.iter().map(|(file, text)| ((*file).to_owned(), (*text).to_owned())).collect();
    Modules::of(&files).circles().join("\n")
}

#[test]
fn a_planted_circle_is_found() {
    let lib = ("lib.rs", "mod a;\nmod b;\nmod c;\n");
    let [a, c] = [("a.rs", "use crate::b::B;\n"), ("c.rs", "fn f() { crate::a::g() }\n")];
    let circle = "a circle of 3 modules:\n  a -> b::inner\n  b::inner -> c\n  c -> a";
    let handing_on = ("b/mod.rs", "mod inner;\npub use inner::{B, More};\n");
    let inner = ("b/inner.rs", "use super::super::{\n    c::{self, C},\n};\npub struct B;\n");
    assert_eq!(circles_of(&[lib, a, handing_on, inner, c]), circle);
    let apart = ("b/inner.rs", "// use crate::c::C;\n#[cfg(doc)]\nuse crate::c;\npub struct B;\n");
    assert_eq!(circles_of(&[lib, a, handing_on, apart, c]), "", "comments and documentation");
    let tested = ("b/inner.rs", "pub struct B;\n#[cfg(test)]\nmod tests {\n    use crate::c::C;\n}\n");
    assert_eq!(circles_of(&[lib, a, handing_on, tested, c]), "", "tests");
    let [folder, own] = [("b/mod.rs", "mod inner;\nuse inner::B;\nstruct D(B);\n"), ("b/inner.rs", "use super::D;\n")];
    assert_eq!(circles_of(&[lib, folder, own]), "", "a module and what it holds");
}
