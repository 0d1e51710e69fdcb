//! Reading a problem file.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::ops::RangeInclusive;
use std::path::Path;

use super::errors::{failed, refuse};
use super::format::{BANNER, OLD_VERSION, TITLE, VERSION};
use super::lines::{Lines, shown};
use super::{Kind, Law, ProblemFile};
use crate::error::{Error, index};
use crate::problem;

/// Reads a problem file.
///
/// # Errors
/// [`Error::File`] if it is no file, cannot be read or is not a complete problem file; the message names
/// the line and what is wrong there. [`Error::OutOfMemory`].
pub fn read(path: &Path) -> Result<ProblemFile, Error> {
    let fail = |error| failed(path, "read", &error);
    // Before it is opened: to open a pipe waits for its writer.
    let about = fs::metadata(path).map_err(fail)?;
    if !about.is_file() {
        let what = if about.is_dir() { "a directory" } else { "a pipe or a device, not a file" };
        return Err(refuse(path, None, &format!("cannot be read: it is {what}")));
    }
    let file = File::open(path).map_err(fail)?;
    // An entry takes two bytes at least: never allocate more than the size of the file allows.
    let most = usize::try_from(about.len() / 2).unwrap_or(usize::MAX);
    let mut lines = Lines::new(path, file);
    let (mut problem, has_covering) = read_header(&mut lines)?;
    read_columns(&mut problem, has_covering, &mut lines, most)?;
    Ok(problem)
}

/// Most bytes that [`read`] takes; 0 of what is no file.
pub fn memory(path: &Path) -> u64 {
    // An entry has two bytes or more in the file and eight in memory; the rest is for a small file.
    fs::metadata(path).map_or(0, |about| {
        about.len().saturating_mul(size_of::<f64>() as u64).saturating_add(262_144)
    })
}

/// The keys of the comments `% key: value` that tell the problem.
const KEYS: [&str; 5] = ["kind", "law", "dim", "pairs", "remark"];

/// The laws that version 1 of the format has.
const OLD_LAWS: [Law; 2] = [Law::Coulomb, Law::Tresca];

/// The comments above the size line.
#[derive(Default)]
struct Comments {
    version: &'static str,
    /// Line and value of each key.
    found: BTreeMap<&'static str, (u64, String)>,
}

impl Comments {
    /// Reads all lines to that of the sizes, on which it stops.
    fn read(lines: &mut Lines<'_>) -> Result<Self, Error> {
        let mut comments = Comments::default();
        loop {
            lines.require(|| "the line of the sizes".into())?;
            let text = lines.text();
            let Some(comment) = text.strip_prefix('%').map(str::trim_ascii) else { break };
            if let Some(found) = comment.strip_prefix(TITLE).map(str::trim_ascii) {
                let known = [OLD_VERSION, VERSION].into_iter().find(|known| *known == found);
                let Some(known) = known else {
                    let found = shown(found);
                    return lines.refuse(format!(
                        "version {found} of the format: {OLD_VERSION} and {VERSION} are known"
                    ));
                };
                comments.version = known;
            } else if let Some((key, value)) = comment.split_once(':')
                && let Some(key) = KEYS.into_iter().find(|known| *known == key)
            {
                let value = (lines.number, value.trim_ascii().to_owned());
                if comments.found.insert(key, value).is_some() {
                    return lines.refuse(format!("a second '{key}:'"));
                }
            }
        }
        if comments.version.is_empty() {
            let what = format!("some other matrix: no line '% {TITLE} {VERSION}' stands above");
            return lines.refuse(what);
        }
        Ok(comments)
    }

    /// Line and value of a key that must be there.
    fn get(&self, lines: &Lines<'_>, key: &str) -> Result<(u64, &str), Error> {
        match self.found.get(key) {
            Some((at, value)) => Ok((*at, value)),
            None => lines.refuse(format!("no line '% {key}:' stands above")),
        }
    }

    fn size(&self, lines: &Lines<'_>, key: &str) -> Result<usize, Error> {
        let (at, value) = self.get(lines, key)?;
        let wrong = |_| lines.refuse_at(at, format!("{key} is {}, not a size", shown(value)));
        value.parse().or_else(wrong)
    }

    /// The kind and, of contact, the law: in version 1 of the format the kind is the law.
    fn kind(&self, lines: &Lines<'_>) -> Result<Kind, Error> {
        let of_law = |law: Option<Law>, what: &str, (at, name): (u64, &str)| match law {
            Some(law) => Ok(Kind::Contact(law)),
            None => lines.refuse_at(at, format!("no {what} is {}", shown(name))),
        };
        let find = |name: &str| Law::ALL.into_iter().find(|law| law.name() == name);
        let kind = self.get(lines, "kind")?;
        match kind.1 {
            "lcp" => Ok(Kind::Lcp),
            name if self.version == OLD_VERSION => {
                let law = find(name).filter(|law| OLD_LAWS.contains(law));
                of_law(law, "kind of problem", kind)
            }
            "contact" => {
                let law = self.get(lines, "law")?;
                of_law(find(law.1), "friction law", law)
            }
            _ => of_law(None, "kind of problem", kind),
        }
    }
}

/// Columns of an LCP besides the matrix: `q` and, if given, the covering vector.
const LCP_COLUMNS: RangeInclusive<usize> = 1..=2;

