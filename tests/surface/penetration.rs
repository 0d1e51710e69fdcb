//! The check after a solution: a cantilever that bends through what it is not paired with.

use crate::common::mesh::{Mesh, steps};
use crate::surfaces::{flat, line, steps as equal, unlimited};
use signorini::reduce::ContactPairs;
use signorini::surface::{
    Faces, KeptSurfaces, Master, Obstacle, Penetration, SurfacePairs, SurfaceSettings, Surfaces,
    pair_surfaces,
};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// Length of the beam, and the gap below it.
const LENGTH: f64 = 20.0;
const GAP: f64 = 6.0;

/// Bends of a beam that is clamped at x = 0 and loaded at its tip by a force: Euler and Bernoulli's, whose tip moves by
/// `tip`.
fn bend(x: f64, tip: f64) -> f64 {
    let s = x / LENGTH;
    -tip * s * s * (3.0 - s) / 2.0
}

/// A beam of the height 1 on y = 0, and a block below the gap, with pairs within a distance.
struct Beam {
    mesh: Mesh,
    first_of_block: usize,
    found: SurfacePairs,
    kept: KeptSurfaces,
}

/// The body below.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Below {
    Block,
    Plane,
    /// A rigid line with a node of its own at each end.
    Line,
}

const PLANE: Obstacle = Obstacle::Plane { point: [0.0, -GAP, 0.0], outward: [0.0, 1.0, 0.0] };

impl Beam {
    fn new(columns: usize, below: Below, search_distance: Option<f64>) -> Beam {
        let mut mesh = Mesh::default();
        let upper = mesh.block(&steps(0.0, LENGTH, columns), &steps(0.0, 1.0, 2), (1000.0, 0.0));
        let first_of_block = 2 * mesh.nodes.len();
        let lower = mesh.block(
            &steps(-1.0, 21.0, columns / 2 + 1),
            &steps(-GAP - 2.0, -GAP, 2),
            (1000.0, 0.0),
        );
        let faces = |row: Vec<usize>| row.windows(2).map(<[usize]>::to_vec).collect::<Vec<_>>();
        let (slave, mut master) = (faces(upper.row(0)), faces(lower.row(2)));
        master.iter_mut().for_each(|face| face.reverse());
        let ((start, nodes), (of_start, of_nodes)) = (flat(&slave), flat(&master));
        let slave = Faces { start: &start, nodes: &nodes };
        let master = Faces { start: &of_start, nodes: &of_nodes };
        let x = mesh.nodes.concat();
        let settings = &SurfaceSettings { search_distance, ..SurfaceSettings::default() };
        let (ends, line) = ([21.0, -GAP, -1.0, -GAP], Faces { start: &[0, 2], nodes: &[0, 1] });
        let master = match below {
            Below::Plane => Master::RigidShape(PLANE),
            Below::Block => Master::Faces(master),
            Below::Line => Master::RigidFaces { coordinates: &ends, faces: line },
        };
        let surfaces = Surfaces { dim: 2, coordinates: &x, slave, master };
        let found = pair_surfaces(&surfaces, settings, &mut unlimited()).unwrap();
        Beam { mesh, first_of_block, found, kept: KeptSurfaces::new(&surfaces, 0.0) }
    }

    /// The penetration after displacements of all degrees of freedom.
    fn after(&self, u: impl Fn(usize) -> f64) -> Penetration {
        let of_node = |node, axis| u(2 * node + axis);
        self.kept.penetration(&self.found, of_node, &mut unlimited()).unwrap()
    }

    /// The beam bends by Euler and Bernoulli's curve, the block moves by `block`.
    fn bent(&self, tip: f64, block: f64) -> Penetration {
        self.after(|dof| match (dof < self.first_of_block, dof % 2) {
            (true, 1) => bend(self.mesh.nodes[dof / 2][0], tip),
            (false, 1) => block,
            _ => 0.0,
        })
    }
}

