//! Half and quarter models against the whole body, which is made of them by reflection, with friction: pairs on named
//! planes of symmetry carry what they carry in the whole body. Every mesh has its mirror image, also distorted ones
//! and those of simplices, as matrix, nodes and faces are reflected.

use std::collections::BTreeMap;

use crate::common::dense::largest;
use crate::common::mesh::Stiffness;
use crate::common::solids::{Cells, Order, Point, Solid};
use crate::surfaces::{SHAPES, Shape, Sheet, TwoSheets, grid, pair, unlimited};
use fastrand::Rng;
use signorini::reduce::ContactPairs;
use signorini::surface::{
    Normals, PairResults, Pairing, Rims, SurfacePair, SurfacePairs, SurfaceSettings, SymmetryPlane,
};
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Solution, State, Status};

/// Two bodies, or what is left of them on one side of planes of symmetry at zero.
pub struct Bodies {
    pub dim: usize,
    pub nodes: Vec<Point>,
    /// Entries of the stiffness in its lower triangle; places may repeat.
    pub entries: Vec<(usize, usize, f64)>,
    /// Slave and master.
    pub faces: [Vec<Vec<usize>>; 2],
}

/// A face seen in the mirror, which turns it over. Corners first, then mid nodes, then the centre.
fn turned(dim: usize, face: &[usize]) -> Vec<usize> {
    let corners = match (dim, face.len()) {
        (2, _) => return [&[face[1], face[0]], &face[2..]].concat(),
        (_, 3 | 6) => 3,
        _ => 4,
    };
    let mut face = face.to_vec();
    face[..corners].reverse();
    if face.len() > corners {
        // Mid i stands between corners i and i + 1: the last edge stays the last.
        face[corners..2 * corners - 1].reverse();
    }
    face
}

impl Bodies {
    /// Blocks on 0..1 along each axis but the last, with irregular steps.
    fn new(kinds: [(Cells, Order); 2], cells: [[usize; 2]; 2], dim: usize, rng: &mut Rng) -> Self {
        Bodies::of_sizes([1.0; 2], (kinds, cells), dim, rng)
    }

    /// Blocks from 0 to their size along each axis but the last.
    fn of_sizes(
        sizes: [f64; 2],
        (kinds, cells): ([(Cells, Order); 2], [[usize; 2]; 2]),
        dim: usize,
        rng: &mut Rng,
    ) -> Self {
        let materials = [(2000.0, 0.3), (500.0, 0.2)];
        let solids = [0, 1].map(|body| {
            let level = if body == 0 { [-0.8, 0.0] } else { [0.0, 0.6] };
            let mut lines: Vec<Vec<f64>> =
                (0..dim - 1).map(|c| grid(0.0, sizes[body], cells[body][c], rng)).collect();
            lines.push(crate::surfaces::steps(level[0], level[1], 2));
            let lines: Vec<&[f64]> = lines.iter().map(|line| &line[..]).collect();
            Solid::new(&lines, kinds[body], materials[body], (0.15, rng))
        });
        Bodies::of(&solids)
    }

    /// Two blocks, one upon the other.
    pub fn of(solids: &[Solid; 2]) -> Self {
        let first = solids[0].nodes.len();
        let shifted = |face: &Vec<usize>| face.iter().map(|node| first + node).collect();
        let lower = solids[1].lower.iter().map(shifted).collect();
        Bodies {
            dim: solids[0].dim,
            nodes: [&solids[0].nodes[..], &solids[1].nodes].concat(),
            entries: Solid::stiffness(&solids.each_ref()).entries().collect(),
            faces: [lower, solids[0].upper.clone()],
        }
    }

