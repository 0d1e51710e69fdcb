//! The library's sources as the tests of its rules read them: tokens without comments, in modules.

use std::fs;
use std::path::{Path, PathBuf};

/// A word, number, literal or mark of the language, without comments.
#[derive(Clone, Debug, PartialEq)]
pub struct Token {
    pub text: String,
    pub kind: Kind,
    /// Counted from 1.
    pub line: usize,
    /// `true` if white space stands before and after it: `a < b` compares, `Vec<f64>` does not.
    pub spaced: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A name, a keyword, or the number of a tuple's field.
    Word,
    Number,
    /// A string or a character.
    Literal,
    Mark,
}

/// A file of the library.
pub struct Source {
    /// Below `src`, with `/` between folders.
    pub path: String,
    /// Its module: empty of `lib.rs`.
    pub module: Vec<String>,
    pub lines: Vec<String>,
    /// All but those of unit tests.
    pub tokens: Vec<Token>,
}

/// Marks of more than one character, longer ones first.
const MARKS: [&str; 19] = [
    "..=", "...", "::", "->", "=>", "==", "!=", "<=", ">=", "&&", "||", "..", "+=", "-=", "*=",
    "/=", "%=", "^=", "|=",
];

/// Unit tests that fill a file of their own, beside the module that they test.
const UNIT_TESTS: &str = "tests.rs";

/// All files below `src`, but the build script.
pub fn sources() -> Vec<Source> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut folders, mut files) = (vec![root.clone()], Vec::new());
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
    files.retain(|path| *path != root.join("build.rs"));
    files.sort();
    assert!(files.len() > 10, "the sources have moved");
    files.iter().map(|path| source(&root, path)).collect()
}

fn source(root: &Path, file: &PathBuf) -> Source {
    let text = fs::read_to_string(file).unwrap();
    let parts = file.strip_prefix(root).unwrap().iter();
    let parts: Vec<&str> = parts.map(|part| part.to_str().unwrap()).collect();
    let mut module: Vec<String> =
        parts.iter().map(|part| part.trim_end_matches(".rs").to_owned()).collect();
    if matches!(module.last().map(String::as_str), Some("mod" | "lib")) {
        module.pop();
    }
    let lines = text.lines().map(str::to_owned).collect();
    let tokens = match file.ends_with(UNIT_TESTS) {
        true => Vec::new(),
        false => without_tests(tokens(&text)),
    };
    Source { path: parts.join("/"), module, lines, tokens }
}

impl Source {
    /// The first folder or file below `src`.
    pub fn room(&self) -> &str {
        self.module.first().map_or("lib", String::as_str)
    }
}

/// The tokens of a text.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut lexer = Lexer { text, at: 0, line: 1, tokens: Vec::new() };
    while lexer.at < text.len() {
        lexer.step();
    }
    lexer.tokens
}

struct Lexer<'t> {
    text: &'t str,
    at: usize,
    line: usize,
    tokens: Vec<Token>,
}

impl Lexer<'_> {
    fn step(&mut self) {
        let rest = &self.text[self.at..];
        let first = rest.chars().next().unwrap();
        if first.is_whitespace() {
            self.skip(first.len_utf8());
        } else if rest.starts_with("//") {
            self.skip(rest.find('\n').unwrap_or(rest.len()));
        } else if rest.starts_with("/*") {
            self.skip(comment_length(rest));
        } else if let Some(length) = text_length(rest) {
            self.take(length, Kind::Literal);
        } else if first == '\'' {
            let length = 1 + word_length(&rest[1..]);
            self.take(length, Kind::Mark);
        } else if first.is_alphabetic() || first == '_' {
            self.take(word_length(rest), Kind::Word);
        } else if first.is_ascii_digit() {
            let field = self.tokens.last().is_some_and(|last| last.text == ".");
            let kind = if field { Kind::Word } else { Kind::Number };
            let length = if field { word_length(rest) } else { number_length(rest) };
            self.take(length, kind);
        } else {
            let mark = MARKS.iter().find(|mark| rest.starts_with(**mark));
            self.take(mark.map_or(first.len_utf8(), |mark| mark.len()), Kind::Mark);
        }
    }

    fn skip(&mut self, length: usize) {
        self.line += self.text[self.at..self.at + length].matches('\n').count();
        self.at += length;
    }

    fn take(&mut self, length: usize, kind: Kind) {
        let end = self.at + length;
        let space = |c: Option<char>| c.is_none_or(char::is_whitespace);
        let spaced = space(self.text[..self.at].chars().next_back())
            && space(self.text[end..].chars().next());
        let text = self.text[self.at..end].to_owned();
        self.tokens.push(Token { text, kind, line: self.line, spaced });
        self.skip(length);
    }
}

fn word_length(text: &str) -> usize {
    text.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(text.len())
}

