//! Zones in one set of pairs: the rows of each, what each carries, and what cannot be joined.

use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets, flat, line, nodal_forces, pair, steps};
use fastrand::Rng;
use signorini::surface::{
    ContactZone, Faces, Joined, PairResults, SurfacePair, SurfacePairs, SurfaceSettings,
    SymmetryPlane, join_zones,
};

/// Lines of elements from 0 to 1 at two heights, the upper one looking down, each the nodes of a mesh of its own.
struct Lines {
    nodes: Vec<[f64; 3]>,
    upper: Vec<Vec<usize>>,
    lower: Vec<Vec<usize>>,
}

impl Lines {
    /// The lower line at 0 with `cells` elements, the upper one at `gap` with one more.
    fn new(cells: usize, gap: f64) -> Lines {
        let (mut nodes, upper) = line(&steps(0.0, 1.0, cells + 1), false, 0);
        nodes.iter_mut().for_each(|node| node[1] = gap);
        let (below, mut lower) = line(&steps(0.0, 1.0, cells), false, nodes.len());
        lower.iter_mut().for_each(|face| face.swap(0, 1));
        nodes.extend(below);
        Lines { nodes, upper, lower }
    }

    fn pairs(
        &self,
        slave: &[Vec<usize>],
        master: &[Vec<usize>],
        axisymmetric: bool,
    ) -> SurfacePairs {
        let settings = SurfaceSettings { axisymmetric, ..SurfaceSettings::default() };
        pair(2, &self.nodes, [slave, master], &settings).unwrap()
    }
}

/// The pairs are those of the zones one after the other. Under the pressure 3 on the first and 5 on the second zone each
/// carries its pressure times its area, which is 1.
#[test]
fn joined_zones_are_their_pairs_one_after_the_other() {
    let lines = Lines::new(3, 0.25);
    let (upper, lower) = (flat(&lines.upper), flat(&lines.lower));
    let down = lines.pairs(&lines.upper, &lines.lower, false);
    let up = lines.pairs(&lines.lower, &lines.upper, false);
    let zones = [
        ContactZone {
            name: "down",
            contact: &down,
            slave: Faces { start: &upper.0, nodes: &upper.1 },
        },
        ContactZone { name: "up", contact: &up, slave: Faces { start: &lower.0, nodes: &lower.1 } },
    ];
    let Joined { contact: joined, starts } = join_zones(&zones).unwrap();
    assert_eq!(starts, [0, 5, 9]);
    let first = down.pairs.len();
    assert_eq!(joined.pairs, [&down.pairs[..], &up.pairs].concat());
    assert_eq!((first, joined.pairs.len()), (5, 9));
    assert_eq!((joined.report.slave_faces, joined.report.uncovered_faces.len()), (7, 0));
    assert!((joined.report.covered_area - 2.0).abs() < 1e-14);

    let pressure = |j: usize| if j < first { 3.0 } else { 5.0 };
    let normal = |(j, pair): (usize, &SurfacePair)| [-pressure(j) * pair.area, 0.0];
    let force: Vec<f64> = joined.pairs.iter().enumerate().flat_map(normal).collect();
    let d = vec![0.0; force.len()];
    let results = PairResults { gap: None, reference_slip: None, d: &d, force: &force };
    for (pairs, pressure, direction) in [(0..first, 3.0, 1.0), (first..9, 5.0, -1.0)] {
        let sums = joined.resultant_of(pairs, &results, &[0.0; 2]).unwrap();
        assert!((sums.largest_pressure - pressure).abs() < 1e-12);
        assert!((sums.pressed_area - 1.0).abs() < 1e-14);
        // Down is the outward normal of the upper line, and it is pushed up.
        assert!((sums.force[1] - direction * pressure).abs() < 1e-12);
    }
    let summary = join_zones(&zones).unwrap().summary(&zones).to_string();
    assert!(
        summary.starts_with("down: 5 pairs on 100.00 %") && summary.contains(". up: 4 pairs on"),
        "{summary}"
    );
    assert!(!summary.contains("cut"), "{summary}");
}