/// Nothing holds the beam, and its tip passes through by what it bends more than the gap, at every size of elements. Before
/// the tip is there, nothing is told. Nodes and middles of faces are counted where the curve is below.
#[test]
fn what_nothing_holds_is_told_with_its_depth() {
    for columns in [2, 5, 20, 80] {
        for below in [Below::Block, Below::Plane, Below::Line] {
            let beam = Beam::new(columns, below, Some(1.0));
            assert!(beam.found.pairs.is_empty());
            for (tip, block) in [(0.0, 0.0), (5.999, 0.0), (7.0, 0.0), (9.0, 0.0), (6.5, 0.25)] {
                let context = format!("{columns}, {below:?}, {tip}");
                let found = beam.bent(tip, block);
                let level = -GAP + if below == Below::Block { block } else { 0.0 };
                let depth = level - bend(LENGTH, tip);
                if depth < 0.0 {
                    assert_eq!(found, Penetration::default(), "{context}");
                    continue;
                }
                let step = LENGTH / columns as f64;
                assert!((found.depth - depth).abs() < 1e-12 * GAP, "{context}: {found:?}, {depth}");
                assert_eq!((found.node, found.face), (Some(columns), columns - 1), "{context}");
                assert_eq!(found.master.is_none(), below == Below::Plane, "{context}");
                assert!((found.point[1] - bend(LENGTH, tip)).abs() < 1e-12, "{context}");
                let x = |k: usize| step * k as f64 / 2.0;
                let middle = |k: usize| match k % 2 {
                    0 => bend(x(k), tip),
                    _ => 0.5 * (bend(x(k - 1), tip) + bend(x(k + 1), tip)),
                };
                let count = (0..=2 * columns).filter(|&k| middle(k) < level).count();
                assert_eq!(found.count, count, "{context}");
            }
        }
    }
}

/// The solution of a beam that its pairs hold: nothing has passed through, although the same load bends it by 1.5 gaps
/// without them.
#[test]
fn where_contact_holds_nothing_is_told() {
    for (columns, below) in
        [10, 20, 40].into_iter().flat_map(|n| [(n, Below::Block), (n, Below::Plane)])
    {
        for distance in [Some(8.0), Some(1.0)] {
            let beam = Beam::new(columns, below, distance);
            let stiffness = beam.mesh.stiffness();
            let arrays = beam.found.rows();
            let pairs = ContactPairs {
                dim: 2,
                count: arrays.count,
                master_start: &arrays.master_start,
                masters: &arrays.masters,
                weights: &arrays.weights,
                normals: &arrays.normals,
                tangents: Some(&arrays.tangents),
                ..ContactPairs::default()
            };
            let clamped = (0..beam.mesh.nodes.len()).filter(|&node| {
                let [x, y] = beam.mesh.nodes[node];
                if y < -1.0 { y < -GAP - 1.5 } else { x == 0.0 && y > 0.0 }
            });
            let fixed: Vec<usize> = clamped.flat_map(|node| [2 * node, 2 * node + 1]).collect();
            let model = Model::sparse(&stiffness.view(), &fixed, &pairs).unwrap();
            // w = P L^3 / 3 E I with I = 1 / 12, but for what linear quadrilaterals are too stiff.
            let force = 1.5 * GAP * 3.0 * 1000.0 / 12.0 / LENGTH.powi(3);
            let mut load = vec![0.0; beam.mesh.size()];
            load[2 * columns + 1] = -4.0 * force;
            let case = LoadCase {
                load: &load,
                prescribed: None,
                gap: &arrays.gaps,
                law: FrictionLaw::Frictionless,
                reference_slip: None,
            };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            assert_eq!(solution.status, Status::Solved);
            let u = model.recover(Some(&load), None, &solution.d).unwrap();
            let found = beam.after(|dof| u[dof]);
            let context = format!("{columns}, {below:?}, {distance:?}: {found:?}");
            let tip = -u[2 * columns + 1];
            if distance == Some(8.0) {
                assert_eq!(found, Penetration::default(), "{context}");
                assert!(solution.certificate.force.iter().any(|force| *force < 0.0), "{context}");
            } else {
                assert!(tip > 1.2 * GAP, "{context}, {tip}");
                assert!(found.depth >= tip - GAP, "{context}, {tip}");
            }
        }
    }
}

/// A shape that is none, and displacements that are none, are refused by name.
#[test]
fn what_is_no_shape_is_refused() {
    let beam = Beam::new(4, Below::Plane, None);
    let outward = [0.0; 3];
    let nowhere = Obstacle::Plane { point: [0.0; 3], outward };
    let x = beam.mesh.nodes.concat();
    let slave = Faces { start: &[0, 2], nodes: &[0, 1] };
    let master = Master::RigidShape(nowhere);
    let kept = KeptSurfaces::new(&Surfaces { dim: 2, coordinates: &x, slave, master }, 0.0);
    let refused = kept.penetration(&beam.found, |_, _| 0.0, &mut unlimited()).unwrap_err();
    assert!(refused.to_string().contains("its outward direction is zero"), "{refused}");
    let refused = beam.kept.penetration(&beam.found, |_, _| f64::NAN, &mut unlimited());
    assert!(refused.unwrap_err().to_string().contains("not finite"));
}

