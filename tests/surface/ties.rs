//! Tied surfaces: the whole tensor of stress passes flat interfaces between meshes that do not match, with elements of
//! every kind; blocks that are tied node by node are the blocks of one mesh; and models of each kind agree.

use crate::bodies::window_loads;
use crate::common::dense::largest;
use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{pair, steps};
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Equations};
use signorini::surface::{PairArrays, SurfaceSettings};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, State, Status};

const KINDS: [(Cells, Order); 8] = [
    (Cells::Boxes, Order::Linear),
    (Cells::Boxes, Order::Edges),
    (Cells::Boxes, Order::Full),
    (Cells::Simplices, Order::Linear),
    (Cells::Simplices, Order::Edges),
    (Cells::Wedges, Order::Linear),
    (Cells::Wedges, Order::Full),
    (Cells::Mixed, Order::Edges),
];

/// (E, nu) of both blocks: stress and displacement gradient are then the same in both.
const MATERIAL: (f64, f64) = (1000.0, 0.3);

/// Two blocks, one upon the other, whose interface is z = 0.
struct Blocks {
    dim: usize,
    solids: [Solid; 2],
    nodes: Vec<Point>,
    /// Faces of the interface: of the lower and of the upper block.
    faces: [Vec<Vec<usize>>; 2],
}

impl Blocks {
    /// Each finer than the other along one axis.
    fn new(
        dim: usize,
        kinds: [(Cells, Order); 2],
        cells: [[usize; 2]; 2],
        rng: &mut Rng,
    ) -> Blocks {
        let level = [[-0.8, 0.0], [0.0, 0.6]];
        let solids = [0, 1].map(|body| {
            let flat = (0..dim - 1).map(|c| steps(0.0, 1.0, cells[body][c]));
            let upright = steps(level[body][0], level[body][1], 2);
            let lines: Vec<Vec<f64>> = flat.chain([upright]).collect();
            let lines: Vec<&[f64]> = lines.iter().map(|line| &line[..]).collect();
            Solid::new(&lines, kinds[body], MATERIAL, (0.0, rng))
        });
        let first = solids[0].nodes.len();
        let shifted = |face: &Vec<usize>| face.iter().map(|node| first + node).collect();
        let faces = [solids[0].upper.clone(), solids[1].lower.iter().map(shifted).collect()];
        let nodes = [&solids[0].nodes[..], &solids[1].nodes].concat();
        Blocks { dim, solids, nodes, faces }
    }

    fn rows(&self, upper_is_slave: bool) -> PairArrays {
        let [lower, upper] = &self.faces;
        let sides = if upper_is_slave { [&upper[..], lower] } else { [&lower[..], upper] };
        pair(self.dim, &self.nodes, sides, &SurfaceSettings::default()).unwrap().rows()
    }

    /// The degrees of freedom of the nodes at a height.
    fn at_height(&self, z: f64) -> Vec<usize> {
        let dim = self.dim;
        let nodes =
            (0..self.nodes.len()).filter(|&node| (self.nodes[node][dim - 1] - z).abs() < 1e-9);
        nodes.flat_map(|node| dim * node..dim * (node + 1)).collect()
    }
}

/// A random linear field of displacements, `u = G x`, and the traction of its stress on z = 0.
fn linear_field(dim: usize, rng: &mut Rng) -> (impl Fn(&Point) -> Vec<f64> + use<>, Vec<f64>) {
    let gradient: Vec<[f64; 3]> =
        (0..dim).map(|_| std::array::from_fn(|_| 0.02 * (rng.f64() - 0.5))).collect();
    let (young, poisson) = MATERIAL;
    let lame = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    let shear = young / (2.0 * (1.0 + poisson));
    let trace: f64 = (0..dim).map(|c| gradient[c][c]).sum();
    let up = dim - 1;
    let traction = (0..dim).map(|c| {
        let own = if c == up { lame * trace } else { 0.0 };
        own + shear * (gradient[c][up] + gradient[up][c])
    });
    let traction = traction.collect();
    let field = move |p: &Point| -> Vec<f64> {
        gradient.iter().map(|row| (0..dim).map(|c| row[c] * p[c]).sum()).collect()
    };
    (field, traction)
}

fn solve(model: &Model, case: &LoadCase<'_>, settings: &Settings) -> Solution {
    let monitor = &mut Monitor::new(settings, None);
    let solution = model.solve(case, settings, None, monitor).unwrap();
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    solution
}