#[test]
fn zones_that_cannot_be_joined_are_named() {
    let (lines, high) = (Lines::new(2, 0.1), Lines::new(2, 0.2));
    let faces = flat(&lines.upper);
    let slave = Faces { start: &faces.0, nodes: &faces.1 };
    let contact = lines.pairs(&lines.upper, &lines.lower, false);
    let of_rings = high.pairs(&high.upper, &high.lower, true);
    let nothing = SurfacePairs { pairs: Vec::new(), ..contact.clone() };
    let in_space = SurfacePairs { dim: 3, ..SurfacePairs::default() };
    let no_faces = Faces { start: &[0], nodes: &[] };
    let zone = |name, contact, slave| ContactZone { name, contact, slave };
    let one = zone("one", &contact, slave);
    for (other, words) in [
        (zone("one", &contact, no_faces), "two zones are named 'one': give each a name"),
        (zone("", &contact, no_faces), "zone 1 has no name"),
        (zone("a\nb", &contact, no_faces), "the name of zone 1 has a control character"),
        (zone("two", &in_space, no_faces), "zone 'two' is in 3 dimensions, unlike zone 'one'"),
        (
            zone("two", &of_rings, no_faces),
            "zone 'two' is a body of revolution, and zone 'one' is in the plane: give axisymmetric alike",
        ),
        (
            zone("two", &contact, slave),
            "slave face 0 of zone 'two' is slave face 0 of zone 'one', and both have a pair of node 0",
        ),
    ] {
        let error = join_zones(&[one, other]).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
    assert!(join_zones(&[]).is_err());
    let rings = zone("rings", &of_rings, no_faces);
    let error = join_zones(&[rings, one]).expect_err("not both").to_string();
    assert!(error.contains("zone 'one' is in the plane, and zone 'rings' is a body of revolution"));
    // The other side of the faces, as of a shell between two bodies: their normals are opposite.
    let mut other_side = contact.clone();
    other_side.pairs.iter_mut().for_each(|pair| pair.normal = pair.normal.map(|n| -n));
    let both = join_zones(&[one, zone("two", &other_side, slave)]).expect("a shell").contact.pairs;
    assert_eq!(both, [contact.pairs.clone(), other_side.pairs.clone()].concat());
    // The same side twice, of which one zone has found nothing.
    let found = join_zones(&[one, zone("two", &nothing, slave)]).unwrap().contact;
    assert_eq!((found.pairs, found.unpaired), (contact.pairs, contact.unpaired));
}

/// The slave and the master faces of a zone.
pub type Sides = [Vec<Vec<usize>>; 2];

/// Pairs zones, and joins them.
pub fn paired(
    dim: usize,
    nodes: &[[f64; 3]],
    zones: &[Sides],
    settings: &SurfaceSettings,
) -> Joined {
    let found = |[slave, master]: &Sides| pair(dim, nodes, [slave, master], settings).unwrap();
    let contacts: Vec<SurfacePairs> = zones.iter().map(found).collect();
    let lists: Vec<_> = zones.iter().map(|[slave, _]| flat(slave)).collect();
    let mut zones = Vec::new();
    for ((name, contact), (start, nodes)) in ["a", "b", "c", "d"].iter().zip(&contacts).zip(&lists)
    {
        zones.push(ContactZone { name, contact, slave: Faces { start, nodes } });
    }
    join_zones(&zones).unwrap()
}

/// The faces of each part: those of either side of `x = 1`, or of `y = 1` too.
pub fn cut(faces: &[Vec<usize>], nodes: &[[f64; 3]], in_four: bool) -> Vec<Vec<Vec<usize>>> {
    let mut parts = vec![Vec::new(); if in_four { 4 } else { 2 }];
    for face in faces {
        let mean = |axis: usize| -> f64 {
            face.iter().map(|&node| nodes[node][axis]).sum::<f64>() / face.len() as f64
        };
        let beyond = |axis: usize| usize::from(mean(axis) > 1.0);
        parts[beyond(0) + if in_four { 2 * beyond(1) } else { 0 }].push(face.clone());
    }
    parts
}

/// Each node has one pair, which is that of the whole: a row of dual mortar is a sum over the faces at its node.
fn assert_like(joined: &SurfacePairs, whole: &SurfacePairs, context: &str) {
    let mut pairs: Vec<&SurfacePair> = joined.pairs.iter().collect();
    pairs.sort_by_key(|pair| pair.slave);
    assert_eq!(pairs.len(), whole.pairs.len(), "{context}");
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13);
    for (own, expected) in pairs.into_iter().zip(&whole.pairs) {
        let context = format!("{context}: {own:?} is not {expected:?}");
        assert_eq!(own.slave, expected.slave, "{context}");
        assert_eq!(own.slave_count, expected.slave_count, "{context}");
        let [a, b]: [(Vec<usize>, Vec<f64>); 2] =
            [own, expected].map(|pair| pair.nodes.iter().copied().unzip());
        assert_eq!(a.0, b.0, "{context}");
        assert!(near(&a.1, &b.1), "{context}");
        assert!(near(&own.normal, &expected.normal) && near(&own.point, &expected.point));
        assert!(near(&own.tangents[0], &expected.tangents[0]), "{context}");
        assert!(near(&own.tangents[1], &expected.tangents[1]), "{context}");
        let [a, b] = [own, expected].map(|pair| [pair.gap, pair.measured_gap, pair.area]);
        assert!(near(&a, &b), "{context}");
    }
    assert_eq!((&joined.unpaired, &joined.held), (&whole.unpaired, &whole.held), "{context}");
}