/// Shells that are closer than half their thicknesses overlap, and a clearance lets middle surfaces pass by as much: over another
/// shell and over a plane. No pair is within the search distance.
#[test]
fn a_clearance_stands_between_surfaces() {
    let nodes = [[0.0, 0.5], [1.0, 0.5], [0.0, 0.0], [1.0, 0.0]];
    let slave = Faces { start: &[0, 2], nodes: &[0, 1] };
    let shell = Master::Faces(Faces { start: &[0, 2], nodes: &[3, 2] });
    let plane = Obstacle::Plane { point: [0.0; 3], outward: [0.0, 1.0, 0.0] };
    for (master, name) in [(shell, "shell"), (Master::RigidShape(plane), "plane")] {
        for (clearance, fall, depth) in [
            (-0.3, 0.1, 0.0),
            (-0.3, 0.4, 0.2),
            (0.0, 0.4, 0.0),
            (0.0, 0.7, 0.2),
            (0.3, 0.7, 0.0),
            (0.3, 1.0, 0.2),
        ] {
            let coordinates = &nodes.concat();
            let surfaces = Surfaces { dim: 2, coordinates, slave, master };
            let search_distance = Some(0.1);
            let settings = SurfaceSettings { search_distance, clearance, ..Default::default() };
            let found = pair_surfaces(&surfaces, &settings, &mut unlimited()).unwrap();
            assert!(found.pairs.is_empty());
            let kept = KeptSurfaces::new(&surfaces, clearance);
            let u = |node, axis| if node < 2 && axis == 1 { -fall } else { 0.0 };
            let passed = kept.penetration(&found, u, &mut unlimited()).unwrap();
            let context = format!("{name}, {clearance}, {fall}: {passed:?}");
            // Rounding of numbers of size one.
            assert!((passed.depth - depth).abs() < 1e-15, "{context}");
            assert_eq!(passed.count, if depth > 0.0 { 3 } else { 0 }, "{context}");
        }
    }
}

/// A slave line and a master line, paired within a distance, and what has passed through after displacements along y.
fn after(
    [slave, master]: [(&[f64], f64, bool); 2],
    search_distance: f64,
    u: impl Fn(bool, f64) -> f64,
) -> Penetration {
    let (mut nodes, mut faces) = (Vec::new(), Vec::new());
    for (x, height, is_below) in [slave, master] {
        let (places, mut list) = line(x, false, nodes.len());
        nodes.extend(places.into_iter().map(|[x, ..]| [x, height]));
        list.iter_mut().filter(|_| is_below).for_each(|face| face.reverse());
        faces.push(flat(&list));
    }
    let [(start, of_slave), (of_start, of_master)] = &faces[..] else { unreachable!() };
    let slaves = Faces { start, nodes: of_slave };
    let masters = Master::Faces(Faces { start: of_start, nodes: of_master });
    let coordinates = &nodes.concat();
    let surfaces = Surfaces { dim: 2, coordinates, slave: slaves, master: masters };
    let settings =
        SurfaceSettings { search_distance: Some(search_distance), ..SurfaceSettings::default() };
    let found = pair_surfaces(&surfaces, &settings, &mut unlimited()).unwrap();
    let moved = |node: usize, axis: usize| match axis {
        1 => u(node < slave.0.len(), nodes[node][0]),
        _ => 0.0,
    };
    let kept = KeptSurfaces::new(&surfaces, 0.0);
    kept.penetration(&found, moved, &mut unlimited()).unwrap()
}

/// The ground is the slave and reaches beyond the beam: the tip is over a face that is covered in part, between its nodes. It is
/// told with its depth at every size of faces, if it is deeper than a tenth of an element of the beam, by which pairs may let
/// it pass.
#[test]
fn a_tip_over_a_face_at_the_rim_is_told() {
    let beam = equal(0.0, LENGTH, 20);
    for (faces, end) in [1, 2, 3, 5, 7].into_iter().flat_map(|n| [20.5, 22.4, 26.0].map(|e| (n, e)))
    {
        let ground = equal(10.0, end, faces);
        let tip_after = |tip: f64| {
            let sides = [(&ground[..], 0.0, true), (&beam[..], GAP, false)];
            after(sides, 8.0, |is_ground, x| if is_ground { 0.0 } else { bend(x, tip) })
        };
        let context = format!("{faces}, {end}");
        assert_eq!(tip_after(GAP), Penetration::default(), "{context}");
        let found = tip_after(GAP + 1.5);
        assert!((found.depth - 1.5).abs() < 1e-12, "{context}: {found:?}");
        assert_eq!(found.node, Some(ground.len() + 20), "{context}: {found:?}");
        let over = (0..faces).find(|at| ground[at + 1] > LENGTH).unwrap();
        assert_eq!((found.face, found.master), (over, Some(19)), "{context}: {found:?}");
        assert!(found.count > 0 && found.point[1] == GAP + bend(LENGTH, GAP + 1.5), "{found:?}");
    }
}