/// The problem of the comment lines and the size line, still without its arrays; and whether a covering vector
/// follows.
fn read_header(lines: &mut Lines<'_>) -> Result<(ProblemFile, bool), Error> {
    lines.require(|| "the line of the format".into())?;
    let words = |text: &str| -> Vec<String> {
        text.split_ascii_whitespace().map(str::to_ascii_lowercase).collect()
    };
    if words(&lines.text()) != words(BANNER) {
        return lines.refuse(format!("not a problem file, which begins with '{BANNER}'"));
    }
    let comments = Comments::read(lines)?;
    let kind = comments.kind(lines)?;
    let (dim, pairs) = match kind {
        Kind::Lcp => (0, 0),
        Kind::Contact(_) => {
            let dim = comments.size(lines, "dim")?;
            problem::checked_dim(dim).or_else(|error| lines.refuse(format!("above, {error}")))?;
            (dim, comments.size(lines, "pairs")?)
        }
    };
    let (size, columns) = sizes(lines)?;
    let more = columns.checked_sub(size);
    match kind {
        Kind::Lcp if !more.is_some_and(|more| LCP_COLUMNS.contains(&more)) => {
            return lines
                .refuse(format!("{size} rows ask for 1 or 2 columns more, not for {columns}"));
        }
        Kind::Contact(law) => {
            // Loads, gaps and reference slips, and the parameters of the law.
            let wanted = 3 + law.parameters().len();
            if dim.checked_mul(pairs) != Some(size) || more != Some(wanted) {
                return lines.refuse(format!(
                    "{size} rows and {columns} columns: with dim {dim}, {pairs} pairs and the law \
                     '{}' there must be dim * pairs rows and {wanted} columns more",
                    law.name()
                ));
            }
        }
        Kind::Lcp => {}
    }
    let has_covering = kind == Kind::Lcp && more == Some(*LCP_COLUMNS.end());
    if problem::unknowns(1, size).is_err() {
        return lines.refuse(format!("{size} rows: the matrix cannot exist"));
    }
    // It may be shown on a terminal, which control characters command.
    let remark = comments.found.get("remark").map(|(_, remark)| remark.as_str());
    let remark = remark.unwrap_or_default().replace(char::is_control, " ");
    let problem = ProblemFile { kind, dim, pairs, size, remark, ..ProblemFile::default() };
    Ok((problem, has_covering))
}

/// Reads the columns; nothing may follow them.
fn read_columns(
    problem: &mut ProblemFile,
    has_covering: bool,
    lines: &mut Lines<'_>,
    most: usize,
) -> Result<(), Error> {
    let (dim, size) = (problem.dim, problem.size);
    let (matrix_name, load_name) = match problem.kind {
        Kind::Contact(_) => ("K", "f"),
        Kind::Lcp => ("M", "q"),
    };
    problem.matrix = lines.entries(matrix_name, (size, size * size), most)?;
    let mut column = |name| lines.entries(name, (size, size), most);
    problem.load = column(load_name)?;
    match problem.kind {
        Kind::Lcp => problem.covering = has_covering.then(|| column("cover")).transpose()?,
        Kind::Contact(law) => {
            problem.gap = rows(lines, "gap", (size, most), |i| i % dim == 0)?;
            let names = law.names();
            // Columns of the file, of which the pairs are the rows.
            problem.friction = vec![0.0; problem.pairs * names.len()];
            for (k, name) in names.iter().enumerate() {
                let column = rows(lines, name, (size, most), |i| i % dim == 0)?;
                let places = problem.friction.iter_mut().skip(k).step_by(names.len());
                places.zip(column).for_each(|(place, value)| *place = value);
            }
            problem.reference_slip = rows(lines, "slip0", (size, most), |i| i % dim != 0)?;
        }
    }
    while lines.advance()? {
        if !lines.text().is_empty() {
            let what = shown(&lines.text());
            return lines.refuse(format!("the problem ends above, what is {what}"));
        }
    }
    Ok(())
}

/// The entries of a column in the rows that `hold` some; the others are 0.
fn rows(
    lines: &mut Lines<'_>,
    name: &str,
    (size, most): (usize, usize),
    hold: impl Fn(usize) -> bool,
) -> Result<Vec<f64>, Error> {
    let before = lines.number;
    let column = lines.entries(name, (size, size), most)?;
    if let Some(i) = (0..size).find(|&i| !hold(i) && column[i] != 0.0) {
        let (row, value) = (index(i), column[i]);
        let what = format!("{name}, row {row}: {value:e} must be 0, such rows have no {name}");
        return lines.refuse_at(before + 1 + i as u64, what);
    }
    Ok(column.into_iter().enumerate().filter(|(i, _)| hold(*i)).map(|(_, value)| value).collect())
}

/// Rows and columns, of the size line.
fn sizes(lines: &Lines<'_>) -> Result<(usize, usize), Error> {
    let text = lines.text();
    let numbers: Vec<_> = text.split_ascii_whitespace().map(str::parse).collect();
    match numbers[..] {
        [Ok(rows), Ok(columns)] => Ok((rows, columns)),
        _ => lines.refuse(format!("not two sizes, rows and columns: {}", shown(&text))),
    }
}
