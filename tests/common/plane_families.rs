//! Problems with friction in the plane that are hard for Newton's method: graded meshes on four kinds
//! of support, friction up to 20, gaps and slips of every kind.

use fastrand::Rng;
use signorini::Model;

use super::mesh::{Mesh, Pairs, steps};

/// Side of the blocks, mm.
const SIZE: f64 = 40.0;

/// Growth of the rows of elements away from the contact line.
const GROWTH: f64 = 1.5;

const STEEL: (f64, f64) = (13000.0, 0.2);

/// Way of the upper side of a block under the pressure: 5 on 40 of steel.
const MOVED: f64 = 0.0154;

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Support {
    /// One side slides along the normal: a rigid motion, which contact alone stops.
    Roller,
    /// One side is held.
    Side,
    /// The upper side is held, and moved down and along.
    Top,
    /// A body on a roller on a second one, whose mesh does not match: a rigid motion.
    TwoBodies,
}

pub const SUPPORTS: [Support; 4] =
    [Support::Roller, Support::Side, Support::Top, Support::TwoBodies];

/// A condensed structure with what its loads are made of.
pub struct Structure {
    pub support: Support,
    pub pairs: usize,
    /// Column-major.
    pub stiffness: Vec<f64>,
    /// Loads of pressure on the upper side, of a traction along it, and of one on a side; with a held
    /// upper side, of its motion down, along, and of the traction.
    loads: [Vec<f64>; 3],
}

/// A problem: what `ContactData` takes beside the stiffness.
pub struct Case {
    pub load: Vec<f64>,
    pub gap: Vec<f64>,
    pub mu: Vec<f64>,
    pub slip: Option<Vec<f64>>,
    pub name: String,
}

/// Heights of rows that grow from `from` by the factor [`GROWTH`], the first `first` high.
fn graded(first: f64) -> Vec<f64> {
    let mut heights = vec![first];
    while heights.iter().sum::<f64>() < SIZE {
        heights.push(GROWTH * heights[heights.len() - 1]);
    }
    let stretch = SIZE / heights.iter().sum::<f64>();
    let mut lines = vec![0.0];
    for height in &heights {
        lines.push(lines[lines.len() - 1] + stretch * height);
    }
    lines
}

impl Structure {
    pub fn new(support: Support, pairs: usize) -> Self {
        let columns = pairs - 1;
        let lines = graded(SIZE / columns as f64);
        let mut mesh = Mesh::default();
        let block = mesh.block(&steps(0.0, SIZE, columns), &lines, STEEL);
        let across = |node: usize| 2 * node;
        let both = |node: usize| [2 * node, 2 * node + 1];
        let held = block.column(columns);
        let mut contact = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
        let mut fixed: Vec<usize> = match support {
            Support::Roller => held.into_iter().map(across).collect(),
            // A pair is fixed along the contact line on both sides or on neither.
            Support::TwoBodies => held[1..].iter().copied().map(across).collect(),
            Support::Side => held.into_iter().flat_map(both).collect(),
            Support::Top => block.row(block.rows).into_iter().flat_map(both).collect(),
        };
        if support == Support::TwoBodies {
            // Three elements for four of the upper body, and the ends in common.
            let count = (3 * columns / 4).max(1);
            let below: Vec<f64> = graded(SIZE / count as f64).iter().rev().map(|y| -y).collect();
            let lower = mesh.block(&steps(0.0, SIZE, count), &below, STEEL);
            fixed.extend(lower.row(0).into_iter().flat_map(both));
            let masters: Vec<Vec<(usize, f64)>> = (0..=columns)
                .map(|i| {
                    let at = i as f64 * count as f64 / columns as f64;
                    let left = (at as usize).min(count - 1);
                    let part = at - left as f64;
                    let node = |i| lower.node(i, lower.rows);
                    vec![(node(left), 1.0 - part), (node(left + 1), part)]
                })
                .collect();
            contact = Pairs::new(&block.row(0), &masters, [0.0, -1.0]);
        }
        let model = mesh.stiffness().model(&fixed, &contact).expect("a valid model");
        let condensed = |load: &[f64], prescribed: Option<&[f64]>| {
            model.condensed_load(load, prescribed).expect("valid loads")
        };
        let traction = |line: &[usize], traction: [f64; 2]| {
            let mut load = vec![0.0; mesh.size()];
            mesh.traction(line, traction, &mut load);
            condensed(&load, None)
        };
        let moved = |component: usize, by: f64| {
            let prescribed: Vec<f64> =
                fixed.iter().map(|i| if i % 2 == component { by } else { 0.0 }).collect();
            condensed(&vec![0.0; mesh.size()], Some(&prescribed))
        };
        let top = block.row(block.rows);
        let side = traction(&block.column(0), [10.0, 0.0]);
        let loads = match support {
            Support::Top => [moved(1, -MOVED), moved(0, MOVED), side],
            _ => [traction(&top, [0.0, -5.0]), traction(&top, [5.0, 0.0]), side],
        };
        let stiffness = Model::stiffness(&model).to_vec();
        Structure { support, pairs, stiffness, loads }
    }