/// The lower side is held as the linear field has it, all other sides have its tractions, and nothing but the tie holds the
/// upper block: the displacements are linear to 1e-10 of their size, whether the interface is pressed, pulled or sheared.
/// Either side is slave; or both are, with pairs that depend on each other.
#[test]
fn the_whole_stress_passes_flat_interfaces() {
    let rng = &mut Rng::with_seed(1);
    let (mut pulled, mut pressed) = (0, 0);
    for (place, kind) in KINDS.iter().enumerate() {
        for other in [0, 1, 3] {
            let kinds = [*kind, KINDS[(place + other) % KINDS.len()]];
            let dim = if place < 5
                && kinds[1].0 != Cells::Wedges
                && kinds[1].0 != Cells::Mixed
                && other == 1
            {
                2
            } else {
                3
            };
            let blocks = Blocks::new(dim, kinds, [[2, 1], [1, 2]], rng);
            let (field, traction) = linear_field(dim, rng);
            let exact: Vec<f64> = blocks.nodes.iter().flat_map(&field).collect();
            let stiffness = Solid::stiffness(&blocks.solids.each_ref());
            let mut load = stiffness.times(&exact);
            // The force in the interface is no load: it acts on the lower block upwards along the normal, and back.
            for (faces, sign) in blocks.faces.iter().zip([-1.0, 1.0]) {
                for (node, share, _) in window_loads(dim, &blocks.nodes, faces, [[0.0, 1.0]; 2]) {
                    (0..dim).for_each(|c| load[dim * node + c] += sign * traction[c] * share);
                }
            }
            let fixed = blocks.at_height(-0.8);
            let prescribed: Vec<f64> = fixed.iter().map(|&dof| exact[dof]).collect();
            let arrays = blocks.rows(place % 2 == 0);
            let model =
                Model::sparse(&stiffness.view(), &fixed, &ContactPairs::from(&arrays)).unwrap();
            let case = LoadCase {
                load: &load,
                prescribed: Some(&prescribed),
                gap: &arrays.gaps,
                law: FrictionLaw::Tied,
                reference_slip: None,
            };
            let solution =
                solve(&model, &case, &Settings { tolerance: 1e-13, ..Settings::default() });
            assert!(solution.certificate.states.iter().all(|&state| state == State::Stick));
            let u = model.recover(Some(&load), Some(&prescribed), &solution.d).unwrap();
            let size = largest(&exact);
            for (dof, (u, exact)) in u.iter().zip(&exact).enumerate() {
                let off = (u - exact).abs() / size;
                assert!(off <= 1e-10, "{kinds:?} in {dim}, {dof}: {u} is not {exact}, {off:e}");
            }
            // Each pair carries the traction over its area, the normal part of which it presses or pulls with.
            for (j, area) in arrays.areas.iter().enumerate() {
                let force = &solution.certificate.force[dim * j..dim * (j + 1)];
                let carried = force.iter().map(|f| f * f).sum::<f64>().sqrt() / area;
                let expected = traction.iter().map(|t| t * t).sum::<f64>().sqrt();
                assert!(
                    (carried - expected).abs() <= 1e-10 * expected,
                    "{kinds:?}: {carried} {expected}"
                );
                assert!((force[0] - traction[dim - 1] * area).abs() <= 1e-10 * expected * area);
            }
            *if traction[dim - 1] > 0.0 { &mut pulled } else { &mut pressed } += 1;
        }
    }
    assert!(pulled >= 6 && pressed >= 6, "{pulled} {pressed}");
}