/// A post that is narrower than half a face, between the nodes and the middle of it, passes into a beam without pairs.
#[test]
fn a_post_between_the_points_of_a_face_is_told() {
    let (beam, post) = (equal(0.0, LENGTH, 2), [13.1, 13.6]);
    for tip in [9.0, 12.0, 15.0] {
        let sides = [(&beam[..], GAP, false), (&post[..], 0.0, true)];
        let found = after(sides, 1.0, |is_beam, x| if is_beam { bend(x, tip) } else { 0.0 });
        // The face is straight between its nodes at half of the length and at its end.
        let height = |x: f64| {
            let part = (x - 10.0) / 10.0;
            GAP + (1.0 - part) * bend(10.0, tip) + part * bend(LENGTH, tip)
        };
        let depths = post.map(|x| -height(x));
        assert_eq!(found.count, depths.iter().filter(|depth| **depth > 0.0).count(), "{found:?}");
        let deepest = depths[1].max(0.0);
        assert!((found.depth - deepest).abs() < 1e-12, "{tip}: {found:?}, {deepest}");
        if deepest > 0.0 {
            assert_eq!((found.node, found.face, found.master), (Some(4), 1, Some(0)), "{found:?}");
        }
    }
}

/// The ground is the slave, wholly under the beam, and its faces are longer than the beam's: its pairs hold the beam in the mean. A
/// node of the beam that passes through between the nodes of a face is told with its depth.
#[test]
fn a_node_between_those_of_a_long_face_is_told() {
    let beam = equal(0.0, LENGTH, 20);
    for (faces, begin, over) in [(1, 2.0, 0), (2, 2.0, 1), (3, 5.0, 1), (4, 3.0, 2)] {
        let ground = equal(begin, LENGTH - 0.25, faces);
        let after_dent = |deepest: f64| {
            let sides = [(&ground[..], 0.0, true), (&beam[..], GAP, false)];
            after(sides, 8.0, |is_ground, x| match x {
                _ if is_ground => 0.0,
                13.0 => -deepest,
                _ => -0.5 * GAP,
            })
        };
        assert_eq!(after_dent(GAP), Penetration::default(), "{faces}");
        let found = after_dent(GAP + 1.5);
        assert!((found.depth - 1.5).abs() < 1e-12, "{faces}: {found:?}");
        assert_eq!((found.count, found.face), (1, over), "{faces}: {found:?}");
        assert_eq!(found.node, Some(ground.len() + 13), "{faces}: {found:?}");
    }
}

/// A line of 8 faces of length 1, inclined over a level one that it touches at its lower end, slides along itself: its pairs keep
/// their gaps, and the end is `t sin a` below, which is `t tan a` along its normal. It is told if the end is deeper than a tenth
/// of a face, by which pairs may let it pass.
#[test]
fn a_line_that_slides_along_itself_is_told_with_its_depth() {
    for (angle, slip) in
        [0.0_f64, 0.2, 0.5, 0.7].into_iter().flat_map(|a| [0.05, 0.3, 2.0].map(|t| (a, t)))
    {
        let (sin, cos) = angle.sin_cos();
        let upper = (0..=8).map(|at| [f64::from(at) * cos, f64::from(at) * sin]);
        let lower = (0..=8).map(|at| [2.0 * f64::from(at) - 4.0, 0.0]);
        let x: Vec<f64> = upper.chain(lower).flatten().collect();
        let slave: Vec<_> = (0..8).map(|at| vec![at, at + 1]).collect();
        let master: Vec<_> = (9..17).map(|at| vec![at + 1, at]).collect();
        let ((start, of_slave), (of_start, of_master)) = (flat(&slave), flat(&master));
        let surfaces = Surfaces {
            dim: 2,
            coordinates: &x,
            slave: Faces { start: &start, nodes: &of_slave },
            master: Master::Faces(Faces { start: &of_start, nodes: &of_master }),
        };
        let settings =
            SurfaceSettings { search_distance: Some(20.0), ..SurfaceSettings::default() };
        let found = pair_surfaces(&surfaces, &settings, &mut unlimited()).unwrap();
        assert_eq!(found.pairs.len(), 9);
        let along = [-slip * cos, -slip * sin];
        let u = |node: usize, axis: usize| if node < 9 { along[axis] } else { 0.0 };
        let passed = KeptSurfaces::new(&surfaces, 0.0).penetration(&found, u, &mut unlimited());
        let (passed, depth) = (passed.unwrap(), slip * angle.tan());
        let context = format!("{angle}, {slip}: {passed:?}");
        if depth < 0.1 {
            assert_eq!(passed, Penetration::default(), "{context}");
        } else {
            assert!((passed.depth - depth).abs() < 1e-12, "{context}");
            assert_eq!((passed.node, passed.face), (Some(0), 0), "{context}");
        }
    }
}