    /// With their mirror image across an axis. The first nodes are those of before.
    pub fn reflected(&self, axis: usize) -> Self {
        let (dim, mut nodes) = (self.dim, self.nodes.clone());
        let image: Vec<usize> = (0..self.nodes.len())
            .map(|node| {
                if self.nodes[node][axis] == 0.0 {
                    return node;
                }
                let mut place = self.nodes[node];
                place[axis] = -place[axis];
                nodes.push(place);
                nodes.len() - 1
            })
            .collect();
        let of = |dof: usize| dim * image[dof / dim] + dof % dim;
        let sign = |dof: usize| if dof % dim == axis { -1.0 } else { 1.0 };
        let mirrored = self
            .entries
            .iter()
            .map(|&(i, j, value)| (of(i).max(of(j)), of(i).min(of(j)), sign(i) * sign(j) * value));
        let faces = self.faces.each_ref().map(|faces| {
            let seen = faces.iter().map(|face| face.iter().map(|&node| image[node]).collect());
            let seen = seen.map(|face: Vec<usize>| turned(dim, &face));
            faces.iter().cloned().chain(seen).collect()
        });
        Bodies {
            dim,
            entries: self.entries.iter().copied().chain(mirrored).collect(),
            nodes,
            faces,
        }
    }

    pub fn stiffness(&self) -> Stiffness {
        let mut columns = vec![BTreeMap::new(); self.dim * self.nodes.len()];
        for &(i, j, value) in &self.entries {
            *columns[j].entry(i).or_insert(0.0) += value;
        }
        let mut matrix =
            Stiffness { size: columns.len(), col_start: vec![0], row: vec![], values: vec![] };
        for column in columns {
            for (i, value) in column {
                matrix.row.push(i as i64);
                matrix.values.push(value);
            }
            matrix.col_start.push(matrix.row.len() as i64);
        }
        matrix
    }

    /// The surfaces a little apart, more so outwards; `planes`: those that the bodies end at and that are named.
    fn found(&self, upper_is_slave: bool, planes: usize) -> SurfacePairs {
        let [lower, upper] = [&self.faces[1], &self.faces[0]];
        let sides = if upper_is_slave { [&upper[..], lower] } else { [&lower[..], upper] };
        let symmetry = (0..planes).map(|axis| SymmetryPlane::across(axis, 0.0)).collect();
        let settings = SurfaceSettings { symmetry, ..SurfaceSettings::default() };
        let mut found = pair(self.dim, &self.nodes, sides, &settings).unwrap();
        for pair in &mut found.pairs {
            let place = self.nodes[pair.slave];
            pair.gap += 0.025 * place[..self.dim - 1].iter().map(|x| x * x).sum::<f64>();
        }
        found
    }