/// A flat surface over a tilted one whose mesh does not match, cut in two and in four, which meet in a node: with all
/// masters, and where a line of both meshes runs along the cut with those of each part; at a plane of symmetry too. Faces of
/// two kinds at an edge share its control values in the whole alone.
#[test]
fn zones_that_cut_a_surface_have_the_pairs_of_the_whole() {
    let mut rng = Rng::with_seed(7);
    let square = [[0.0, 2.0]; 2];
    let of_own_kind = |shape: &Shape| !matches!(shape, Shape::Full | Shape::Eight);
    for shape in SHAPES.into_iter().filter(of_own_kind) {
        for (distortion, cells) in [(0.0, 6), (0.2, 3), (0.2, 5)] {
            let slave = Sheet::rectangle(shape, [4; 2], square, (0.0, &mut rng));
            let slave = slave.mapped(|x| [x[0], x[1], 0.1]).turned();
            let master = Sheet::rectangle(shape, [cells; 2], square, (distortion, &mut rng));
            let both = TwoSheets::new(3, slave, master.mapped(|x| [x[0], x[1], -0.05 * x[0]]));
            for symmetry in [Vec::new(), vec![SymmetryPlane::across(1, 0.0)]] {
                let settings = SurfaceSettings { symmetry, ..SurfaceSettings::default() };
                let whole = both.pair(&settings).unwrap();
                for in_four in [false, true] {
                    let slaves = cut(&both.slave, &both.nodes, in_four);
                    let masters = match distortion {
                        0.0 => cut(&both.master, &both.nodes, in_four),
                        _ => vec![both.master.clone(); slaves.len()],
                    };
                    let zones: Vec<Sides> =
                        slaves.into_iter().zip(masters).map(Sides::from).collect();
                    let joined = paired(3, &both.nodes, &zones, &settings);
                    let context = format!("{shape:?}, {cells}, {in_four}, {settings:?}");
                    assert_like(&joined.contact, &whole, &context);
                }
            }
        }
    }
}

/// Lines, and meridians of bodies of revolution from their axis on.
#[test]
fn zones_that_cut_a_line_have_the_pairs_of_the_whole() {
    for (quadratic, axisymmetric) in [(false, false), (true, false), (false, true), (true, true)] {
        let (mut nodes, slave) = line(&steps(0.0, 2.0, 4), quadratic, 0);
        nodes.iter_mut().for_each(|x| x[1] = 0.1);
        let (below, mut master) = line(&steps(0.0, 2.0, 5), quadratic, nodes.len());
        master.iter_mut().for_each(|face| face.swap(0, 1));
        nodes.extend(below);
        let settings = SurfaceSettings { axisymmetric, ..SurfaceSettings::default() };
        let whole = pair(2, &nodes, [&slave, &master], &settings).unwrap();
        let zones: Vec<Sides> =
            cut(&slave, &nodes, false).into_iter().map(|part| [part, master.clone()]).collect();
        let joined = paired(2, &nodes, &zones, &settings);
        assert_eq!(joined.starts[2], whole.pairs.len());
        assert_like(&joined.contact, &whole, &format!("{quadratic}, {axisymmetric}"));
    }
}

/// A master that ends under the slave, so that nodes are folded, in each zone on its own: a uniform pressure still passes,
/// as it does in the whole.
#[test]
fn zones_pass_a_uniform_pressure_where_nodes_are_folded() {
    let mut rng = Rng::with_seed(8);
    for shape in SHAPES {
        for end in [1.1, 1.6] {
            let slave = Sheet::rectangle(shape, [4; 2], [[0.0, 2.0]; 2], (0.2, &mut rng));
            let master = Sheet::rectangle(shape, [3, 5], [[0.0, end], [0.0, 1.3]], (0.2, &mut rng));
            let both = TwoSheets::new(3, slave.turned(), master);
            let settings = SurfaceSettings::default();
            let whole = both.pair(&settings).unwrap();
            for in_four in [false, true] {
                let slaves = cut(&both.slave, &both.nodes, in_four);
                let zones: Vec<Sides> =
                    slaves.into_iter().map(|part| [part, both.master.clone()]).collect();
                let joined = paired(3, &both.nodes, &zones, &settings).contact;
                let [own, expected] =
                    [&joined, &whole].map(|found| nodal_forces(found, both.nodes.len(), 1.0));
                for &node in both.master.iter().flatten() {
                    let (own, expected) = (own[node][2], expected[node][2]);
                    assert!((own - expected).abs() < 1e-12, "{shape:?}, {end}, {node}");
                }
                let mut nodes: Vec<usize> = joined.pairs.iter().map(|pair| pair.slave).collect();
                nodes.sort_unstable();
                assert!(nodes.windows(2).all(|two| two[0] < two[1]), "one pair each");
            }
        }
    }
}

