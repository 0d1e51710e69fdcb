//! Sectors of bodies that repeat about an axis, and planes of symmetry across no axis, against the whole body and against
//! the same planes across axes.

use std::collections::{BTreeMap, HashMap};

use crate::common::dense::largest;
use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{grid, pair, steps};
use crate::symmetry::Bodies;
use fastrand::Rng;
use signorini::reduce::{ContactPairs, Equations};
use signorini::surface::{
    NodalFields, PairResults, Pairing, Sector, SurfacePairs, SurfaceSettings, SymmetryPlane,
};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, State, Status};

/// Bodies with supports and equations.
struct Case {
    bodies: Bodies,
    found: SurfacePairs,
    /// Prescribed displacements by degree of freedom.
    supports: BTreeMap<usize, f64>,
    /// Dependents with their terms.
    equations: Vec<(usize, Vec<(usize, f64)>)>,
}

struct Solved {
    u: Vec<f64>,
    fields: NodalFields,
    states: Vec<State>,
}

impl Case {
    fn solved(&self, mu: f64) -> Solved {
        let dim = self.bodies.dim;
        let mut stiffness = self.bodies.stiffness();
        // Unknowns beyond the nodes have no stiffness of their own.
        let terms = self.equations.iter().flat_map(|(_, terms)| terms).map(|(dof, _)| dof + 1);
        stiffness.size = terms.max().unwrap_or(0).max(stiffness.size);
        let end = stiffness.row.len() as i64;
        stiffness.col_start.resize(stiffness.size + 1, end);
        let (fixed, prescribed): (Vec<usize>, Vec<f64>) = self.supports.iter().unzip();
        let dependent: Vec<usize> = self.equations.iter().map(|(dof, _)| *dof).collect();
        let (mut start, mut dofs, mut coefficients) = (vec![0], vec![], vec![]);
        for (_, terms) in &self.equations {
            dofs.extend(terms.iter().map(|(dof, _)| *dof));
            coefficients.extend(terms.iter().map(|(_, a)| *a));
            start.push(dofs.len());
        }
        let equations = Equations {
            dependent: &dependent,
            start: &start,
            dofs: &dofs,
            coefficients: &coefficients,
        };
        let arrays = self.found.rows();
        let equations = if dependent.is_empty() { Equations::default() } else { equations };
        let pairs = ContactPairs { equations, ..ContactPairs::from(&arrays) };
        let model = Model::sparse(&stiffness.view(), &fixed, &pairs).unwrap();
        let place = |j: usize| self.bodies.nodes[self.found.pairs[j].slave];
        let away = |x: Point| x[..dim].iter().map(|x| x * x).sum::<f64>();
        let gap: Vec<f64> =
            (0..arrays.count).map(|j| arrays.gaps[j] + 0.02 * away(place(j))).collect();
        let case = LoadCase {
            load: &vec![0.0; stiffness.size],
            prescribed: Some(&prescribed),
            gap: &gap,
            law: FrictionLaw::Coulomb(&vec![mu; arrays.count]),
            reference_slip: None,
        };
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let u = model.recover(None, Some(&prescribed), &solution.d).unwrap();
        let results = PairResults {
            gap: Some(&gap),
            reference_slip: None,
            d: &solution.d,
            force: &solution.certificate.force,
        };
        let fields = self.found.fields(&results).unwrap();
        Solved { u, fields, states: solution.certificate.states.clone() }
    }

    /// The upper end is pressed down, spread and turned, alike in each quarter; the lower end is held.
    fn support_ends(&mut self) {
        let dim = self.bodies.dim;
        for (node, x) in self.bodies.nodes.iter().enumerate() {
            let [low, high] = [-0.8, 0.6].map(|level| (x[dim - 1] - level).abs() < 1e-12);
            let spread = 0.01 * (1.0 + x[0] * x[0] + x[1] * x[1]);
            let pressed = [spread * x[0] - 0.004 * x[1], spread * x[1] + 0.004 * x[0], -0.02];
            if low || high {
                for (axis, u) in pressed.into_iter().enumerate() {
                    self.supports.insert(dim * node + axis, if high { u } else { 0.0 });
                }
            }
        }
    }
}

/// A quarter of two blocks, with the corner on the axis, whose boundaries `y = 0` and `x = 0` match.
fn quarter(kinds: [(Cells, Order); 2], cells: [usize; 2], rng: &mut Rng) -> Bodies {
    let materials = [(2000.0, 0.3), (500.0, 0.2)];
    let solids = [0, 1].map(|body| {
        let level = if body == 0 { [-0.8, 0.0] } else { [0.0, 0.6] };
        let (along, up) = (grid(0.0, 1.0, cells[body], rng), steps(level[0], level[1], 2));
        Solid::new(&[&along, &along, &up], kinds[body], materials[body], (0.15, rng))
    });
    Bodies::of(&solids)
}

