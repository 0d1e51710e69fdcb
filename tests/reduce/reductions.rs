//! Models of each kind tell of themselves: forces on the host's nodes, components that supports fix, what is
//! not symmetric, prescribed values that are alike, and the host's functions that it does not give.

use signorini::reduce::{self, ContactPairs, HostOperator, Indices, SparseMatrix, Triangle};
use signorini::{
    Argument, Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, Status,
};

/// Springs along each component; with an inverse alone.
struct Springs(Vec<f64>);

impl HostOperator for Springs {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        y.iter_mut().zip(x).zip(&self.0).for_each(|((y, x), k)| *y = k * x);
        Ok(())
    }

    fn has_inverse(&self) -> bool {
        true
    }

    fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        y.iter_mut().zip(x).zip(&self.0).for_each(|((y, x), k)| *y = x / k);
        Ok(())
    }
}

/// A host with solutions alone.
struct Held(Vec<f64>);

impl HostOperator for Held {
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        y.iter_mut().zip(x).zip(&self.0).for_each(|((y, x), k)| *y = k * x);
        Ok(())
    }

    fn has_held(&self) -> bool {
        true
    }

    fn held(&self, held: &reduce::Held<'_>, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
        let held = held.components;
        for (i, y) in y.iter_mut().enumerate() {
            *y = if held[i] { 0.0 } else { x[i] / self.0[i] };
        }
        Ok(())
    }
}

