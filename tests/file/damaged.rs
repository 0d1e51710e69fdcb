//! Problem files that are damaged, foreign or out of reach: an error in a sentence, and never a crash.

use std::fs;
use std::path::Path;

use crate::common::folder::{Folder, SMALL};
use signorini::ContactProblem;
use signorini::file;

#[test]
fn every_truncation_is_refused() {
    let folder = Folder::new("truncated");
    let whole = folder.load(SMALL.as_bytes()).unwrap();
    for ending in ["\n", "\r\n"] {
        let text = SMALL.replace('\n', ending);
        assert_eq!(folder.load(text.as_bytes()).unwrap(), whole);
        for length in 0..text.len() {
            let message = folder.load(&text.as_bytes()[..length]).unwrap_err();
            let line = 1 + text[..length].matches('\n').count();
            assert!(message.contains(&format!(": line {line}: ")), "{length} bytes: {message}");
        }
    }
}

#[test]
fn what_readers_and_mailers_change_is_accepted() {
    let folder = Folder::new("changed");
    let whole = folder.load(SMALL.as_bytes()).unwrap();
    for changed in [
        SMALL.replace("%%MatrixMarket matrix array", "%%matrixmarket  MATRIX Array"),
        SMALL.replace("% kind", "% by way of: mail\n%\n%%\n%no space\n% kind"),
        SMALL.replace("inf", "Infinity").replace("3e-1", "  +0.3  "),
        SMALL.replace("2 6", "  2\t6"),
        format!("{SMALL}\n \r\n\n"),
    ] {
        assert_eq!(folder.load(changed.as_bytes()).unwrap(), whole, "{changed}");
    }
    let latin = SMALL.replace("% Written", "% M?ller");
    let latin: Vec<u8> = latin.bytes().map(|b| if b == b'?' { 0xFC } else { b }).collect();
    assert_eq!(folder.load(&latin).unwrap(), whole);
    let remark = folder.load(SMALL.replace("one pair", "a\x1b[2Jb\0c").as_bytes()).unwrap().remark;
    assert_eq!(remark, "a [2Jb c");
}

/// A change: the old text, the new one, the line that is named, and a part of the sentence.
const MUTATIONS: [(&str, &str, usize, &str); 41] = [
    ("%%MatrixMarket", "%MatrixMarket", 1, "not a problem file"),
    ("array", "coordinate", 1, "not a problem file"),
    ("real", "complex", 1, "not a problem file"),
    ("general", "symmetric", 1, "not a problem file"),
    ("%%MatrixMarket matrix array real general\n", "", 1, "not a problem file"),
    ("% signorini problem 2\n", "", 8, "some other matrix"),
    ("problem 2", "problem 3", 2, "version '3'"),
    ("problem 2", "problem 11", 2, "version '11'"),
    ("% kind: contact\n", "", 8, "no line '% kind:'"),
    ("contact", "coulomb", 3, "no kind of problem is 'coulomb'"),
    ("% law: coulomb\n", "", 8, "no line '% law:'"),
    ("coulomb", "viscous", 4, "no friction law is 'viscous'"),
    ("% law: coulomb\n", "% law: coulomb\n% law: tresca\n", 5, "a second 'law:'"),
    ("coulomb", "frictionless", 9, "3 columns more"),
    ("problem 2", "problem 1", 3, "no kind of problem is 'contact'"),
    ("% dim: 2\n", "", 8, "no line '% dim:'"),
    ("dim: 2", "dim: 4", 9, "above, dim is 4"),
    ("dim: 2", "dim: two", 5, "dim is 'two'"),
    ("dim: 2", "dim: 3", 9, "with dim 3"),
    ("% pairs: 1\n", "", 8, "no line '% pairs:'"),
    ("pairs: 1", "pairs: 2", 9, "2 pairs"),
    ("pairs: 1", "pairs: -1", 6, "pairs is '-1'"),
    ("pairs: 1", "pairs: 99999999999999999999", 6, "pairs is '99999999999999999999'"),
    ("% dim: 2\n", "% dim: 2\n% dim: 2\n", 6, "a second 'dim:'"),
    ("2 6", "2 7", 9, "4 columns more"),
    ("2 6", "2", 9, "not two sizes"),
    ("2 6", "2 6 12", 9, "not two sizes"),
    ("2 6", "4294967296 4294967300", 9, "there must be"),
    ("1.25e0", "1.25e0 7", 15, "f, row 1: '1.25e0 7' is not a number"),
    ("1.25e0", "1.25d0", 15, "'1.25d0' is not a number"),
    ("1.25e0", "", 15, "'' is not a number"),
    ("1.25e0", "NaN", 15, "must be finite"),
    ("1.25e0", "inf", 15, "must be finite"),
    ("1.25e0", "1e999", 15, "too large"),
    ("1.25e0", "% 1", 15, "is not a number"),
    ("inf", "-inf", 16, "gap, row 0: '-inf' must be finite"),
    ("inf", "1e400", 16, "too large"),
    ("inf\n0e0", "inf\n1e0", 17, "such rows have no gap"),
    ("3e-1\n0e0", "3e-1\ninf", 19, "must be finite"),
    ("0e0\n-7e-1", "2e0\n-7e-1", 20, "such rows have no slip0"),
    ("-7e-1\n", "-7e-1\n0e0\n", 22, "the problem ends above"),
];