/// Four zones of a bowl meet in a node. Each zone has another mean normal there; the sum does not depend on their order, and its
/// first tangent is the part of the direction asked for.
#[test]
fn the_order_of_zones_changes_no_pair() {
    let mut rng = Rng::with_seed(9);
    let bowl = |x: [f64; 2], z: f64| [x[0], x[1], z + 0.1 * (x[0] * x[0] + 2.0 * x[1] * x[1])];
    for shape in SHAPES {
        let slave = Sheet::rectangle(shape, [4; 2], [[0.0, 2.0]; 2], (0.2, &mut rng));
        let slave = slave.mapped(|x| bowl([x[0], x[1]], 0.01)).turned();
        let master = Sheet::rectangle(shape, [5; 2], [[0.0, 2.0]; 2], (0.2, &mut rng));
        let both = TwoSheets::new(3, slave, master.mapped(|x| bowl([x[0], x[1]], 0.0)));
        let mut zones: Vec<Sides> = Vec::new();
        for part in cut(&both.slave, &both.nodes, true) {
            zones.push([part, both.master.clone()]);
        }
        let towards = [1.0, 0.3, 0.2];
        let tangent = Some(towards);
        let settings = SurfaceSettings { tangent, ..SurfaceSettings::default() };
        let sorted = |zones: &[Sides]| {
            let mut pairs = paired(3, &both.nodes, zones, &settings).contact.pairs;
            pairs.sort_by_key(|pair| pair.slave);
            pairs
        };
        let expected = sorted(&zones);
        zones.swap(0, 3);
        zones.swap(1, 3);
        for (pair, expected) in sorted(&zones).iter().zip(&expected) {
            assert_eq!(pair.slave, expected.slave);
            // Rounding of sums of four numbers of size one.
            let is_near = |a: f64, b: f64| (a - b).abs() < 1e-14;
            let same = pair.normal.iter().zip(&expected.normal).all(|(a, b)| is_near(*a, *b));
            assert!(same && is_near(pair.gap, expected.gap), "{shape:?}: {pair:?}, {expected:?}");
            let dot = |a: [f64; 3], b: [f64; 3]| a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>();
            let along = dot(towards, pair.normal);
            let part: [f64; 3] = std::array::from_fn(|i| towards[i] - along * pair.normal[i]);
            let length = dot(part, part).sqrt();
            assert!((0..3).all(|i| is_near(part[i] / length, pair.tangents[0][i])), "{pair:?}");
            let nodes = pair.nodes.iter().zip(&expected.nodes);
            assert!(nodes.into_iter().all(|(a, b)| a.0 == b.0 && is_near(a.1, b.1)), "{shape:?}");
        }
    }
}

/// A master whose slanted end crosses the cut: the node at the end of the cut is wholly covered in one zone, and in the other, where
/// less than half of it is, in the pair of its neighbour. The summary tells. Over a master that goes on nothing is folded.
#[test]
fn nodes_that_are_folded_in_one_zone_alone_are_told() {
    let mut rng = Rng::with_seed(10);
    let slave = Sheet::rectangle(Shape::Q4, [4; 2], [[0.0, 2.0]; 2], (0.0, &mut rng));
    for (end, told) in [(1.05, true), (2.0, false)] {
        let master = Sheet::rectangle(Shape::Q4, [2; 2], [[0.0, 1.0], [0.0, 2.0]], (0.0, &mut rng));
        let slanted = master.mapped(|x| [x[0] * (end + 0.3 * x[1]), x[1], x[2]]);
        let both = TwoSheets::new(3, slave.clone().turned(), slanted);
        let parts = cut(&both.slave, &both.nodes, false);
        let zones: Vec<Sides> = parts.into_iter().map(|part| [part, both.master.clone()]).collect();
        let settings = SurfaceSettings::default();
        let found =
            |[slave, master]: &Sides| pair(3, &both.nodes, [slave, master], &settings).unwrap();
        let contacts: Vec<SurfacePairs> = zones.iter().map(found).collect();
        let lists: Vec<_> = zones.iter().map(|[slave, _]| flat(slave)).collect();
        let zone = |name, at: usize| ContactZone {
            name,
            contact: &contacts[at],
            slave: Faces { start: &lists[at].0, nodes: &lists[at].1 },
        };
        let zones = [zone("a", 0), zone("b", 1)];
        let summary = join_zones(&zones).unwrap().summary(&zones).to_string();
        assert_eq!(
            summary.contains("1 nodes of such cuts are folded in one zone"),
            told,
            "{summary}"
        );
    }
}

