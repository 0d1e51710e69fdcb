//! A second form of the relation between displacements and forces, behind the same certificate.
//!
//! A host has `K u = f + Bᵀ F` and `d = B u`. With a diagonal `D > 0`, `A = K + Bᵀ D B`, `G = B A⁻¹ Bᵀ`
//! and `d0 = B A⁻¹ f`, displacements and forces satisfy `(I - G D) d - G F = d0`, whether the rows of
//! `B` depend on each other or not. Scaled, with `S = D^½ G D^½`:
//!
//! ```text
//! (I - S) D^½ d - S D^-½ F = D^½ d0          that is (I - S) v + S P = q, up to gaps and slips
//! ```
//!
//! Rows that are independent have the stiffness form too, with `K_rel = G⁻¹ - D`.

use crate::common::dense::{Elimination, dot, largest, product};
use crate::common::problems::{uniform, vector};
use crate::general_rows::Host;
use fastrand::Rng;
use signorini::certificate::{Certificate, certify, certify_pair};
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Monitor, Relation, Settings, State, Status, solve,
};

/// Tolerance of a verdict. Candidates are solved to 1e-12; measured in the other form `eta` is larger
/// by the ratio of the blocks `D` and `K_rel` at most, which is below 100 here.
const TOLERANCE: f64 = 1e-9;

/// The data of a problem beside its relation.
#[derive(Clone)]
struct Contact {
    dim: usize,
    gap: Vec<f64>,
    mu: Vec<f64>,
    slip0: Vec<f64>,
}

impl Contact {
    fn random(rng: &mut Rng, dim: usize, pairs: usize) -> Contact {
        let number = |rng: &mut Rng, low: f64, high: f64| uniform(rng, low, high);
        let gap =
            |rng: &mut Rng| if rng.u8(0..8) == 0 { f64::INFINITY } else { number(rng, -0.3, 0.3) };
        Contact {
            dim,
            gap: (0..pairs).map(|_| gap(rng)).collect(),
            mu: (0..pairs).map(|_| number(rng, 0.05, 0.5)).collect(),
            slip0: (0..(dim - 1) * pairs).map(|_| number(rng, -0.2, 0.2)).collect(),
        }
    }

    fn doubled(&self) -> Contact {
        let twice = |values: &[f64], count: usize| [&values[..count], values].concat();
        Contact {
            dim: self.dim,
            gap: twice(&self.gap, 1),
            mu: twice(&self.mu, 1),
            slip0: twice(&self.slip0, self.dim - 1),
        }
    }

    fn on<R: Relation>(&self, relation: R) -> ContactProblem<'_, R> {
        let law = FrictionLaw::Coulomb(&self.mu);
        ContactProblem::with_relation(relation, self.dim, &self.gap, law, Some(&self.slip0))
            .expect("the data are valid")
    }

    /// Displacements, forces and states of the solution of the stiffness form.
    fn solved(&self, k: &[f64], load: &[f64]) -> Option<(Vec<f64>, Vec<f64>, Vec<State>)> {
        let problem = self.stiffness_form(k, load);
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve(&problem, &settings, None, monitor).expect("the settings fit");
        let Certificate { force, states, .. } = solution.certificate;
        (solution.status == Status::Solved).then_some((solution.d, force, states))
    }

    fn stiffness_form<'a>(&'a self, k: &'a [f64], load: &'a [f64]) -> ContactProblem<'a> {
        ContactProblem::new(ContactData {
            dim: self.dim,
            pairs: self.gap.len(),
            stiffness: k,
            ld: load.len(),
            load,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: Some(&self.slip0),
        })
        .expect("a stiffness of the form G⁻¹ - D")
    }
}

/// A problem with its solution: the host, its data of contact, and displacements, forces and states.
type Solved = (Host, Contact, Vec<f64>, Vec<f64>, Vec<State>);

/// Problems of one to four pairs that have a solution.
fn solved(rng: &mut Rng, count: usize) -> Vec<Solved> {
    let mut solved = Vec::new();
    while solved.len() < count {
        let dim = rng.usize(2..=3);
        let pairs = rng.usize(1..=4);
        let host = Host::random(rng, dim, pairs);
        let contact = Contact::random(rng, dim, pairs);
        let (k, load) = host.stiffness(dim);
        if let Some((d, force, states)) = contact.solved(&k, &load) {
            solved.push((host, contact, d, force, states));
        }
    }
    solved
}

/// `values` with one of them moved.
fn moved(rng: &mut Rng, values: &[f64], by: f64) -> Vec<f64> {
    let mut moved = values.to_vec();
    moved[rng.usize(..values.len())] += by;
    moved
}

