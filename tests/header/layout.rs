//! The headers from `include/layout.txt` and the items that it names.
//!
//! `@file` begins a header. Lines of the layout that begin with `@` are replaced by the items that they name; all others are
//! copied. Lines with `@` that follow each other form one block; its constants form a table. `@forward` declares structures whose definitions
//! follow later.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::items::{Item, Kind};

/// Longest line of the header.
const WIDTH: usize = 100;

/// Puts the items where the layout wants them. Returns the names and texts of the headers.
///
/// # Panics
/// If the layout misses an item, names one twice, or names one that does not exist.
pub fn arrange(layout: &str, items: Vec<Item>) -> Vec<(String, String)> {
    let mut left: BTreeMap<String, Item> =
        items.into_iter().map(|item| (item.name.clone(), item)).collect();
    let mut headers = Vec::new();
    let mut lines = layout.lines().peekable();
    while let Some(line) = lines.next() {
        if let Some(name) = line.strip_prefix("@file ") {
            headers.push((name.to_owned(), String::new()));
            continue;
        }
        let (_, header) = headers.last_mut().expect("the layout begins with @file");
        if let Some(names) = line.strip_prefix("@forward ") {
            for name in names.split_whitespace() {
                writeln!(header, "typedef struct {name} {name};").unwrap();
            }
        } else if let Some(names) = line.strip_prefix("@ ") {
            let mut names = names.to_owned();
            while let Some(more) = lines.next_if(|line| line.starts_with("@ ")) {
                names.push_str(&more[1..]);
            }
            let take = |name: &str| {
                let missing = "is no item, or stands twice in include/layout.txt";
                left.remove(name).unwrap_or_else(|| panic!("{name} {missing}"))
            };
            let items: Vec<Item> = names.split_whitespace().map(take).collect();
            header.push_str(&block(&items));
        } else {
            writeln!(header, "{line}").unwrap();
        }
    }
    let left: Vec<_> = left.keys().collect();
    assert!(left.is_empty(), "include/layout.txt does not name {left:?}");
    headers
}

/// The items of a line of the layout.
fn block(items: &[Item]) -> String {
    let constants: Vec<(&[String], String)> = items
        .iter()
        .filter_map(|item| match &item.kind {
            Kind::Constant(value) => {
                Some((&item.comment[..], format!("#define {} {value}", item.name)))
            }
            _ => None,
        })
        .collect();
    if !constants.is_empty() {
        assert_eq!(constants.len(), items.len(), "a line of constants names other items");
        return table("", &constants);
    }
    items.iter().map(item).collect::<Vec<_>>().join("\n")
}

fn item(item: &Item) -> String {
    let name = &item.name;
    let mut text = above("", &item.comment);
    match &item.kind {
        Kind::Constant(_) => unreachable!("constants stand in tables"),
        Kind::Opaque => writeln!(text, "typedef struct {name} {name};").unwrap(),
        Kind::Structure(fields) => {
            let fields: Vec<_> = fields
                .iter()
                .map(|(comment, field)| (&comment[..], field.replace("struct ", "")))
                .collect();
            write!(text, "struct {name} {{\n{}}};\n", table("    ", &fields)).unwrap();
        }
        Kind::Function(front, parameters) => text.push_str(&function(front, parameters)),
    }
    text
}

/// A function, its parameters filled into lines.
fn function(front: &str, parameters: &[String]) -> String {
    let mut text = format!("{front}(");
    let indent = text.len();
    let mut column = indent;
    for (i, parameter) in parameters.iter().enumerate() {
        let end = if i + 1 == parameters.len() { ");\n" } else { "," };
        if i > 0 && column + 1 + parameter.len() + end.trim_end().len() > WIDTH {
            write!(text, "\n{:indent$}", "").unwrap();
            column = indent;
        } else if i > 0 {
            text.push(' ');
            column += 1;
        }
        write!(text, "{parameter}{end}").unwrap();
        column += parameter.len() + end.len();
    }
    text
}

/// Declarations with their comments: beside them where a line has room, else above.
fn table(indent: &str, rows: &[(&[String], String)]) -> String {
    let beside = |comment: &[String]| match comment {
        [line] => Some(format!("/**< {line} */")),
        _ => None,
    };
    // Only what gets a comment beside it has its column.
    let fits = |row: &&(&[String], String)| {
        beside(row.0).is_some_and(|note| indent.len() + row.1.len() + 1 + note.len() <= WIDTH)
    };
    let width = rows.iter().filter(fits).map(|row| row.1.len()).max().unwrap_or(0);
    let mut text = String::new();
    for row in rows {
        let (comment, code) = row;
        let note = beside(comment).filter(|_| fits(&row));
        match note {
            Some(note) if indent.len() + width + 1 + note.len() <= WIDTH => {
                writeln!(text, "{indent}{code:width$} {note}").unwrap();
            }
            Some(note) => writeln!(text, "{indent}{code} {note}").unwrap(),
            None => writeln!(text, "{}{indent}{code}", above(indent, comment)).unwrap(),
        }
    }
    text
}

/// A comment above what it is about.
fn above(indent: &str, comment: &[String]) -> String {
    if let [line] = comment
        && indent.len() + line.len() + "/**  */".len() <= WIDTH
    {
        return format!("{indent}/** {line} */\n");
    }
    let mut text = format!("{indent}/**\n");
    for line in comment {
        writeln!(text, "{}", format!("{indent} * {line}").trim_end()).unwrap();
    }
    text + &format!("{indent} */\n")
}