/// A cube in a corner of a room, and a square in a corner: nodes at edges have a pair with each of the walls.
#[test]
fn corners_keep_a_pair_in_each_zone() {
    let mut rng = Rng::with_seed(9);
    let turn = |x: [f64; 3], by: usize| std::array::from_fn(|axis| x[(axis + 3 - by) % 3]);
    let (mut nodes, mut zones): (Vec<[f64; 3]>, Vec<Sides>) = (Vec::new(), Vec::new());
    let mut number = |places: Vec<[f64; 3]>, faces: Vec<Vec<usize>>| -> Vec<Vec<usize>> {
        let mut find = |x: [f64; 3]| {
            let known = nodes.iter().position(|node| *node == x);
            known.unwrap_or_else(|| {
                nodes.push(x);
                nodes.len() - 1
            })
        };
        let places: Vec<usize> = places.into_iter().map(&mut find).collect();
        faces.into_iter().map(|face| face.into_iter().map(|node| places[node]).collect()).collect()
    };
    let square = [[0.0, 1.0]; 2];
    for by in 0..3 {
        let sheet = |cells| Sheet::rectangle(Shape::Q4, [cells; 2], square, (0.0, &mut rng));
        let [slave, master] = [2, 3].map(sheet);
        let slave = slave.mapped(|x| turn(x, by)).turned();
        let master = master.mapped(|x| turn([x[0], x[1], -0.01], by));
        zones.push([slave, master].map(|sheet| number(sheet.nodes, sheet.faces)));
    }
    let joined = paired(3, &nodes, &zones, &SurfaceSettings::default());
    assert_eq!(joined.starts, [0, 9, 18, 27]);
    let at_corner = joined.contact.pairs.iter().filter(|pair| pair.point == [0.0; 3]);
    assert_eq!(at_corner.count(), 3);

    let nodes: Vec<[f64; 3]> = [[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [-0.1, 1.0], [-0.1, 0.0]]
        .into_iter()
        .chain([[0.0, -0.1], [1.0, -0.1]])
        .map(|[x, y]| [x, y, 0.0])
        .collect();
    let wall = [vec![vec![0, 1]], vec![vec![4, 3]]];
    let floor = [vec![vec![1, 2]], vec![vec![6, 5]]];
    let joined = paired(2, &nodes, &[wall, floor], &SurfaceSettings::default());
    assert_eq!(joined.starts, [0, 2, 4]);
}

/// A thin body of one layer of faces with both sides in one list is refused, and the remedy that is named works: of two zones
/// each node has a pair to either side.
#[test]
fn both_sides_of_a_thin_body_are_two_zones() {
    let at = |height: f64| [0.0, 1.0, 2.0].map(|x| [x, height, 0.0]);
    let nodes = [at(0.0), at(0.1), at(-0.2)].concat();
    let settings = SurfaceSettings::default();
    let [down, up] = [vec![vec![0, 1], vec![1, 2]], vec![vec![2, 1], vec![1, 0]]];
    let [below, above] = [vec![vec![7, 6], vec![8, 7]], vec![vec![3, 4], vec![4, 5]]];
    let both = [[&down[..], &up].concat(), [&below[..], &above].concat()];
    let error = pair(2, &nodes, [&both[0], &both[1]], &settings).unwrap_err().to_string();
    assert!(error.contains("in two calls and join them as two zones"), "{error}");
    let Joined { contact, starts } = paired(2, &nodes, &[[down, below], [up, above]], &settings);
    assert_eq!(starts, [0, 3, 6]);
    for (pair, (gap, normal)) in
        contact.pairs.iter().zip([[(0.2, -1.0); 3], [(0.1, 1.0); 3]].concat())
    {
        assert!((pair.gap - gap).abs() < 1e-15 && pair.normal[1] == normal);
    }
}