    /// Tractions of the pairs in the host's axes, by slave nodes, and the displacements of the first `nodes` nodes.
    /// The upper end is pressed down and spread; the lower end is held. `held`: axes across which the bodies end.
    fn solved(&self, upper_is_slave: bool, (held, planes): (usize, usize), nodes: usize) -> Solved {
        let (dim, found) = (self.dim, self.found(upper_is_slave, planes));
        let (mut fixed, mut prescribed) = (vec![], vec![]);
        for (node, place) in self.nodes.iter().enumerate() {
            let [low, high] = [-0.8, 0.6].map(|level| (place[dim - 1] - level).abs() < 1e-12);
            for axis in 0..dim {
                let pressed = match axis + 1 == dim {
                    true => -0.02,
                    false => 0.01 * place[axis] * (1.0 + place[0] * place[0]),
                };
                let on_plane = axis < held && place[axis] == 0.0;
                if low || high || on_plane {
                    fixed.push(dim * node + axis);
                    prescribed.push(if high { pressed } else { 0.0 });
                }
            }
        }
        let stiffness = self.stiffness();
        let arrays = found.rows();
        let model = Model::sparse(&stiffness.view(), &fixed, &ContactPairs::from(&arrays)).unwrap();
        let load = vec![0.0; stiffness.size];
        let mu = vec![0.2; arrays.count];
        let case = LoadCase {
            load: &load,
            prescribed: Some(&prescribed),
            gap: &arrays.gaps,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let settings = Settings { tolerance: 1e-12, ..Settings::default() };
        let solution =
            model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let frames = model.frames().unwrap();
        let traction = |j: usize| {
            let mut sum = vec![0.0; dim];
            for (c, direction) in frames[dim * dim * j..dim * dim * (j + 1)].chunks(dim).enumerate()
            {
                let force = solution.certificate.force[dim * j + c] / found.pairs[j].area;
                sum.iter_mut().zip(direction).for_each(|(sum, part)| *sum += force * part);
            }
            sum
        };
        let mut u = model.recover(None, Some(&prescribed), &solution.d).unwrap();
        u.truncate(dim * nodes);
        Solved {
            traction: (0..arrays.count).map(|j| (found.pairs[j].slave, traction(j))).collect(),
            states: solution.certificate.states.clone(),
            fields: self.fields(&found, &solution, nodes),
            u,
        }
    }
}

impl Bodies {
    /// Pressures and tractions of both sides at the first nodes.
    fn fields(&self, found: &SurfacePairs, solution: &Solution, nodes: usize) -> Vec<f64> {
        let results = PairResults {
            gap: None,
            reference_slip: None,
            d: &solution.d,
            force: &solution.certificate.force,
        };
        let fields = found.fields(&results).unwrap();
        let own = (0..fields.nodes.len()).filter(|&k| fields.nodes[k] < nodes);
        own.flat_map(|k| {
            let traction = &fields.traction[self.dim * k..self.dim * (k + 1)];
            [&[fields.pressure[k]], traction].concat()
        })
        .collect()
    }
}

struct Solved {
    traction: BTreeMap<usize, Vec<f64>>,
    /// Pressures and tractions at nodes of both sides.
    fields: Vec<f64>,
    states: Vec<State>,
    u: Vec<f64>,
}

impl Solved {
    /// The largest difference of tractions, and of displacements, beside the largest.
    fn differs(&self, whole: &Solved) -> [f64; 3] {
        let flat = |traction: &BTreeMap<usize, Vec<f64>>| -> Vec<f64> {
            self.traction.keys().flat_map(|node| traction[node].clone()).collect()
        };
        let fields = (self.fields.clone(), whole.fields.clone());
        let tractions = (flat(&self.traction), flat(&whole.traction));
        [tractions, (self.u.clone(), whole.u.clone()), fields].map(|(a, b)| {
            let apart: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a - b).collect();
            largest(&apart) / largest(&b)
        })
    }
}

/// Compares a part that ends at planes across the first `held` axes with the whole body. Returns how much the part
/// differs from it whose planes are not named, and the states.
fn check(
    part: &Bodies,
    held: usize,
    upper_is_slave: bool,
    context: &str,
) -> ([f64; 3], Vec<State>) {
    let whole = (0..held).fold(None, |whole: Option<Bodies>, axis| {
        Some(whole.as_ref().unwrap_or(part).reflected(axis))
    });
    let nodes = part.nodes.len();
    let whole = whole.unwrap().solved(upper_is_slave, (0, 0), nodes);
    let named = part.solved(upper_is_slave, (held, held), nodes);
    for part in named.differs(&whole) {
        // The tolerance of the forces, 1e-12, by the condition of the body on its contact.
        assert!(part < 1e-9, "{context}: {part:e}");
    }
    let unnamed = part.solved(upper_is_slave, (held, 0), nodes);
    (unnamed.differs(&whole), named.states)
}

/// Open, slipping and sticking pairs are among the states.
fn assert_all(states: &[State]) {
    for state in [State::Open, State::Slip, State::Stick] {
        assert!(states.contains(&state), "no pair has the state {state:?}");
    }
}

/// Half and quarter of bodies in space, finer or coarser along and across the planes.
#[test]
fn parts_have_the_solution_of_the_whole_body() {
    let mut rng = Rng::with_seed(21);
    let kinds = [
        [(Cells::Boxes, Order::Linear); 2],
        [(Cells::Simplices, Order::Linear), (Cells::Wedges, Order::Linear)],
        [(Cells::Boxes, Order::Edges), (Cells::Boxes, Order::Full)],
        [(Cells::Simplices, Order::Edges), (Cells::Boxes, Order::Linear)],
    ];
    let (mut unnamed, mut states) = (0.0_f64, vec![]);
    for (i, kinds) in kinds.into_iter().enumerate() {
        for upper_is_slave in [false, true] {
            let held = 1 + (i + usize::from(upper_is_slave)) % 2;
            let part = Bodies::new(kinds, [[3, 2], [2, 4]], 3, &mut rng);
            let context = format!("{kinds:?}, {held} planes, {upper_is_slave}");
            let (differs, found) = check(&part, held, upper_is_slave, &context);
            states.extend(found);
            unnamed = unnamed.max(differs[0]);
        }
    }
    assert_all(&states);
    // Without the planes the result is another one: rows of half of their masters carry friction.
    assert!(unnamed > 1e-4, "{unnamed:e}");
}

