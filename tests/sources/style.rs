//! The style that a reader may count on: short functions, short files, and no number in a condition
//! whose meaning is not named.

use std::collections::BTreeMap;

use crate::sources::{
    Kind, Token, closing, compares, left_operand, right_operand, sources, tokens,
};

/// Most lines of a function without `// long: <reason>` on the line above it.
const FUNCTION: usize = 60;

/// Most lines of a file.
const FILE: usize = 350;

/// Numbers that a condition may have where a part of its text stands: the place, the text, and why.
const ALLOWED: [(&str, &str, &str); 0] = [];

#[test]
fn functions_are_short() {
    let mut long = Vec::new();
    for source in sources() {
        for (name, first, last) in functions(&source.tokens) {
            let lines = last - first + 1;
            let above = first.checked_sub(2).map_or("", |above| source.lines[above].trim());
            let reason = above.strip_prefix("// long: ").is_some_and(|reason| !reason.is_empty());
            if lines > FUNCTION && !reason {
                long.push(format!("src/{}:{first}: {name} has {lines} lines", source.path));
            }
        }
    }
    assert!(long.is_empty(), "long functions without a reason:\n{}", long.join("\n"));
}

#[test]
fn files_are_short() {
    let long: Vec<String> = sources()
        .iter()
        .filter(|source| source.lines.len() > FILE)
        .map(|source| format!("src/{} has {} lines", source.path, source.lines.len()))
        .collect();
    assert!(long.is_empty(), "long files:\n{}", long.join("\n"));
}

#[test]
fn conditions_have_no_bare_numbers() {
    let mut found = Vec::new();
    let mut used = [false; ALLOWED.len()];
    for source in sources().iter() {
        for (line, number) in bare_numbers(&source.tokens) {
            let text = source.lines[line - 1].trim();
            let allowed = ALLOWED
                .iter()
                .position(|(place, part, _)| source.path.starts_with(place) && text.contains(part));
            match allowed {
                Some(entry) => used[entry] = true,
                None => found.push(format!("src/{}:{line}: {number} in: {text}", source.path)),
            }
        }
    }
    assert!(found.is_empty(), "numbers without a name in conditions:\n{}", found.join("\n"));
    for (used, (place, part, _)) in used.iter().zip(ALLOWED) {
        assert!(used, "{part} is allowed in src/{place} and does not stand there");
    }
}

/// Names of all functions with a body, with their first and last lines.
fn functions(tokens: &[Token]) -> Vec<(String, usize, usize)> {
    let mut functions = Vec::new();
    for at in 0..tokens.len().saturating_sub(1) {
        if tokens[at].text != "fn" || tokens[at + 1].kind != Kind::Word {
            continue;
        }
        let body = (at..).find(|&end| match tokens[end].text.as_str() {
            "{" => true,
            // It ends an array type in the signature, or a function without a body.
            ";" => !in_brackets(&tokens[at..end]),
            _ => false,
        });
        let body = body.unwrap();
        if tokens[body].text == "{" {
            let last = tokens[closing(tokens, body)].line;
            functions.push((tokens[at + 1].text.clone(), tokens[at].line, last));
        }
    }
    functions
}

fn in_brackets(tokens: &[Token]) -> bool {
    let count = |text: &str| tokens.iter().filter(|token| token.text == text).count();
    count("[") > count("]") || count("(") > count(")")
}

/// Numbers in conditions that have no name, with their lines.
fn bare_numbers(tokens: &[Token]) -> Vec<(usize, String)> {
    let mut conditions = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let is = |at: usize, text: &str| tokens.get(at).is_some_and(|token| token.text == text);
        match token.text.as_str() {
            _ if compares(token) => {
                conditions.push(left_operand(tokens, at).start..right_operand(tokens, at).end);
            }
            "if" | "while" if token.kind == Kind::Word => {
                conditions.push(at + 1..end_of_condition(tokens, at + 1));
            }
            "assert" | "debug_assert" | "matches" if is(at + 1, "!") => {
                conditions.push(at + 2..end_of_argument(tokens, at + 2));
            }
            "assert_eq" | "assert_ne" | "debug_assert_eq" if is(at + 1, "!") => {
                conditions.push(at + 2..closing(tokens, at + 2));
            }
            _ => {}
        }
    }
    let mut found = BTreeMap::new();
    for condition in conditions {
        let dimension = tokens[condition.clone()].iter().any(|token| token.text == "dim");
        for at in condition {
            let token = &tokens[at];
            if token.kind == Kind::Number && !is_plain(&token.text, dimension) {
                found.insert(at, (token.line, token.text.clone()));
            }
        }
    }
    found.into_values().collect()
}

