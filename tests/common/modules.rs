//! Which file of the library imports from which, by the paths that it names.

use std::collections::{BTreeMap, BTreeSet};
use std::iter;

use super::sources::{Kind, Source, Token, closing};

/// A path that a file names.
pub struct Named {
    /// Its segments; of an item of a group those of the group first.
    pub path: Vec<String>,
    /// The file's own name for it.
    pub name: String,
    /// The module from which it is named, which an inline module makes another than the file's.
    pub from: Vec<String>,
    pub kind: Way,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Way {
    /// `use`
    Import,
    /// `pub use`, of any visibility.
    Reexport,
    /// In an expression or a type.
    InPlace,
}

/// The modules of the library, each with its file.
pub struct Modules {
    files: BTreeMap<Vec<String>, usize>,
    named: Vec<Vec<Named>>,
    /// Words of each file outside of `use` and `mod`, as they stand alone.
    words: Vec<BTreeSet<String>>,
}

/// An import: whose item, and the path as it is written, from the root.
pub struct Import {
    /// The place of the file that defines the item.
    pub target: usize,
    /// The module that the path names, before any re-export is followed.
    pub written: Vec<String>,
    pub path: String,
}

impl Modules {
    pub fn new(sources: &[Source]) -> Self {
        let files = sources.iter().enumerate().map(|(at, file)| (file.module.clone(), at));
        Modules {
            files: files.collect(),
            named: sources.iter().map(named).collect(),
            words: sources.iter().map(words).collect(),
        }
    }

    /// The imports of a file from others.
    pub fn imports(&self, file: usize) -> Vec<Import> {
        let mut imports = Vec::new();
        for named in &self.named[file] {
            // A name that is only passed on is no import.
            if named.kind == Way::Reexport && !self.words[file].contains(&named.name) {
                continue;
            }
            let Some((written, Some(item))) = self.walk(&named.from, file, &named.path) else {
                continue;
            };
            let target = self.defining(&written, &item);
            if target != file {
                imports.push(Import { target, written, path: named.path.join("::") });
            }
        }
        imports
    }

    /// The module of a path and the item in it; `None` if it leads out of the library.
    fn walk(
        &self,
        from: &[String],
        file: usize,
        path: &[String],
    ) -> Option<(Vec<String>, Option<String>)> {
        let mut module = from.to_vec();
        let mut rest = path;
        match path[0].as_str() {
            "crate" => (module, rest) = (Vec::new(), &path[1..]),
            "self" => rest = &path[1..],
            "super" => {
                while rest.first().is_some_and(|segment| segment == "super") {
                    module.pop();
                    rest = &rest[1..];
                }
            }
            first => {
                if !self.files.contains_key(&join(&module, first)) {
                    // A module that the file has imported under this name.
                    let import = self.named[file].iter().find(|named| {
                        named.kind != Way::InPlace && named.name == first && named.path != path
                    })?;
                    let (found, item) = self.walk(&import.from, file, &import.path)?;
                    if item.is_some() {
                        return None;
                    }
                    (module, rest) = (found, &path[1..]);
                }
            }
        }
        while let Some(next) = rest.first() {
            let inner = join(&module, next);
            // A function may be passed on under the name of its module.
            let passed = rest.len() == 1
                && self.files.get(&module).is_some_and(|&file| self.passes_on(file, next));
            if passed || !self.files.contains_key(&inner) {
                break;
            }
            (module, rest) = (inner, &rest[1..]);
        }
        // An inline module belongs to the file around it.
        while !self.files.contains_key(&module) {
            module.pop();
        }
        Some((module, rest.first().cloned()))
    }

    fn passes_on(&self, file: usize, item: &str) -> bool {
        let mut named = self.named[file].iter();
        named.any(|named| named.kind == Way::Reexport && named.name == item)
    }

