//! No module of the crate uses, directly or through others, what uses it.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// A module's path from the crate's root: `gpu::film` is `["gpu", "film"]`.
type Name = Vec<String>;

/// A module as its file has it, without comments and tests.
struct Module {
    code: String,
    /// What its `use` declarations bind: the name, the path as written, and whether it is handed on.
    bound: Vec<Import>,
}

/// One name that a `use` declaration binds; `*` for all names of a module.
struct Import {
    name: String,
    path: Vec<String>,
    is_handed_on: bool,
}

/// The crate's modules by name.
struct Modules(BTreeMap<Name, Module>);

impl Modules {
    /// From pairs of a file, like `gpu/film/mod.rs`, and its text. Modules of tests are left out.
    fn of<'a>(files: impl IntoIterator<Item = (&'a str, &'a str)>) -> Self {
        let texts: Vec<_> = files.into_iter().map(|(file, text)| (module_name(file), without_comments(text))).collect();
        let tests: BTreeSet<Name> = texts.iter().flat_map(|(name, code)| test_modules(name, code)).collect();
        let is_tested = |name: &Name| (1..=name.len()).any(|length| tests.contains(&name[..length]));
        let modules = texts.into_iter().filter(|(name, _)| !is_tested(name));
        Self(modules.map(|(name, code)| (name, Module::of(without_tests(&code)))).collect())
    }

    /// The module that defines what a path, seen from a module, leads to; nothing for paths out of the crate.
    fn resolve(&self, from: &Name, path: &[String], depth: usize) -> Option<Name> {
        let (mut at, rest) = match path.first()?.as_str() {
            "crate" => (vec![], &path[1..]),
            "self" => (from.clone(), &path[1..]),
            "super" => {
                let ups = path.iter().take_while(|part| *part == "super").count();
                (from[..from.len().saturating_sub(ups)].to_vec(), &path[ups..])
            }
            child if self.0.contains_key(&[from.as_slice(), &[child.to_owned()]].concat()) => (from.clone(), path),
            _ => return None,
        };
        for (place, part) in rest.iter().enumerate() {
            let deeper = [at.as_slice(), std::slice::from_ref(part)].concat();
            if self.0.contains_key(&deeper) {
                at = deeper;
                continue;
            }
            // A name that the module has from elsewhere leads on there; a chain of more than a few is a loop.
            let import = self.0.get(&at)?.bound.iter().find(|import| import.name == *part).filter(|_| depth < 8);
            let onward = import.map(|import| [&import.path, &rest[place + 1..]].concat());
            return match onward {
                Some(onward) => self.resolve(&at, &onward, depth + 1),
                None => Some(at),
            };
        }
        Some(at)
    }

    /// For each module those that it uses.
    fn uses(&self) -> BTreeMap<&Name, BTreeSet<Name>> {
        self.0.iter().map(|(name, module)| (name, self.uses_of(name, module))).collect()
    }

    fn uses_of(&self, name: &Name, module: &Module) -> BTreeSet<Name> {
        // What is only handed on is used by those who take it.
        let taken =
            module.bound.iter().filter(|import| !import.is_handed_on || names_often(&module.code, &import.name));
        let paths = taken.map(|import| import.path.clone()).chain(inline_paths(&module.code));
        let mut used: BTreeSet<Name> = paths.filter_map(|path| self.resolve(name, &path, 0)).collect();
        used.remove(name);
        used
    }

    /// Uses between the modules of a folder, each of which stands for all that it holds: from which, to which, and the modules that do it.
    /// A module and those that it holds are one in this: they may use each other.
    fn neighbours(&self) -> BTreeMap<Name, BTreeMap<Name, BTreeMap<Name, BTreeSet<String>>>> {
        let mut folders: BTreeMap<Name, BTreeMap<Name, BTreeMap<Name, BTreeSet<String>>>> = BTreeMap::new();
        for (from, used) in self.uses() {
            for to in used {
                let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
                if shared == from.len() || shared == to.len() {
                    continue;
                }
                let folder = folders.entry(from[..shared].to_vec()).or_default();
                let [near, far] = [from, &to].map(|name| name[..=shared].to_vec());
                folder.entry(near).or_default().entry(far).or_default().insert(format!(
                    "{} -> {}",
                    from.join("::"),
                    to.join("::")
                ));
            }
        }
        folders
    }

    /// For each circle of modules, the uses that make it.
    fn circles(&self) -> Vec<Vec<String>> {
        let mut found = Vec::new();
        for uses in self.neighbours().values() {
            let reach: BTreeMap<&Name, BTreeSet<Name>> = uses.keys().map(|name| (name, reached(uses, name))).collect();
            let meet = |a: &Name, b: &Name| reach[a].contains(b) && reach.get(b).is_some_and(|back| back.contains(a));
            let mut seen = BTreeSet::new();
            for name in uses.keys().filter(|name| meet(name, name)) {
                if !seen.insert(name) {
                    continue;
                }
                let mut circle = Vec::new();
                for other in uses.keys().filter(|other| meet(name, other)) {
                    seen.insert(other);
                    circle.extend(uses[other].iter().filter(|(to, _)| meet(name, to)).flat_map(|(_, by)| by.clone()));
                }
                found.push(circle);
            }
        }
        found
    }
}