/// Pairs of nodes at the same places, and a load at random: the blocks of one mesh. The tie is held in all directions, and the
/// forces on a node of the interface of the one mesh are those on both.
#[test]
fn blocks_tied_node_by_node_are_one_mesh() {
    for (place, kind) in KINDS.iter().enumerate() {
        let rng = &mut Rng::with_seed(place as u64);
        let dim = 3;
        let blocks = Blocks::new(dim, [*kind, *kind], [[2, 2], [2, 2]], rng);
        let lines = [
            steps(0.0, 1.0, 2),
            steps(0.0, 1.0, 2),
            [&steps(-0.8, 0.0, 2)[..], &[0.3, 0.6]].concat(),
        ];
        let lines: Vec<&[f64]> = lines.iter().map(|line| &line[..]).collect();
        let one = Solid::new(&lines, *kind, MATERIAL, (0.0, rng));
        let same = |a: &Point, b: &Point| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-9);
        let first = blocks.solids[0].nodes.len();
        let mut slaves = Vec::new();
        let mut masters = Vec::new();
        for upper in first..blocks.nodes.len() {
            let lower = (0..first).find(|&lower| same(&blocks.nodes[lower], &blocks.nodes[upper]));
            if let Some(lower) = lower {
                slaves.extend(dim * upper..dim * (upper + 1));
                masters.extend(dim * lower..dim * (lower + 1));
            }
        }
        let count = slaves.len() / dim;
        let tangents = [1.0, 0.0, 0.0].repeat(count);
        let pairs = ContactPairs {
            dim,
            count,
            slaves: &slaves,
            master_start: &(0..=count).collect::<Vec<_>>(),
            masters: &masters,
            weights: &vec![1.0; count],
            normals: &[0.0, 0.0, -1.0].repeat(count),
            tangents: Some(&tangents),
            vectors: None,
            equations: Equations::default(),
        };
        let stiffness = Solid::stiffness(&blocks.solids.each_ref());
        let fixed = blocks.at_height(-0.8);
        let load: Vec<f64> = (0..stiffness.size).map(|_| rng.f64() - 0.5).collect();
        let of_one: Vec<usize> = blocks
            .nodes
            .iter()
            .map(|p| one.nodes.iter().position(|other| same(p, other)).expect("the same nodes"))
            .collect();
        let mut whole_load = vec![0.0; one.size()];
        for (node, own) in of_one.iter().enumerate() {
            (0..dim).for_each(|c| whole_load[dim * own + c] += load[dim * node + c]);
        }
        let held = |node: usize| (one.nodes[node][2] + 0.8).abs() < 1e-9;
        let whole_fixed: Vec<usize> = (0..one.size()).filter(|dof| held(dof / dim)).collect();
        // A pair that nothing loads makes a model of the one mesh, whose displacements are those of its load.
        let top =
            (0..one.nodes.len()).find(|&node| (one.nodes[node][2] - 0.6).abs() < 1e-9).unwrap();
        let alone = ContactPairs {
            dim,
            count: 1,
            slaves: &[dim * top, dim * top + 1, dim * top + 2],
            master_start: &[0, 0],
            masters: &[],
            weights: &[],
            normals: &[0.0, 0.0, 1.0],
            tangents: None,
            vectors: None,
            equations: Equations::default(),
        };
        let whole_stiffness = Solid::stiffness(&[&one]);
        let whole = Model::sparse(&whole_stiffness.view(), &whole_fixed, &alone).unwrap();
        let free = LoadCase {
            load: &whole_load,
            prescribed: None,
            gap: &[f64::INFINITY],
            law: FrictionLaw::Tied,
            reference_slip: None,
        };
        let settings = Settings { tolerance: 1e-13, ..Settings::default() };
        let solution = solve(&whole, &free, &settings);
        let expected = whole.recover(Some(&whole_load), None, &solution.d).unwrap();
        let model = Model::sparse(&stiffness.view(), &fixed, &pairs).unwrap();
        let gap = vec![0.0; count];
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::Tied,
            reference_slip: None,
        };
        let solution = solve(&model, &case, &settings);
        let u = model.recover(Some(&load), None, &solution.d).unwrap();
        let size = largest(&expected);
        for (node, own) in of_one.iter().enumerate() {
            for c in 0..dim {
                let off = (u[dim * node + c] - expected[dim * own + c]).abs() / size;
                assert!(off <= 1e-10, "{kind:?}, node {node}: {off:e}");
            }
        }
    }
}