/// Where the condition of an `if`, a `while` or a guard, also of `matches!`, ends.
fn end_of_condition(tokens: &[Token], begin: usize) -> usize {
    let mut at = begin;
    loop {
        match tokens[at].text.as_str() {
            "(" | "[" => at = closing(tokens, at),
            // The pattern of a structure in `if let`, or the block.
            "{" if is_pattern(tokens, begin, at) => at = closing(tokens, at),
            "{" | "=>" | ")" | "]" | "," => return at,
            _ => {}
        }
        at += 1;
    }
}

/// `true` if the brace at `at` opens the pattern of an `if let`, which an `=` follows.
fn is_pattern(tokens: &[Token], begin: usize, at: usize) -> bool {
    let binds = tokens[begin..at].iter().rev().take_while(|token| token.text != "=");
    let binds = binds.into_iter().any(|token| token.text == "let");
    binds && tokens.get(closing(tokens, at) + 1).is_some_and(|next| next.text != "else")
}

/// Where the first argument of a macro ends, whose bracket is at `open`.
fn end_of_argument(tokens: &[Token], open: usize) -> usize {
    let mut at = open + 1;
    let end = closing(tokens, open);
    while at < end && tokens[at].text != "," {
        if matches!(tokens[at].text.as_str(), "(" | "[" | "{") {
            at = closing(tokens, at);
        }
        at += 1;
    }
    // The second one of `matches!` is a pattern with its guard.
    if tokens[open - 2].text == "matches" { end } else { at }
}

/// `true` if a number needs no name: 0, 1 and 2, and 3 as a dimension.
fn is_plain(number: &str, dimension: bool) -> bool {
    const TYPES: [&str; 10] =
        ["usize", "isize", "u64", "i64", "u32", "i32", "u8", "i8", "f64", "u16"];
    let text = TYPES.iter().find_map(|name| number.strip_suffix(name)).unwrap_or(number);
    let value: Option<f64> = text.trim_end_matches('_').replace('_', "").parse().ok();
    value.is_some_and(|value| [0.0, 1.0, 2.0].contains(&value) || (dimension && value == 3.0))
}

#[test]
fn the_search_finds_numbers() {
    for line in [
        "if x > 1e-9 { a() }",
        "while n < 60 {}",
        "let far = size.abs() > 0.5 * scale;",
        "match x { n if n % 32 == 0 => 1, _ => 0 }",
        "assert!(n < 7);",
        "debug_assert!(f(x, 1e-3));",
        "let some = matches!(n, 5 | 6);",
        "let all = values.iter().all(|&v| v >= -1e-12);",
        "if let Some(x) = find(17) { a() }",
        "if n == 3 {}",
        "if is_near(x, 4) && y {}",
        "let first = (0..n).find(|i| i % 8 != 0);",
        "} else if n >= 1_000 {",
    ] {
        let line = format!("{line} {{ }}");
        assert!(!bare_numbers(&tokens(&line)).is_empty(), "not found: {line}");
    }
}

#[test]
fn the_search_leaves_names_and_plain_numbers_alone() {
    for line in [
        "if x > LEAST { let y = 17; }",
        "const MOST: usize = 60;",
        "if n % 2 == 1 && x > 0.0 && y != -1.0 { a(4) }",
        "if dim == 3 {}",
        "let v: Vec<[f64; 3]> = vec![[0.0; 3]; 5];",
        "let half = 0.5 * x;",
        "if pair.0 > pair.1 {}",
        "for i in 0..16 {}",
        "let n = if small { 8 } else { 16 };",
        "while let Some(x) = next() { y += 5; }",
        "match n { 5 => 1, _ => 0 }",
        "if let Run { z, .. } = run { let a = 7; }",
        "assert!(ok, \"{} of {}\", 5, 6);",
    ] {
        assert_eq!(bare_numbers(&tokens(line)), [], "found in: {line}");
    }
}
