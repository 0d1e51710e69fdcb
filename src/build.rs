//! Names the shared object: before version 1.0 each minor version is its own interface.

fn main() {
    println!("cargo::rerun-if-changed=src/build.rs");
    let version = |part| std::env::var(format!("CARGO_PKG_VERSION_{part}")).unwrap();
    let name = format!("libsignorini.so.{}.{}", version("MAJOR"), version("MINOR"));
    if std::env::var("CARGO_CFG_TARGET_OS").as_deref() == Ok("linux") {
        println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,{name}");
    }
}