fn solve(model: &Model, load: &[f64], slip: Option<&[f64]>, mu: f64) -> Solution {
    let case = LoadCase {
        load,
        prescribed: None,
        gap: &vec![0.0; model.pairs()],
        law: FrictionLaw::Coulomb(&vec![mu; model.pairs()]),
        reference_slip: slip,
    };
    let settings = Settings::default();
    let solution = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

/// Two pairs on springs of their own: `d_n = 0` and `F_n = -f_n` where they are pressed, and a pair sticks where its
/// reference slip is. Models of a matrix, of products and inverses, and of products and solutions agree; a contact
/// force is the host's nodal force.
#[test]
fn pairs_on_springs_stick_at_their_reference_slip() {
    let k = [2.0, 3.0, 5.0, 7.0];
    let matrix: Vec<f64> = (0..16).map(|i| if i % 5 == 0 { k[i / 5] } else { 0.0 }).collect();
    let models = [
        Model::condensed(2, 2, &matrix, 4).unwrap(),
        Model::operator(2, 2, Box::new(Springs(k.to_vec())), None).unwrap(),
        Model::operator(2, 2, Box::new(Held(k.to_vec())), None).unwrap(),
    ];
    let (load, slip) = ([10.0, 1.0, 20.0, -2.0], [0.5, -0.25]);
    let expected = [-10.0, 0.5 * 3.0 - 1.0, -20.0, -0.25 * 7.0 + 2.0];
    for model in &models {
        let solution = solve(model, &load, Some(&slip), 0.5);
        let force = &solution.certificate.force;
        for (i, d) in [0.0, 0.5, 0.0, -0.25].into_iter().enumerate() {
            // A few roundings, or the tolerance of 1e-10 of the largest force of an iteration.
            assert!((solution.d[i] - d).abs() <= 2e-9, "{:?}", solution.d);
            assert!((force[i] - expected[i]).abs() <= 2e-9, "{force:?}");
        }
        assert_eq!(model.nodal_forces(force).unwrap(), *force);
        assert_eq!(model.recover(None, None, &solution.d).unwrap(), solution.d);
    }
    assert!(models[1].stiffness().is_empty() && models[2].stiffness().is_empty());
    // A function that is not given fails, if it is called.
    assert!(!Springs(vec![]).has_held() && !Held(vec![]).has_inverse());
    let nothing = reduce::Held { components: &[], springs: &[], changed: true };
    assert!(Springs(vec![]).held(&nothing, &[], &mut []).is_err());
    assert!(Held(vec![]).inverse(&[], &mut []).is_err());
}

/// The rounding that a certificate states is half a unit of the sizes of all terms of `K u`, relative to the larger
/// of loads and forces, times the bound on what the law makes of a change of the force: `2 + mu` on a disc. Of an
/// operator eight units of its components stand for the terms.
#[test]
fn rounding_is_half_a_unit_of_all_terms() {
    let norm = |values: &[f64]| values.iter().map(|v| v * v).sum::<f64>().sqrt();
    let check = |solution: &Solution, load: &[f64], terms: &[f64]| {
        let scale = norm(load).max(norm(&solution.certificate.force));
        let of_law = 2.0;
        let expected = of_law * f64::EPSILON / 2.0 * norm(terms) / scale;
        let error = (solution.certificate.rounding - expected).abs();
        assert!(error <= 1e-9 * expected, "{expected:e}: {:?}", solution.certificate);
    };
    let k = [2.0, 3e3, 5e-3, 7.0];
    let load = [-1.0, 4e3, -0.03, 2.0];
    let model = Model::operator(2, 2, Box::new(Springs(k.to_vec())), Some(&k)).unwrap();
    let solution = solve(&model, &load, None, 0.0);
    let terms: Vec<f64> = k.iter().zip(&solution.d).map(|(k, d)| 8.0 * k * d).collect();
    check(&solution, &load, &terms);

    // A node on an obstacle at y = 0 below it, tied to another node by springs of 1 and 2.
    let values = [3.0, -1.0, 5.0, -2.0, 4.0, 6.0];
    let matrix = SparseMatrix {
        size: 4,
        col_start: Indices::Wide(&[0, 2, 4, 5, 6]),
        row: Indices::Wide(&[0, 2, 1, 3, 2, 3]),
        values: &values,
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let pairs = ContactPairs {
        dim: 2,
        count: 1,
        slaves: &[0, 1],
        master_start: &[0, 0],
        masters: &[],
        weights: &[],
        normals: &[0.0, -1.0],
        tangents: None,
        ..ContactPairs::default()
    };
    let settings = Settings { full_space: true, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let model = Model::sparse_within(&matrix, &[], &pairs, None, monitor).unwrap();
    assert!(model.stiffness().is_empty());
    for load in [[2.0, 3.0, 0.0, 0.0], [-0.5, -3.0, 0.0, 0.0]] {
        let solution = solve(&model, &load, None, 0.0);
        let mut u = model.recover(Some(&load), None, &solution.d).unwrap();
        u.iter_mut().for_each(|u| *u = u.abs());
        let terms = [
            3.0 * u[0] + u[2],
            5.0 * u[1] + 2.0 * u[3],
            u[0] + 4.0 * u[2],
            2.0 * u[1] + 6.0 * u[3],
        ];
        check(&solution, &load, &terms);
    }
}

/// Nodes in the plane on springs along their axes; pairs of one slave and one master, normal -y.
struct Nodes<'a> {
    springs: &'a [f64],
    fixed: &'a [usize],
    /// Node of the slave and of the master.
    pairs: &'a [[usize; 2]],
    /// Signed weights in the place of a slave of its own.
    general: bool,
}

impl Nodes<'_> {
    fn model(&self) -> Model {
        let size = self.springs.len();
        let col_start: Vec<i64> = (0..=size as i64).collect();
        let row: Vec<i64> = (0..size as i64).collect();
        let matrix = SparseMatrix {
            size,
            col_start: Indices::Wide(&col_start),
            row: Indices::Wide(&row),
            values: self.springs,
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let dofs = |node: usize| [2 * node, 2 * node + 1];
        let count = self.pairs.len();
        let normals = [0.0, -1.0].repeat(count);
        let (slaves, masters, weights, start): (Vec<_>, Vec<_>, Vec<_>, Vec<_>) = if self.general {
            let masters = self.pairs.iter().flatten().flat_map(|&node| dofs(node)).collect();
            let weights = [1.0, -1.0].repeat(count);
            (vec![], masters, weights, (0..=count).map(|pair| 2 * pair).collect())
        } else {
            let slaves = self.pairs.iter().flat_map(|pair| dofs(pair[0])).collect();
            let masters = self.pairs.iter().flat_map(|pair| dofs(pair[1])).collect();
            (slaves, masters, vec![1.0; count], (0..=count).collect())
        };
        let pairs = ContactPairs {
            dim: 2,
            count,
            slaves: &slaves,
            master_start: &start,
            masters: &masters,
            weights: &weights,
            normals: &normals,
            tangents: None,
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, self.fixed, &pairs).unwrap()
    }
}

/// Along x the slave is fixed and the master is not: friction holds the master back, which a pull of 3 moves by
/// `(3 - mu p) / k` where the slave is pressed on it by `p`.
#[test]
fn a_master_slides_under_a_slave_that_is_held() {
    for general in [false, true] {
        let nodes =
            Nodes { springs: &[1.0, 2.0, 4.0, 2.0], fixed: &[0], pairs: &[[0, 1]], general };
        let model = nodes.model();
        // Pressed together by 8 on springs of 2 each: p = 8.
        let load = [0.0, -8.0, 3.0, 8.0];
        let solution = solve(&model, &load, None, 0.25);
        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let expected = [0.0, 0.0, 0.25, 0.0];
        for (u, expected) in u.iter().zip(expected) {
            assert!((u - expected).abs() <= 1e-9, "{general}: {u:?}");
        }
    }
}

/// Where supports hold both sides of a pair along x, its slip is zero and carries no force, whatever reference slip
/// is given there; the other pair sticks at its own. So in rows of slaves of their own and in general rows.
#[test]
fn a_reference_slip_counts_where_a_pair_can_slip() {
    for held in [0, 1] {
        for general in [false, true] {
            let fixed = [4 * held, 4 * held + 2];
            let nodes = Nodes {
                springs: &[1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0, 2.0],
                fixed: &fixed,
                pairs: &[[0, 1], [2, 3]],
                general,
            };
            let model = nodes.model();
            let load = [0.0, -8.0, 0.0, 8.0].repeat(2);
            let solution = solve(&model, &load, Some(&[0.5, 0.5]), 0.25);
            let slips = [solution.d[1].abs(), solution.d[3].abs()];
            let forces = [solution.certificate.force[1].abs(), solution.certificate.force[3].abs()];
            let free = 1 - held;
            assert_eq!((slips[held], forces[held]), (0.0, 0.0), "{general}: {:?}", solution.d);
            // Two springs of 1 in a row, stretched by 0.5.
            assert!((slips[free] - 0.5).abs() <= 1e-9, "{general}: {:?}", solution.d);
            assert!((forces[free] - 0.25).abs() <= 1e-9, "{general}: {forces:?}");
        }
    }
}

/// Both sides of a pair are fixed along x: prescribed values that are alike up to their rounding are taken, and
/// others are not, in all units.
#[test]
fn prescribed_values_are_alike_up_to_their_rounding() {
    let nodes =
        Nodes { springs: &[1.0, 2.0, 1.0, 2.0], fixed: &[0, 2], pairs: &[[0, 1]], general: false };
    let model = nodes.model();
    for unit in [1e-9, 1.0, 1e9] {
        let sum = unit * 0.1 + unit * 0.2;
        let accepted = |other: f64| {
            let case = LoadCase {
                load: &[0.0; 4],
                prescribed: Some(&[sum, other]),
                gap: &[0.0],
                law: FrictionLaw::Frictionless,
                reference_slip: None,
            };
            let settings = Settings::default();
            model.solve(&case, &settings, None, &mut Monitor::new(&settings, None))
        };
        assert!(accepted(0.3 * unit).is_ok() && accepted(sum * (1.0 + 4.0 * f64::EPSILON)).is_ok());
        match accepted(sum * (1.0 + 1e-9)) {
            Err(Error::Invalid { argument: Argument::Prescribed, message }) => {
                assert!(message.contains("pair 0"), "{message}");
            }
            other => panic!("{unit:e}: {other:?}"),
        }
    }
}

/// Entries that mirror each other differ by less than rounding of what their own rows resist, or are refused: beside
/// a stiff row as well as among soft ones.
#[test]
fn symmetry_is_judged_by_the_rows_of_an_entry() {
    let build = |stiffness: [f64; 4], (below, above): (f64, f64)| {
        let values = [stiffness[0], below, above, stiffness[1], stiffness[2], stiffness[3]];
        let matrix = SparseMatrix {
            size: 4,
            col_start: Indices::Wide(&[0, 2, 4, 5, 6]),
            row: Indices::Wide(&[0, 1, 0, 1, 2, 3]),
            values: &values,
            index_base: 0,
            triangle: Triangle::Full,
        };
        let pairs = ContactPairs {
            dim: 2,
            count: 1,
            slaves: &[2, 3],
            master_start: &[0, 0],
            masters: &[],
            weights: &[],
            normals: &[0.0, 1.0],
            tangents: None,
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &[], &pairs)
    };
    for unit in [1e-8, 1.0, 1e8] {
        for ratio in [1e-6, 1.0, 1e6] {
            // The root of both diagonals is the unit.
            let stiffness = [unit * ratio, unit / ratio, unit, unit];
            assert!(build(stiffness, (0.5 * unit, 0.5 * unit * (1.0 + 1e-13))).is_ok());
            match build(stiffness, (0.5 * unit, 0.5 * unit + 1e-4 * unit)) {
                Err(Error::Invalid { argument: Argument::Matrix, message }) => {
                    assert!(message.contains("not symmetric"), "{message}");
                }
                other => panic!("{unit:e}, {ratio:e}: {:?}", other.map(|_| "accepted")),
            }
        }
    }
}

/// An operator is as linear, symmetric and reproducible in all units as in one.
#[test]
fn operators_are_judged_alike_in_all_units() {
    /// `K` with a fault in the first row, of this size beside its entries.
    struct Faulty {
        unit: f64,
        unsymmetric: f64,
        affine: f64,
        irreproducible: f64,
        calls: std::sync::atomic::AtomicU32,
    }
    impl HostOperator for Faulty {
        fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
            let call = self.calls.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            for (i, y) in y.iter_mut().enumerate() {
                *y = self.unit
                    * (2.0 * x[i] + x[(i + 1) % x.len()] + x[(i + x.len() - 1) % x.len()]);
            }
            let moved = self.irreproducible * f64::from(call % 5);
            y[0] += self.unit * (self.unsymmetric * x[1] + self.affine + moved);
            Ok(())
        }

        fn has_inverse(&self) -> bool {
            true
        }

        fn inverse(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32> {
            y.iter_mut().zip(x).for_each(|(y, x)| *y = x / self.unit);
            Ok(())
        }
    }
    for unit in [1e-12, 1.0, 1e12] {
        let model = |[unsymmetric, affine, irreproducible]: [f64; 3]| {
            let faulty =
                Faulty { unit, unsymmetric, affine, irreproducible, calls: Default::default() };
            Model::operator(2, 3, Box::new(faulty), None)
        };
        // Rounding of a host's products may leave so much.
        assert!(model([0.0; 3]).is_ok() && model([1e-13; 3]).is_ok(), "{unit:e}");
        for (made, part) in [
            (model([1e-6, 0.0, 0.0]), "not symmetric"),
            (model([0.0, 1e-6, 0.0]), "not linear"),
            (model([0.0, 0.0, 1e-6]), "not reproducible"),
        ] {
            match made {
                Err(Error::Invalid { argument: Argument::Matrix, message }) => {
                    assert!(message.contains(part), "{unit:e}: {message}");
                }
                other => panic!("{unit:e}: {part}: {:?}", other.map(|_| "accepted")),
            }
        }
    }
}

/// A node on an obstacle, tied to another one by a spring of 1 along each axis; `ground` holds the other along x.
fn tied(ground: f64, general: bool) -> Result<Model, Error> {
    let values = [1.0, -1.0, 1.0, -1.0, 1.0 + ground, 2.0];
    let matrix = SparseMatrix {
        size: 4,
        col_start: Indices::Wide(&[0, 2, 4, 5, 6]),
        row: Indices::Wide(&[0, 2, 1, 3, 2, 3]),
        values: &values,
        index_base: 0,
        triangle: Triangle::Lower,
    };
    let slave = [0, 1];
    let pairs = ContactPairs {
        dim: 2,
        count: 1,
        slaves: if general { &[] } else { &slave },
        master_start: if general { &[0, 1] } else { &[0, 0] },
        masters: if general { &slave } else { &[] },
        weights: if general { &[1.0] } else { &[] },
        normals: &[0.0, -1.0],
        tangents: None,
        ..ContactPairs::default()
    };
    Model::sparse(&matrix, &[], &pairs)
}

/// Springs of 1 that hold each other leave a rounding of 4 halves of 2.2e-16 in the energy of their common motion:
/// from 3 to 100 times as much is unclear, below it is free, and a negative energy as large as that is refused.
#[test]
fn a_motion_is_free_held_unclear_or_refused() {
    for general in [false, true] {
        let message = |ground: f64| match tied(ground, general) {
            Err(Error::Invalid { argument: Argument::Matrix, message }) => message.to_string(),
            other => panic!("{ground:e}: {:?}", other.map(|_| "accepted")),
        };
        assert!(tied(0.0, general).is_ok() && tied(1e-12, general).is_ok());
        let moves = "it moves 2 of the degrees of freedom 0 to 2, most of all degree of freedom";
        let unclear = message(2e-14);
        let told = "the stiffness against a motion cannot be told from the rounding of K";
        assert!(unclear.contains(told) && unclear.contains(moves), "{unclear}");
        // Rows of general pairs may follow from others nearly.
        assert_eq!(unclear.contains("each other's slaves"), general, "{unclear}");
        let negative = message(-1e-12);
        assert!(negative.contains("the energy of a motion is negative"), "{negative}");
        assert!(negative.contains(moves), "{negative}");
    }
}

/// Signed weights of 1e6 sum to zero up to their rounding, or are refused.
#[test]
fn weights_sum_up_to_their_rounding() {
    let build = |other: f64| {
        let matrix = SparseMatrix {
            size: 4,
            col_start: Indices::Wide(&[0, 1, 2, 3, 4]),
            row: Indices::Wide(&[0, 1, 2, 3]),
            values: &[1.0; 4],
            index_base: 0,
            triangle: Triangle::Lower,
        };
        let pairs = ContactPairs {
            dim: 2,
            count: 1,
            slaves: &[],
            master_start: &[0, 2],
            masters: &[0, 1, 2, 3],
            weights: &[1e6, other],
            normals: &[0.0, -1.0],
            tangents: None,
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &[], &pairs)
    };
    assert!(build(-1e6).is_ok() && build(-1e6 * (1.0 + 1e-12)).is_ok());
    match build(-1e6 * (1.0 + 1e-8)) {
        Err(Error::Invalid { argument: Argument::Pairs, message }) => {
            assert!(message.contains("pair 0: its signed weights sum to"), "{message}");
        }
        other => panic!("{:?}", other.map(|_| "accepted")),
    }
}
