//! Zones in one set of pairs: the rows of each, what each carries, and what cannot be joined.

use crate::surfaces::{flat, line, pair, steps};
use signorini::surface::{
    ContactZone, Faces, PairResults, SurfacePairs, SurfaceSettings, join_zones, summary_of_zones,
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
    let joined = join_zones(&zones).unwrap();
    let first = down.pairs.len();
    assert_eq!(joined.pairs, [&down.pairs[..], &up.pairs].concat());
    assert_eq!((first, joined.pairs.len()), (5, 9));
    assert_eq!((joined.report.slave_faces, joined.report.uncovered_faces.len()), (7, 0));
    assert!((joined.report.covered_area - 2.0).abs() < 1e-14);

    let pressure = |j: usize| if j < first { 3.0 } else { 5.0 };
    let normal =
        |(j, pair): (usize, &signorini::surface::SurfacePair)| [-pressure(j) * pair.area, 0.0];
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
    let summary = summary_of_zones(zones.iter().map(|zone| (zone.name, zone.contact))).to_string();
    assert!(
        summary.starts_with("down: 5 pairs on 100.00 %") && summary.contains(". up: 4 pairs on"),
        "{summary}"
    );
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
        (zone("one", &contact, no_faces), "two zones are named 'one'"),
        (zone("", &contact, no_faces), "zone 1 has no name"),
        (zone("two", &in_space, no_faces), "zone 'two' is in 3 dimensions, unlike zone 'one'"),
        (
            zone("two", &of_rings, no_faces),
            "zone 'two' is of revolution and not, or not and is, unlike zone 'one'",
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
    // The other side of the faces, as of a shell between two bodies: their normals are opposite.
    let mut other_side = contact.clone();
    other_side.pairs.iter_mut().for_each(|pair| pair.normal = pair.normal.map(|n| -n));
    let both = join_zones(&[one, zone("two", &other_side, slave)]).expect("a shell").pairs;
    assert_eq!(both, [contact.pairs.clone(), other_side.pairs.clone()].concat());
    // The same side twice, of which one zone has found nothing.
    assert_eq!(join_zones(&[one, zone("two", &nothing, slave)]).unwrap().pairs, contact.pairs);
}