/// A slave that is wider than its master has nodes with little cover, on planes too: their rows go to nodes on both sides of a
/// plane, and the rows that take them in hold mirror images.
#[test]
fn rims_at_planes_are_those_of_the_whole_body() {
    const WIDE: [f64; 2] = [1.2, 1.25];
    let mut rng = Rng::with_seed(25);
    let kinds = [
        (Cells::Boxes, Order::Linear),
        (Cells::Simplices, Order::Linear),
        (Cells::Boxes, Order::Edges),
        (Cells::Simplices, Order::Edges),
        (Cells::Wedges, Order::Edges),
    ];
    let mut with_images = 0;
    for (i, kind) in kinds.into_iter().enumerate() {
        for (upper_is_slave, wide) in [false, true].into_iter().flat_map(|b| WIDE.map(|w| (b, w))) {
            let sizes = if upper_is_slave { [1.0, wide] } else { [wide, 1.0] };
            let held = 1 + (i + usize::from(upper_is_slave)) % 2;
            let part = Bodies::of_sizes(sizes, ([kind; 2], [[3, 2], [2, 3]]), 3, &mut rng);
            let context = format!("{kind:?}, {held} planes, {upper_is_slave}, {wide}");
            with_images += usize::from(!part.found(upper_is_slave, held).rows().vectors.is_empty());
            check(&part, held, upper_is_slave, &context);
        }
    }
    assert!(with_images > 0);
}

/// In the plane.
#[test]
fn parts_in_the_plane_have_the_solution_of_the_whole_body() {
    let (mut rng, mut states) = (Rng::with_seed(22), vec![]);
    for order in [Order::Linear, Order::Edges] {
        for cells in [Cells::Boxes, Cells::Simplices] {
            for upper_is_slave in [false, true] {
                let kinds = [(cells, order), (Cells::Boxes, Order::Linear)];
                let part = Bodies::new(kinds, [[9, 0], [7, 0]], 2, &mut rng);
                let context = format!("{kinds:?}, {upper_is_slave}");
                states.extend(check(&part, 1, upper_is_slave, &context).1);
            }
        }
    }
    assert_all(&states);
}

/// Slave nodes that are moved onto the other side stay on planes of symmetry, and go where they go in the whole body. The
/// master is larger: as many rows as nodes, which have one solution. To 1e-11: conjugate gradients leave 1e-12 of the
/// distances.
#[test]
fn moved_nodes_are_those_of_the_whole_surface() {
    let mut rng = Rng::with_seed(24);
    for shape in SHAPES {
        let mut sheet =
            |cells, end| Sheet::rectangle(shape, cells, [[0.0, end]; 2], (0.2, &mut rng));
        let slave = sheet([3, 4], 1.0).mapped(|[x, y, _]| [x, y, -0.1 * (x * x + 2.0 * y * y)]);
        let master = sheet([4, 3], 1.4).mapped(|[x, y, _]| [x, y, 0.02]).turned();
        let sheets = TwoSheets::new(3, slave, master);
        let faces = [sheets.slave, sheets.master];
        let part = Bodies { dim: 3, nodes: sheets.nodes, entries: vec![], faces };
        let whole = part.reflected(0).reflected(1);
        let moved = |bodies: &Bodies, symmetry| {
            let search_distance = Some(1.0);
            let settings = SurfaceSettings { search_distance, symmetry, ..Default::default() };
            let faces = bodies.faces.each_ref().map(|faces| &faces[..]);
            let found = pair(3, &bodies.nodes, faces, &settings).unwrap();
            let mut coordinates = bodies.nodes.concat();
            found.adjust(f64::INFINITY, &mut coordinates, &mut unlimited()).unwrap();
            coordinates
        };
        let planes = [0, 1].map(|axis| SymmetryPlane::across(axis, 0.0));
        let (of_part, of_whole) = (moved(&part, planes.to_vec()), moved(&whole, vec![]));
        let before = part.nodes.concat();
        let most = before.iter().zip(&of_part).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(most > 0.05, "{shape:?}: {most}");
        for (dof, (own, whole)) in of_part.iter().zip(&of_whole).enumerate() {
            let context = format!("{shape:?}, {dof}: {own} is not {whole}");
            assert!((own - whole).abs() < 1e-11, "{context}");
            assert!(before[dof] != 0.0 || dof % 3 == 2 || *own == 0.0, "{context}");
        }
    }
}

