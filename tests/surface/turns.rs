//! Rows that keep rigid turns: nothing that is tied is strained by one, however the facets of both sides stand.

use crate::surfaces::{SHAPES, Sheet, TwoSheets, line, pair, steps};
use crate::zones::{cut, paired};
use fastrand::Rng;
use signorini::surface::{Pairing, SurfacePairs, SurfaceSettings};

/// The most that a displacement of size one moves a row by degree of freedom.
fn most_moved(found: &SurfacePairs, nodes: &[[f64; 3]], u: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
    let (dim, rows) = (found.dim, found.rows());
    assert!(!rows.vectors.is_empty(), "{:?}", found.pairs);
    let of_pair = |ends: &[usize]| {
        let mut d = vec![0.0; dim];
        for k in ends[0]..ends[1] {
            let moved = u(nodes[rows.masters[k] / dim])[rows.masters[k] % dim];
            d.iter_mut().zip(&rows.vectors[dim * k..]).for_each(|(d, part)| *d += part * moved);
        }
        d.iter().map(|d| d.abs()).fold(0.0, f64::max)
    };
    rows.master_start.windows(2).map(of_pair).fold(0.0, f64::max)
}

/// A rigid motion, turned about a direction and moved.
fn rigid(dim: usize, rng: &mut Rng) -> impl Fn([f64; 3]) -> [f64; 3] + use<> {
    let mut number = || 2.0 * rng.f64() - 1.0;
    let (moved, mut about) = ([number(), number(), 0.0], [number(), number(), number()]);
    if dim == 2 {
        about = [0.0, 0.0, about[2]];
    }
    move |[x, y, z]| {
        let [a, b, c] = about;
        [b * z - c * y + moved[0], c * x - a * z + moved[1], a * y - b * x]
    }
}

fn keeping(pairing: Pairing) -> SurfaceSettings {
    SurfaceSettings { pairing, keep_turns: true, ..SurfaceSettings::default() }
}

/// Bowls whose facets do not fit, up to a tenth apart, faces of all kinds, in one zone and in four: a rigid motion moves no row, to
/// rounding of sums of some ten coordinates of the size one. Rows of nodes are moved by more than a ten-thousandth. Weights, gaps
/// and areas are those without.
#[test]
fn rigid_motions_move_no_row() {
    let mut rng = Rng::with_seed(51);
    let bowl = |[x, y, z]: [f64; 3]| [x, y, z + 0.08 * (2.0 * x + 0.3).sin() * (1.5 * y).cos()];
    for shape in SHAPES {
        for apart in [0.0, 0.1] {
            let slave = Sheet::rectangle(shape, [4; 2], [[0.0, 2.0]; 2], (0.1, &mut rng));
            let master = Sheet::rectangle(shape, [3, 5], [[-0.1, 2.1]; 2], (0.1, &mut rng));
            let master = master.mapped(|[x, y, z]| bowl([x, y, z - apart]));
            let both = TwoSheets::new(3, slave.turned().mapped(bowl), master);
            for pairing in [Pairing::DualMortar, Pairing::NodeToSurface] {
                let context = format!("{shape:?}, {apart}, {pairing:?}");
                let found = both.pair(&keeping(pairing)).unwrap();
                let of_nodes = SurfaceSettings { keep_turns: false, ..keeping(pairing) };
                let of_nodes = both.pair(&of_nodes).unwrap();
                let motion = rigid(3, &mut rng);
                let moved = most_moved(&found, &both.nodes, &motion);
                assert!(moved < 1e-13, "{context}: {moved:e}");
                let strained = crate::surfaces::most_moved(&of_nodes, &both.nodes, &motion);
                assert!(strained > 1e-4, "{context}: {strained:e}");
                let plain = |found: &SurfacePairs| {
                    found
                        .pairs
                        .iter()
                        .map(|pair| (pair.nodes.clone(), pair.gap, pair.area))
                        .collect::<Vec<_>>()
                };
                assert_eq!(plain(&found), plain(&of_nodes), "{context}");
            }
            let zones: Vec<_> = cut(&both.slave, &both.nodes, true)
                .into_iter()
                .map(|part| [part, both.master.clone()])
                .collect();
            let joined = paired(3, &both.nodes, &zones, &keeping(Pairing::DualMortar)).contact;
            let moved = most_moved(&joined, &both.nodes, rigid(3, &mut rng));
            assert!(moved < 1e-13, "{shape:?}, {apart}, zones: {moved:e}");
        }
    }
}

