//! The frames of pairs in space: which tangent is the first.

use super::pairs::SurfacePairs;
use super::plane;
use crate::linalg::vector3::{ERROR_OF_DIRECTION, Vector3, most_across, unit};

impl SurfacePairs {
    /// Gives all pairs their tangents, the first towards a direction. Without one it is the axis most across all normals: an
    /// axis for each pair by itself would jump between pairs whose normals differ by little.
    pub(super) fn set_tangents(&mut self, towards: Option<[f64; 3]>) {
        let towards = towards.and_then(|towards| unit(towards.into()));
        let towards = towards.unwrap_or_else(|| most_across(self.mean_squares()));
        for at in 0..self.pairs.len() {
            let pair = &self.pairs[at];
            let found = tangents(self.dim, pair.normal.into(), towards, &self.held(pair.slave));
            self.pairs[at].tangents = found.map(Into::into);
        }
        self.towards = towards.into();
    }

    /// Squares of the components of the normals, by area.
    fn mean_squares(&self) -> Vector3 {
        let square = |normal: Vector3| normal.component_mul(&normal);
        self.pairs.iter().map(|pair| pair.area * square(pair.normal.into())).sum()
    }
}

/// Tangents of a normal, in space the first towards a unit vector as nearly as may be.
pub(super) fn tangents(
    dim: usize,
    normal: Vector3,
    towards: Vector3,
    held: &[Vector3],
) -> [Vector3; 2] {
    let first = match held {
        _ if dim == 2 => None,
        // A frame has a tangent along a direction that is held.
        [across] => {
            let along = across.cross(&normal);
            let nearness = |tangent: Vector3| tangent.dot(&towards).abs();
            let is_nearer = nearness(along) >= nearness(*across) - ERROR_OF_DIRECTION;
            let nearer = if is_nearer { along } else { *across };
            Some(if nearer.dot(&towards) < 0.0 { -nearer } else { nearer })
        }
        _ => {
            let along = towards - normal.dot(&towards) * normal;
            unit(along).filter(|_| along.norm() > ERROR_OF_DIRECTION)
        }
    };
    first.map_or_else(|| plane::tangents(dim, normal), |first| [first, normal.cross(&first)])
}
