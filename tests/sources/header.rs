//! The headers in include/ are what cbindgen makes of src/ffi, in the order of include/layout.txt.

use std::fs;
use std::path::Path;

/// Fails when a committed header is stale; `SIGNORINI_BLESS=1 cargo test --profile daily --test sources` renews them.
#[test]
fn headers_are_fresh() {
    for (name, fresh) in fresh() {
        let path = root().join("include").join(&name);
        if std::env::var_os("SIGNORINI_BLESS").is_some() {
            fs::write(&path, &fresh).unwrap();
        }
        let committed = fs::read_to_string(&path).unwrap_or_default();
        assert!(
            committed == fresh,
            "include/{name} is stale: run SIGNORINI_BLESS=1 cargo test --profile daily --test sources"
        );
    }
}

/// A C programmer reads the first header in 25 minutes, at 240 words a minute, and finds 45 functions in all three.
#[test]
fn the_headers_are_short() {
    let headers = fresh();
    let (_, first) = &headers[0];
    let words = first.split_whitespace().filter(|word| word.contains(char::is_alphanumeric));
    let (lines, words) = (first.lines().count(), words.count());
    assert!(lines <= 900 && words <= 6000, "{lines} lines, {words} words");
    let functions = headers.iter().flat_map(|(_, text)| text.lines());
    let functions =
        functions.filter(|line| line.contains(" signorini_") || line.contains(" *signorini_"));
    let count =
        functions.filter(|line| line.contains('(') && !line.starts_with([' ', 't'])).count();
    assert!((30..=45).contains(&count), "{count} functions");
}

#[test]
fn no_line_is_longer_than_a_hundred_columns() {
    for (name, header) in fresh() {
        for (i, line) in header.lines().enumerate() {
            assert!(line.len() <= 100, "{name}, line {}: {line}", i + 1);
            assert!(line.is_ascii() && line.trim_end() == line, "{name}, line {}: {line}", i + 1);
        }
    }
}

/// tests/c/layout.c states the size of every structure and the place of every field and the value of every number, so
/// that a change of one of them does not compile.
#[test]
fn the_layout_of_every_structure_is_stated() {
    let headers: String = fresh().into_iter().map(|(_, text)| text).collect();
    let stated = fs::read_to_string(root().join("tests/c/layout.c")).unwrap();
    let (mut structure, mut fields, mut values) = (None, 0, 0);
    let missing = |line: &str| assert!(stated.contains(line), "tests/c/layout.c lacks {line}...");
    for line in headers.lines().filter(|line| !line.trim_start().starts_with('*')) {
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

/// cbindgen's output for a constant and a function.
const TWO: &str =
    "/**\n * One.\n */\n#define ONE 1\n\n/**\n * Two.\n */\nint32_t two(int32_t n,\n double *x);\n";

#[test]
fn items_stand_where_the_layout_wants_them() {
    let layout = "@file a\nbegin\n@ two\n@file b\n@ ONE\nend";
    let headers = crate::layout::arrange(layout, crate::items::cut(TWO));
    let wanted = [
        ("a", "begin\n/** Two. */\nint32_t two(int32_t n, double *x);\n"),
        ("b", "#define ONE 1 /**< One. */\nend\n"),
    ];
    let wanted = wanted.map(|(name, text)| (name.to_owned(), text.to_owned()));
    assert_eq!(headers, wanted);
}

#[test]
#[should_panic(expected = "does not name [\"two\"]")]
fn an_item_that_the_layout_misses_is_named() {
    crate::layout::arrange("@file a\n@ ONE", crate::items::cut(TWO));
}

#[test]
#[should_panic(expected = "ONE is no item, or stands twice")]
fn an_item_that_the_layout_names_twice_is_named() {
    crate::layout::arrange("@file a\n@ ONE\n\n@ two ONE", crate::items::cut(TWO));
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn fresh() -> Vec<(String, String)> {
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
    let items = crate::items::cut(std::str::from_utf8(&output).unwrap());
    let layout = fs::read_to_string(root().join("include/layout.txt")).unwrap();
    crate::layout::arrange(&layout, items)
}
