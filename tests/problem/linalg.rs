//! Files of `src/linalg` by themselves: nothing outside of the library can name what they hold.

#![allow(dead_code)] // The library uses all of it.

#[path = "../../src/linalg/ball.rs"]
pub mod ball;
#[path = "../../src/linalg/columns.rs"]
pub mod columns;
#[path = "../../src/linalg/conjugate_gradients.rs"]
pub mod conjugate_gradients;
#[path = "../../src/linalg/definite.rs"]
pub mod definite;
#[path = "../../src/linalg/dense.rs"]
pub mod dense;
#[path = "../../src/linalg/double_double.rs"]
pub mod double_double;
#[path = "../../src/linalg/factor.rs"]
pub mod factor;
#[path = "../../src/linalg/gmres.rs"]
pub mod gmres;
#[path = "../../src/linalg/least_squares.rs"]
pub mod least_squares;
#[path = "../../src/linalg/matrix.rs"]
pub mod matrix;
#[path = "../../src/linalg/power_of_two.rs"]
pub mod power_of_two;
#[path = "../../src/linalg/simd.rs"]
pub mod simd;
#[path = "../../src/linalg/small_products.rs"]
pub mod small_products;
#[path = "../../src/linalg/tolerances.rs"]
pub mod tolerances;
#[path = "../../src/linalg/vector.rs"]
pub mod vector;
#[path = "../../src/linalg/watched.rs"]
pub mod watched;

mod factors;
mod iterations;
mod numbers;
mod residuals;
