//! Says whether the C library is built, and names its shared object: before version 1.0 each minor version is its own
//! interface.
//!
//! The C library has an allocator and a panic hook for the whole process. A Rust program that depends on the package
//! has its own, so it gets them only if it asks for them by the feature `c-allocator`. Cargo says which packages were
//! selected on its command line, to the compiler of this file too: those are built for themselves.

fn main() {
    println!("cargo::rerun-if-changed=src/build.rs");
    println!("cargo::rustc-check-cfg=cfg(c_library)");
    let has = |feature| std::env::var_os(format!("CARGO_FEATURE_{feature}")).is_some();
    let is_selected = option_env!("CARGO_PRIMARY_PACKAGE").is_some();
    if has("C_ALLOCATOR") || has("C_LIBRARY") && is_selected {
        println!("cargo::rustc-cfg=c_library");
    }
    let version = |part| std::env::var(format!("CARGO_PKG_VERSION_{part}")).unwrap();
    let name = format!("libsignorini.so.{}.{}", version("MAJOR"), version("MINOR"));
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,{name}");
    }
}
