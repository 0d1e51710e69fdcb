//! The lists of friction laws in Fortran and in Python are those of the library's table.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use signorini::file::Law;

use crate::sources::sources;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The line above a list names this file; a blank line ends the list.
const MARK: &str = "(tests/sources/bindings.rs)";

/// Fails when a list is stale; `SIGNORINI_BLESS=1 cargo test --test sources` renews it.
#[test]
fn lists_of_laws_are_fresh() {
    fresh("include/signorini.f90", &module());
    fresh("c_examples/python/signorini/_constants.py", &package());
}

/// The number of each law, its name in upper case, and how many numbers it has for each pair.
fn laws() -> impl Iterator<Item = (usize, String, usize)> {
    let name = |law: Law| law.name().to_uppercase().replace('-', "_");
    Law::ALL.into_iter().enumerate().map(move |(i, law)| (i, name(law), law.parameters().len()))
}

fn module() -> Vec<String> {
    let mut lines: Vec<_> = laws()
        .map(|(i, name, _)| {
            format!("    integer(c_int32_t), parameter :: SIGNORINI_LAW_{name} = {i}")
        })
        .collect();
    let last = Law::ALL.len() - 1;
    let numbers: Vec<_> = laws().map(|(.., numbers)| numbers.to_string()).collect();
    let numbers = numbers.join(", ");
    lines.push(format!("    integer, parameter, private :: law_numbers(0:{last}) = [{numbers}]"));
    lines
}

fn package() -> Vec<String> {
    laws().map(|(i, name, numbers)| format!("    {name} = {i}, {numbers}")).collect()
}

fn fresh(path: &str, list: &[String]) {
    let path = root().join(path);
    let text = fs::read_to_string(&path).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let first = 1 + lines.iter().position(|line| line.contains(MARK)).unwrap();
    let count = lines[first..].iter().position(|line| line.trim().is_empty()).unwrap();
    lines.splice(first..first + count, list.iter().cloned());
    let renewed = lines.join("\n") + "\n";
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        fs::write(&path, &renewed).unwrap();
        return;
    }
    let path = path.display();
    assert!(
        text == renewed,
        "the laws of {path} are stale: run SIGNORINI_BLESS=1 cargo test --test sources"
    );
}

/// Entries of Fortran 77, without what compilers add to a name.
fn fortran_77() -> BTreeSet<String> {
    let entries: BTreeSet<String> = sources()
        .iter()
        .filter(|source| source.path.starts_with("ffi/fortran/"))
        .flat_map(|source| &source.tokens)
        .filter_map(|token| token.text.strip_suffix("_64_"))
        .map(str::to_owned)
        .collect();
    assert!(!entries.is_empty());
    entries
}

/// The build script exports each entry of Fortran 77 by further names on Windows.
#[test]
fn all_entries_of_fortran_77_have_their_names_on_windows() {
    let script = fs::read_to_string(root().join("src/build.rs")).unwrap();
    let list = script.split("FORTRAN: ").nth(1).unwrap().split(';').nth(1).unwrap();
    let listed: BTreeSet<String> = list.split('"').skip(1).step_by(2).map(str::to_owned).collect();
    assert_eq!(listed, fortran_77());
}

/// What the DLL exports, for those who make an import library of their own.
fn definitions() -> String {
    let mut names = BTreeSet::new();
    for name in ["signorini.h", "signorini_file.h", "signorini_surface.h"] {
        let header = fs::read_to_string(root().join("include").join(name)).unwrap();
        // A declaration begins at the start of its line.
        for line in header.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_lowercase()))
        {
            let before = line.split('(').next().filter(|before| before.len() < line.len());
            let name = before.and_then(|before| before.rsplit([' ', '*']).next());
            names.extend(name.filter(|name| name.starts_with("signorini_")).map(str::to_owned));
        }
    }
    for entry in fortran_77() {
        for name in [entry.clone(), format!("{entry}_64")] {
            names.extend([format!("{name}_"), name.to_uppercase(), name]);
        }
    }
    let lines: Vec<String> = names.iter().map(|name| format!("    {name}\n")).collect();
    format!("LIBRARY signorini.dll\nEXPORTS\n{}", lines.concat())
}

/// `SIGNORINI_BLESS=1 cargo test --test sources` renews it.
#[test]
fn the_list_of_the_dlls_functions_is_fresh() {
    let path = root().join("include/signorini.def");
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        fs::write(&path, definitions()).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap_or_default() == definitions(),
        "include/signorini.def is stale: run SIGNORINI_BLESS=1 cargo test --test sources"
    );
}

/// Files that no build makes from Cargo.toml.
#[test]
fn the_version_is_the_same_everywhere() {
    let version = env!("CARGO_PKG_VERSION");
    let (interface, _patch) = version.rsplit_once('.').unwrap();
    for (path, words) in [
        ("c_examples/install/recipe.yaml", format!("version: \"{version}\"")),
        (
            "c_examples/install/spack/packages/signorini/package.py",
            format!("signorini@{version}\n"),
        ),
        ("c_examples/python/signorini/_library.py", format!("SONAME_VERSION = \"{interface}\"")),
        ("c_examples/guide/first.md", format!("find_package(signorini {interface} ")),
        ("README.md", format!("find_package(signorini {interface})")),
    ] {
        let text = fs::read_to_string(root().join(path)).unwrap();
        assert!(text.contains(&words), "{path} does not say {words}");
    }
}
