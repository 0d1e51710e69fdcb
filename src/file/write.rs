//! Writing a problem file: all of it, or none.

use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::errors::{failed, refuse};
use super::format::{BANNER, MOST_REMARK, TITLE, VERSION};
use crate::error::{Argument, Error};
use crate::problem::{ContactProblem, Lcp, check_finite_matrix};

/// Writes a contact problem to the file `path`, which is replaced if it exists. The remark is one
/// line.
///
/// # Errors
/// [`Error::Invalid`] for an entry of the matrix that is not finite, or the remark;
/// [`Error::File`] if the file cannot be written: then there is no new one, and an old one is as it
/// was.
pub fn write(path: &Path, problem: &ContactProblem<'_>, remark: Option<&str>) -> Result<(), Error> {
    let (dim, n, pairs, law) = (problem.dim(), problem.unknowns(), problem.pairs(), problem.law());
    check_finite_matrix(("K", Argument::Matrix), &problem.stiffness())?;
    // A value of each pair in its normal row.
    let in_normal_rows = |value: &dyn Fn(usize) -> f64| -> Vec<f64> {
        (0..n).map(|i| if i % dim == 0 { value(i / dim) } else { 0.0 }).collect()
    };
    let slip0 = |i| match i % dim {
        0 => 0.0,
        axis => problem.reference_slip(i / dim, axis - 1),
    };
    let mut columns = vec![problem.load().to_vec(), in_normal_rows(&|pair| problem.gap(pair))];
    columns.extend((0..law.parameters()).map(|k| in_normal_rows(&|pair| law.numbers(pair)[k])));
    columns.push((0..n).map(slip0).collect());
    let law = law.law();
    let kind = format!("contact\n% law: {}\n% dim: {dim}\n% pairs: {pairs}", law.name());
    let names = listed(&[&["gap"], &law.names()[..]].concat());
    let names = format!("K ({n}), f, {names} in normal rows, slip0 in tangential rows");
    save(path, (&kind, remark, &names), n, |j| problem.column(j), &columns)
}

/// Writes an LCP.
///
/// # Errors
/// As [`write()`].
pub fn write_lcp(path: &Path, lcp: &Lcp<'_>, remark: Option<&str>) -> Result<(), Error> {
    let (n, covering) = (lcp.size(), lcp.covering);
    let columns: Vec<_> = [lcp.q()].into_iter().chain(covering).map(<[f64]>::to_vec).collect();
    let names = format!("M ({n}), q{}", if covering.is_some() { ", cover" } else { "" });
    save(path, ("lcp", remark, &names), n, |j| lcp.column(j), &columns)
}

/// Writes a problem: the comment lines, with the kind and what belongs to it, and the names of the columns; the sizes;
/// the `n` columns of a matrix and further ones, an entry a line, in the fewest digits that give back the same bits.
fn save<'m>(
    path: &Path,
    (kind, remark, names): (&str, Option<&str>, &str),
    n: usize,
    matrix: impl Fn(usize) -> &'m [f64],
    columns: &[Vec<f64>],
) -> Result<(), Error> {
    check_remark(remark)?;
    replace(path, |file| {
        writeln!(file, "{BANNER}\n% {TITLE} {VERSION}\n% kind: {kind}")?;
        if let Some(remark) = remark.filter(|remark| !remark.is_empty()) {
            writeln!(file, "% remark: {remark}")?;
        }
        let version = env!("CARGO_PKG_VERSION");
        writeln!(file, "% Written by signorini {version} in the units of the host.")?;
        writeln!(file, "% Columns: {names}.\n{n} {}", n + columns.len())?;
        let mut column =
            |values: &[f64]| values.iter().try_for_each(|value| writeln!(file, "{value:e}"));
        (0..n).try_for_each(|j| column(matrix(j)))?;
        columns.iter().try_for_each(|values| column(values))
    })
}

/// Names in a sentence: "gap and mu", "gap, mu, b and a".
fn listed(names: &[&str]) -> String {
    match names {
        [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
        _ => names.concat(),
    }
}

fn check_remark(remark: Option<&str>) -> Result<(), Error> {
    let remark = remark.unwrap_or_default();
    if remark.len() > MOST_REMARK {
        let length = remark.len();
        return Argument::Remark
            .refuse(format!("remark has {length} bytes, at most {MOST_REMARK} fit"));
    }
    if remark.chars().any(char::is_control) {
        return Argument::Remark
            .refuse("remark has a control character, it must be one line of text");
    }
    if remark.trim() != remark {
        return Argument::Remark.refuse("remark begins or ends with a space");
    }
    Ok(())
}

/// Writes to a temporary file, then renames it: a full disk or a crash leaves the old file, or none,
/// under the name, never a part of the new one. A new file takes over the mode of the old one; other names
/// (hard links) of the old one keep its contents.
pub(super) fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Error> {
    let fail = |error: io::Error| failed(path, "written", &error);
    // Through a symbolic link to the file that it names; a path that names nothing yet stays.
    let target = match fs::canonicalize(path) {
        Ok(target) => target,
        Err(error) if error.kind() == ErrorKind::NotFound => {
            if fs::symlink_metadata(path).is_ok() {
                return Err(refuse(path, None, "cannot be written: it is a link to nothing"));
            }
            path.to_path_buf()
        }
        Err(error) => return Err(fail(error)),
    };
    let old = fs::metadata(&target).ok();
    // A directory, a device or a pipe must not be replaced.
    if old.as_ref().is_some_and(|old| !old.is_file()) {
        return Err(refuse(path, None, "cannot be written: it is not a file"));
    }
    let (file, part) = new_part(&target).map_err(fail)?;
    // Before there is anything to read in it.
    let kept = old.map_or(Ok(()), |old| file.set_permissions(old.permissions()));
    let mut file = BufWriter::new(file);
    let written = kept
        .and_then(|()| fill(&mut file))
        .and_then(|()| file.flush())
        // Some file systems tell only here that they are full.
        .and_then(|()| file.get_ref().sync_all());
    // Closed before it is renamed, as Windows wants it, without another try to write the rest.
    drop(file.into_parts());
    written.and_then(|()| fs::rename(&part, &target)).map_err(|error| {
        // The error that is told is the first one.
        let _ = fs::remove_file(&part);
        fail(error)
    })
}

/// A new file in the directory of `target`.
fn new_part(target: &Path) -> io::Result<(File, PathBuf)> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let part = target.with_file_name(format!(".signorini-{}-{count}.part", std::process::id()));
        match File::create_new(&part) {
            Ok(file) => return Ok((file, part)),
            // Left by a program of the same number that was killed.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}
