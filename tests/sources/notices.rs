//! LICENSE-THIRD-PARTY names all crates that are linked into the library, on any system, with their licences and the
//! texts that these ask for. `SIGNORINI_BLESS=1 cargo test --test sources -- notices::` writes it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const FILE: &str = "LICENSE-THIRD-PARTY";

const BEGIN: &str = "\
Notices of what is linked into signorini's libraries, on any system.

Rust's standard library: MIT OR Apache-2.0, with parts under other permissive licences. Copyright The Rust Project
Contributors. Each distribution of Rust has the whole list as share/doc/rust/COPYRIGHT-library.html.

Programs that rustc links by MinGW contain parts of its runtime, which is in the public domain or under permissive
licences (COPYING.MinGW-w64-runtime.txt of MinGW-w64), and the unwinder of GCC, under GPL 3 with the GCC Runtime Library
Exception.

The crates, all from crates.io, where their sources are had under name and version. Those without a text of their own
are by the authors of faer and gemm, and under the MIT licence as it stands below for these:

";

/// A crate by name and version, with its licences as its manifest writes them, and its folder.
struct Crate {
    name: String,
    licences: String,
    folder: PathBuf,
}

fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo {arguments:?}: {said}");
    String::from_utf8(output.stdout).expect("cargo writes UTF-8")
}

/// All crates that are linked: no macros and nothing that only builds or tests.
fn crates() -> Vec<Crate> {
    let metadata = cargo(&["metadata", "--format-version", "1", "--locked"]);
    let folders: BTreeMap<String, PathBuf> = metadata
        .split("\"manifest_path\":\"")
        .skip(1)
        .filter_map(|rest| {
            Path::new(&rest.split('"').next()?.replace("\\\\", "/")).parent().map(Path::to_owned)
        })
        .map(|folder| (folder.file_name().unwrap().to_string_lossy().into_owned(), folder))
        .collect();
    let tree = cargo(&[
        "tree",
        "--locked",
        "--target",
        "all",
        "--edges",
        "normal,no-proc-macro",
        "--prefix",
        "none",
        "--format",
        "{p}|{l}|",
    ]);
    let mut names = BTreeSet::new();
    for line in tree.lines() {
        let mut fields = line.split('|');
        let (package, licences) = (fields.next().unwrap(), fields.next().unwrap());
        let mut words = package.split(' ');
        let (name, version) =
            (words.next().unwrap(), words.next().unwrap().trim_start_matches('v'));
        if name != env!("CARGO_PKG_NAME") {
            names.insert((format!("{name}-{version}"), licences.to_owned()));
        }
    }
    let folder =
        |name: &String| folders.get(name).unwrap_or_else(|| panic!("no sources of {name}")).clone();
    names
        .into_iter()
        .map(|(name, licences)| Crate { folder: folder(&name), name, licences })
        .collect()
}

/// The texts that a crate's licences ask to hand on: that of MIT where it may be chosen, else all that it has.
fn texts(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = names.map(|name| name.to_string_lossy().into_owned()).collect();
    names.retain(|name| {
        let name = name.to_uppercase();
        ["LICEN", "COPYING", "COPYRIGHT", "NOTICE"].iter().any(|start| name.starts_with(start))
    });
    names.sort();
    let of_mit: Vec<String> =
        names.iter().filter(|name| name.to_uppercase().contains("MIT")).cloned().collect();
    let chosen = if of_mit.is_empty() { names } else { of_mit };
    let read = |name: &String| fs::read_to_string(folder.join(name)).expect("a licence is a text");
    chosen.iter().map(|name| tidy(&read(name))).collect()
}

/// Without white space at ends of lines and of the text.
fn tidy(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    lines.join("\n").trim_matches('\n').to_owned()
}

fn notices(crates: &[Crate]) -> String {
    let mut file = BEGIN.to_owned();
    let mut by_text: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for linked in crates {
        let texts = texts(&linked.folder);
        let none = if texts.is_empty() { "; no text of its own" } else { "" };
        file += &format!("  {}: {}{none}\n", linked.name, linked.licences);
        for text in texts {
            by_text.entry(text).or_default().push(&linked.name);
        }
    }
    for (text, names) in by_text {
        let rule = "-".repeat(80);
        file += &format!("\n{rule}\n{}\n{rule}\n\n{text}\n", names.join(", "));
    }
    file
}

#[test]
fn notices_of_all_that_is_linked_are_there() {
    let wanted = notices(&crates());
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(FILE);
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        fs::write(&path, &wanted).unwrap();
    }
    let given = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        given == wanted,
        "{FILE} is not what the crates say: SIGNORINI_BLESS=1 cargo test --test sources -- notices:: writes it"
    );
}

#[test]
fn a_notice_that_is_missing_is_seen() {
    let mut crates = crates();
    let whole = notices(&crates);
    for name in ["faer", "nalgebra", "libc"] {
        let of_crate = |line: &str| line.starts_with(&format!("  {name}-"));
        assert!(whole.lines().any(of_crate), "{name} is linked and not named");
    }
    let removed = crates.remove(crates.len() / 2);
    let less = notices(&crates);
    assert!(
        less != whole
            && whole.contains(&removed.name)
            && !less.contains(&format!("  {}:", removed.name))
    );
}
