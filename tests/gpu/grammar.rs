//! What browsers demand of WGSL and naga lets pass.

use super::passes::file_names;

/// Kinds of binary operators that need parentheses where they meet: a browser refuses `a << 1u | b`.
const KINDS: [&[&str]; 5] = [&["<<", ">>"], &["|"], &["&"], &["^"], &["+", "-", "*", "/", "%"]];

/// Lines where operators of different kinds stand side by side without parentheses.
fn mixed_operators(wgsl: &str) -> Vec<String> {
    let code = wgsl.lines().map(|line| line.split("//").next().unwrap_or("").to_owned() + " ");
    let mut found = Vec::new();
    // The kind of the operators seen so far, for each parenthesis that is open.
    let mut kinds: Vec<Option<usize>> = vec![None];
    // Binary operators stand between blanks; brackets and commas need not.
    for line in code {
        for word in line.split_inclusive(['(', ')', '[', ']', ',', ';', '{', '}', ' ']) {
            let (name, end) = word.split_at(word.len() - word.chars().last().map_or(0, char::len_utf8));
            let kind = KINDS.iter().position(|kind| end == " " && kind.contains(&name));
            if let (Some(kind), Some(open)) = (kind, kinds.last_mut()) {
                if open.is_some_and(|before| before != kind) {
                    found.push(line.trim().to_owned());
                }
                *open = Some(kind);
            } else if end == " " && ["=", "==", "!=", "<", ">", "<=", ">=", "&&", "||", "return"].contains(&name) {
                kinds.pop();
                kinds.push(None);
            }
            match end {
                "(" | "[" => kinds.push(None),
                ")" | "]" => drop(kinds.pop()),
                "," | ";" | "{" | "}" => {
                    kinds.pop();
                    kinds.push(None);
                }
                _ => (),
            }
        }
    }
    found
}

#[test]
fn operators_of_different_kinds_stand_in_parentheses() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let mut mixed = Vec::new();
    for folder in std::fs::read_dir(root).unwrap().map(|folder| folder.unwrap().file_name().into_string().unwrap()) {
        for file in file_names(&folder) {
            let text = std::fs::read_to_string(format!("{root}/{folder}/{file}.wgsl")).unwrap();
            mixed.extend(mixed_operators(&text).into_iter().map(|line| format!("{folder}/{file}.wgsl: {line}")));
        }
    }
    assert!(mixed.is_empty(), "put parentheses around one of the operators in\n{}", mixed.join("\n"));
}

#[test]
fn mixed_operators_are_noticed() {
    for fine in [
        "let a = (b << 1u) | c;",
        "f(a | b, c & d);",
        "let a = b + c * d;",
        "if (a < b && c > d) {",
        "x[i + 1u] | y",
        "// a << b | c",
    ] {
        assert!(mixed_operators(fine).is_empty(), "{fine}");
    }
    for wrong in ["let a = b << 1u | c;", "let a = b |\n    c & d;", "a[i] & b + 1u", "let c = f(a) >> 2u & b;"] {
        assert_eq!(mixed_operators(wrong).len(), 1, "{wrong}");
    }
}