/// Normals, gaps and areas of curved surfaces near planes of symmetry are those of the whole, whatever the faces and
/// the kind of pairing: without the planes normals at the rim would lean over.
#[test]
fn normals_and_gaps_are_those_of_the_whole_surface() {
    let mut rng = Rng::with_seed(23);
    for shape in SHAPES {
        let mut sheet = |cells| Sheet::rectangle(shape, cells, [[0.0, 1.0]; 2], (0.2, &mut rng));
        let slave = sheet([3, 4])
            .mapped(|[x, y, _]| [x, y, -0.1 * (x * x + 2.0 * y * y) + 0.05 * x * x * y * y]);
        let master = sheet([4, 3]).mapped(|[x, y, _]| [x, y, 0.02]).turned();
        let sheets = TwoSheets::new(3, slave, master);
        let faces = [sheets.slave, sheets.master];
        let part = Bodies { dim: 3, nodes: sheets.nodes, entries: vec![], faces };
        let whole = part.reflected(0).reflected(1);
        for (pairing, normals) in [
            (Pairing::DualMortar, Normals::Averaged),
            (Pairing::DualMortar, Normals::Faces),
            (Pairing::NodeToSurface, Normals::Averaged),
            (Pairing::NodeToSurface, Normals::Faces),
        ] {
            let found = |bodies: &Bodies, symmetry| {
                let (search_distance, rims) = (Some(1.0), Rims::Fold);
                let settings = SurfaceSettings {
                    pairing,
                    search_distance,
                    symmetry,
                    normals,
                    rims,
                    ..Default::default()
                };
                pair(3, &bodies.nodes, bodies.faces.each_ref().map(|faces| &faces[..]), &settings)
                    .unwrap()
            };
            let planes = [0, 1].map(|axis| SymmetryPlane::across(axis, 0.0));
            let (of_part, of_whole) = (found(&part, planes.to_vec()), found(&whole, vec![]));
            assert!(of_part.on_symmetry().count() >= 4, "{shape:?}");
            for pair in &of_part.pairs {
                let at =
                    of_whole.pairs.binary_search_by_key(&pair.slave, |pair| pair.slave).unwrap();
                let same = &of_whole.pairs[at];
                let context = format!("{shape:?}, {pairing:?}, {normals:?}, node {}", pair.slave);
                let held = of_part.held.get(&pair.slave).map_or(&[][..], Vec::as_slice);
                let on = held.len();
                let place = part.nodes[pair.slave];
                let across = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].into_iter().zip(place);
                let across: Vec<_> =
                    across.filter(|(_, x)| *x == 0.0).map(|(axis, _)| axis).collect();
                assert_eq!(held, across, "{context}");
                let apart = |a: f64, b: f64| (a - b).abs();
                for (a, b) in pair.normal.iter().zip(same.normal) {
                    assert!(
                        apart(*a, b) < 1e-14,
                        "{context}: {:?}, {:?}",
                        pair.normal,
                        same.normal
                    );
                }
                // Rounding of coordinates of the size one.
                assert!(apart(pair.gap, same.gap) < 1e-14, "{context}: {}, {}", pair.gap, same.gap);
                let area = pair.area * f64::from(1 << on);
                assert!(apart(area, same.area) < 1e-14, "{context}: {area}, {}", same.area);
            }
        }
    }
}

