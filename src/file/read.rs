//! Reading a problem file.

use std::fs::File;
use std::path::Path;

use super::lines::{Lines, shown};
use super::{BANNER, Kind, ProblemFile, TITLE, VERSION, refuse};
use crate::error::Error;

/// Reads a problem file.
///
/// # Errors
/// [`Error::File`] if it cannot be read or is not a complete problem file; the message names the
/// line and what is wrong there. [`Error::OutOfMemory`].
pub fn read(path: &Path) -> Result<ProblemFile, Error> {
    let fail = |error| refuse(path, None, &format!("cannot be read: {error}"));
    let file = File::open(path).map_err(fail)?;
    let about = file.metadata().map_err(fail)?;
    if about.is_dir() {
        return Err(refuse(path, None, "cannot be read: it is a directory"));
    }
    // An entry takes two bytes at least: what a size line claims is not believed beyond that.
    let most = usize::try_from(about.len() / 2).unwrap_or(usize::MAX);
    let mut lines = Lines::new(path, file);
    let header = Header::read(&mut lines)?;
    header.columns(&mut lines, most)
}

/// What the comment lines and the size line say.
struct Header {
    kind: Kind,
    dim: usize,
    pairs: usize,
    size: usize,
    covering: bool,
    remark: String,
}

/// The value of a comment `% key: value` and its line.
type Comment = Option<(u64, String)>;

/// The comments above the size line.
#[derive(Default)]
struct Comments {
    kind: Comment,
    dim: Comment,
    pairs: Comment,
    remark: Comment,
}

/// Columns of a contact problem besides the matrix: loads, gaps, friction and reference slips.
const CONTACT_COLUMNS: usize = 4;

impl Comments {
    /// Reads all lines to that of the sizes, on which it stops.
    fn read(lines: &mut Lines<'_>) -> Result<Self, Error> {
        let mut comments = Comments::default();
        let mut titled = false;
        loop {
            lines.require(|| "the line of the sizes".into())?;
            let text = lines.text();
            let Some(comment) = text.strip_prefix('%').map(str::trim_ascii) else { break };
            if let Some(version) = comment.strip_prefix(TITLE).map(str::trim_ascii) {
                if version != VERSION {
                    let version = shown(version);
                    let what = format!("version {version} of the format: {VERSION} is known");
                    return Err(lines.refuse(&what));
                }
                titled = true;
            } else if let Some((key, value)) = comment.split_once(':') {
                let place = match key {
                    "kind" => &mut comments.kind,
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
        if !titled {
            let what = format!("some other matrix: no line '% {TITLE} {VERSION}' stands above");
            return Err(lines.refuse(&what));
        }
        Ok(comments)
    }
}

impl Header {
    fn read(lines: &mut Lines<'_>) -> Result<Self, Error> {
        lines.require(|| "the line of the format".into())?;
        let words = |text: &str| -> Vec<String> {
            text.split_ascii_whitespace().map(str::to_ascii_lowercase).collect()
        };
        if words(&lines.text()) != words(BANNER) {
            let what = format!("not a problem file, which begins with '{BANNER}'");
            return Err(lines.refuse(&what));
        }
        let Comments { kind, dim, pairs, remark } = Comments::read(lines)?;
        let Some((at, name)) = kind else {
            return Err(lines.refuse("no line '% kind:' stands above"));
        };
        let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.name() == name) else {
            return Err(lines.refuse_at(at, &format!("no kind of problem is {}", shown(&name))));
        };
        // It may be shown on a terminal, which control characters command.
        let remark = remark.map_or_else(String::new, |(_, remark)| remark);
        let remark = remark.replace(char::is_control, " ");
        let mut header = match kind {
            Kind::Lcp => Self::lcp(lines)?,
            Kind::Coulomb | Kind::Tresca => Self::contact(lines, kind, &dim, &pairs)?,
        };
        header.remark = remark;
        Ok(header)
    }

    /// Of a bare complementarity problem, at its size line.
    fn lcp(lines: &Lines<'_>) -> Result<Self, Error> {
        let (size, columns) = sizes(lines)?;
        let covering = columns.checked_sub(2) == Some(size);
        if !covering && columns.checked_sub(1) != Some(size) {
            let what = format!("{size} rows ask for 1 or 2 columns more, not for {columns}");
            return Err(lines.refuse(&what));
        }
        check_memory(lines, size)?;
        let remark = String::new();
        Ok(Header { kind: Kind::Lcp, dim: 0, pairs: 0, size, covering, remark })
    }

    /// Of a contact problem, at its size line.
    fn contact(
        lines: &Lines<'_>,
        kind: Kind,
        dim: &Comment,
        pairs: &Comment,
    ) -> Result<Self, Error> {
        let dim = number(lines, "dim", dim)?;
        if dim != 2 && dim != 3 {
            return Err(lines.refuse(&format!("dim above is {dim}, it must be 2 or 3")));
        }
        let pairs = number(lines, "pairs", pairs)?;
        let (size, columns) = sizes(lines)?;
        if dim.checked_mul(pairs) != Some(size)
            || columns.checked_sub(CONTACT_COLUMNS) != Some(size)
        {
            let what = format!(
                "{size} rows and {columns} columns: with dim {dim} and {pairs} pairs there must \
                 be dim * pairs rows and {CONTACT_COLUMNS} columns more"
            );
            return Err(lines.refuse(&what));
        }
        check_memory(lines, size)?;
        Ok(Header { kind, dim, pairs, size, covering: false, remark: String::new() })
    }

    /// Reads the columns and what follows them: nothing.
    fn columns(self, lines: &mut Lines<'_>, most: usize) -> Result<ProblemFile, Error> {
        let Header { kind, dim, pairs, size, covering, remark } = self;
        let names = match kind {
            Kind::Coulomb => ["K", "f", "mu"],
            Kind::Tresca => ["K", "f", "g"],
            Kind::Lcp => ["M", "q", ""],
        };
        let matrix = lines.entries(names[0], (size, size * size), most)?;
        let mut column = |name| lines.entries(name, (size, size), most);
        let mut problem = ProblemFile {
            kind,
            dim,
            pairs,
            size,
            matrix,
            load: column(names[1])?,
            gap: Vec::new(),
            friction: Vec::new(),
            slip: Vec::new(),
            covering: None,
            remark,
        };
        if kind == Kind::Lcp {
            problem.covering = covering.then(|| column("cover")).transpose()?;
        } else {
            problem.gap = rows(lines, "gap", (size, most), |i| i % dim == 0)?;
            problem.friction = rows(lines, names[2], (size, most), |i| i % dim == 0)?;
            problem.slip = rows(lines, "slip", (size, most), |i| i % dim != 0)?;
        }
        while lines.advance()? {
            if !lines.text().is_empty() {
                let what = format!("the problem ends above, what is {}", shown(&lines.text()));
                return Err(lines.refuse(&what));
            }
        }
        Ok(problem)
    }
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
        let what = format!("{name}, row {i}: {:e} must be 0, such rows have no {name}", column[i]);
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
