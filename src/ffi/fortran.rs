//! The Fortran 77 entries: by reference, `name_` for 4-byte and `name_64_` for 8-byte integers.
//!
//! `include/signorini.inc` is their reference. They are those that a code of 1985 needs; the module in
//! `include/signorini.f90` has all the library does. They count from 1, return nothing but their last argument INFO,
//! and call the functions of C: the entries translate arguments and their positions; indices in sentences are counted
//! by [`crate::error`]. Models and pairs of surfaces are known by numbers, of 8 bytes in both widths, so that a wrong
//! one is refused and not followed.

/// Exports a subroutine for each width of integers; `I` is the integer in the types.
macro_rules! export {
    ($short:ident $long:ident ($($argument:ident: $type:ty),* $(,)?) $body:block) => {
        mod $short {
            use super::*;

            unsafe fn generic<I: Integer>($($argument: $type),*) {
                // SAFETY: the caller's contract, which include/signorini.inc states.
                unsafe { $body }
            }

            export! { narrow i32 $short ($($argument: $type),*) }
            export! { wide i64 $long ($($argument: $type),*) }
        }
    };
    ($width:ident $integer:ident $name:ident ($($argument:ident: $type:ty),*)) => {
        mod $width {
            use super::*;
            type I = $integer;

            #[unsafe(no_mangle)]
            unsafe extern "C" fn $name($($argument: $type),*) {
                // SAFETY: as above.
                unsafe { generic($($argument),*) }
            }
        }
    };
}

/// Exports an entry, whose last argument INFO is not in the list. In the body each argument has its position and its
/// name; it returns the status of the function of C that it calls, or a refusal of its own. The arguments of that
/// function are those of the entry that `calls` lists.
macro_rules! entry {
    ($short:ident $long:ident calls [$($given:ident),*],
     ($($argument:ident: $type:ty),* $(,)?) $body:block) => {
        export! {
            $short $long ($($argument: $type,)* INFO: *mut I) {
                let mut position = 0;
                $(
                    position += 1;
                    let $argument = Argument::of($argument, position, stringify!($argument));
                )*
                run(INFO, &[$($given.position),*], || $body)
            }
        }
    };
}

mod arguments;
mod calls;
mod handles;
mod surfaces;
