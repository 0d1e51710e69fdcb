//! include/signorini.h is what cbindgen makes of src/ffi, in the order of include/layout.txt.

#[path = "header/items.rs"]
mod items;
#[path = "header/layout.rs"]
mod layout;

use std::fs;
use std::path::Path;

/// Fails when the committed header is stale; `SIGNORINI_BLESS=1 cargo test --test header` renews it.
#[test]
fn header_is_fresh() {
    let fresh = fresh();
    let path = root().join("include/signorini.h");
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        fs::write(&path, &fresh).unwrap();
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == fresh,
        "include/signorini.h is stale: run SIGNORINI_BLESS=1 cargo test --release --test header"
    );
}

#[test]
fn no_line_is_longer_than_a_hundred_columns() {
    for (i, line) in fresh().lines().enumerate() {
        assert!(line.len() <= 100, "line {} of the header: {line}", i + 1);
        assert!(line.is_ascii() && line.trim_end() == line, "line {}: {line}", i + 1);
    }
}

/// tests/c/layout.c states the size of every structure and the place of every field and the value of every number, so
/// that a change of one of them does not compile.
#[test]
fn the_layout_of_every_structure_is_stated() {
    let header = fs::read_to_string(root().join("include/signorini.h")).unwrap();
    let stated = fs::read_to_string(root().join("tests/c/layout.c")).unwrap();
    let (mut structure, mut fields, mut values) = (None, 0, 0);
    let missing = |line: &str| assert!(stated.contains(line), "tests/c/layout.c lacks {line}...");
    for line in header.lines().filter(|line| !line.trim_start().starts_with('*')) {
        let code = line.split("/*").next().unwrap().trim_end();
        if let Some(name) = code.strip_prefix("struct ").and_then(|code| code.strip_suffix(" {")) {
            missing(&format!("SIZE({name}, "));
            structure = Some(name);
        } else if code == "};" {
            structure = None;
        } else if let (Some(name), Some(code)) = (structure, code.strip_suffix(';')) {
            let field = code.rsplit([' ', '*']).next().unwrap().split('[').next().unwrap();
            missing(&format!("FIELD({name}, {field}, "));
            fields += 1;
        } else if let Some(value) = code.strip_prefix("#define SIGNORINI_")
            && let Some((name, number)) = value.split_once(' ')
            && !name.starts_with("VERSION_")
        {
            missing(&format!("VALUE(SIGNORINI_{name}, {number});"));
            values += 1;
        }
    }
    // Those of the first version at least: the search finds them.
    assert!(fields > 100 && values > 40, "{fields} fields, {values} values");
}

/// What cbindgen writes for a constant and a function.
const TWO: &str =
    "/**\n * One.\n */\n#define ONE 1\n\n/**\n * Two.\n */\nint32_t two(int32_t n,\n double *x);\n";

#[test]
fn items_stand_where_the_layout_wants_them() {
    let header = layout::arrange("begin\n@ two\n\n@ ONE\nend", items::cut(TWO));
    let wanted = "begin\n/** Two. */\nint32_t two(int32_t n, double *x);\n\n#define ONE 1 /**< One. */\nend\n";
    assert_eq!(header, wanted);
}

#[test]
#[should_panic(expected = "does not name [\"two\"]")]
fn an_item_that_the_layout_misses_is_named() {
    layout::arrange("@ ONE", items::cut(TWO));
}

#[test]
#[should_panic(expected = "ONE is no item, or stands twice")]
fn an_item_that_the_layout_names_twice_is_named() {
    layout::arrange("@ ONE\n\n@ two ONE", items::cut(TWO));
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn fresh() -> String {
    let config = cbindgen::Config::from_file(root().join("include/cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    let mut sources: Vec<_> =
        fs::read_dir(root().join("src/ffi")).unwrap().map(|entry| entry.unwrap().path()).collect();
    sources.sort();
    for source in sources {
        // The entries of Fortran 77 have a reference of their own, include/signorini.inc.
        if source.extension().is_some_and(|extension| extension == "rs")
            && !source.ends_with("fortran.rs")
        {
            builder = builder.with_src(source);
        }
    }
    let mut output = Vec::new();
    builder.generate().unwrap().write(&mut output);
    let items = items::cut(std::str::from_utf8(&output).unwrap());
    let layout = fs::read_to_string(root().join("include/layout.txt")).unwrap();
    layout::arrange(&layout, items)
}
