//! Reading a problem file.

use std::fs::{self, File};
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
    // An entry has two bytes or more in the file and eight in memory.
    const LEAST: u64 = 262_144;
    const EACH: u64 = 8;
    fs::metadata(path).map_or(0, |about| about.len().saturating_mul(EACH).saturating_add(LEAST))
}

/// The value of a comment `% key: value` and its line.
type Comment = Option<(u64, String)>;

/// The comments above the size line.
#[derive(Default)]
struct Comments {
    version: &'static str,
    kind: Comment,
    law: Comment,
    dim: Comment,
    pairs: Comment,
    remark: Comment,
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
                    let known = format!("{OLD_VERSION} and {VERSION} are known");
                    return Err(lines.refuse(&format!("version {found} of the format: {known}")));
                };
                comments.version = known;
            } else if let Some((key, value)) = comment.split_once(':') {
                let place = match key {
                    "kind" => &mut comments.kind,
                    "law" => &mut comments.law,
                    "dim" => &mut comments.dim,
                    "pairs" => &mut comments.pairs,
                    "remark" => &mut comments.remark,
                    _ => continue,
                };
                if place.replace((lines.number(), value.trim_ascii().to_owned())).is_some() {
                    return Err(lines.refuse(&format!("a second '{key}:'")));
                }
            }
        }
        if comments.version.is_empty() {
            let what = format!("some other matrix: no line '% {TITLE} {VERSION}' stands above");
            return Err(lines.refuse(&what));
        }
        Ok(comments)
    }
}

/// Columns of a contact problem besides the matrix and the parameters of its law: loads, gaps and
/// reference slips.
const CONTACT_COLUMNS: usize = 3;

/// The problem of the comment lines and the size line, still without its arrays; and whether a covering vector
/// follows.
fn read_header(lines: &mut Lines<'_>) -> Result<(ProblemFile, bool), Error> {
    lines.require(|| "the line of the format".into())?;
    let words = |text: &str| -> Vec<String> {
        text.split_ascii_whitespace().map(str::to_ascii_lowercase).collect()
    };
    if words(&lines.text()) != words(BANNER) {
        let what = format!("not a problem file, which begins with '{BANNER}'");
        return Err(lines.refuse(&what));
    }
    let comments = Comments::read(lines)?;
    let kind = read_kind(lines, comments.version, &comments.kind, &comments.law)?;
    let mut problem = ProblemFile { kind, ..ProblemFile::default() };
    let has_covering = match kind {
        Kind::Lcp => read_lcp_size(&mut problem, lines)?,
        Kind::Contact(law) => read_contact_size(&mut problem, lines, law, &comments)?,
    };
    check_memory(lines, problem.size)?;
    // It may be shown on a terminal, which control characters command.
    let remark = comments.remark.map_or_else(String::new, |(_, remark)| remark);
    problem.remark = remark.replace(char::is_control, " ");
    Ok((problem, has_covering))
}

/// Takes the size of an LCP; `true` if it has a covering vector.
fn read_lcp_size(problem: &mut ProblemFile, lines: &Lines<'_>) -> Result<bool, Error> {
    let (size, columns) = sizes(lines)?;
    problem.size = size;
    match columns.checked_sub(size) {
        Some(more @ (1 | 2)) => Ok(more == 2),
        _ => {
            let what = format!("{size} rows ask for 1 or 2 columns more, not for {columns}");
            Err(lines.refuse(&what))
        }
    }
}

