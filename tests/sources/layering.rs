//! Who may import whom: rooms, the order of the solvers, and no cycle between files.

use std::collections::{BTreeMap, BTreeSet};

use crate::modules::{Modules, cycles};
use crate::sources::{Source, Token, sources, tokens};

/// Rooms that each room may import. `lib.rs` passes names on and is no room.
const ROOMS: [(&str, &[&str]); 16] = [
    ("counters", &[]),
    ("error", &[]),
    ("shortage", &[]),
    ("workers", &["counters"]),
    ("linalg", &["shortage", "workers"]),
    ("settings", &["error"]),
    ("monitor", &["error", "settings", "shortage"]),
    ("problem", &["error", "linalg"]),
    ("law", &["error", "linalg", "problem"]),
    ("reduce", &["error", "linalg", "problem"]),
    ("surface", &["error", "linalg", "monitor", "problem"]),
    ("file", &["error", "problem"]),
    ("certificate", &["error", "linalg", "problem", "law"]),
    (
        "solve",
        &[
            "counters",
            "error",
            "linalg",
            "settings",
            "monitor",
            "problem",
            "law",
            "certificate",
            "workers",
        ],
    ),
    (
        "model",
        &[
            "error",
            "linalg",
            "settings",
            "monitor",
            "problem",
            "law",
            "reduce",
            "surface",
            "file",
            "certificate",
            "solve",
        ],
    ),
    (
        "ffi",
        &[
            "error",
            "shortage",
            "workers",
            "linalg",
            "settings",
            "monitor",
            "problem",
            "law",
            "reduce",
            "surface",
            "file",
            "certificate",
            "solve",
            "model",
        ],
    ),
];

/// The rooms of `solve`: each imports from those before it only.
const SOLVERS: [&str; 14] = [
    "result",
    "pieces",
    "part",
    "rigid",
    "sweeps",
    "newton",
    "path",
    "proximal",
    "lcp",
    "uniqueness",
    "plan",
    "operator",
    "units",
    "mod",
];

#[test]
fn rooms_import_only_what_they_may() {
    let sources = sources();
    let modules = Modules::new(&sources);
    let allowed: BTreeMap<&str, &[&str]> = ROOMS.into_iter().collect();
    let mut wrong = Vec::new();
    for (at, source) in sources.iter().enumerate().filter(|(_, source)| source.room() != "lib") {
        let room = source.room();
        let may = allowed.get(room).unwrap_or_else(|| panic!("a room without a rule: {room}"));
        for import in modules.imports(at) {
            let target = sources[import.target].room();
            if target != room && !may.contains(&target) {
                wrong.push(format!("{} imports {}", source.path, import.path));
            }
        }
    }
    assert!(wrong.is_empty(), "imports that no room may have:\n{}", wrong.join("\n"));
}

