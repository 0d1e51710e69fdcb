//! Files of `src/surface` by themselves: nothing outside of the library can name what they hold.

#![allow(dead_code)] // The library uses all of it.

#[path = "../../src/surface/bilinear.rs"]
mod bilinear;
#[path = "../../src/surface/clip.rs"]
mod clip;
#[path = "../../src/surface/control.rs"]
mod control;
#[path = "../../src/surface/curved.rs"]
mod curved;
#[path = "../../src/surface/curved_patch.rs"]
mod curved_patch;
#[path = "../../src/surface/face.rs"]
mod face;
#[path = "../../src/surface/quadrature.rs"]
mod quadrature;
#[path = "../../src/surface/shape.rs"]
mod shape;

mod curved_faces;
mod functions;
mod polygons;