/// Sides whose nodes are opposite each other, or twice as many on the slave: their rows have one master or masters on a line, which
/// tell no turn about it. Faces of all kinds, flat and in a bowl.
#[test]
fn rigid_motions_move_no_row_of_one_master() {
    let mut rng = Rng::with_seed(55);
    for shape in SHAPES {
        for (bend, own, opposite) in
            [(0.0, [4; 2], [4; 2]), (0.1, [4; 2], [4; 2]), (0.1, [4, 8], [4; 2])]
        {
            let bowl = |[x, y, z]: [f64; 3]| [x, y, z + bend * (2.0 * x + 0.3).sin()];
            let sheet =
                |cells| Sheet::rectangle(shape, cells, [[0.0, 2.0]; 2], (0.0, &mut Rng::new()));
            let master = sheet(opposite).mapped(|[x, y, z]| bowl([x, y, z - 0.05]));
            let both = TwoSheets::new(3, sheet(own).turned().mapped(bowl), master);
            let found = both.pair(&keeping(Pairing::DualMortar)).unwrap();
            let moved = most_moved(&found, &both.nodes, rigid(3, &mut rng));
            assert!(moved < 1e-13, "{shape:?}, {bend}, {own:?}: {moved:e}");
        }
    }
}

/// In the plane, where masters are on a line.
#[test]
fn rigid_motions_move_no_row_in_the_plane() {
    let mut rng = Rng::with_seed(52);
    let kinds = [[false, false], [true, false], [false, true], [true, true]];
    for (quadratic, masters) in kinds.into_iter().flat_map(|kind| [(kind, 5), (kind, 7)]) {
        let (mut nodes, slave) = line(&steps(0.0, 2.0, 7), quadratic[0], 0);
        let (below, mut master) = line(&steps(0.0, 2.0, masters), quadratic[1], nodes.len());
        master.iter_mut().for_each(|face| face.swap(0, 1));
        nodes.extend(below.iter().map(|[x, y, z]| [*x, y - 0.05, *z]));
        nodes.iter_mut().for_each(|p| p[1] += 0.2 * p[0].powi(2));
        let found = pair(2, &nodes, [&slave, &master], &keeping(Pairing::DualMortar)).unwrap();
        let moved = most_moved(&found, &nodes, rigid(2, &mut rng));
        assert!(moved < 1e-13, "{quadratic:?}: {moved:e}");
    }
}

/// Flat sides that touch keep turns without it, and have rows of nodes as before. Meridians do not turn.
#[test]
fn rows_of_flat_sides_stay_rows_of_nodes() {
    let mut rng = Rng::with_seed(53);
    for shape in SHAPES {
        let mut sheet = |cells| Sheet::rectangle(shape, cells, [[0.0, 2.0]; 2], (0.1, &mut rng));
        let both = TwoSheets::new(3, sheet([4; 2]).turned(), sheet([3, 5]));
        let found = both.pair(&keeping(Pairing::DualMortar)).unwrap();
        assert!(found.rows().vectors.is_empty(), "{shape:?}");
    }
    let (mut nodes, slave) = line(&steps(0.0, 2.0, 7), false, 0);
    let (below, mut master) = line(&steps(0.0, 2.0, 5), false, nodes.len());
    master.iter_mut().for_each(|face| face.swap(0, 1));
    nodes.extend(below);
    let settings = SurfaceSettings { axisymmetric: true, ..keeping(Pairing::DualMortar) };
    let error = pair(2, &nodes, [&slave, &master], &settings).unwrap_err().to_string();
    assert!(error.contains("keep_turns: meridians of a body of revolution do not turn"), "{error}");
}
