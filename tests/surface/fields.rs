//! Fields and resultants of pairs from surfaces against sums over their rows, and files of meshes.

use std::fs;

use crate::common::folder::Folder;
use crate::surfaces::{Shape, Sheet, pair};
use fastrand::Rng;
use signorini::Argument;
use signorini::Error;
use signorini::file::{Field, Mesh, Values, write_vtu};
use signorini::surface::{NodeDofs, PairResults, Pairing, SurfacePairs, SurfaceSettings};

/// Two sheets on the unit square of other faces each, the slave's above.
fn found(shapes: [Shape; 2], pairing: Pairing) -> (Vec<[f64; 3]>, SurfacePairs) {
    let mut rng = Rng::with_seed(7);
    let unit = [[0.0, 1.0]; 2];
    let slave = Sheet::rectangle(shapes[0], [3, 4], unit, (0.25, &mut rng)).turned();
    let mut master = Sheet::rectangle(shapes[1], [4, 3], unit, (0.25, &mut rng));
    let first = slave.nodes.len();
    master.faces.iter_mut().flatten().for_each(|node| *node += first);
    let nodes = [slave.nodes, master.nodes].concat();
    let settings = SurfaceSettings { pairing, ..SurfaceSettings::default() };
    let pairs = pair(3, &nodes, [&slave.faces, &master.faces], &settings).unwrap();
    (nodes, pairs)
}

/// A force and a displacement of each pair that have nothing to do with each other.
fn random(pairs: &SurfacePairs) -> [Vec<f64>; 3] {
    let mut rng = Rng::with_seed(11);
    let mut numbers = |count: usize| (0..count).map(|_| rng.f64() - 0.5).collect();
    let count = pairs.pairs.len();
    [numbers(3 * count), numbers(3 * count), numbers(2 * count)]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The resultant is that of nodal forces by the rows, and on the master it is the opposite one.
#[test]
fn resultants_are_sums_of_nodal_forces() {
    for shapes in [[Shape::T3, Shape::Q4], [Shape::Q8, Shape::T6], [Shape::Q9, Shape::Quadratic]] {
        let (nodes, pairs) = found(shapes, Pairing::DualMortar);
        let [d, force, slip0] = random(&pairs);
        let results = PairResults { gap: None, reference_slip: Some(&slip0), d: &d, force: &force };
        let about = [0.3, -0.2, 2.0];
        let told = pairs.resultant(&results, &about).unwrap();
        let mut sums = [[0.0; 3]; 4];
        let mut work = 0.0;
        for (j, pair) in pairs.pairs.iter().enumerate() {
            let [f_n, f_1, f_2] = [0, 1, 2].map(|k| force[3 * j + k]);
            let [t_1, t_2] = pair.tangents;
            let acting = [0, 1, 2].map(|i| f_n * pair.normal[i] + f_1 * t_1[i] + f_2 * t_2[i]);
            for (side, weights) in [pair.slaves(), pair.masters()].into_iter().enumerate() {
                for &(node, weight) in weights {
                    let arm = [0, 1, 2].map(|i| weight * (nodes[node][i] - about[i]));
                    let moment = cross(arm, acting);
                    for i in 0..3 {
                        sums[2 * side][i] += weight * acting[i];
                        sums[2 * side + 1][i] += moment[i];
                    }
                }
            }
            work -= f_1 * (d[3 * j + 1] - slip0[2 * j]) + f_2 * (d[3 * j + 2] - slip0[2 * j + 1]);
        }
        // Rounding of sums of some hundred numbers of order 1, on both sides: flat surfaces that touch.
        for i in 0..3 {
            for (sum, own) in [(sums[0], told.force), (sums[2], told.force)] {
                assert!((sum[i] - own[i]).abs() < 1e-12, "{shapes:?}: {sum:?} {own:?}");
            }
            for sum in [sums[1], sums[3]] {
                assert!((sum[i] - told.moment[i]).abs() < 1e-11, "{shapes:?}: {sum:?} {told:?}");
            }
        }
        assert!((work - told.friction_work).abs() < 1e-13);
    }
}

/// A uniform traction is uniform at all nodes of both sides, of any faces: the means keep it.
#[test]
fn a_uniform_traction_is_uniform_everywhere() {
    for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
        for shapes in
            [[Shape::T3, Shape::Q9], [Shape::Quadratic, Shape::Q8], [Shape::Q4, Shape::T6]]
        {
            let (nodes, pairs) = found(shapes, pairing);
            let components = [-3.0, 0.5, -0.25];
            let force: Vec<f64> =
                pairs.pairs.iter().flat_map(|pair| components.map(|c| c * pair.area)).collect();
            let d = [0.125, 0.5, 0.25].repeat(pairs.pairs.len());
            let gap = vec![0.5; pairs.pairs.len()];
            let results =
                PairResults { gap: Some(&gap), reference_slip: None, d: &d, force: &force };
            let fields = pairs.fields(&results).unwrap();
            // Slave nodes may pass a node of the master by, but no integral over its faces does.
            let all = pairing == Pairing::DualMortar;
            assert!(!all || fields.nodes.len() == nodes.len(), "{shapes:?}");
            // The normal is -z: t1 = x and t2 = n x t1 = -y.
            let traction = [0.5, 0.25, 3.0];
            let slip = [0.5, -0.25, 0.0];
            for (k, node) in fields.nodes.iter().enumerate() {
                let sign =
                    if pairs.pairs.iter().any(|pair| pair.slave == *node) { 1.0 } else { -1.0 };
                assert!((fields.pressure[k] - 3.0).abs() < 1e-13);
                assert!((fields.clearance[k] - 0.375).abs() < 1e-13);
                for i in 0..3 {
                    assert!((fields.traction[3 * k + i] - sign * traction[i]).abs() < 1e-12);
                    assert!((fields.slip[3 * k + i] - sign * slip[i]).abs() < 1e-12);
                }
            }
        }
    }
}