/// A hollow slave looks across the plane: a notch above a wedge, apart. Pairs of the half are those of the whole, on which it stands
/// twice, with their gaps; and they feel what they feel there, if both sides of the whole move as mirror images; also where rows keep turns.
#[test]
fn a_hollow_slave_looks_across_the_plane() {
    let (slope, apart) = (0.5, 0.4);
    let line = |count: usize, end: f64, top: f64| -> Vec<Point> {
        let x = (0..=count).map(|i| end * i as f64 / count as f64);
        x.map(|x| [x, top - slope * x, 0.0]).collect()
    };
    let (notch, wedge) = (line(6, 1.0, 1.0), line(5, 1.2, 1.0 - apart));
    // The notch's body is above, and to the left of lines that run to the left; the wedge's is below.
    let slave = (0..6).map(|i| vec![i, i + 1]).collect();
    let master = (7..12).map(|i| vec![i + 1, i]).collect();
    let part =
        Bodies { dim: 2, nodes: [notch, wedge].concat(), entries: vec![], faces: [slave, master] };
    let whole = part.reflected(0);
    let rng = &mut Rng::with_seed(26);
    let moved: Vec<[f64; 2]> = (0..part.nodes.len())
        .map(|node| [if part.nodes[node][0] == 0.0 { 0.0 } else { rng.f64() }, rng.f64()])
        .collect();
    let felt = |bodies: &Bodies, symmetry: Vec<SymmetryPlane>, keep_turns: bool| {
        let settings = SurfaceSettings { symmetry, keep_turns, ..Default::default() };
        let found =
            pair(2, &bodies.nodes, bodies.faces.each_ref().map(|f| &f[..]), &settings).unwrap();
        // By places: a mirror image moves as its node does, but for the sign along x.
        let motion = |node: usize| {
            let [x, y, _] = bodies.nodes[node];
            let own = part.nodes.iter().position(|p| p[0] == x.abs() && p[1] == y).unwrap();
            [moved[own][0] * x.signum(), moved[own][1]]
        };
        let rows = found.rows();
        let each = if rows.vectors.is_empty() { 2 } else { 1 };
        let of_pair = |(j, pair): (usize, &SurfacePair)| {
            let mut d = [0.0; 2];
            for k in rows.master_start[j]..rows.master_start[j + 1] {
                for axis in 0..each {
                    let dof = rows.masters[each * k + axis];
                    let u = motion(dof / 2)[dof % 2];
                    let vector = match each {
                        1 => [rows.vectors[2 * k], rows.vectors[2 * k + 1]],
                        _ => [0, 1].map(|c| if c == axis { rows.weights[k] } else { 0.0 }),
                    };
                    (0..2).for_each(|c| d[c] += vector[c] * u);
                }
            }
            (pair.slave, pair.gap, d)
        };
        found.pairs.iter().enumerate().map(of_pair).collect::<Vec<_>>()
    };
    let mut turned = 0.0_f64;
    for keep_turns in [false, true] {
        let of_part = felt(&part, vec![SymmetryPlane::across(0, 0.0)], keep_turns);
        let of_whole = felt(&whole, vec![], keep_turns);
        assert_eq!(of_part.len(), 7);
        for ((node, gap, d), (same, other_gap, other)) in of_part.iter().zip(&of_whole) {
            assert_eq!(node, same);
            // To rounding of coordinates and displacements of the size one.
            let apart = [gap - other_gap, d[0] - other[0], d[1] - other[1]];
            assert!(largest(&apart) < 1e-13, "{node}, {keep_turns}: {apart:?}");
        }
        let sum: f64 = of_part.iter().map(|(.., d)| d[0] + d[1]).sum();
        turned += if keep_turns { sum } else { -sum };
    }
    assert!(turned.abs() > 1e-3, "{turned:e}");
}

