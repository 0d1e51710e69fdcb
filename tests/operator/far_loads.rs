//! Loads in full space that act far from the contact, or cancel there, beside the condensed form: the relative loads are
//! zero, or less than the rounding of all loads.
//!
//! Chains of nodes with the springs 1 between them, and 2 to the ground, have the matrix 4 on the diagonal and -1 beside it
//! along each axis. With `D_n` of `n` nodes, `U_n = det D_n = 4 U_(n-1) - U_(n-2)`, `U_0 = 1`, `U_1 = 4`, and a force 1 on one end moves the
//! other by `1 / U_n`.

use crate::common::dense::largest;
use crate::common::mesh::{Pairs, Stiffness};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status};

/// Chains in the plane one after the other, and a pair of one node with an obstacle along the first axis.
struct Chains {
    stiffness: Stiffness,
    load: Vec<f64>,
    node: usize,
}

impl Chains {
    fn new(lengths: &[usize], node: usize) -> Chains {
        let ends: Vec<usize> = lengths
            .iter()
            .scan(0, |end, length| {
                *end += length;
                Some(*end)
            })
            .collect();
        let nodes = lengths.iter().sum::<usize>();
        let mut stiffness =
            Stiffness { size: 2 * nodes, col_start: vec![0], row: Vec::new(), values: Vec::new() };
        for dof in 0..2 * nodes {
            let mut entry = |row: usize, value: f64| {
                stiffness.row.push(row as i64);
                stiffness.values.push(value);
            };
            entry(dof, 4.0);
            if !ends.contains(&(dof / 2 + 1)) {
                entry(dof + 2, -1.0);
            }
            stiffness.col_start.push(stiffness.row.len() as i64);
        }
        Chains { stiffness, load: vec![0.0; 2 * nodes], node }
    }

    fn model(&self, full_space: bool) -> Model {
        let settings = Settings { full_space, ..Settings::default() };
        let pairs = Pairs::on_obstacle(&[self.node], [1.0, 0.0]);
        let monitor = &mut Monitor::new(&settings, None);
        self.stiffness.model_under(&[], &pairs.view(), monitor).expect("a valid model")
    }

    /// The most that a node lacks to equilibrium, by the displacements that are recovered.
    fn lacking(&self, model: &Model, solution: &Solution) -> f64 {
        let u = model.recover(Some(&self.load), None, &solution.d).unwrap();
        let forces = model.nodal_forces(&solution.certificate.force).unwrap();
        let sums = self.stiffness.times(&u);
        largest(&(0..u.len()).map(|i| sums[i] - self.load[i] - forces[i]).collect::<Vec<f64>>())
    }

    fn case<'a>(&'a self, gap: &'a f64, law: FrictionLaw<'a>) -> LoadCase<'a> {
        let gap = std::slice::from_ref(gap);
        LoadCase { load: &self.load, prescribed: None, gap, law, reference_slip: None }
    }

    /// The solutions in full space and condensed, each in equilibrium to the rounding of a few sums of all loads.
    fn solved(&self, gap: f64, law: FrictionLaw<'_>) -> [Solution; 2] {
        [true, false].map(|full_space| {
            let (model, settings) = (self.model(full_space), Settings::default());
            let case = self.case(&gap, law);
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            let context = format!("gap {gap}, full space {full_space}: {}", solution.message);
            assert_eq!(solution.status, Status::Solved, "{context}");
            let lacking = self.lacking(&model, &solution);
            assert!(lacking <= 1e-14 * largest(&self.load), "{context}: {lacking:e} lacks");
            solution
        })
    }
}

const MU: FrictionLaw<'_> = FrictionLaw::Coulomb(&[0.3]);