/// A quarter turn about the third axis.
fn turned([x, y, z]: Point) -> Point {
    [-y, x, z]
}

/// The image of each node of a body among its nodes, where there is one.
fn images(bodies: &Bodies) -> Vec<Option<usize>> {
    // Nodes of the two bodies stand at one place.
    let key = |body: usize, x: Point| (body, x.map(|x| (x * 1e9).round() as i64));
    let body = bodies_of_nodes(bodies);
    let places: HashMap<_, usize> =
        (0..bodies.nodes.len()).map(|node| (key(body[node], bodies.nodes[node]), node)).collect();
    let image = |node: usize| places.get(&key(body[node], turned(bodies.nodes[node]))).copied();
    (0..bodies.nodes.len()).map(image).collect()
}

/// The body, 0 or 1, of each node: those that entries join are of one.
fn bodies_of_nodes(bodies: &Bodies) -> Vec<usize> {
    let dim = bodies.dim;
    let mut body: Vec<usize> = (0..bodies.nodes.len()).collect();
    fn root(body: &mut [usize], mut node: usize) -> usize {
        while body[node] != node {
            body[node] = body[body[node]];
            node = body[node];
        }
        node
    }
    for &(i, j, _) in &bodies.entries {
        let [a, b] = [i, j].map(|dof| root(&mut body, dof / dim));
        body[a.max(b)] = a.min(b);
    }
    (0..body.len()).map(|node| usize::from(root(&mut body, node) != 0)).collect()
}

/// The whole body of a quarter and its images. The first nodes are those of the quarter.
fn whole(quarter: &Bodies) -> Bodies {
    let count = quarter.nodes.len();
    let body = bodies_of_nodes(quarter);
    let key = |body: usize, x: Point| (body, x.map(|x| (x * 1e9).round() as i64));
    let mut all = Bodies {
        dim: 3,
        nodes: quarter.nodes.clone(),
        entries: quarter.entries.clone(),
        faces: quarter.faces.clone(),
    };
    let mut places: HashMap<_, usize> =
        (0..count).map(|node| (key(body[node], all.nodes[node]), node)).collect();
    let mut image: Vec<usize> = (0..count).collect();
    // What a displacement along an axis of the quarter is in its image: an axis, with a sign.
    let mut axes = [(0, 1.0), (1, 1.0), (2, 1.0)];
    for _ in 1..4 {
        for (node, image) in image.iter_mut().enumerate() {
            let place = turned(all.nodes[*image]);
            *image = *places.entry(key(body[node], place)).or_insert_with(|| {
                all.nodes.push(place);
                all.nodes.len() - 1
            });
        }
        axes = axes.map(|(axis, sign)| ([1, 0, 2][axis], sign * [1.0, -1.0, 1.0][axis]));
        let of = |dof: usize| (3 * image[dof / 3] + axes[dof % 3].0, axes[dof % 3].1);
        for &(i, j, value) in &quarter.entries {
            let ((i, a), (j, b)) = (of(i), of(j));
            all.entries.push((i.max(j), i.min(j), a * b * value));
        }
        for (faces, own) in all.faces.iter_mut().zip(&quarter.faces) {
            faces.extend(own.iter().map(|face| face.iter().map(|node| image[*node]).collect()));
        }
    }
    all
}

/// The greatest difference between values at nodes, beside the largest.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let differ: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    largest(&differ) / largest(b)
}

