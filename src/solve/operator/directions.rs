//! Directions in which GMRES has moved the bodies, kept for the next system: its rows differ on the pairs whose
//! states have changed only, and what a direction costs, a solution with a factor, is spent (M. L. Parks,
//! E. de Sturler, G. Mackey, D. D. Johnson and S. Maiti, *Recycling Krylov subspaces for sequences of linear
//! systems*, SIAM J. Sci. Comput. 28 (2006) 1651-1674).

use crate::linalg::gmres::orthogonalised;

/// Most new directions of one system.
pub const MOST_DIRECTIONS: usize = 100;

/// Most bytes of the directions that are kept: with a million pairs taking them out of each new one costs more than the
/// products that they save.
const MOST_BYTES: usize = 1 << 29;

/// Vectors of all unknowns that a direction takes: itself, its product, and its image.
pub const VECTORS: usize = 3;

/// Most directions that are kept of so many unknowns, the latest ones: half of those of one system.
pub fn most_kept(unknowns: usize) -> usize {
    (MOST_DIRECTIONS / 2).min(MOST_BYTES / (VECTORS * size_of::<f64>() * unknowns.max(1)))
}

/// Where less than this part of an image is left when the others are taken out of it, its direction is left out: the
/// shares of such directions are large, and their sum loses these digits.
const LEAST_OF_IMAGE: f64 = 1e-4;

/// A change of all unknowns, and the forces that it asks for, of `A` times it: those on the pairs where the inner unknowns
/// are in equilibrium, all of them otherwise. It is one whatever is held.
pub struct Moved {
    pub z: Vec<f64>,
    pub forces: Vec<f64>,
}

/// The directions that are kept.
#[derive(Default)]
pub struct Directions(Vec<Moved>);

impl Directions {
    pub fn clear(&mut self) {
        self.0.clear();
    }

    pub fn count(&self) -> usize {
        self.0.len()
    }

    pub fn add(&mut self, moved: Moved) {
        self.0.push(moved);
    }

    pub fn iter(&self) -> impl Iterator<Item = &Moved> {
        self.0.iter()
    }

    /// Forgets the oldest ones.
    pub fn forget(&mut self) {
        let most = self.0.first().map_or(0, |moved| most_kept(moved.z.len()));
        self.0.drain(..self.0.len().saturating_sub(most));
    }

    /// Adds a share of each of them to a change of all unknowns.
    pub fn add_shares(&self, shares: &[f64], sum: &mut Moved) {
        for (share, moved) in shares.iter().zip(&self.0).filter(|(share, _)| **share != 0.0) {
            sum.z.iter_mut().zip(&moved.z).for_each(|(sum, part)| *sum += share * part);
            sum.forces.iter_mut().zip(&moved.forces).for_each(|(sum, part)| *sum += share * part);
        }
    }
}

/// The images of directions in the equations of a system, as an orthonormal basis `C` and a triangle `R`: the
/// images are `C R`.
#[derive(Default)]
pub struct Images {
    basis: Vec<Vec<f64>>,
    /// Columns of `R`.
    triangle: Vec<Vec<f64>>,
    /// The directions that have a column, and the number of all.
    which: Vec<usize>,
    count: usize,
}

impl Images {
    /// The basis of these images, one for each direction.
    pub fn new(images: impl Iterator<Item = Vec<f64>>) -> Self {
        let mut all = Images::default();
        for mut image in images {
            let (mut column, left, was) = orthogonalised(&mut image, &all.basis);
            if left > LEAST_OF_IMAGE * was {
                image.iter_mut().for_each(|v| *v /= left);
                column.pop();
                column.push(left);
                all.basis.push(image);
                all.triangle.push(column);
                all.which.push(all.count);
            }
            all.count += 1;
        }
        all
    }

    /// Takes the images out of a vector, and returns its shares in `C`.
    pub fn take_out(&self, vector: &mut [f64]) -> Vec<f64> {
        let (mut shares, _, _) = orthogonalised(vector, &self.basis);
        shares.pop();
        shares
    }

    /// The shares of the directions whose image has the given shares in `C`.
    pub fn of_directions(&self, mut shares: Vec<f64>) -> Vec<f64> {
        let mut all = vec![0.0; self.count];
        for k in (0..shares.len()).rev() {
            shares[k] /= self.triangle[k][k];
            let known = shares[k];
            (0..k).for_each(|j| shares[j] -= known * self.triangle[k][j]);
            all[self.which[k]] = known;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sum of images is found again by its shares, also where some images follow from others.
    #[test]
    fn shares_of_a_sum_of_images() {
        let mut rng = fastrand::Rng::with_seed(1);
        let mut vector = || -> Vec<f64> { (0..12).map(|_| rng.f64() - 0.5).collect() };
        let mut images: Vec<Vec<f64>> = (0..6).map(|_| vector()).collect();
        images[3] = images[1].iter().zip(&images[2]).map(|(a, b)| a - 2.0 * b).collect();
        let sum: Vec<f64> = (0..12).map(|i| images[0][i] + images[3][i] - images[5][i]).collect();
        let all = Images::new(images.iter().cloned());
        let mut left = sum.clone();
        let shares = all.take_out(&mut left);
        let shares = all.of_directions(shares);
        assert_eq!(shares.len(), images.len());
        for i in 0..12 {
            let again: f64 =
                shares.iter().zip(&images).map(|(share, image)| share * image[i]).sum();
            // Rounding of twelve terms, and of a basis of a condition about 10.
            assert!((again - sum[i]).abs() <= 1e-13, "{again} {}", sum[i]);
            assert!(left[i].abs() <= 1e-13, "{}", left[i]);
        }
    }
}