fn reached<T>(uses: &BTreeMap<Name, BTreeMap<Name, T>>, from: &Name) -> BTreeSet<Name> {
    let mut found = BTreeSet::new();
    let mut next = vec![from.clone()];
    while let Some(name) = next.pop() {
        for used in uses.get(&name).into_iter().flat_map(BTreeMap::keys) {
            if found.insert(used.clone()) {
                next.push(used.clone());
            }
        }
    }
    found
}

impl Module {
    fn of(code: String) -> Self {
        let (mut bound, mut rest) = (Vec::new(), String::new());
        let mut lines = code.lines();
        while let Some(line) = lines.next() {
            let Some((visibility, tree)) = use_declaration(line) else {
                rest.push_str(line);
                rest.push('\n');
                continue;
            };
            let mut tree = tree.to_owned();
            while !tree.contains(';') {
                let Some(line) = lines.next() else { break };
                tree.push_str(line);
            }
            let paths = use_paths(tree.trim_end_matches(';'));
            let is_handed_on = !visibility.is_empty();
            bound.extend(paths.into_iter().map(|(path, name)| Import { name, path, is_handed_on }));
        }
        Self { code: rest, bound }
    }
}

/// The visibility and the tree of a `use` declaration that begins on a line.
fn use_declaration(line: &str) -> Option<(&str, &str)> {
    let (visibility, tree) = line.trim().split_once("use ").map(|(before, tree)| (before.trim(), tree))?;
    let is_one = visibility.is_empty()
        || visibility.starts_with("pub") && !visibility.contains(' ')
        || visibility.starts_with("pub(in ");
    is_one.then_some((visibility, tree))
}

/// Place of a word from a place on.
fn next_word(code: &str, word: &str, from: usize) -> Option<usize> {
    let is_part = |character: char| character.is_alphanumeric() || character == '_';
    code[from..]
        .match_indices(word)
        .map(|(at, _)| from + at)
        .find(|at| !code[..*at].ends_with(is_part) && !code[at + word.len()..].starts_with(is_part))
}

fn names_often(code: &str, word: &str) -> bool {
    next_word(code, word, 0).is_some()
}

/// All paths of a use tree, each with the name that it binds.
fn use_paths(tree: &str) -> Vec<(Vec<String>, String)> {
    let tree = tree.trim().trim_start_matches("::");
    if let Some(open) = tree.find('{') {
        let prefix: Vec<String> =
            tree[..open].split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned).collect();
        let inside = &tree[open + 1..tree.rfind('}').unwrap_or(tree.len())];
        return split_list(inside)
            .into_iter()
            .flat_map(use_paths)
            .map(|(path, name)| {
                let path = if path == ["self"] { prefix.clone() } else { [prefix.as_slice(), &path].concat() };
                let name = if name == "self" { prefix.last().cloned().unwrap_or_default() } else { name };
                (path, name)
            })
            .collect();
    }
    if tree.is_empty() {
        return vec![];
    }
    let (path, alias) = tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias.trim())));
    let path: Vec<String> = path.split("::").map(|part| part.trim().to_owned()).collect();
    let name = alias.map_or_else(|| path.last().cloned().unwrap_or_default(), str::to_owned);
    vec![(path, name)]
}

/// Items of a list, by commas outside of braces.
fn split_list(list: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, character) in list.char_indices() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                items.push(&list[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    items.push(&list[start..]);
    items
}

/// Paths outside of `use` declarations.
fn inline_paths(code: &str) -> impl Iterator<Item = Vec<String>> {
    let is_part = |character: char| character.is_alphanumeric() || character == '_' || character == ':';
    code.split(move |character| !is_part(character))
        .filter(|path| path.contains("::"))
        .map(|path| path.split("::").map(str::to_owned).collect())
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
    let declared = code.split("#[cfg(test)]").skip(1).filter_map(|after| {
        let declaration = after.trim_start().strip_prefix("mod ")?;
        Some(declaration.split([';', ' ', '{']).next()?.to_owned())
    });
    declared.map(|child| [name.as_slice(), &[child]].concat()).collect()
}

/// Without the modules of tests that stand at a file's end.
fn without_tests(code: &str) -> String {
    code.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().to_owned()
}

fn rust_files(folder: &Path, root: &Path, found: &mut Vec<(String, String)>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, root, found);
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            let name = path.strip_prefix(root).unwrap().to_str().unwrap().replace('\\', "/");
            found.push((name, std::fs::read_to_string(&path).unwrap()));
        }
    }
}

#[test]
fn no_modules_use_each_other() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    rust_files(&root, &root, &mut files);
    // The binary is another crate.
    let files = files.iter().filter(|(file, _)| file != "main.rs").map(|(file, text)| (file.as_str(), text.as_str()));
    let modules = Modules::of(files);
    let circles = modules.circles();
    let told: Vec<_> = circles.iter().map(|circle| format!("circle:\n  {}", circle.join("\n  "))).collect();
    assert!(told.is_empty(), "{}", told.join("\n"));
}