/// A quarter with equations on its boundaries has the solution of the whole: displacements, and pressures, tractions, clearances
/// and slips on both sides, at both boundaries too. Rows of half a body would have other ones.
#[test]
fn a_sector_has_the_solution_of_the_whole_body() {
    let (rng, mut states) = (&mut Rng::with_seed(41), vec![]);
    let sector =
        Sector { point: [0.0, 0.0, 0.3], axis: [0.0, 0.0, 2.0], count: 4, ..Sector::default() };
    for kinds in [
        [(Cells::Boxes, Order::Linear); 2],
        [(Cells::Wedges, Order::Edges), (Cells::Boxes, Order::Edges)],
        [(Cells::Boxes, Order::Full), (Cells::Wedges, Order::Linear)],
        [(Cells::Simplices, Order::Linear), (Cells::Simplices, Order::Edges)],
    ] {
        for (pairing, upper_is_slave, keep_turns) in [
            (Pairing::DualMortar, true, false),
            (Pairing::DualMortar, false, false),
            (Pairing::DualMortar, false, true),
            (Pairing::NodeToSurface, true, false),
        ] {
            let context = format!("{kinds:?}, {pairing:?}, {upper_is_slave}, {keep_turns}");
            let part = quarter(kinds, [3, 2], rng);
            let solved = |bodies: Bodies, sector: Option<Sector>| {
                let [lower, upper] = [&bodies.faces[1][..], &bodies.faces[0]];
                let sides = if upper_is_slave { [upper, lower] } else { [lower, upper] };
                let settings =
                    SurfaceSettings { pairing, sector, keep_turns, ..SurfaceSettings::default() };
                let found = pair(3, &bodies.nodes, sides, &settings).unwrap();
                let image = images(&bodies);
                let (supports, equations) = (BTreeMap::new(), vec![]);
                let mut case = Case { bodies, found, supports, equations };
                case.support_ends();
                for node in (0..image.len()).filter(|_| sector.is_some()) {
                    let Some(second) =
                        image[node].filter(|_| !case.supports.contains_key(&(3 * node)))
                    else {
                        continue;
                    };
                    let (x, y, z) = (3 * node, 3 * node + 1, 3 * node + 2);
                    case.equations.extend(match second == node {
                        true => vec![(x, vec![]), (y, vec![])],
                        false => vec![
                            (3 * second, vec![(y, -1.0)]),
                            (3 * second + 1, vec![(x, 1.0)]),
                            (3 * second + 2, vec![(z, 1.0)]),
                        ],
                    });
                }
                case.solved(0.2)
            };
            let (of_whole, of_part) = (solved(whole(&part), None), solved(part, Some(sector)));
            states.extend(&of_part.states);
            // The tolerance of the forces, 1e-12, by the condition of the body on its contact.
            let error = apart(&of_part.u, &of_whole.u);
            assert!(error < 1e-9, "{context}: {error:e}");
            let at = |fields: &NodalFields, node: &usize| fields.nodes.binary_search(node).unwrap();
            let of = |solved: &Solved, nodes: &[usize]| -> [Vec<f64>; 4] {
                let fields = &solved.fields;
                let places = || nodes.iter().map(|node| at(fields, node));
                let vectors = |values: &[f64]| {
                    places().flat_map(|k| values[3 * k..3 * k + 3].to_vec()).collect()
                };
                let numbers = |values: &[f64]| places().map(|k| values[k]).collect();
                [
                    numbers(&fields.pressure),
                    vectors(&fields.traction),
                    numbers(&fields.clearance),
                    vectors(&fields.slip),
                ]
            };
            let nodes = &of_part.fields.nodes;
            let [own, same] = [&of_part, &of_whole].map(|solved| of(solved, nodes));
            for (own, same) in own.iter().zip(&same) {
                let error = apart(own, same);
                assert!(error < 1e-9, "{context}: {error:e}");
            }
        }
    }
    for state in [State::Open, State::Slip, State::Stick] {
        assert!(states.contains(&state), "no pair has the state {state:?}");
    }
}

type Matrix = [[f64; 3]; 3];

fn times(a: &Matrix, x: Point) -> Point {
    a.map(|row| (0..3).map(|c| row[c] * x[c]).sum())
}

/// A turn by 0.7 about (1, 2, 2) / 3, by the formula of Rodrigues.
fn turn() -> Matrix {
    let (axis, angle) = ([1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0], 0.7_f64);
    let cross = [[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]];
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let unit = if i == j { angle.cos() } else { 0.0 };
            unit + (1.0 - angle.cos()) * axis[i] * axis[j] + angle.sin() * cross[i][j]
        })
    })
}

/// Bodies turned as a whole, with their stiffness.
fn turned_as_a_whole(bodies: &Bodies, turn: &Matrix) -> Bodies {
    let mut blocks: BTreeMap<(usize, usize), Matrix> = BTreeMap::new();
    for &(i, j, value) in &bodies.entries {
        blocks.entry((i / 3, j / 3)).or_default()[i % 3][j % 3] += value;
        if i / 3 == j / 3 && i != j {
            blocks.entry((i / 3, j / 3)).or_default()[j % 3][i % 3] += value;
        }
    }
    let mut entries = vec![];
    for ((a, b), block) in blocks {
        let transposed = |m: &Matrix| -> Matrix { std::array::from_fn(|i| m.map(|row| row[i])) };
        // turn block turn^T.
        let half = transposed(&block).map(|column| times(turn, column));
        let all = transposed(&half).map(|row| times(turn, row));
        let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
        let lower = places.filter(|(i, j)| a != b || i >= j);
        entries.extend(lower.map(|(i, j)| (3 * a + i, 3 * b + j, all[i][j])));
    }
    let nodes = bodies.nodes.iter().map(|x| times(turn, *x)).collect();
    Bodies { dim: 3, nodes, entries, faces: bodies.faces.clone() }
}