#[test]
fn every_mutation_is_refused_with_its_line() {
    let folder = Folder::new("mutated");
    for (from, to, line, part) in MUTATIONS {
        assert!(SMALL.contains(from), "{from}");
        let message = folder.load(SMALL.replacen(from, to, 1).as_bytes()).unwrap_err();
        assert!(message.contains(&format!("problem.mtx: line {line}: ")), "{to}: {message}");
        assert!(message.contains(part), "{to}: {message}");
    }
    let long = format!("% {}\n", "x".repeat(5000));
    let message = folder.load(SMALL.replace("% kind", &(long + "% kind")).as_bytes()).unwrap_err();
    assert!(message.contains("line 3: longer than 4096 bytes"), "{message}");
    let message = folder.load(&[0xFF; 5000]).unwrap_err();
    assert!(message.contains("line 1: longer"), "{message}");
    let message = folder.load(b"\xFF\xFE\x00\n").unwrap_err();
    assert!(message.contains("line 1: not a problem file"), "{message}");
}

/// A size line is not believed: no memory is taken for what cannot be in the file.
#[test]
fn absurd_sizes_are_refused() {
    let folder = Folder::new("absurd");
    for (pairs, part) in [
        (1_usize << 28, "K[1,0] is missing"),
        (1_usize << 40, "the matrix cannot exist"),
        (usize::MAX / 2, "there must be"),
        (usize::MAX, "there must be"),
    ] {
        let n = pairs.wrapping_mul(2);
        let text = format!(
            "%%MatrixMarket matrix array real general\n% signorini problem 1\n% kind: coulomb\n\
             % dim: 2\n% pairs: {pairs}\n{n} {}\n1e0\n",
            n.wrapping_add(4)
        );
        let message = folder.load(text.as_bytes()).unwrap_err();
        assert!(message.contains(part), "{message}");
    }
    let lcp = "%%MatrixMarket matrix array real general\n% signorini problem 1\n% kind: lcp\n";
    let message = folder.load(format!("{lcp}0 18446744073709551615\n").as_bytes()).unwrap_err();
    assert!(message.contains("line 4: 0 rows ask for 1 or 2 columns more"), "{message}");
    let message = folder.load(format!("{lcp}5000000000 5000000001\n").as_bytes()).unwrap_err();
    assert!(message.contains("line 4: 5000000000 rows: the matrix cannot exist"), "{message}");
}

/// Random damage never brings a panic, and what is read is what the lines say.
#[test]
fn random_damage_is_refused_or_read() {
    let folder = Folder::new("damaged");
    let mut random = fastrand::Rng::with_seed(4);
    let mut refused = 0;
    for _ in 0..1000 {
        let mut text = SMALL.as_bytes().to_vec();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(..text.len());
            match random.u8(0..3) {
                0 => text[at] = random.u8(..),
                1 => drop(text.remove(at)),
                _ => text.insert(at, *b"\n%1e- .:".get(random.usize(..8)).unwrap()),
            }
        }
        match folder.load(&text) {
            Ok(problem) => assert_eq!((problem.size, problem.matrix.len()), (2, 4)),
            Err(message) => {
                assert!(message.contains(": line "), "{message}");
                refused += 1;
            }
        }
    }
    assert!(refused > 250, "{refused}");
}

