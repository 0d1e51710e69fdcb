//! The lists of friction laws in Fortran and in Python are those of the library's table.

use std::fs;
use std::path::Path;

use signorini::file::Law;

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
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
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
