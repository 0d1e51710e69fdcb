//! Newton's method on the normal map (`law::normal_map`): one equation for open, stick and slip, in the
//! plane and in space, with the exact friction disc.

mod newton;
mod point;
mod step;

pub use newton::newton;
