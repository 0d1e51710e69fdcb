//! include/signorini.h is what cbindgen makes of src/ffi.

use std::path::Path;

/// Fails when the committed header is stale; `SIGNORINI_BLESS=1 cargo test --test header` renews it.
#[test]
fn header_is_fresh() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(root.join("include/cbindgen.toml")).unwrap();
    let mut fresh = Vec::new();
    let mut builder = cbindgen::Builder::new().with_config(config);
    // In the order in which a reader needs them.
    for file in [
        "status", "settings", "report", "flat", "check", "lcp", "host", "model", "cases", "save",
        "load",
    ] {
        builder = builder.with_src(root.join(format!("src/ffi/{file}.rs")));
    }
    builder.generate().unwrap().write(&mut fresh);
    let fresh = String::from_utf8(fresh).unwrap();
    let path = root.join("include/signorini.h");
    if std::env::var_os("SIGNORINI_BLESS").is_some() {
        std::fs::write(&path, &fresh).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == fresh,
        "include/signorini.h is stale: run SIGNORINI_BLESS=1 cargo test --release --test header"
    );
}