/// Takes the size of a contact problem, which has no covering vector.
fn read_contact_size(
    problem: &mut ProblemFile,
    lines: &Lines<'_>,
    law: Law,
    comments: &Comments,
) -> Result<bool, Error> {
    let dim = number(lines, "dim", &comments.dim)?;
    problem::checked_dim(dim).map_err(|error| lines.refuse(&format!("above, {error}")))?;
    let pairs = number(lines, "pairs", &comments.pairs)?;
    let (size, columns) = sizes(lines)?;
    let more = CONTACT_COLUMNS + law.parameters().len();
    if dim.checked_mul(pairs) != Some(size) || columns.checked_sub(more) != Some(size) {
        let what = format!(
            "{size} rows and {columns} columns: with dim {dim}, {pairs} pairs and the law \
             '{}' there must be dim * pairs rows and {more} columns more",
            law.name()
        );
        return Err(lines.refuse(&what));
    }
    (problem.dim, problem.pairs, problem.size) = (dim, pairs, size);
    Ok(false)
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
            let what = format!("the problem ends above, what is {}", shown(&lines.text()));
            return Err(lines.refuse(&what));
        }
    }
    Ok(())
}

/// The laws that version 1 of the format has.
const OLD_LAWS: [Law; 2] = [Law::Coulomb, Law::Tresca];

/// The kind and, of contact, the law: in version 1 of the format the kind is the law.
fn read_kind(
    lines: &Lines<'_>,
    version: &str,
    kind: &Comment,
    law: &Comment,
) -> Result<Kind, Error> {
    let Some((at, name)) = kind else {
        return Err(lines.refuse("no line '% kind:' stands above"));
    };
    if name == "lcp" {
        return Ok(Kind::Lcp);
    }
    let find = |name: &str| Law::ALL.into_iter().find(|law| law.name() == name);
    if version == OLD_VERSION {
        let law = find(name).filter(|law| OLD_LAWS.contains(law));
        let unknown = || lines.refuse_at(*at, &format!("no kind of problem is {}", shown(name)));
        return law.map(Kind::Contact).ok_or_else(unknown);
    }
    if name != "contact" {
        return Err(lines.refuse_at(*at, &format!("no kind of problem is {}", shown(name))));
    }
    let Some((at, name)) = law else {
        return Err(lines.refuse("no line '% law:' stands above"));
    };
    find(name)
        .map(Kind::Contact)
        .ok_or_else(|| lines.refuse_at(*at, &format!("no friction law is {}", shown(name))))
}

/// The entries of a column in the rows that `hold` some; the others are 0.
fn rows(
    lines: &mut Lines<'_>,
    name: &str,
    (size, most): (usize, usize),
    hold: impl Fn(usize) -> bool,
) -> Result<Vec<f64>, Error> {
    let before = lines.number();
    let column = lines.entries(name, (size, size), most)?;
    if let Some(i) = (0..size).find(|&i| !hold(i) && column[i] != 0.0) {
        let (row, value) = (index(i), column[i]);
        let what = format!("{name}, row {row}: {value:e} must be 0, such rows have no {name}");
        return Err(lines.refuse_at(before + 1 + i as u64, &what));
    }
    Ok(column.into_iter().enumerate().filter(|(i, _)| hold(*i)).map(|(_, value)| value).collect())
}

/// Rows and columns, of the size line.
fn sizes(lines: &Lines<'_>) -> Result<(usize, usize), Error> {
    let text = lines.text();
    let numbers: Vec<_> = text.split_ascii_whitespace().map(str::parse).collect();
    match numbers[..] {
        [Ok(rows), Ok(columns)] => Ok((rows, columns)),
        _ => Err(lines.refuse(&format!("not two sizes, rows and columns: {}", shown(&text)))),
    }
}

/// The number of a comment, which must be there.
fn number(lines: &Lines<'_>, key: &str, comment: &Comment) -> Result<usize, Error> {
    let Some((at, value)) = comment else {
        return Err(lines.refuse(&format!("no line '% {key}:' stands above")));
    };
    value
        .parse()
        .map_err(|_| lines.refuse_at(*at, &format!("{key} is {}, not a size", shown(value))))
}

fn check_memory(lines: &Lines<'_>, size: usize) -> Result<(), Error> {
    match size.checked_mul(size) {
        Some(entries) if entries <= isize::MAX as usize / size_of::<f64>() => Ok(()),
        _ => Err(lines.refuse(&format!("{size} rows: the matrix cannot exist"))),
    }
}
