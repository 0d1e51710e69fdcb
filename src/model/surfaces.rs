//! Pairs from surfaces as those of a model.

use crate::reduce::ContactPairs;
use crate::surface::PairArrays;

impl<'a> From<&'a PairArrays> for ContactPairs<'a> {
    fn from(arrays: &'a PairArrays) -> Self {
        ContactPairs {
            dim: arrays.dim,
            count: arrays.count,
            slaves: &arrays.slaves,
            master_start: &arrays.master_start,
            masters: &arrays.masters,
            weights: &arrays.weights,
            vectors: (!arrays.vectors.is_empty()).then_some(&arrays.vectors),
            normals: &arrays.normals,
            tangents: Some(&arrays.tangents),
            ..ContactPairs::default()
        }
    }
}
