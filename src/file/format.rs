//! The words of the format.

/// The first line of every problem file, up to case and space.
pub(super) const BANNER: &str = "%%MatrixMarket matrix array real general";
/// The comment that tells a problem file from other matrices, followed by the version.
pub(super) const TITLE: &str = "signorini problem";
/// The version of the format that is written.
pub(super) const VERSION: &str = "2";
/// The version before it, which is read too: the kind is the law, or `lcp`.
pub(super) const OLD_VERSION: &str = "1";
/// Most bytes of a remark.
pub(super) const MOST_REMARK: usize = 1000;