    /// The file that defines an item which `module` has or passes on.
    fn defining(&self, module: &[String], item: &str) -> usize {
        let file = self.files[module];
        let passed =
            self.named[file].iter().find(|named| named.kind != Way::InPlace && named.name == item);
        match passed.and_then(|named| self.walk(&named.from, file, &named.path)) {
            Some((inner, Some(name))) if inner != module => self.defining(&inner, &name),
            _ => file,
        }
    }
}

fn join(module: &[String], next: &str) -> Vec<String> {
    module.iter().cloned().chain(iter::once(next.to_owned())).collect()
}

/// The words of a file outside of `use` and `mod` that no path and no value leads to.
fn words(source: &Source) -> BTreeSet<String> {
    let tokens = &source.tokens;
    let mut words = BTreeSet::new();
    let mut at = 0;
    while at < tokens.len() {
        if is_import(tokens, at) {
            at = (at..).find(|&end| tokens[end].text == ";").unwrap();
        } else if tokens[at].text == "mod" {
            at += 2;
        }
        let led_to = at > 0 && matches!(tokens[at - 1].text.as_str(), "." | "::");
        if tokens[at].kind == Kind::Word && !led_to {
            words.insert(tokens[at].text.clone());
        }
        at += 1;
    }
    words
}

/// `true` if a `use` begins at `at`, and not the bounds of a type (`use<'a>`).
fn is_import(tokens: &[Token], at: usize) -> bool {
    tokens[at].text == "use" && tokens.get(at + 1).is_some_and(|next| next.text != "<")
}

/// All paths of a file.
fn named(source: &Source) -> Vec<Named> {
    let tokens = &source.tokens;
    let mut named = Vec::new();
    // Inline modules that are open, with where they end.
    let mut inline: Vec<(String, usize)> = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        inline.retain(|(_, end)| *end > at);
        let from: Vec<String> = source
            .module
            .iter()
            .cloned()
            .chain(inline.iter().map(|(name, _)| name.clone()))
            .collect();
        let is = |at: usize, text: &str| tokens.get(at).is_some_and(|token| token.text == text);
        if is(at, "macro_rules") && is(at + 3, "{") {
            // Its modules stand where it is used, so that their paths are not those of this file.
            at = closing(tokens, at + 3) + 1;
        } else if is(at, "mod") && is(at + 2, "{") {
            inline.push((tokens[at + 1].text.clone(), closing(tokens, at + 2)));
            at += 3;
        } else if is_import(tokens, at) {
            let end = (at..).find(|&end| is(end, ";")).unwrap();
            let public = at > 0 && (is(at - 1, "pub") || is(at - 1, ")"));
            let kind = if public { Way::Reexport } else { Way::Import };
            for (path, name) in tree(&tokens[at + 1..end], &source.path) {
                named.push(Named { path, name, from: from.clone(), kind });
            }
            at = end + 1;
        } else if tokens[at].kind == Kind::Word && is(at + 1, "::") && !(at > 0 && is(at - 1, "::"))
        {
            let mut path = vec![tokens[at].text.clone()];
            while is(at + 1, "::") && tokens[at + 2].kind == Kind::Word {
                path.push(tokens[at + 2].text.clone());
                at += 2;
            }
            let name = path[path.len() - 1].clone();
            named.push(Named { path, name, from, kind: Way::InPlace });
            at += 1;
        } else {
            at += 1;
        }
    }
    named
}

/// The paths of a `use` with the names that they have here.
fn tree(tokens: &[Token], file: &str) -> Vec<(Vec<String>, String)> {
    let mut path: Vec<String> = Vec::new();
    let mut name = None;
    let mut at = 0;
    while at < tokens.len() {
        match tokens[at].text.as_str() {
            "::" => {}
            "*" => panic!("{file} imports all of {path:?}: name what it needs"),
            "as" => {
                name = Some(tokens[at + 1].text.clone());
                at += 1;
            }
            "{" => {
                let inner = &tokens[at + 1..closing(tokens, at)];
                let items = split(inner).into_iter().flat_map(|item| tree(item, file));
                return items
                    .map(|(rest, name)| {
                        let whole: Vec<String> = path.iter().cloned().chain(rest).collect();
                        match name.as_str() {
                            "self" => (path.clone(), path[path.len() - 1].clone()),
                            _ => (whole, name),
                        }
                    })
                    .collect();
            }
            segment => path.push(segment.to_owned()),
        }
        at += 1;
    }
    let name = name.unwrap_or_else(|| path[path.len() - 1].clone());
    vec![(path, name)]
}

/// The parts between the commas of a group.
fn split(tokens: &[Token]) -> Vec<&[Token]> {
    let mut depth = 0;
    let parts = tokens.split(|token| {
        match token.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        depth == 0 && token.text == ","
    });
    parts.filter(|part| !part.is_empty()).collect()
}

/// Groups of nodes each of which leads to all others of its group.
pub fn cycles(edges: &[BTreeSet<usize>]) -> Vec<Vec<usize>> {
    let reach: Vec<BTreeSet<usize>> = (0..edges.len())
        .map(|start| {
            let (mut reached, mut next) = (BTreeSet::new(), vec![start]);
            while let Some(node) = next.pop() {
                next.extend(edges[node].iter().filter(|&&to| reached.insert(to)));
            }
            reached
        })
        .collect();
    let group = |a: usize| -> Vec<usize> {
        (0..edges.len()).filter(|&b| reach[a].contains(&b) && reach[b].contains(&a)).collect()
    };
    let groups = (0..edges.len()).map(group).filter(|group| !group.is_empty());
    groups.collect::<BTreeSet<_>>().into_iter().collect()
}