/// A node of which a row has rounding alone has no pressure: it would be a number of chance.
#[test]
fn nodes_with_weights_of_rounding_have_no_fields() {
    let (_, mut pairs) = found([Shape::Q4, Shape::Q4], Pairing::DualMortar);
    let [d, force, slip0] = random(&pairs);
    let results = PairResults { gap: None, reference_slip: Some(&slip0), d: &d, force: &force };
    let before = pairs.fields(&results).unwrap();
    pairs.pairs[3].nodes.push((1000, 1e-13));
    assert_eq!(pairs.fields(&results).unwrap(), before);
}

/// Rows do not depend on the numbers of the degrees of freedom.
#[test]
fn degrees_of_freedom_follow_the_host() {
    let (nodes, pairs) = found([Shape::Q8, Shape::T3], Pairing::DualMortar);
    let rows = pairs.rows();
    let shells = pairs.rows_on(&NodeDofs::PerNode(6));
    let listed: Vec<usize> = (0..3 * nodes.len()).map(|dof| 6 * (dof / 3) + dof % 3).collect();
    assert_eq!(shells, pairs.rows_on(&NodeDofs::Listed(listed)));
    for (dof, shell) in rows.masters.iter().zip(&shells.masters) {
        assert_eq!(6 * (dof / 3) + dof % 3, *shell);
    }
    assert_eq!((&rows.weights, &rows.gaps), (&shells.weights, &shells.gaps));
}

#[test]
fn arrays_of_another_length_are_refused() {
    let (_, pairs) = found([Shape::T3, Shape::T3], Pairing::DualMortar);
    let [d, force, slip0] = random(&pairs);
    let good = PairResults { gap: None, reference_slip: Some(&slip0), d: &d, force: &force };
    let refused = |results: PairResults<'_>, wanted: Argument| match pairs.fields(&results) {
        Err(Error::Invalid { argument, .. }) => assert_eq!(argument, wanted),
        other => panic!("{wanted:?}: {other:?}"),
    };
    refused(PairResults { d: &d[1..], ..good }, Argument::Start);
    refused(PairResults { force: &force[1..], ..good }, Argument::Load);
    refused(PairResults { gap: Some(&d), ..good }, Argument::Gap);
    refused(PairResults { reference_slip: Some(&d), ..good }, Argument::ReferenceSlip);
    assert!(pairs.resultant(&good, &[0.0; 2]).is_err());
}

