//! Slabs that are held across their thickness: problems of the plane in space, as quarter models have them too.

use signorini::Settings;

use crate::common::brick::{Brick, Support};
use crate::common::dense::{difference, largest};

/// A block, one brick thick, on springs that are far stiffer than itself: the pairs' components across the slab, which
/// supports hold, move nothing. So there are the forces of the plane, and no more work than in the plane: a few linear
/// systems, whatever the library puts on the diagonal of what is held. Pressed, pushed along, and let go by half, with
/// the slips of the step before. The tolerance is that of `eta`, 1e-10, times a condition of 1e3.
#[test]
fn slabs_in_space_are_problems_of_the_plane() {
    let mut brick = Brick::new([24, 1, 6], [4.0, 0.1, 1.0], Support::Springs(1e5));
    brick.held = (0..brick.nodes.len()).map(|node| 3 * node + 1).collect();
    let model = brick.model();
    let kept: Vec<usize> = (0..3 * brick.pairs()).filter(|i| i % 3 != 2).collect();
    let settings = Settings::default();
    let (mut slip, mut slip_in_plane) = (None, None);
    for part in [0.2, 1.0, 0.5] {
        let mut space = brick.case(&model, |_| [0.004 * part, 0.0, -0.01 * part], 0.2);
        space.slip = slip.take();
        let of_kept = |values: &[f64]| kept.iter().map(|&i| values[i]).collect::<Vec<f64>>();
        let size = 3 * brick.pairs();
        let columns = kept.iter().map(|&j| of_kept(&space.k[size * j..size * (j + 1)]));
        let mut plane = space.clone();
        plane.dim = 2;
        (plane.k, plane.f) = (columns.flatten().collect(), of_kept(&space.f));
        plane.slip = slip_in_plane.take();
        let (in_space, in_plane) = (space.solve(&settings), plane.solve(&settings));
        let within = 1e-7 * largest(&in_plane.certificate.force);
        assert!(
            largest(&difference(
                &of_kept(&in_space.certificate.force),
                &in_plane.certificate.force
            )) <= within
        );
        assert!(in_space.iterations <= in_plane.iterations + 3, "{part}: {}", in_space.iterations);
        let slips = |d: &[f64], dim: usize| {
            d.chunks(dim).flat_map(|d| d[1..].to_vec()).collect::<Vec<f64>>()
        };
        (slip, slip_in_plane) = (Some(slips(&in_space.d, 3)), Some(slips(&in_plane.d, 2)));
    }
}