fn number_length(text: &str) -> usize {
    let mut length = word_length(text);
    let rest = &text[length..];
    let fraction = rest.strip_prefix('.').is_some_and(|after| {
        !after.starts_with(|c: char| c == '.' || c == '_' || c.is_alphabetic())
    });
    if fraction {
        length += 1 + word_length(&rest[1..]);
    }
    let hexadecimal = text.starts_with("0x");
    if !hexadecimal
        && text[..length].ends_with(['e', 'E'])
        && text[length..].starts_with(['-', '+'])
    {
        length += 1 + word_length(&text[length + 1..]);
    }
    length
}

fn comment_length(text: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    loop {
        if text[at..].starts_with("/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if text[at..].starts_with("*/") {
            (depth, at) = (depth - 1, at + 2);
        } else {
            at += text[at..].chars().next().expect("the comment ends").len_utf8();
        }
        if depth == 0 {
            return at;
        }
    }
}

/// Length of the string or character with which the text begins.
fn text_length(text: &str) -> Option<usize> {
    let prefix = ["br", "cr", "b", "c", "r"].into_iter().find(|p| {
        text.strip_prefix(p).is_some_and(|rest| {
            rest.starts_with('"')
                || rest.starts_with('\'') && *p == "b"
                || p.ends_with('r') && rest.trim_start_matches('#').starts_with('"')
        })
    });
    let prefix = prefix.unwrap_or("");
    let rest = &text[prefix.len()..];
    if prefix.ends_with('r') {
        let hashes = rest.len() - rest.trim_start_matches('#').len();
        let end = format!("\"{}", "#".repeat(hashes));
        let body = hashes + 1;
        return Some(prefix.len() + body + rest[body..].find(&end).unwrap() + end.len());
    }
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let mut inner = rest[1..].char_indices();
    if quote == '\'' && !rest[1..].starts_with('\\') {
        let (_, first) = inner.next()?;
        let end = 1 + first.len_utf8();
        return rest[end..].starts_with('\'').then_some(prefix.len() + end + 1);
    }
    while let Some((at, c)) = inner.next() {
        if c == '\\' {
            inner.next();
        } else if c == quote {
            return Some(prefix.len() + at + 2);
        }
    }
    None
}

fn without_tests(tokens: Vec<Token>) -> Vec<Token> {
    const BEGIN: [&str; 8] = ["#", "[", "cfg", "(", "test", ")", "]", "mod"];
    let mut kept = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let begins = tokens.len() > at + BEGIN.len()
            && tokens[at..].iter().zip(BEGIN).all(|(token, text)| token.text == text);
        if begins {
            at = closing(&tokens, at + BEGIN.len() + 1) + 1;
        } else {
            kept.push(tokens[at].clone());
            at += 1;
        }
    }
    kept
}

/// The mark that closes the bracket at `open`.
pub fn closing(tokens: &[Token], open: usize) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate().skip(open) {
        match token.text.as_str() {
            "(" | "[" | "{" if token.kind == Kind::Mark => depth += 1,
            ")" | "]" | "}" if token.kind == Kind::Mark => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return at;
        }
    }
    panic!("a bracket is not closed")
}

/// Operators that compare.
pub const COMPARISONS: [&str; 6] = ["<", ">", "<=", ">=", "==", "!="];

/// `true` if the token compares two values.
pub fn compares(token: &Token) -> bool {
    token.kind == Kind::Mark && token.spaced && COMPARISONS.contains(&token.text.as_str())
}

/// Marks and words at which an operand of a comparison ends.
const ENDS: [&str; 19] = [
    ",", ";", "&&", "||", "=", "=>", "|", "{", "}", "if", "while", "match", "return", "let", "in",
    "else", "..", "..=", "->",
];

/// The range of the operand left of the operator at `at`.
pub fn left_operand(tokens: &[Token], at: usize) -> std::ops::Range<usize> {
    let mut begin = at;
    let mut depth = 0;
    while begin > 0 {
        let token = &tokens[begin - 1];
        match token.text.as_str() {
            ")" | "]" => depth += 1,
            "(" | "[" if depth == 0 => break,
            "(" | "[" => depth -= 1,
            text if depth == 0 && (ENDS.contains(&text) || compares(token)) => break,
            _ => {}
        }
        begin -= 1;
    }
    begin..at
}

/// The range of the operand right of the operator at `at`.
pub fn right_operand(tokens: &[Token], at: usize) -> std::ops::Range<usize> {
    let mut end = at + 1;
    let mut depth = 0;
    while end < tokens.len() {
        let token = &tokens[end];
        match token.text.as_str() {
            "(" | "[" => depth += 1,
            ")" | "]" if depth == 0 => break,
            ")" | "]" => depth -= 1,
            text if depth == 0 && (ENDS.contains(&text) || compares(token)) => break,
            _ => {}
        }
        end += 1;
    }
    at + 1..end
}
