//! The items of cbindgen's output: constants, structures, types and functions with their comments.

/// A declaration with the lines of its comment, without the comment's marks.
pub struct Item {
    pub name: String,
    pub comment: Vec<String>,
    pub kind: Kind,
}

pub enum Kind {
    /// The value of a `#define`.
    Constant(String),
    /// The fields of a structure: comment and declaration.
    Structure(Vec<(Vec<String>, String)>),
    /// A structure that only the library knows.
    Opaque,
    /// A function or a type of functions: all in front of the parameters, the parameters, and what
    /// ends it.
    Function(String, Vec<String>),
}

/// Cuts cbindgen's output (`style = "tag"`) into its items.
pub fn cut(output: &str) -> Vec<Item> {
    let mut items = Vec::new();
    let mut lines = output.lines().map(str::trim).peekable();
    while let Some(line) = lines.next() {
        if line != "/**" {
            continue;
        }
        let comment = comment(&mut lines);
        let mut code = lines.next().expect("a declaration follows each comment").to_owned();
        if let Some(rest) = code.strip_prefix("#define ") {
            let (name, value) = rest.split_once(' ').expect("a constant has a value");
            let kind = Kind::Constant(value.to_owned());
            items.push(Item { name: name.to_owned(), comment, kind });
            continue;
        }
        if let Some(name) = code.strip_prefix("struct ").and_then(|rest| rest.strip_suffix(" {")) {
            let kind = Kind::Structure(fields(&mut lines));
            items.push(Item { name: name.to_owned(), comment, kind });
            continue;
        }
        while !code.ends_with(';') {
            code.push(' ');
            code.push_str(lines.next().expect("a declaration ends"));
        }
        items.push(declaration(comment, &code));
    }
    items
}

/// The lines of a comment up to its end; continuation lines keep their column.
fn comment<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Vec<String> {
    let inner = lines.take_while(|line| *line != "*/");
    let text = |line: &str| line.strip_prefix('*').unwrap_or(line).to_owned();
    inner.map(text).map(|line| line.strip_prefix(' ').unwrap_or(&line).to_owned()).collect()
}

fn fields<'a>(lines: &mut impl Iterator<Item = &'a str>) -> Vec<(Vec<String>, String)> {
    let mut fields = Vec::new();
    while let Some(line) = lines.next() {
        match line {
            "};" => return fields,
            "/**" => {
                let comment = comment(lines);
                let field = lines.next().expect("a field follows each comment");
                fields.push((comment, field.to_owned()));
            }
            _ => panic!("a field without a comment: {line}"),
        }
    }
    panic!("a structure does not end")
}

/// An opaque structure, a function or a type of functions.
fn declaration(comment: Vec<String>, code: &str) -> Item {
    let code = code.trim_end_matches(';');
    if let Some(name) = code.strip_prefix("struct ").filter(|name| !name.contains('(')) {
        return Item { name: name.to_owned(), comment, kind: Kind::Opaque };
    }
    let (front, parameters) = code.rsplit_once('(').expect("only functions are left");
    let front = front.replace("struct ", "");
    let name = front.rsplit([' ', '*', '(']).next().unwrap().trim_end_matches(')').to_owned();
    let parameters = parameters.trim_end_matches(')').replace("struct ", "");
    let parameters = parameters.split(", ").map(str::to_owned).collect();
    Item { name, comment, kind: Kind::Function(front, parameters) }
}
