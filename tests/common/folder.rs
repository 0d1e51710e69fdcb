//! Problem files in a directory of a test's own.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use signorini::Error;
use signorini::file::{self, ProblemFile};

/// A problem file of one pair.
pub const SMALL: &str = "\
%%MatrixMarket matrix array real general
% signorini problem 2
% kind: contact
% law: coulomb
% dim: 2
% pairs: 1
% remark: one pair
% Written by hand.
2 6
4e0
1e0
1e0
4e0
2e0
1.25e0
inf
0e0
3e-1
0e0
0e0
-7e-1
";

/// A directory of the test's own, removed at its end.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("file {name}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    pub fn file(&self) -> PathBuf {
        self.0.join("problem.mtx")
    }

    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    /// The answer of `load` to a file with this content.
    pub fn load(&self, content: &[u8]) -> Result<ProblemFile, String> {
        fs::write(self.file(), content).unwrap();
        let loaded = catch_unwind(AssertUnwindSafe(|| file::read(&self.file())));
        loaded.expect("a panic").map_err(|error| {
            assert!(matches!(error, Error::File(_)), "{error}");
            error.to_string()
        })
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}
