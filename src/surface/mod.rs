//! Contact pairs from two surfaces of a mesh, or from a surface and a rigid obstacle.
//!
//! In: coordinates, and the faces of two sides that may touch. Out: rows over nodes with their normals,
//! tangents, gaps and areas, and what found no partner. Lengths are in the host's unit.
//!
//! ```
//! use signorini::{Monitor, Settings};
//! use signorini::surface::{Faces, Master, SurfaceSettings, Surfaces, pair_surfaces};
//!
//! // A line of one element, 0 to 1, stands on one of two elements.
//! let coordinates = [0.0, 0.1, 1.0, 0.1, -1.0, 0.0, 0.5, 0.0, 2.0, 0.0];
//! let slave = Faces { start: &[0, 2], nodes: &[0, 1] };
//! let master = Master::Faces(Faces { start: &[0, 2, 4], nodes: &[4, 3, 3, 2] });
//! let surfaces = Surfaces { dim: 2, coordinates: &coordinates, slave, master };
//! let monitor = &mut Monitor::new(&Settings::default(), None);
//! let found = pair_surfaces(&surfaces, &SurfaceSettings::default(), monitor)?;
//! assert_eq!(found.pairs.len(), 2);
//! assert!((found.pairs[0].gap - 0.1).abs() < 1e-15);
//! assert!((found.pairs[0].area - 0.5).abs() < 1e-15);
//! # Ok::<(), signorini::Error>(())
//! ```

mod adjust;
mod bilinear;
mod candidates;
mod clip;
mod control;
mod curved;
mod curved_patch;
mod digits;
mod exact_shape;
mod face;
mod face_checks;
mod facets;
mod fields;
mod fitted_normals;
mod fitted_quadric;
mod fitted_side;
mod held;
mod images;
mod kept_surfaces;
mod lists;
mod meetings;
mod mesh;
mod mortar;
mod motion;
mod node_to_surface;
mod normals;
mod numbering;
mod obstacle;
mod on_chords;
mod overlap;
mod pair_arrays;
mod pair_surfaces;
mod pairing_progress;
mod pairs;
mod penetration;
mod plane;
mod projected_shapes;
mod quadrature;
mod rims;
mod row;
mod scatter;
mod sector;
mod sector_boundary;
mod self_overlap;
mod settings;
mod shape;
mod summary;
mod surfaces;
mod sweep;
mod symmetry;
mod tree;
mod true_shape;
mod turns;
mod unit;
mod with_images;
mod zones;

pub use exact_shape::Obstacle;
pub use fields::{NodalFields, PairResults, Resultant};
pub use images::Images;
pub use kept_surfaces::KeptSurfaces;
pub use pair_arrays::{NodeDofs, PairArrays};
pub use pair_surfaces::pair_surfaces;
pub use pairs::{Fold, SurfacePair, SurfacePairs, SurfaceReport, Weight};
pub use penetration::Penetration;
pub use sector::Sector;
pub use settings::{Normals, Pairing, Rims, SurfaceSettings, SymmetryPlane, TrueShape};
pub use surfaces::{Faces, Master, Surfaces};
pub use zones::{ContactZone, Joined, join_zones};
