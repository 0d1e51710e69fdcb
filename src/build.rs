//! Says whether the C library is built, and names its shared object: before version 1.0 each minor version is its own
//! interface.
//!
//! The C library has an allocator and a panic hook for the whole process. A Rust program that depends on the package
//! has its own, so it gets them only if it asks for them by the feature `c-allocator`. Cargo says which packages were
//! selected on its command line, to the compiler of this file too: those are built for themselves.

use std::env::var;
use std::fmt::Write;

/// Entries of Fortran 77, without what compilers add to a name.
const FORTRAN: [&str; 13] = [
    "sgsolv", "sglcps", "sgspar", "sgcase", "sgrecv", "sgfree", "sgmesg", "sgsurf", "sgsmod",
    "sgsgap", "sgsfld", "sgsumm", "sgsfre",
];

fn main() {
    println!("cargo::rerun-if-changed=src/build.rs");
    println!("cargo::rustc-check-cfg=cfg(c_library)");
    let has = |feature| std::env::var_os(format!("CARGO_FEATURE_{feature}")).is_some();
    let is_selected = option_env!("CARGO_PRIMARY_PACKAGE").is_some();
    if has("C_ALLOCATOR") || has("C_LIBRARY") && is_selected {
        println!("cargo::rustc-cfg=c_library");
    }
    let version = |part| var(format!("CARGO_PKG_VERSION_{part}")).unwrap();
    let name = format!("libsignorini.so.{}.{}", version("MAJOR"), version("MINOR"));
    match var("CARGO_CFG_TARGET_OS").as_deref() {
        Ok("linux") => println!("cargo::rustc-cdylib-link-arg=-Wl,-soname,{name}"),
        // Programs look where they say: without this, where cargo has built it.
        Ok("macos") => {
            println!("cargo::rustc-cdylib-link-arg=-Wl,-install_name,@rpath/libsignorini.dylib");
        }
        Ok("windows") => export_fortran_names(),
        _ => (),
    }
}

/// The DLL has each entry of Fortran 77 under all names that compilers for Windows give it: gfortran adds an underscore,
/// as the source does; Intel's writes upper case, or lower case by an option, and adds nothing.
fn export_fortran_names() {
    let names = FORTRAN.iter().flat_map(|name| [name.to_string(), format!("{name}_64")]);
    let aliases: Vec<String> = names
        .flat_map(|name| [format!("{name}={name}_"), format!("{}={name}_", name.to_uppercase())])
        .collect();
    if var("CARGO_CFG_TARGET_ENV").as_deref() == Ok("msvc") {
        for alias in aliases {
            println!("cargo::rustc-cdylib-link-arg=/EXPORT:{alias}");
        }
        return;
    }
    let mut definitions = "EXPORTS\n".to_owned();
    for alias in aliases {
        writeln!(definitions, "    {alias}").unwrap();
    }
    let path = format!("{}/fortran.def", var("OUT_DIR").unwrap());
    std::fs::write(&path, definitions).unwrap();
    println!("cargo::rustc-cdylib-link-arg={path}");
}
