//! Where the linear path starts: coordinates after some sweeps, moved by a little at random so that no
//! two pairs change at once.

use super::curved::PERTURBATION;
use crate::law::{Contact, PairLaw, Planar};
use crate::linalg::perturbation::Perturbation;
use crate::linalg::vector::NormSum;
use crate::monitor::Monitor;
use crate::solve::sweeps::Sweeper;

/// The start, its randomness, and the loads of the problem.
pub struct Starts {
    /// `r = f - K (gap, slip0)`: the loads on the body that touches all its obstacles.
    pub load: Vec<f64>,
    /// Displacements after the sweeps, and their force; at first those of the start, which may break the law.
    swept: (Vec<f64>, Vec<f64>),
    /// Size of the random part of each component.
    unit: Vec<f64>,
    /// Size of all forces, each in the unit that its diagonal entry of `K` gives it.
    pub size: f64,
}

impl Starts {
    /// Begins at the displacements `start` (zero if `None`).
    pub fn new(contact: &Contact<'_>, root: &[f64], start: Option<&[f64]>) -> Self {
        let zero = || vec![0.0; contact.unknowns()];
        let d = start.map_or_else(zero, <[f64]>::to_vec);
        let force = contact.problem().force(&d);
        let reference: Vec<f64> =
            contact.pairs().iter().flat_map(|law| law.reference()[..2].to_vec()).collect();
        let load: Vec<f64> =
            contact.problem().force(&reference).iter().map(|force| -force).collect();
        let mut size = NormSum::default();
        load.iter().zip(root).for_each(|(load, root)| size.add(load / root));
        let size = size.root();
        let part = PERTURBATION * size / (root.len() as f64).sqrt();
        Starts {
            load,
            swept: (d, force),
            unit: root.iter().map(|root| part * root).collect(),
            size,
        }
    }

    /// Sweeps on while there is time.
    pub fn sweep(&mut self, contact: &Contact<'_>, sweeps: usize, monitor: &Monitor<'_>) {
        let (sweeper, (d, force)) = (Sweeper::new(), &mut self.swept);
        if sweeps > 0 {
            *d = contact.admissible(d);
            *force = contact.problem().force(d);
        }
        for _ in 0..sweeps {
            if monitor.is_late() {
                return;
            }
            sweeper.sweep(contact, (&mut *d, &mut *force), 1.0);
        }
    }

    /// The coordinates after the sweeps, moved at random.
    pub fn swept(&self, contact: &Contact<'_>, random: &mut Perturbation) -> Vec<Planar> {
        let (d, force) = &self.swept;
        let mut units = self.unit.chunks_exact(2);
        let moved = |(law, d, force): (&PairLaw, &[f64], &[f64])| {
            let unit = units.next().expect("every pair has units");
            let y = law.released(d, force, unit[0] * (2.0 + random.next()));
            std::array::from_fn(|c| y[c] + unit[c] * random.next())
        };
        contact.each(d, force).map(moved).collect()
    }

    /// Coordinates after the sweeps with the pairs in the states that make the path sure to arrive.
    pub fn sure(&self, contact: &Contact<'_>, random: &mut Perturbation) -> Vec<Planar> {
        let swept = self.swept(contact, random);
        contact.pairs().iter().zip(swept).map(|(law, y)| law.sure_start(y)).collect()
    }

    /// All pairs pressed on their obstacles and stuck, by random forces of the size of the loads.
    pub fn pressed(
        &self,
        contact: &Contact<'_>,
        root: &[f64],
        random: &mut Perturbation,
    ) -> Vec<Planar> {
        let swept = self.swept(contact, random);
        let mean = self.size / (root.len() as f64).sqrt();
        let pairs = contact.pairs().iter().zip(swept).zip(root.chunks_exact(2));
        pairs
            .map(|((law, y), root)| law.pressed(y, mean * root[0] * (1.0 + VARIED * random.next())))
            .collect()
    }
}

/// How much the forces of [`Starts::pressed`] differ.
const VARIED: f64 = 0.1;