/// Planes that cannot be: each with what to do.
#[test]
fn wrong_planes_are_refused() {
    let rng = &mut Rng::with_seed(24);
    let sheet = |rng: &mut Rng| Sheet::rectangle(Shape::Q4, [2, 2], [[0.0, 1.0]; 2], (0.0, rng));
    let sheets = TwoSheets::new(3, sheet(rng), sheet(rng).mapped(|[x, y, _]| [x, y, 0.1]).turned());
    for (axis, at, sentence) in [
        (0, f64::NAN, "plane of symmetry 0: it stands at NaN, which is not finite"),
        (
            1,
            0.25,
            "has slave nodes on both sides, 2 and 8: model one side alone, or leave the plane out. \
             Those on one side are 2.5e-1 away at most: if they should stand on it, give its direction and its place, and \
             coordinates, with more digits, as nodes do to 1.0e-6",
        ),
        (2, 0.0, "a plane of symmetry has slave faces in it, at node 0: leave these faces out"),
    ] {
        for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
            let symmetry = vec![SymmetryPlane::across(axis, at)];
            let settings = SurfaceSettings { pairing, symmetry, ..SurfaceSettings::default() };
            let error = sheets.pair(&settings).unwrap_err().to_string();
            assert!(error.contains(sentence), "{error}");
        }
    }
    // A corner stands on two planes, of which no whole body has images: their angle, 0.3, is no part of a half turn.
    let skewed = SymmetryPlane { normal: [f64::sin(0.3), f64::cos(0.3), 0.0], at: 0.0 };
    let symmetry = vec![SymmetryPlane::across(0, 0.0), skewed];
    let error = sheets.pair(&SurfaceSettings { symmetry, ..SurfaceSettings::default() });
    let error = error.unwrap_err().to_string();
    assert!(error.contains("an angle of which half a turn is no multiple"), "{error}");
    // A plane that the surface does not meet changes nothing: another contact zone may.
    let symmetry = vec![SymmetryPlane::across(0, -1.0)];
    let mut far = sheets.pair(&SurfaceSettings { symmetry, ..SurfaceSettings::default() }).unwrap();
    let said = far.summary().to_string();
    assert!(said.ends_with("; no slave node stands on plane of symmetry 0"), "{said}");
    far.report.idle_planes.clear();
    assert_eq!(far, sheets.pair(&SurfaceSettings::default()).unwrap());
    // Nor does one a hundredth beside its rim, but that is told: faces are half as large as the sheet.
    let symmetry = vec![SymmetryPlane::across(1, -1.0), SymmetryPlane::across(0, -0.01)];
    let beside = sheets.pair(&SurfaceSettings { symmetry, ..SurfaceSettings::default() }).unwrap();
    assert!(
        matches!(beside.report.beside_planes[..], [(1, _, distance)] if (distance - 0.01).abs() < 1e-15)
    );
    let said = beside.summary().to_string();
    assert!(said.contains(" is 1.0e-2 away from plane of symmetry 1 and does not count"), "{said}");
}

/// Bodies of revolution may name their axis, which changes nothing. A plane along it is none of theirs.
#[test]
fn of_rings_have_planes_across_the_axis() {
    let nodes = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]].repeat(2);
    let [slave, master] = [vec![vec![0, 1], vec![1, 2]], vec![vec![5, 4], vec![4, 3]]];
    let found = |symmetry: &[SymmetryPlane]| {
        let settings = SurfaceSettings {
            axisymmetric: true,
            symmetry: symmetry.to_vec(),
            ..SurfaceSettings::default()
        };
        pair(2, &nodes, [&slave, &master], &settings)
    };
    let alone = found(&[]).unwrap();
    assert_eq!(alone.pairs, found(&[SymmetryPlane::across(0, 0.0)]).unwrap().pairs);
    for wrong in [SymmetryPlane::across(0, 2.0), SymmetryPlane { normal: [1.0, 1.0, 0.0], at: 0.0 }]
    {
        let error = found(&[wrong]).unwrap_err().to_string();
        assert!(error.contains("is none of a body of revolution"), "{error}");
    }
}
