//! Who may import whom: the rooms of the library and the arrows between them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms that each room may import. `linalg::small` is the part of `linalg` that names no factor.
const ALLOWED: [(&str, &[&str]); 14] = [
    ("error", &[]),
    ("linalg", &[]),
    ("settings", &["error"]),
    ("law", &["error", "linalg::small"]),
    ("matrix", &["error"]),
    ("problem", &["error", "linalg::small", "law", "matrix"]),
    ("reduce", &["error", "linalg", "matrix"]),
    ("file", &["error", "lcp", "problem"]),
    ("model", &["error", "file", "matrix", "monitor", "problem", "reduce", "settings", "solve"]),
    ("lcp", &["error", "linalg::small", "matrix"]),
    ("certificate", &["error", "linalg::small", "law", "problem"]),
    ("monitor", &["error", "settings"]),
    ("solve", &["error", "linalg", "law", "problem", "lcp", "certificate", "settings", "monitor"]),
    (
        "ffi",
        &[
            "error",
            "file",
            "law",
            "matrix",
            "problem",
            "lcp",
            "certificate",
            "settings",
            "monitor",
            "model",
            "reduce",
            "solve",
        ],
    ),
];

/// Solvers that one solver may call.
const SOLVERS: [(&str, &[&str]); 23] = [
    ("auto", &["run", "solution", "uniqueness"]),
    ("bare", &["lemke", "pivot", "solution"]),
    ("bordered", &["pieces"]),
    ("coulomb", &["solution", "sweeps"]),
    ("delayed", &[]),
    ("elimination", &["factor"]),
    ("equations", &["bordered", "pieces", "sor"]),
    ("escape", &["factor"]),
    ("factor", &[]),
    ("friction_lcp", &["elimination", "factor", "pieces", "solution"]),
    ("frictional_lemke", &["friction_lcp", "lemke", "newton", "solution", "statics"]),
    ("frictionless", &["elimination", "lemke", "solution", "sweeps"]),
    ("lemke", &["tableau"]),
    ("newton", &["equations", "pieces", "solution"]),
    ("pieces", &[]),
    ("pivot", &["equations", "newton", "pieces", "solution"]),
    ("relaxation", &[]),
    ("solution", &[]),
    ("sor", &[]),
    ("statics", &["factor"]),
    ("sweeps", &["escape", "relaxation", "solution", "sor"]),
    ("tableau", &["delayed"]),
    ("uniqueness", &["frictional_lemke", "newton", "pieces", "solution"]),
];

#[test]
fn rooms_import_only_what_they_may() {
    let allowed: BTreeMap<_, _> = ALLOWED.into_iter().collect();
    for file in sources() {
        let room = room(&file);
        if room == "lib" || room == "build" {
            continue;
        }
        let allowed = allowed.get(room.as_str()).unwrap_or_else(|| panic!("a new room: {room}"));
        for import in imports(&file, "crate::") {
            let fits = allowed.iter().any(|may| {
                import == *may
                    || import.strip_prefix(may).is_some_and(|rest| rest.starts_with("::"))
            });
            assert!(
                fits || import.split("::").next() == Some(room.as_str()),
                "{} may not import {import}",
                file.display()
            );
        }
    }
}

#[test]
fn solvers_call_only_what_they_may() {
    for (solver, allowed) in SOLVERS {
        let file = root().join(format!("src/solve/{solver}.rs"));
        for import in imports(&file, "super::") {
            let module = import.split("::").next().unwrap();
            let is_type = module.starts_with(char::is_uppercase);
            assert!(is_type || allowed.contains(&module), "{solver} may not import {import}");
        }
    }
    let known = SOLVERS.map(|(solver, _)| solver);
    for file in sources().iter().filter(|file| room(file) == "solve") {
        let stem = file.file_stem().unwrap().to_str().unwrap();
        assert!(stem == "mod" || known.contains(&stem), "a solver without a rule: {stem}");
    }
}

#[test]
fn foreign_crates_stay_in_their_rooms() {
    let homes = [("faer", "linalg"), ("nalgebra", "linalg"), ("pulp", "linalg"), ("libc", "ffi")];
    for file in sources() {
        let text = fs::read_to_string(&file).unwrap();
        for (name, home) in homes {
            let named = text.contains(&format!("{name}::"));
            assert!(!named || room(&file) == home, "{} names {name}", file.display());
        }
        let unsafe_allowed = room(&file) == "ffi";
        assert!(unsafe_allowed || !code(&text).contains("unsafe"), "{} is unsafe", file.display());
    }
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).to_path_buf()
}

fn sources() -> Vec<PathBuf> {
    let mut folders = vec![root().join("src")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    assert!(files.len() > 10, "the sources have moved");
    files
}

/// The first folder or file below `src`.
fn room(file: &Path) -> String {
    let inner = file.strip_prefix(root().join("src")).unwrap();
    let first = inner.components().next().unwrap().as_os_str().to_str().unwrap();
    first.trim_end_matches(".rs").to_owned()
}

fn code(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n")
}

/// Paths below `prefix` that a file names, in `use` or in place; groups are taken apart.
fn imports(file: &Path, prefix: &str) -> Vec<String> {
    let text = code(&fs::read_to_string(file).unwrap());
    let mut found = Vec::new();
    for (begin, _) in text.match_indices(prefix) {
        let rest = &text[begin + prefix.len()..];
        let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap();
        let path = &rest[..end];
        match path.strip_suffix("::") {
            Some(base) => {
                let group = rest[end..].strip_prefix('{').expect("a group of imports");
                for item in group[..group.find('}').unwrap()].split(',') {
                    found.push(format!("{base}::{}", item.trim()));
                }
            }
            None if rest[end..].starts_with('{') && path.is_empty() => {
                let group = &rest[end + 1..];
                for item in group[..group.find('}').unwrap()].split(',') {
                    found.push(item.trim().to_owned());
                }
            }
            None => found.push(path.to_owned()),
        }
    }
    found
}