#[test]
fn independent_rows_have_one_verdict_in_both_forms() {
    let rng = &mut Rng::with_seed(1);
    let mut refused = 0;
    for (host, contact, d, force, states) in solved(rng, 200) {
        let (k, load) = host.stiffness(contact.dim);
        let stiffness = contact.stiffness_form(&k, &load);
        let general = contact.on(host.general_rows(contact.dim));
        let certificate = certify_pair(&general, &d, &force);
        assert!(certificate.holds(TOLERANCE), "{certificate:?}");
        assert!(certify_pair(&stiffness, &d, &force).holds(TOLERANCE));
        assert!(certify(&stiffness, &d).holds(TOLERANCE));
        assert_eq!(certificate.states, states);
        for part in [1e-2, 1e-5] {
            // A displacement is moved by what changes its force as much as the force itself is moved.
            let size = part * largest(&load);
            let softest = (0..d.len()).map(|i| k[i * (d.len() + 1)]).fold(f64::INFINITY, f64::min);
            for (d, force) in [
                (moved(rng, &d, size / softest), force.clone()),
                (d.clone(), moved(rng, &force, size)),
            ] {
                let verdicts = [
                    certify_pair(&general, &d, &force).holds(TOLERANCE),
                    certify_pair(&stiffness, &d, &force).holds(TOLERANCE),
                ];
                assert_eq!(verdicts, [false, false], "{d:?} {force:?}");
                refused += 1;
            }
        }
    }
    assert_eq!(refused, 800);
}

#[test]
fn what_balances_a_force_along_the_rows_balances_it_in_the_host() {
    // The residual of a pair (d, F) is D G (K_rel d - f - F): zero together.
    let rng = &mut Rng::with_seed(2);
    for (host, contact, ..) in solved(rng, 50) {
        let (k, load) = host.stiffness(contact.dim);
        let n = load.len();
        let general = host.general_rows(contact.dim);
        let d = vector(rng, n);
        let mut force = product(&k, &d);
        force.iter_mut().zip(&load).for_each(|(force, load)| *force -= load);
        let size = largest(&force).max(largest(&general.load));
        // Condition numbers up to 1e4: twelve digits are left.
        assert!(largest(&general.residual(&d, &force)) <= 1e-11 * size);
    }
}

/// The candidate of the doubled problem in which the first copy carries `shares` of the force of the
/// pair, its normal and its tangential part.
fn split(dim: usize, force: &[f64], shares: (f64, f64)) -> Vec<f64> {
    let part = |i: usize| if i == 0 { shares.0 } else { shares.1 };
    let first = (0..dim).map(|i| part(i) * force[i]);
    let second = (0..dim).map(|i| (1.0 - part(i)) * force[i]);
    first.chain(second).chain(force[dim..].iter().copied()).collect()
}

#[test]
fn dependent_rows_are_certified_with_any_split_of_their_force() {
    let rng = &mut Rng::with_seed(3);
    let (mut sticking, mut slipping) = (0, 0);
    for (host, contact, d, force, states) in solved(rng, 300) {
        let dim = contact.dim;
        // A pair that carries a force worth splitting.
        if !(force[0] < -0.05 * largest(&force)) {
            continue;
        }
        let twice = host.doubled(dim);
        let (g, _) = twice.flexibility(&twice.diagonal(dim));
        let rank = Elimination::new(twice.rows.len(), &g).rank;
        assert_eq!(rank, twice.rows.len() - dim, "copies have no stiffness form");
        let doubled = contact.doubled();
        let problem = doubled.on(twice.general_rows(dim));
        let both = [&d[..dim], &d[..]].concat();
        let verdict = |d: &[f64], force: &[f64]| certify_pair(&problem, d, force).holds(TOLERANCE);
        for share in [0.5, 0.1, 0.999, rng.f64()] {
            let force = split(dim, &force, (share, share));
            assert!(verdict(&both, &force), "{:?}", certify_pair(&problem, &both, &force));
        }
        // One copy pulls, or both carry all, or nothing is carried.
        for share in [-0.01, 1.01, 2.0] {
            let force = split(dim, &force, (share, share));
            assert!(!verdict(&both, &force), "{:?}", certify_pair(&problem, &both, &force));
        }
        let whole = [&force[..dim], &force[..]].concat();
        assert!(!verdict(&both, &whole));
        let mut nothing = whole;
        nothing[..2 * dim].fill(0.0);
        assert!(!verdict(&both, &nothing));
        // One copy has moved, or both have.
        let mut apart = both.clone();
        apart[rng.usize(..dim)] -= 1e-4 * largest(&d);
        assert!(!verdict(&apart, &split(dim, &force, (0.5, 0.5))));
        let mut away = both.clone();
        away[0] -= 1e-4 * largest(&d);
        away[dim] = away[0];
        assert!(!verdict(&away, &split(dim, &force, (0.5, 0.5))));
        // The tangential force shared otherwise than the normal one: on the bound one copy exceeds its
        // cone; inside it there is room.
        let tangential = dot(&force[1..dim], &force[1..dim]).sqrt();
        let uneven = split(dim, &force, (0.5, 0.51));
        match states[0] {
            State::Slip => {
                slipping += 1;
                assert!(!verdict(&both, &uneven));
            }
            _ if tangential < 0.9 * contact.mu[0] * force[0].abs() => {
                sticking += 1;
                assert!(verdict(&both, &uneven));
            }
            _ => {}
        }
    }
    assert!(sticking > 10 && slipping > 50, "{sticking} sticking, {slipping} slipping");
}