    /// A random problem on the structure.
    pub fn case(&self, rng: &mut Rng) -> Case {
        let between = |rng: &mut Rng, low: f64, high: f64| low + (high - low) * rng.f64();
        let shares = [between(rng, 0.3, 1.0), between(rng, -0.5, 0.5), between(rng, -1.0, 1.0)];
        let mut load = vec![0.0; 2 * self.pairs];
        for (part, share) in self.loads.iter().zip(shares) {
            load.iter_mut().zip(part).for_each(|(load, part)| *load += share * part);
        }
        let coefficients = [0.05, 0.1, 0.3, 1.0, 2.0, 5.0, 10.0, 20.0];
        let most = coefficients[rng.usize(..coefficients.len())];
        let constant = rng.bool();
        let mu: Vec<f64> = (0..self.pairs)
            .map(|_| if constant { most } else { most * between(rng, 0.1, 1.0) })
            .collect();
        let (gap, gaps) = self.gaps(rng);
        let (slip, slips) = self.slips(rng);
        let name = format!(
            "{:?} {} mu {most}{} gaps {gaps} slips {slips}",
            self.support,
            self.pairs,
            if constant { "" } else { " random" }
        );
        Case { load, gap, mu, slip, name }
    }

    fn gaps(&self, rng: &mut Rng) -> (Vec<f64>, &'static str) {
        let n = self.pairs;
        let random = |rng: &mut Rng, low: f64| -> Vec<f64> {
            (0..n).map(|_| MOVED * (low + (1.0 - low) * rng.f64()) / 10.0).collect()
        };
        match rng.usize(..5) {
            0 => (vec![0.0; n], "zero"),
            1 => {
                let waves = (1 + rng.usize(..8)) as f64;
                let turn = std::f64::consts::TAU * waves / (n - 1) as f64;
                let gap = (0..n).map(|i| MOVED / 5.0 * (1.0 - (turn * i as f64).cos()));
                (gap.collect(), "wavy")
            }
            2 => (random(rng, 0.0), "random"),
            3 => (random(rng, -0.5), "partly negative"),
            _ => {
                let mut gap = random(rng, 0.0);
                for gap in gap.iter_mut().filter(|_| rng.usize(..4) == 0) {
                    *gap = f64::INFINITY;
                }
                // The ends keep their obstacles, so that loads never turn the body over.
                (gap[0], gap[n - 1]) = (0.0, 0.0);
                (gap, "partly infinite")
            }
        }
    }

    fn slips(&self, rng: &mut Rng) -> (Option<Vec<f64>>, &'static str) {
        let n = self.pairs;
        let step = |rng: &mut Rng| MOVED / 10.0 * (2.0 * rng.f64() - 1.0);
        match rng.usize(..3) {
            0 => (None, "zero"),
            1 => (Some((0..n).map(|_| step(rng)).collect()), "random"),
            _ => {
                let mut at = 0.0;
                let walk = (0..n).map(|_| {
                    at += step(rng) / (n as f64).sqrt();
                    at
                });
                (Some(walk.collect()), "walk")
            }
        }
    }
}
