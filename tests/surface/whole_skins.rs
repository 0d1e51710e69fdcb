//! Blocks whose whole boundary is a side of the contact: none stands in the other's way by faces that look elsewhere.

use crate::surfaces::{flat, unlimited};
use signorini::surface::{
    Faces, KeptSurfaces, Master, Penetration, SurfaceSettings, Surfaces, pair_surfaces,
};

/// Nodes of a closed line, turning to the left.
type Outline = Vec<[f64; 2]>;

/// The boundary of a rectangle, turning to the left, with its sides divided.
fn boundary([x, y]: [[f64; 2]; 2], [nx, ny]: [usize; 2]) -> Outline {
    let corners = [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]];
    let sides = (0..4).flat_map(|side| {
        let ([from, to], parts) = ([corners[side], corners[(side + 1) % 4]], [nx, ny][side % 2]);
        (0..parts).map(move |k| {
            let part = k as f64 / parts as f64;
            [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
        })
    });
    sides.collect()
}

/// Closed lines through lists of nodes, by their faces with outward normals to the right.
fn closed(lists: &[Outline], nodes: &mut Vec<[f64; 2]>) -> Vec<Vec<usize>> {
    let mut faces = Vec::new();
    for list in lists {
        let first = nodes.len();
        faces.extend((0..list.len()).map(|k| vec![first + k, first + (k + 1) % list.len()]));
        nodes.extend(list);
    }
    faces
}

/// The penetration after a block has moved against plates, as slave or as master, all turned by an angle.
fn after(
    (block, plates): (&[Outline], &[Outline]),
    (is_slave, angle): (bool, f64),
    motion: [f64; 2],
) -> Penetration {
    let mut nodes = Vec::new();
    let own = closed(block, &mut nodes);
    let count = nodes.len();
    let others = closed(plates, &mut nodes);
    let (sin, cos) = angle.sin_cos();
    let turned = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
    let coordinates: Vec<f64> = nodes.into_iter().flat_map(turned).collect();
    let [slave, master] = if is_slave { [own, others] } else { [others, own] }.map(|it| flat(&it));
    let surfaces = Surfaces {
        dim: 2,
        coordinates: &coordinates,
        slave: Faces { start: &slave.0, nodes: &slave.1 },
        master: Master::Faces(Faces { start: &master.0, nodes: &master.1 }),
    };
    let settings = SurfaceSettings { search_distance: Some(0.1), ..SurfaceSettings::default() };
    let found = pair_surfaces(&surfaces, &settings, &mut unlimited()).unwrap();
    let motion = turned(motion);
    let u = |node: usize, axis: usize| if node < count { motion[axis] } else { 0.0 };
    KeptSurfaces::new(&surfaces, 0.0).penetration(&found, u, &mut unlimited()).unwrap()
}

const TURNS: [f64; 3] = [0.0, 0.3, 2.0];

/// A block slides along the tops of plates and sinks by a little: beyond the end of a plate, over a joint, from above an open gap. No point
/// has passed by more than it sinks, although the ends of plates lie behind the front of the block.
#[test]
fn a_block_that_slides_has_not_passed_the_ends_of_plates() {
    let one = [boundary([[0.0, 2.0], [-0.5, 0.0]], [8, 2])];
    let two = [one[0].clone(), boundary([[-2.0, -0.05], [-0.5, 0.0]], [8, 2])];
    for (plates, begin) in
        [(&one[..], 1.18), (&one[..], -0.78), (&two[..], -0.78), (&two[..], -0.83)]
    {
        for (parts, slide) in [1, 3, 5].into_iter().flat_map(|n| [0.02, 0.25, -0.6].map(|s| (n, s)))
        {
            let block = [boundary([[begin, begin + 0.8], [0.0, 0.6]], [parts, 2])];
            for (is_slave, angle) in [true, false].into_iter().flat_map(|is| TURNS.map(|t| (is, t)))
            {
                for sink in [0.0, 1e-4] {
                    let found = after((&block, plates), (is_slave, angle), [slide, -sink]);
                    let context =
                        format!("{begin}, {parts}, {slide}, {is_slave}, {angle}: {found:?}");
                    // Rounding of coordinates.
                    assert!(found.depth < sink + 1e-14, "{context}");
                }
            }
        }
    }
}

/// A block above a plate, with no pair, falls into it, or through the whole of it: its lowest nodes are as deep as they are below the
/// plate's top, and beyond a plate that is thinner than that.
#[test]
fn a_block_that_falls_through_a_plate_is_told_with_its_depth() {
    for (thickness, parts) in [0.1, 0.5, 3.0].into_iter().flat_map(|t| [1, 2, 5].map(|n| (t, n))) {
        let plate = [boundary([[0.0, 2.0], [-thickness, 0.0]], [parts, 1])];
        let block = [boundary([[0.7, 1.5], [1.0, 1.6]], [parts, 2])];
        for (is_slave, angle) in [true, false].into_iter().flat_map(|is| TURNS.map(|t| (is, t))) {
            for depth in [-0.5, 0.05, 0.3, 2.0] {
                let found = after((&block, &plate), (is_slave, angle), [0.0, -1.0 - depth]);
                let context =
                    format!("{thickness}, {parts}, {is_slave}, {angle}, {depth}: {found:?}");
                assert!((found.depth - f64::max(depth, 0.0)).abs() < 1e-13, "{context}");
                assert_eq!(found.count > 0, depth > 0.0, "{context}");
            }
        }
    }
}