#[test]
fn files_that_cannot_be_written_or_read_are_named() {
    let folder = Folder::new("paths");
    let problem = file::read(&{
        fs::write(folder.file(), SMALL).unwrap();
        folder.file()
    })
    .unwrap();
    let problem = ContactProblem::new(problem.contact().unwrap()).unwrap();
    let save = |path: &Path| file::write(path, &problem, None).unwrap_err().to_string();
    let load = |path: &Path| file::read(path).unwrap_err().to_string();

    let absent = folder.0.join("absent");
    assert!(save(&absent.join("p.mtx")).contains("p.mtx: cannot be written: "));
    assert!(load(&absent).contains("absent: cannot be read: "));
    assert!(save(&folder.0).contains("it is not a file"));
    assert!(load(&folder.0).contains("it is a directory"));
    assert!(save(&folder.file().join("p.mtx")).contains("cannot be written: "));

    let deep = folder.0.join("d".repeat(200)).join("e".repeat(200)).join("p.mtx");
    let message = load(&deep);
    assert!(message.len() < 300 && message.contains("p.mtx: cannot be read"), "{message}");

    for remark in ["two\nlines", "a tab\t", " space", &"x".repeat(1001)] {
        let refused = file::write(&folder.file(), &problem, Some(remark)).unwrap_err();
        assert!(refused.to_string().starts_with("remark"), "{refused}");
    }
    assert_eq!(fs::read_to_string(folder.file()).unwrap(), SMALL, "a refused call wrote");
    assert_eq!(folder.names(), ["problem.mtx"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_left_alone() {
    let folder = Folder::new("links");
    fs::write(folder.file(), SMALL).unwrap();
    let problem = file::read(&folder.file()).unwrap();
    let problem = ContactProblem::new(problem.contact().unwrap()).unwrap();
    let link = folder.0.join("link");
    std::os::unix::fs::symlink("problem.mtx", &link).unwrap();
    file::write(&link, &problem, Some("through the link")).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(file::read(&folder.file()).unwrap().remark, "through the link");

    let message = file::write(Path::new("/dev/null"), &problem, None).unwrap_err().to_string();
    assert_eq!(message, "/dev/null: cannot be written: it is not a file");
    for device in ["/dev/zero", "/dev/null"] {
        let message = file::read(Path::new(device)).unwrap_err().to_string();
        assert_eq!(
            message,
            format!("{device}: cannot be read: it is a pipe or a device, not a file")
        );
    }
    let nowhere = folder.0.join("nowhere");
    std::os::unix::fs::symlink("absent", &nowhere).unwrap();
    let message = file::write(&nowhere, &problem, None).unwrap_err().to_string();
    assert!(message.ends_with("nowhere: cannot be written: it is a link to nothing"), "{message}");
}

/// To open a pipe for reading waits for a writer: it is refused before.
#[cfg(unix)]
#[test]
fn a_pipe_is_refused_at_once() {
    let folder = Folder::new("pipe");
    let pipe = folder.0.join("pipe\nin two lines");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    let message = file::read(&pipe).unwrap_err().to_string();
    let end = "pipe?in two lines: cannot be read: it is a pipe or a device, not a file";
    assert!(message.ends_with(end), "{message}");
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_keeps_its_mode() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("mode");
    fs::write(folder.file(), SMALL).unwrap();
    let problem = file::read(&folder.file()).unwrap();
    let problem = ContactProblem::new(problem.contact().unwrap()).unwrap();
    for mode in [0o600, 0o640, 0o664] {
        fs::set_permissions(folder.file(), fs::Permissions::from_mode(mode)).unwrap();
        file::write(&folder.file(), &problem, None).unwrap();
        let found = fs::metadata(folder.file()).unwrap().permissions().mode();
        assert_eq!(found & 0o7777, mode);
    }
    // Another name of the old file keeps its contents.
    let other = folder.0.join("other");
    fs::hard_link(folder.file(), &other).unwrap();
    let before = fs::read(&other).unwrap();
    file::write(&folder.file(), &problem, Some("new")).unwrap();
    assert_eq!(fs::read(&other).unwrap(), before);
    assert_eq!(file::read(&folder.file()).unwrap().remark, "new");
}

/// A limit on the size of files, in a child process: the old file stays, and nothing is left beside it.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_on_files_leaves_the_old_one() {
    const FOLDER: &str = "SIGNORINI_LIMITED_FOLDER";
    if let Some(place) = std::env::var_os(FOLDER) {
        let path = Path::new(&place).join("problem.mtx");
        let problem = file::read(&path).unwrap();
        let problem = ContactProblem::new(problem.contact().unwrap()).unwrap();
        let message = file::write(&path, &problem, None).unwrap_err().to_string();
        assert!(message.contains("problem.mtx: cannot be written: File too large"), "{message}");
        return;
    }
    let folder = Folder::new("limited");
    fs::write(folder.file(), SMALL).unwrap();
    // The shell ignores the signal, and so does its child, as hosts do that want the error.
    let child = std::process::Command::new("sh")
        .args([
            "-c",
            "trap '' XFSZ; ulimit -f 0; exec \"$0\" --exact damaged::a_limit_on_files_leaves_the_old_one",
        ])
        .arg(std::env::current_exe().unwrap())
        .env(FOLDER, &folder.0)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&child.stdout);
    assert!(child.status.success() && told.contains("1 passed"), "{told}");
    assert_eq!(fs::read_to_string(folder.file()).unwrap(), SMALL);
    assert_eq!(folder.names(), ["problem.mtx"]);
}