/// A part of the pairs tied, the others under Coulomb's law: the model in full space has the answers of the condensed one,
/// also from load step to load step, as has one with rows of both directions, which depend on each other.
#[test]
fn models_of_each_kind_have_the_same_ties() {
    let rng = &mut Rng::with_seed(7);
    let blocks = Blocks::new(3, [KINDS[0], KINDS[3]], [[4, 3], [3, 4]], rng);
    let stiffness = Solid::stiffness(&blocks.solids.each_ref());
    let arrays = blocks.rows(true);
    let fixed = blocks.at_height(-0.8);
    let numbers: Vec<f64> = (0..arrays.count)
        .flat_map(|j| if j % 3 == 0 { [7.0, 0.0, 0.0, 0.0] } else { [1.0, 0.2, 0.0, 0.0] })
        .collect();
    let pairs = ContactPairs::from(&arrays);
    let condensed = Model::sparse(&stiffness.view(), &fixed, &pairs).unwrap();
    let settings = Settings { full_space: true, ..Settings::default() };
    let full = Model::sparse_within(
        &stiffness.view(),
        &fixed,
        &pairs,
        None,
        &mut Monitor::new(&settings, None),
    )
    .unwrap();
    assert!(full.is_matrix_free());
    let mut slip = vec![0.0; 2 * arrays.count];
    let mut gap = arrays.gaps.clone();
    (0..arrays.count).step_by(3).for_each(|j| {
        gap[j] = 0.002;
        slip[2 * j] = 0.001;
    });
    for step in 0..6 {
        let mut load = vec![0.0; stiffness.size];
        for (k, dof) in blocks.at_height(0.6).into_iter().enumerate() {
            // Pulled off one edge, pressed at the other.
            load[dof] = [0.1, 0.0, -0.2][dof % 3] * (f64::from(step) + (k % 5) as f64 - 3.0);
        }
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::ByPair(&numbers),
            reference_slip: Some(&slip),
        };
        let [one, other] =
            [&condensed, &full].map(|model| solve(model, &case, &Settings::default()));
        let size = largest(&one.d);
        for (a, b) in one.d.iter().zip(&other.d) {
            // eta is 1e-10 of forces, the condition a few thousand.
            assert!((a - b).abs() <= 1e-6 * size, "step {step}: {a} {b}");
        }
        assert_eq!(one.certificate.states, other.certificate.states, "step {step}");
        let force = largest(&one.certificate.force);
        for (a, b) in one.certificate.force.iter().zip(&other.certificate.force) {
            assert!((a - b).abs() <= 1e-6 * force, "step {step}: {a} {b}");
        }
        for j in (0..arrays.count).step_by(3) {
            assert_eq!(one.d[3 * j..3 * j + 3], [0.002, 0.001, 0.0]);
            assert_eq!(other.d[3 * j..3 * j + 3], [0.002, 0.001, 0.0]);
        }
        for model in [&condensed, &full] {
            assert!(model.certify(&case, &one.d).unwrap().holds(1e-6));
        }
    }
}

/// Each side slave of the other, node upon node: pairs depend on each other, and the tie is the same.
#[test]
fn ties_may_depend_on_each_other() {
    let rng = &mut Rng::with_seed(3);
    let blocks = Blocks::new(2, [KINDS[0], KINDS[0]], [[3, 1], [3, 1]], rng);
    let stiffness = Solid::stiffness(&blocks.solids.each_ref());
    let fixed = blocks.at_height(-0.8);
    let mut load = vec![0.0; stiffness.size];
    for (k, dof) in blocks.at_height(0.6).into_iter().enumerate() {
        load[dof] = 0.3 + 0.1 * k as f64;
    }
    let one_way = blocks.rows(true);
    let mut both_ways =
        pair(2, &blocks.nodes, [&blocks.faces[1], &blocks.faces[0]], &SurfaceSettings::default())
            .unwrap();
    both_ways.pairs.extend(
        pair(2, &blocks.nodes, [&blocks.faces[0], &blocks.faces[1]], &SurfaceSettings::default())
            .unwrap()
            .pairs,
    );
    let both_ways = both_ways.rows();
    let u = [&one_way, &both_ways].map(|arrays| {
        let model = Model::sparse(&stiffness.view(), &fixed, &ContactPairs::from(arrays)).unwrap();
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &arrays.gaps,
            law: FrictionLaw::Tied,
            reference_slip: None,
        };
        let solution = solve(&model, &case, &Settings { tolerance: 1e-12, ..Settings::default() });
        assert_eq!(model.dependent_pairs().is_empty(), arrays.count == one_way.count);
        model.recover(Some(&load), None, &solution.d).unwrap()
    });
    let size = largest(&u[0]);
    for (a, b) in u[0].iter().zip(&u[1]) {
        assert!((a - b).abs() <= 1e-8 * size, "{a} {b}");
    }
}