/// Planes of symmetry across no axis do what planes across axes do: a quarter, turned as a whole with its planes, has its
/// solution, turned; on the line of both planes too.
#[test]
fn skewed_planes_are_planes_across_axes_turned() {
    let (rng, turn, mut states) = (&mut Rng::with_seed(43), turn(), vec![]);
    for kinds in [
        [(Cells::Boxes, Order::Linear); 2],
        [(Cells::Wedges, Order::Edges), (Cells::Boxes, Order::Edges)],
        [(Cells::Simplices, Order::Edges), (Cells::Boxes, Order::Full)],
    ] {
        for (pairing, upper_is_slave) in [
            (Pairing::DualMortar, true),
            (Pairing::DualMortar, false),
            (Pairing::NodeToSurface, true),
        ] {
            let context = format!("{kinds:?}, {pairing:?}, {upper_is_slave}");
            let part = quarter(kinds, [3, 2], rng);
            let solved = |part: &Bodies, turn: Option<&Matrix>| {
                let bodies = turned_as_a_whole(part, turn.unwrap_or(&UNIT));
                let [lower, upper] = [&bodies.faces[1][..], &bodies.faces[0]];
                let sides = if upper_is_slave { [upper, lower] } else { [lower, upper] };
                let normals = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
                let normals = normals.map(|across| turn.map_or(across, |turn| times(turn, across)));
                let symmetry = normals.map(|normal| SymmetryPlane { normal, at: 0.0 }).to_vec();
                let settings = SurfaceSettings { pairing, symmetry, ..SurfaceSettings::default() };
                let found = pair(3, &bodies.nodes, sides, &settings).unwrap();
                let (supports, equations) = (BTreeMap::new(), vec![]);
                let mut case =
                    Case { bodies: turned_as_a_whole(part, &UNIT), found, supports, equations };
                case.support_ends();
                case.bodies = bodies;
                let mut beyond = 3 * part.nodes.len();
                for (node, x) in part.nodes.iter().enumerate() {
                    let own = [3 * node, 3 * node + 1, 3 * node + 2];
                    let on: Vec<usize> = [0, 1].into_iter().filter(|&c| x[c] == 0.0).collect();
                    if case.supports.contains_key(&own[0]) {
                        let u = own.map(|dof| case.supports[&dof]);
                        let u = turn.map_or(u, |turn| times(turn, u));
                        case.supports.extend(own.into_iter().zip(u));
                    } else if let Some(turn) = turn.filter(|_| !on.is_empty()) {
                        // u = turn u', of which u' across the planes is zero.
                        let axes = [beyond, beyond + 1, beyond + 2];
                        beyond += 3;
                        for (dof, row) in own.into_iter().zip(turn) {
                            case.equations.push((dof, axes.into_iter().zip(*row).collect()));
                        }
                        case.supports.extend(on.iter().map(|&c| (axes[c], 0.0)));
                    } else {
                        case.supports.extend(on.iter().map(|&c| (own[c], 0.0)));
                    }
                }
                case.solved(0.2)
            };
            let (across_axes, skewed) = (solved(&part, None), solved(&part, Some(&turn)));
            states.extend(&skewed.states);
            let vectors = |values: &[f64]| -> Vec<f64> {
                values.chunks(3).flat_map(|v| times(&turn, [v[0], v[1], v[2]])).collect()
            };
            let fields = [&skewed.fields, &across_axes.fields];
            assert_eq!(fields[0].nodes, fields[1].nodes);
            let nodes = 3 * part.nodes.len();
            // The tolerance of the forces, 1e-12, by the condition of the body on its contact.
            for (own, same) in [
                (skewed.u[..nodes].to_vec(), vectors(&across_axes.u)),
                (fields[0].pressure.clone(), fields[1].pressure.clone()),
                (fields[0].traction.clone(), vectors(&fields[1].traction)),
                (fields[0].clearance.clone(), fields[1].clearance.clone()),
                (fields[0].slip.clone(), vectors(&fields[1].slip)),
            ] {
                let error = apart(&own, &same);
                assert!(error < 1e-9, "{context}: {error:e}");
            }
        }
    }
    for state in [State::Open, State::Slip, State::Stick] {
        assert!(states.contains(&state), "no pair has the state {state:?}");
    }
}

const UNIT: Matrix = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