/// The loads act on the second body alone: the pair of the first stays where it is, and carries nothing.
#[test]
fn loads_on_a_body_without_contact_move_no_pair() {
    let mut chains = Chains::new(&[5, 7], 0);
    for size in [1.0, 1e-6, 1e9] {
        (10..24).for_each(|dof| chains.load[dof] = size * (dof as f64).sin());
        for gap in [0.0, 0.1, f64::INFINITY] {
            for law in [FrictionLaw::Coulomb(&[0.0]), MU, FrictionLaw::Tresca(&[1.0])] {
                for solution in chains.solved(gap, law) {
                    assert_eq!(solution.d, [0.0; 2]);
                    assert_eq!(solution.certificate.force, [0.0; 2]);
                }
            }
        }
    }
}

/// The load `(1, 1/2)` acts on the last node and the pair is that of the first. Held it carries `-(1, 1/2) / U_(n-1)`, free it moves by
/// `(1, 1/2) / U_n`, and where it slips with the coefficient 3/10 by `1/5 / U_n`. Both forms find that to the tolerance of
/// the forces, or of the rounding of all loads where that is more.
#[test]
fn loads_that_fade_towards_the_contact_are_solved() {
    let (mut before, mut last) = (1.0_f64, 4.0_f64);
    for nodes in 2..=40 {
        (before, last) = (last, 4.0 * last - before);
        let mut chains = Chains::new(&[nodes], 0);
        chains.load[2 * nodes - 2..].copy_from_slice(&[1.0, 0.5]);
        let bound = 1e-10 * (before.recip() + 4.0 * f64::EPSILON);
        let free = [1.0 / last, 0.5 / last, 0.0, 0.0];
        let held = [0.0, 0.2 / last, -1.0 / before, -0.3 / before];
        for (gap, wanted) in [(f64::INFINITY, free), (0.0, held)] {
            for solution in chains.solved(gap, MU) {
                let found = [&solution.d[..], &solution.certificate.force].concat();
                let apart = found.iter().zip(wanted).map(|(found, wanted)| found - wanted);
                let apart = largest(&apart.collect::<Vec<f64>>());
                assert!(apart <= bound, "{nodes} nodes, gap {gap}: {found:?} {wanted:?}");
            }
        }
    }
}

/// The loads are those of displacements, whole numbers, that are zero at the pair in the middle, and opposite beside it: what
/// is left of them there is rounding.
#[test]
fn loads_that_cancel_at_the_contact_are_solved() {
    for nodes in [7, 15, 31] {
        let mut chains = Chains::new(&[nodes], nodes / 2);
        let mut wanted: Vec<f64> = (0..2 * nodes).map(|dof| (7 * dof % 11) as f64 - 5.0).collect();
        let pair = 2 * (nodes / 2);
        wanted[pair..pair + 2].copy_from_slice(&[0.0; 2]);
        for axis in 0..2 {
            wanted[pair + 2 + axis] = -wanted[pair - 2 + axis];
        }
        chains.load = chains.stiffness.times(&wanted);
        let rounding = 8.0 * f64::EPSILON * largest(&chains.load);
        for gap in [0.0, 0.1, f64::INFINITY] {
            for solution in chains.solved(gap, MU) {
                let force = &solution.certificate.force;
                assert!(largest(&solution.d) <= rounding, "{nodes} nodes: {:?}", solution.d);
                assert!(largest(force) <= rounding, "{nodes} nodes: {force:?}");
            }
        }
    }
}

/// Displacements whose forces are a part of the rounding of all loads are told from those of the solution.
#[test]
fn forces_below_the_rounding_of_the_loads_are_seen() {
    let mut chains = Chains::new(&[5, 7], 0);
    chains.load[20] = 1.0;
    let model = chains.model(true);
    for gap in [0.0, f64::INFINITY] {
        let holds = |d: [f64; 2]| {
            model.certify(&chains.case(&gap, MU), &d).unwrap().holds(Settings::default().tolerance)
        };
        assert!(holds([0.0; 2]));
        for off in [1e-22, 1e-18, 1e-9] {
            assert!(!holds([-off, 0.0]) && !holds([0.0, off]) && !holds([off, -off]), "{off:e}");
        }
    }
}