#[test]
fn entries_that_are_no_numbers_are_refused() {
    let (_, pairs) = found([Shape::T3, Shape::T3], Pairing::DualMortar);
    let [d, force, slip0] = random(&pairs);
    let gap = vec![f64::INFINITY; pairs.pairs.len()];
    let good = PairResults { gap: Some(&gap), reference_slip: Some(&slip0), d: &d, force: &force };
    assert!(pairs.fields(&good).is_ok());
    let wrong = |values: &[f64]| {
        let mut values = values.to_vec();
        values[1] = f64::NAN;
        values
    };
    let [gap, d, force, slip0] = [&gap, &d, &force, &slip0].map(|values| wrong(values));
    for (results, says) in [
        (PairResults { gap: Some(&gap), ..good }, "gap[1] is NaN, it must be a number or +inf"),
        (PairResults { d: &d, ..good }, "d[1] is not finite"),
        (PairResults { force: &force, ..good }, "F[1] is not finite"),
        (PairResults { reference_slip: Some(&slip0), ..good }, "slip0[1] is not finite"),
    ] {
        for error in
            [pairs.fields(&results).unwrap_err(), pairs.resultant(&results, &[0.0; 3]).unwrap_err()]
        {
            assert!(error.message().contains(says), "{error}");
        }
    }
    let error = pairs.resultant(&good, &[0.0, f64::NAN, 0.0]).unwrap_err();
    assert!(error.message().contains("point[1] is not finite"), "{error}");
}

/// VTK 9 wrote this for the same arrays in its own binary form without compression, but for white space.
#[test]
fn a_mesh_is_written_as_vtk_has_it() {
    let folder = Folder::new("vtu");
    let path = folder.0.join("line.vtu");
    let mesh = Mesh {
        dim: 2,
        coordinates: &[0.0, 0.0, 1.0, 2.0],
        types: &[3],
        start: &[0, 2],
        nodes: &[0, 1],
    };
    let fields = [
        Field { name: "a<b", values: Values::Scalars(&[1.0, f64::INFINITY]) },
        Field { name: "state", values: Values::Integers(&[-1, 2]) },
    ];
    write_vtu(&path, &mesh, &fields).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    for line in [
        "MAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAADwPwAAAAAAAABAAAAAAAAAAAA=",
        "EAAAAAAAAAAAAAAAAAAAAAEAAAAAAAAA",
        "AQAAAAAAAAAD",
        "EAAAAAAAAAAAAAAAAADwPwAAAAAAAPB/",
        "CAAAAAAAAAD/////AgAAAA==",
    ] {
        assert!(text.lines().any(|other| other == line), "{line} is not in\n{text}");
    }
    assert!(text.contains("Name=\"a&lt;b\" NumberOfComponents=\"1\""));
    let refused = |mesh: &Mesh<'_>, fields: &[Field<'_>], part: &str| {
        let error = write_vtu(&path, mesh, fields).unwrap_err();
        assert!(error.message().contains(part), "{error}");
    };
    refused(&Mesh { nodes: &[0, 2], ..mesh }, &[], "cell 0 has node 2");
    refused(&Mesh { types: &[5], ..mesh }, &[], "cell 0 has 2 nodes, no number of VTK's type 5");
    refused(&Mesh { start: &[0, 1], ..mesh }, &[], "cell_start ends with 1, cells have 2 nodes");
    refused(&Mesh { dim: 4, ..mesh }, &[], "dim is 4");
    let short = Field { name: "x", values: Values::Vectors(&[1.0]) };
    refused(&mesh, &[short], "field x has 1 entries, it needs 4");
    refused(&mesh, &[Field { name: "", values: Values::Scalars(&[]) }], "a name that is empty");
    // Nothing has changed by what was refused.
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
}