#[test]
fn solvers_import_only_what_stands_before_them() {
    let sources = sources();
    let modules = Modules::new(&sources);
    let group = |source: &Source| match source.module.get(1) {
        Some(name) => name.clone(),
        None => "mod".to_owned(),
    };
    let rank = |source: &Source| {
        let name = group(source);
        let rank = SOLVERS.iter().position(|solver| *solver == name);
        rank.unwrap_or_else(|| panic!("a solver without a place in the order: {name}"))
    };
    let mut wrong = Vec::new();
    for (at, source) in sources.iter().enumerate().filter(|(_, source)| source.room() == "solve") {
        for import in modules.imports(at) {
            let target = &sources[import.target];
            if target.room() != "solve" || group(target) == group(source) {
                continue;
            }
            if rank(target) > rank(source) {
                wrong.push(format!("{} imports {}: upwards", source.path, import.path));
            }
            if import.written.len() > 2 {
                let what = "past the mod.rs of its folder";
                wrong.push(format!("{} imports {} {what}", source.path, import.path));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_order_of_the_solvers_is_the_documented_one() {
    let sources = sources();
    let solve = sources.iter().find(|source| source.path == "solve/mod.rs").unwrap();
    let stated =
        solve.lines.iter().any(|line| line.trim_start_matches("//! ") == SOLVERS.join(" ← "));
    assert!(stated, "solve/mod.rs does not say: {}", SOLVERS.join(" ← "));
}

#[test]
fn no_files_import_each_other_in_a_cycle() {
    let sources = sources();
    let modules = Modules::new(&sources);
    let edges: Vec<BTreeSet<usize>> = (0..sources.len())
        .map(|at| modules.imports(at).into_iter().map(|import| import.target).collect())
        .collect();
    let mut found = Vec::new();
    for cycle in cycles(&edges) {
        for &from in &cycle {
            let imports = modules.imports(from);
            for import in imports.iter().filter(|import| cycle.contains(&import.target)) {
                found.push(format!("{} imports {}", sources[from].path, import.path));
            }
        }
        found.push(String::new());
    }
    assert!(found.is_empty(), "files that import each other:\n{}", found.join("\n"));
}

/// Rooms in which each type stands in a file of its own.
const ROOMS_OF_FILES: [&str; 7] =
    ["certificate", "file", "law", "linalg", "problem", "reduce", "surface"];

/// A type that a `mod.rs` defines makes every file of its room import upwards.
#[test]
fn a_room_has_no_type_in_its_mod_rs() {
    let is_type = |text: &str| matches!(text, "struct" | "enum" | "trait" | "union");
    let mut wrong = Vec::new();
    for source in sources() {
        let is_mod = source.path.ends_with("/mod.rs") && ROOMS_OF_FILES.contains(&source.room());
        for token in source.tokens.iter().filter(|token| is_mod && is_type(&token.text)) {
            wrong.push(format!("src/{}:{} defines a type", source.path, token.line));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_search_follows_names_to_their_files() {
    let sources = sources();
    let modules = Modules::new(&sources);
    let place = |path: &str| sources.iter().position(|source| source.path == path).unwrap();
    let imports = |path: &str| -> BTreeSet<&str> {
        let imports = modules.imports(place(path));
        imports.iter().map(|import| sources[import.target].path.as_str()).collect()
    };
    // `use super::Bound`, which law/mod.rs passes on.
    assert!(imports("law/friction.rs").contains("law/bound.rs"));
    assert!(!imports("law/friction.rs").contains("law/mod.rs"));
    // law/mod.rs passes `Contact` on without a use of its own, and law/pair_law.rs needs `Bound` itself.
    assert!(imports("law/pair_law.rs").contains("law/bound.rs"));
    assert!(!imports("law/mod.rs").contains("law/contact.rs"));
    // `use crate::solve::solve`, which that `mod.rs` defines, and `from_pieces`, which `newton/mod.rs` passes on.
    assert!(imports("model.rs").contains("solve/mod.rs"));
    assert!(imports("solve/uniqueness/search.rs").contains("solve/newton/iteration.rs"));
    // `auto::solve(..)` after `use super::auto`.
    assert!(imports("solve/plan/distant_gaps.rs").contains("solve/plan/auto.rs"));
    // `pub use solve::Status` of lib.rs.
    assert!(!imports("lib.rs").contains("solve/result/solution.rs"));
}

#[test]
fn the_search_finds_cycles() {
    let edges = |lists: &[&[usize]]| -> Vec<BTreeSet<usize>> {
        lists.iter().map(|list| list.iter().copied().collect()).collect()
    };
    assert!(cycles(&edges(&[&[1, 2], &[2], &[]])).is_empty());
    assert_eq!(cycles(&edges(&[&[1], &[2], &[0], &[0]])), [vec![0, 1, 2]]);
    assert_eq!(cycles(&edges(&[&[1], &[0], &[3], &[2, 0]])), [vec![0, 1], vec![2, 3]]);
}

#[test]
fn foreign_crates_and_unsafe_stay_in_their_rooms() {
    let homes = [
        ("faer", "linalg"),
        ("nalgebra", "linalg"),
        ("pulp", "linalg"),
        ("libc", "ffi"),
        ("unsafe", "ffi"),
    ];
    for source in sources() {
        for token in &source.tokens {
            let home = homes.iter().find(|(name, _)| token.text == *name);
            let fits = home.is_none_or(|(_, home)| source.room() == *home);
            assert!(fits, "src/{}:{} names {}", source.path, token.line, token.text);
        }
    }
}

/// Nothing but `settings.threads` starts a thread, and one file does.
#[test]
fn threads_are_started_in_one_place() {
    for source in sources() {
        let starts = |text: &str| {
            matches!(text, "spawn" | "spawn_scoped" | "spawn_unchecked" | "scope" | "rayon")
                || text == "pthread_create"
        };
        if source.path != "ffi/threads/system_thread.rs" {
            let token = source.tokens.iter().find(|token| starts(&token.text));
            let line = token.map(|token| token.line);
            assert_eq!(line, None, "src/{} may start a thread", source.path);
        }
    }
    let sources = sources();
    let source = sources.iter().find(|source| source.path == "ffi/threads/system_thread.rs");
    let tokens = &source.expect("the file is there").tokens;
    assert!(tokens.iter().any(|token| token.text == "pthread_create"));
}

/// Files that know on which system they run. All others compile and do the same everywhere.
const FILES_OF_SYSTEMS: [&str; 7] = [
    "ffi/args.rs",
    "ffi/fork_lock.rs",
    "ffi/guard.rs",
    "ffi/mod.rs",
    "ffi/static_link.rs",
    "ffi/surroundings.rs",
    "ffi/threads/system_thread.rs",
];

/// Types of C that every system has.
const TYPES_OF_C: [&str; 3] = ["c_char", "c_int", "c_void"];

/// True of a word that asks for a system or a processor, or calls what one alone has.
fn is_of_a_system(tokens: &[Token], at: usize) -> bool {
    let text = |place: Option<usize>| {
        place.and_then(|place| tokens.get(place)).map_or("", |token| token.text.as_str())
    };
    let (before, word, after) = (text(at.checked_sub(1)), text(Some(at)), text(Some(at + 1)));
    match word {
        "target_os" | "target_env" | "target_family" | "target_arch" | "target_vendor" | "asm" => {
            true
        }
        // `slice.windows(2)` is none.
        "unix" | "windows" => before != ".",
        "libc" => after == "::" && !TYPES_OF_C.contains(&text(Some(at + 2))),
        // `std::arch`, `std::os`, and functions of the C library that are declared here.
        "arch" | "os" => before == "::",
        "extern" => text(Some(at + 2)) == "{",
        _ => false,
    }
}

#[test]
fn the_system_is_asked_for_in_its_places() {
    let (mut wrong, mut found) = (Vec::new(), BTreeSet::new());
    for source in sources() {
        for at in (0..source.tokens.len()).filter(|at| is_of_a_system(&source.tokens, *at)) {
            let token = &source.tokens[at];
            match FILES_OF_SYSTEMS.iter().find(|file| **file == source.path) {
                Some(file) => _ = found.insert(*file),
                None => wrong.push(format!("src/{}:{}: {}", source.path, token.line, token.text)),
            }
        }
    }
    assert!(wrong.is_empty(), "what one system alone has:\n{}", wrong.join("\n"));
    assert_eq!(found.len(), FILES_OF_SYSTEMS.len(), "files that know no system: {found:?} do");
}

#[test]
fn the_search_for_systems_finds_them() {
    let is_found = |text: &str| {
        let tokens = tokens(text);
        (0..tokens.len()).any(|at| is_of_a_system(&tokens, at))
    };
    let of_a_system = [
        "#[cfg(unix)] fn f() {}",
        "if cfg!(windows) {}",
        "#[cfg(target_arch = \"x86_64\")]",
        "unsafe { libc::fork() }",
        "use std::os::fd::AsFd;",
        "core::arch::asm!(\"nop\")",
        "unsafe extern \"C\" { fn fork() -> i32; }",
    ];
    for text in of_a_system {
        assert!(is_found(text), "{text}");
    }
    for text in ["for pair in ends.windows(2) {}", "use libc::c_char;", "extern \"C\" fn f() {}"] {
        assert!(!is_found(text), "{text}");
    }
}
