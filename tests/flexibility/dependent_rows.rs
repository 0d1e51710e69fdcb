//! Pairs whose rows depend on each other: contact forces are not unique, displacements are, and what has no
//! solution is said for what it is.

use crate::common::brick::{Brick, Support};
use crate::common::dense::{Elimination, difference, dot, largest};
use crate::common::problems::{uniform, vector};
use crate::rows::{Host, solved, springs};
use fastrand::Rng;
use signorini::{
    Error, Escape, FrictionLaw, LoadCase, Monitor, Search, Settings, Solution, State, Status,
    Uniqueness,
};

/// A node on springs of stiffness 2 along each axis, against rigid planes with these outward normals.
fn node_on_planes(normals: &[[f64; 2]]) -> Host {
    Host {
        dim: 2,
        stiffness: vec![2.0, 0.0, 0.0, 2.0],
        fixed: vec![],
        rows: vec![vec![(0, 1.0)]; normals.len()],
        normals: normals.concat(),
        tangents: None,
    }
}

/// Solves with one coefficient of friction, and asserts that a solution balances in the host.
fn checked(host: &Host, load: &[f64], gap: &[f64], mu: f64) -> Solution {
    let model = host.model().unwrap();
    let mu = vec![mu; gap.len()];
    let solution = solved(&model, load, gap, &mu);
    if solution.status == Status::Solved {
        let law = FrictionLaw::Coulomb(&mu);
        let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
        host.assert_balanced(&model, &case, &solution, 1e-9);
        if !model.dependent_pairs().is_empty() {
            assert_eq!(solution.uniqueness, Uniqueness::NotKnown);
        }
    }
    solution
}

/// Floor below (normal -y), wall at the right (normal +x), no gaps.
const CORNER: [[f64; 2]; 2] = [[0.0, -1.0], [1.0, 0.0]];

/// A call for a node that (1, -1) presses into the corner, with mu .3.
fn pressed_into_the_corner(settings: &Settings) -> Result<Solution, Error> {
    let model = node_on_planes(&CORNER).model().unwrap();
    let law = FrictionLaw::Coulomb(&[0.3; 2]);
    let load = &[1.0, -1.0];
    let case = LoadCase { load, prescribed: None, gap: &[0.0; 2], law, reference_slip: None };
    model.solve(&case, settings, None, &mut Monitor::new(settings, None))
}

/// A call that has no time to condense ends where it starts, certified: without displacements nothing carries the
/// load.
#[test]
fn a_call_without_time_ends_where_it_starts() {
    let settings = Settings { time_limit: f64::MIN_POSITIVE, ..Settings::default() };
    let solution = pressed_into_the_corner(&settings).unwrap();
    assert_eq!(solution.status, Status::TimeLimit, "{}", solution.message);
    assert_eq!(solution.d, [0.0; 4]);
    assert!(solution.certificate.eta > 0.1, "{:e}", solution.certificate.eta);
}

/// Nodes on springs against planes, and against means of two nodes, whose normals and weights are apart by 1e-9 to 1, so that rows
/// repeat others, nearly do, or do not: bodies that springs hold have a solution whatever friction is, and it balances in the host. To 1e-8:
/// a hundred times the tolerance. One of a hundred may be left without one, and none is said to have none.
#[test]
fn rows_that_nearly_follow_from_others_are_solved() {
    let power = |rng: &mut Rng, low: f64, high: f64| 10f64.powf(uniform(rng, low, high));
    let (mut dependent, mut unsolved) = (0, 0);
    for seed in 0..400 {
        let rng = &mut Rng::with_seed(seed);
        let (dim, nodes, pairs) = (rng.usize(2..=3), rng.usize(1..=3), rng.usize(2..=11));
        let apart = power(rng, -9.0, 0.0);
        let base = vector(rng, dim * nodes);
        let (mut rows, mut normals) = (Vec::new(), Vec::new());
        for _ in 0..pairs {
            let node = rng.usize(0..nodes);
            let off = vector(rng, dim);
            let near = base[dim * node..dim * (node + 1)].iter().zip(off);
            normals.extend(near.map(|(base, off)| base + apart * off));
            let share = if rng.bool() { power(rng, -9.0, -0.3) } else { 0.5 };
            let is_mean = nodes > 1 && rng.u8(0..10) < 3;
            let mean = || vec![(node, 1.0 - share), ((node + 1) % nodes, share)];
            rows.push(if is_mean { mean() } else { vec![(node, 1.0)] });
        }
        let stiffness = springs(rng, dim * nodes);
        let host = Host { dim, stiffness, fixed: vec![], rows, normals, tangents: None };
        let model = host.model().unwrap_or_else(|error| panic!("seed {seed}: {error}"));
        dependent += usize::from(!model.dependent_pairs().is_empty());
        let load = vector(rng, dim * nodes);
        let gap: Vec<f64> = (0..pairs).map(|_| uniform(rng, -0.2, 0.1).max(0.0)).collect();
        let mu: Vec<f64> = (0..pairs).map(|_| uniform(rng, -0.5, 1.0).max(0.0)).collect();
        let law = FrictionLaw::Coulomb(&mu);
        let case = LoadCase { load: &load, prescribed: None, gap: &gap, law, reference_slip: None };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = model.solve(&case, &settings, None, monitor).unwrap();
        match solution.status {
            Status::Solved => host.assert_balanced(&model, &case, &solution, 1e-8),
            status => {
                assert_eq!(status, Status::Stalled, "seed {seed}: {}", solution.message);
                unsolved += 1;
            }
        }
    }
    assert!(dependent > 300, "{dependent}");
    assert!(unsolved <= 4, "{unsolved}");
}

/// A question that these models cannot answer is refused, as in full space.
#[test]
fn a_search_for_other_solutions_is_refused() {
    let settings = Settings { search: Search::Others, ..Settings::default() };
    let error = pressed_into_the_corner(&settings).unwrap_err();
    assert!(error.to_string().contains("search for other solutions"), "{error}");
}

/// Pressed into the corner by (1, -1) nothing moves. Normal and tangential forces of either plane share
/// the load: N + T = 1 with N of one plane and T of the other. The smallest forces are N = T = 1/2, where
/// friction allows T = N; below that T = mu N, so N = 1 / (1 + mu).
#[test]
fn a_corner_node_presses_on_floor_and_wall() {
    let host = node_on_planes(&CORNER);
    assert_eq!(host.model().unwrap().dependent_pairs().len(), 1);
    for mu in [0.0, 0.1, 0.5, 1.0, 1.5, 10.0] {
        let solution = checked(&host, &[1.0, -1.0], &[0.0; 2], mu);
        assert_eq!(solution.status, Status::Solved, "mu {mu}: {}", solution.message);
        // The tolerance is 1e-12 of forces of size 1.
        assert!(largest(&solution.d) < 1e-10, "mu {mu}: {:?}", solution.d);
        let normal = 1.0 / (1.0 + f64::min(mu, 1.0));
        let force = &solution.certificate.force;
        for pair in 0..2 {
            assert!((force[2 * pair] + normal).abs() < 1e-9, "mu {mu}: {force:?}");
            assert!(
                (force[2 * pair + 1].abs() - (1.0 - normal)).abs() < 1e-9,
                "mu {mu}: {force:?}"
            );
        }
    }
}

/// Pressed on the wall by 1 and lifted by f: the floor opens, and the wall holds up to mu.
#[test]
fn a_corner_node_leaves_the_floor_along_the_wall() {
    let host = node_on_planes(&CORNER);
    for (mu, lift) in [(0.0, 0.4), (0.3, 0.4), (0.3, 1.0), (0.5, 2.0)] {
        let solution = checked(&host, &[1.0, lift], &[0.0; 2], mu);
        assert_eq!(solution.status, Status::Solved, "mu {mu}: {}", solution.message);
        // Springs of stiffness 2; the normal displacement of the floor is downwards.
        let up = (lift - mu) / 2.0;
        assert!((solution.d[0] + up).abs() < 1e-10, "mu {mu}: {:?}", solution.d);
        assert_eq!(solution.certificate.states, [State::Open, State::Slip]);
        assert!((solution.certificate.force[2] + 1.0).abs() < 1e-10);
    }
}

/// A node in a groove of half angle a whose walls both overlap it by h: they lift it by h / sin a against
/// its springs. It slides up, so that friction pulls it down: 2 N (sin a - mu cos a) = k h / sin a. With
/// tan a <= mu no N does this.
#[test]
fn a_wedge_is_solved_or_said_to_be_one() {
    let (h, k) = (0.1, 2.0);
    let (mut lifted, mut wedged) = (0, 0);
    for degrees in [10.0_f64, 20.0, 45.0, 70.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let host = node_on_planes(&[[cos, -sin], [-cos, -sin]]);
        for mu in [0.0, 0.1, 0.3, 1.1] {
            let solution = checked(&host, &[0.0; 2], &[-h; 2], mu);
            let context = format!("{degrees} degrees, mu {mu}: {}", solution.message);
            if mu < sin / cos {
                assert_eq!(solution.status, Status::Solved, "{context}");
                let normal = k * h / sin / (2.0 * (sin - mu * cos));
                let force = &solution.certificate.force;
                for pair in 0..2 {
                    let error = force[2 * pair] + normal;
                    assert!(error.abs() < 1e-8 * normal, "{context}: {force:?}");
                }
                lifted += 1;
            } else {
                assert_eq!(solution.status, Status::Stalled, "{context}");
                assert!(context.contains("pairs 0, 1 grow without end"), "{context}");
                wedged += 1;
            }
        }
    }
    assert_eq!((lifted, wedged), (12, 4));
}

/// The groove where friction all but holds the node, at angles a little above `tan a = mu`, and without friction as good as two
/// planes that face each other: the forces are large and right. They follow from the small part of the resultant that is left, so
/// that the tolerance of 1e-10 is one of 1e-10 times the forces over the load of the springs.
#[test]
fn a_groove_near_its_limit_is_solved() {
    let (h, k) = (0.1, 2.0);
    for mu in [0.0_f64, 0.05, 0.3, 1.0] {
        for beyond in [1e-2, 1e-3, 1e-4] {
            let (sin, cos) = (mu.atan() + beyond).sin_cos();
            let host = node_on_planes(&[[cos, -sin], [-cos, -sin]]);
            let solution = checked(&host, &[0.0; 2], &[-h; 2], mu);
            let context = format!("mu {mu}, {beyond}: {}", solution.message);
            assert_eq!(solution.status, Status::Solved, "{context}");
            let normal = k * h / sin / (2.0 * (sin - mu * cos));
            let allowed = 1e-10 * normal / (k * h / sin);
            for pair in 0..2 {
                let error = (solution.certificate.force[2 * pair] + normal).abs() / normal;
                assert!(error <= allowed.max(1e-10), "{context}: {error:e}");
            }
        }
    }
}

/// Pressed down by 1 into a groove that it just touches: it rests, whatever the friction, and the walls carry the load.
#[test]
fn a_node_pressed_into_a_groove_rests() {
    for degrees in [10.0_f64, 20.0, 45.0, 70.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let host = node_on_planes(&[[cos, -sin], [-cos, -sin]]);
        for mu in [0.0, 0.1, 0.3, 1.1, 3.0] {
            let solution = checked(&host, &[0.0, -1.0], &[0.0; 2], mu);
            let context = format!("{degrees} degrees, mu {mu}: {}", solution.message);
            assert_eq!(solution.status, Status::Solved, "{context}");
            // The tolerance is 1e-12 of forces of at most 3 on springs of 2.
            assert!(largest(&solution.d) < 1e-10, "{context}: {:?}", solution.d);
        }
    }
}

/// Walls closer than the body, with a rough tolerance: the forces, which balance each other, grow round by round, and what is left
/// does not count beside them.
#[test]
fn contradicting_gaps_are_not_solved_roughly() {
    let host = node_on_planes(&[[1.0, 0.0], [-1.0, 0.0]]);
    let model = host.model().unwrap();
    for tolerance in [1e-8, 1e-6, 1e-4, 1e-3] {
        for mu in [0.0, 0.3] {
            let law = FrictionLaw::Coulomb(&[mu; 2]);
            let (load, gap) = (&[0.3, 0.2], &[-0.01; 2]);
            let case = LoadCase { load, prescribed: None, gap, law, reference_slip: None };
            let settings = Settings { tolerance, ..Settings::default() };
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            let context = format!("{tolerance:e}, mu {mu}: {}", solution.message);
            assert_eq!(solution.status, Status::Stalled, "{context}");
            assert!(context.contains("the gaps of pairs 0, 1 contradict each other"), "{context}");
        }
    }
}

/// Walls closer than the body: whatever it does, it enters one of them.
#[test]
fn gaps_that_contradict_each_other_are_named() {
    let host = node_on_planes(&[[1.0, 0.0], [0.0, -1.0], [-1.0, 0.0]]);
    for mu in [0.0, 0.3] {
        let solution = checked(&host, &[0.3, 0.2], &[-0.1, 0.2, 0.05], mu);
        assert_eq!(solution.status, Status::Stalled, "{}", solution.message);
        let said = "no solution exists: the gaps of pairs 0, 2 contradict each other";
        assert!(solution.message.contains(said), "{}", solution.message);
        // With room between them there is one.
        let solution = checked(&host, &[0.3, 0.2], &[-0.1, 0.2, 0.15], mu);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    }
}

/// Two pairs of one node have the same displacement. A tie prescribes it, so that the other pair must prescribe the same along
/// its normal and tangent if it is tied, and must have its obstacle there or beyond if it is not.
#[test]
fn ties_that_contradict_each_other_are_named() {
    let model = node_on_planes(&[[0.0, -1.0], [0.0, -1.0]]).model().unwrap();
    let tie = [7.0, 0.0, 0.0, 0.0];
    let of_second = [[7.0, 0.0, 0.0, 0.0], [1.0, 0.3, 0.0, 0.0], [2.0, 5.0, 0.0, 0.0], [0.0; 4]];
    for (kind, second) in of_second.into_iter().enumerate() {
        for (gap, slip) in [
            ([0.0, 0.01], [0.0; 2]),
            ([0.0, -0.01], [0.0; 2]),
            ([0.02, 0.02], [0.0, 0.01]),
            ([0.02, 0.02], [0.01, 0.01]),
            ([0.02, 0.03], [-0.01, 0.01]),
        ] {
            let fits = match kind {
                0 => gap[0] == gap[1] && slip[0] == slip[1],
                _ => gap[0] <= gap[1],
            };
            let numbers = [tie, second].concat();
            let case = LoadCase {
                load: &[0.3, 0.2],
                prescribed: None,
                gap: &gap,
                law: FrictionLaw::ByPair(&numbers),
                reference_slip: Some(&slip),
            };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let solution = model.solve(&case, &settings, None, monitor).unwrap();
            let context = format!("{second:?}, {gap:?}, {slip:?}: {}", solution.message);
            if fits {
                assert_eq!(solution.status, Status::Solved, "{context}");
                // The tolerance is 1e-10 of forces below 1, on springs of 2.
                assert!((solution.d[0] - gap[0]).abs() < 1e-9, "{context}");
                assert!((solution.d[1] - slip[0]).abs() < 1e-9, "{context}");
            } else {
                assert_ne!(solution.status, Status::Solved, "{context}");
                let said =
                    "no solution exists: the gaps or slips of pairs 0, 1 contradict each other";
                assert!(solution.message.contains(said), "{context}");
            }
        }
    }
}

/// A pair whose node is fixed, beside a node that is slave of two pairs: a penetration, the gap of a tie and a tension ask for a
/// displacement or a force that the fixed node does not have, and are refused as they are without the second pair.
#[test]
fn held_pairs_beside_dependent_ones_are_checked() {
    for copies in [1, 2] {
        let count = 1 + copies;
        let mut rows = vec![vec![(1, 1.0)]; count];
        rows[0] = vec![(0, 1.0)];
        let stiffness = vec![
            3.0, 0.0, -1.0, 0.0, 0.0, 3.0, 0.0, -1.0, -1.0, 0.0, 3.0, 0.0, 0.0, -1.0, 0.0, 3.0,
        ];
        let normals = [1.0, 0.0].repeat(count);
        let host = Host { dim: 2, stiffness, fixed: vec![0, 1], rows, normals, tangents: None };
        let model = host.model().unwrap();
        let [mu, cohesion] = [vec![0.3; count], [0.3, 2.0, 1.0].repeat(count)];
        for (first, law, said) in [
            (-1.0, FrictionLaw::Coulomb(&mu), Some("gap[0] is -1, a penetration")),
            (0.5, FrictionLaw::Tied, Some("gap[0] is 0.5, and the pair is tied")),
            (0.5, FrictionLaw::Cohesive(&cohesion), Some("pair 0 has a tension of 1")),
            (0.5, FrictionLaw::Coulomb(&mu), None),
        ] {
            let mut gap = vec![0.2; count];
            gap[0] = first;
            let load = &[0.0, 0.0, 1.0, 0.0];
            let case = LoadCase { load, prescribed: None, gap: &gap, law, reference_slip: None };
            let settings = Settings::default();
            let found = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None));
            match (found, said) {
                (Err(error), Some(said)) => {
                    assert!(error.to_string().starts_with(said), "{copies}: {error}");
                }
                (Ok(solution), None) => assert_eq!(solution.status, Status::Solved),
                (found, _) => panic!("{copies}, {law:?}: {found:?}"),
            }
        }
    }
}

/// A host with independent random rows.
fn independent(rng: &mut Rng) -> Host {
    loop {
        let dim = rng.usize(2..=3);
        let (nodes, pairs) = (rng.usize(8..=12), rng.usize(1..=4));
        let row = |rng: &mut Rng| {
            let weight = uniform(rng, 0.2, 0.8);
            let mut node = || rng.usize(0..nodes);
            vec![(node(), 1.0), (node(), -weight), (node(), weight - 1.0)]
        };
        let rows = (0..pairs).map(|_| row(rng)).collect();
        let stiffness = springs(rng, dim * nodes);
        let normals = vector(rng, dim * pairs);
        let host = Host { dim, stiffness, fixed: vec![], rows, normals, tangents: None };
        if host.model().is_ok_and(|model| model.dependent_pairs().is_empty()) {
            return host;
        }
    }
}

/// Every pair named two or three times moves as it did, each copy with its share of the force. Where forces
/// are unique but for the copies, the smallest ones are equal shares.
#[test]
fn copies_of_pairs_share_their_forces() {
    let mut friction = 0;
    for seed in 0..150 {
        let rng = &mut Rng::with_seed(seed);
        let host = independent(rng);
        let (pairs, copies) = (host.rows.len(), rng.usize(2..=3));
        let load: Vec<f64> = vector(rng, host.size()).iter().map(|f| 3.0 * f).collect();
        let gap: Vec<f64> = vector(rng, pairs).iter().map(|gap| 0.3 * gap).collect();
        // Far below the bounds of non-uniqueness by friction.
        let mu = *rng.choice([0.0, 0.05, 0.2].iter()).unwrap();
        let once = checked(&host, &load, &gap, mu);
        assert_eq!(once.status, Status::Solved, "seed {seed}: {}", once.message);
        let mut several = host.clone();
        several.rows = vec![host.rows.clone(); copies].concat();
        several.normals = host.normals.repeat(copies);
        let solution = checked(&several, &load, &gap.repeat(copies), mu);
        assert_eq!(solution.status, Status::Solved, "seed {seed}: {}", solution.message);
        let error = largest(&difference(&solution.d, &once.d.repeat(copies)));
        assert!(error <= 1e-8 * largest(&once.d), "seed {seed}: {error:e}");
        let share: Vec<f64> =
            once.certificate.force.iter().map(|force| force / copies as f64).collect();
        let error = largest(&difference(&solution.certificate.force, &share.repeat(copies)));
        assert!(error <= 1e-7 * largest(&once.certificate.force), "seed {seed}: {error:e}");
        friction += usize::from(mu > 0.0);
    }
    assert!(friction > 50);
}

/// A cube of bricks that nothing holds but walls at these sides of it: axis and place.
fn free_cube(sides: &[(usize, f64)]) -> Host {
    let brick = Brick::new([2, 2, 2], [1.0; 3], Support::Free);
    let n = brick.size();
    let mut stiffness = vec![0.0; n * n];
    for (i, j, value) in brick.stiffness().entries() {
        stiffness[i + n * j] = value;
        stiffness[j + n * i] = value;
    }
    let (mut rows, mut normals) = (vec![], vec![]);
    for &(axis, side) in sides {
        for node in (0..brick.nodes.len()).filter(|&node| brick.nodes[node][axis] == side) {
            rows.push(vec![(node, 1.0)]);
            normals.extend((0..3).map(|c| if c == axis { -1.0 } else { 0.0 }));
        }
    }
    Host { dim: 3, stiffness, fixed: vec![], rows, normals, tangents: None }
}

/// A load of this sum, the same on each node.
fn weight_of(host: &Host, sum: [f64; 3]) -> Vec<f64> {
    let nodes = host.size() / 3;
    (0..host.size()).map(|dof| sum[dof % 3] / nodes as f64).collect()
}

/// Two walls hold a cube along the third axis by friction alone, which carries a twentieth of what presses. Pushed along
/// it by 8 the cube leaves: by friction from each other the walls press by `1 / (1 - mu)` at most, and hold
/// `2 mu / (1 - mu)`. From mu = 1 on they jam.
#[test]
fn a_free_cube_rests_at_two_walls() {
    let host = free_cube(&[(0, -0.5), (2, 0.0)]);
    let gap = vec![0.0; host.rows.len()];
    for mu in [0.3, 1.0, 3.0] {
        let solution = checked(&host, &weight_of(&host, [-1.0, -0.1, -1.0]), &gap, mu);
        assert_eq!(solution.status, Status::Solved, "mu {mu}: {}", solution.message);
        if mu < 1.0 {
            let leaves = checked(&host, &weight_of(&host, [-1.0, -8.0, -1.0]), &gap, mu);
            assert_eq!(leaves.status, Status::NoEquilibrium, "mu {mu}: {}", leaves.message);
        }
    }
}

/// Each pair of the cube in the corner two or five times, and a second time with a wall further away, which
/// nothing reaches: it rests, and the walls that it touches balance the loads.
#[test]
fn walls_that_are_named_again_change_nothing() {
    let host = free_cube(&[(0, -0.5), (1, -0.5), (2, 0.0)]);
    let (pairs, load) = (host.rows.len(), weight_of(&host, [-1.0, -0.8, -1.2]));
    for (copies, further) in [(2, 0.0), (5, 0.0), (2, 0.05)] {
        let mut several = host.clone();
        several.rows = vec![host.rows.clone(); copies].concat();
        several.normals = host.normals.repeat(copies);
        let mut gap = vec![0.0; copies * pairs];
        gap[pairs..].fill(further);
        for mu in [0.3, 1.0, 3.0] {
            let context = format!("{copies} copies at {further}, mu {mu}");
            let solution = checked(&several, &load, &gap, mu);
            assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
            if further > 0.0 {
                let states = &solution.certificate.states[pairs..];
                assert!(states.iter().all(|state| *state == State::Open), "{context}");
            }
        }
    }
}

/// A cube of bricks that nothing but three walls holds, pressed into their corner: the walls' forces balance
/// the loads, and it rests. Pulled out of the corner, it leaves: no equilibrium, as long as friction cannot
/// jam it. Three walls can: N (1 - sqrt(2) mu) (1, 1, 1) pulls inwards from mu = 0.71 on.
#[test]
fn a_free_cube_rests_in_a_corner() {
    let host = free_cube(&[(0, -0.5), (1, -0.5), (2, 0.0)]);
    let gap = vec![0.0; host.rows.len()];
    assert!(!host.model().unwrap().dependent_pairs().is_empty());
    let weight = [-1.0, -0.8, -1.2];
    let load = |sign: f64| weight_of(&host, weight.map(|force| sign * force));
    for mu in [0.0, 0.3, 1.0, 3.0] {
        let solution = checked(&host, &load(1.0), &gap, mu);
        assert_eq!(solution.status, Status::Solved, "mu {mu}: {}", solution.message);
        let nodal = host.model().unwrap().nodal_forces(&solution.certificate.force).unwrap();
        for (axis, weight) in weight.iter().enumerate() {
            let sum: f64 = nodal.iter().skip(axis).step_by(3).sum();
            assert!((sum + weight).abs() < 1e-9, "mu {mu}: {sum}");
        }
        if mu < 0.5_f64.sqrt() {
            let away = checked(&host, &load(-1.0), &gap, mu);
            assert_eq!(away.status, Status::NoEquilibrium, "mu {mu}: {}", away.message);
            // It can be drawn: the motion is of size 1, no wall stops it, and nothing balances the loads along it.
            let Escape { motion, unbalanced } = away.escape.expect("a motion to draw");
            let rounding = 1e-9;
            assert!((largest(&motion) - 1.0).abs() < rounding, "mu {mu}: {motion:?}");
            assert!(
                motion.iter().step_by(3).all(|normal| *normal < rounding),
                "mu {mu}: {motion:?}"
            );
            assert!(dot(&motion, &unbalanced) > rounding, "mu {mu}: {unbalanced:?}");
        }
    }
}

/// A pair that is open, sticks, or slips to one side.
const STATES: [(bool, f64); 4] = [(false, 0.0), (true, 0.0), (true, 1.0), (true, -1.0)];

/// True if the states of two pairs of a node on springs, with normals and first tangents, are a solution: their equations give the node's
/// displacement and both forces, which obey the law to rounding.
fn is_solution(
    states: [(bool, f64); 2],
    (k, load): (&[f64], &[f64]),
    frames: &[[[f64; 2]; 2]; 2],
    (mu, slip): (&[f64; 2], &[f64; 2]),
) -> bool {
    let (mut rows, mut right) = ([[0.0; 6]; 6], [load[0], load[1], 0.0, 0.0, 0.0, 0.0]);
    for i in 0..2 {
        (rows[i][0], rows[i][1]) = (k[i], k[i + 2]);
        (0..4).for_each(|j| rows[i][2 + j] = -frames[j / 2][j % 2][i]);
    }
    for (pair, (closed, side)) in states.into_iter().enumerate() {
        let [normal, tangent] = &mut [rows[2 + 2 * pair], rows[3 + 2 * pair]];
        match closed {
            true => normal[..2].copy_from_slice(&frames[pair][0]),
            false => normal[2 + 2 * pair] = 1.0,
        }
        match closed && side == 0.0 {
            true => {
                tangent[..2].copy_from_slice(&frames[pair][1]);
                right[3 + 2 * pair] = slip[pair];
            }
            // F_t = mu F_n towards the first tangent, as F_n presses with a negative sign.
            false => {
                tangent[3 + 2 * pair] = 1.0;
                tangent[2 + 2 * pair] = -side * mu[pair];
            }
        }
        (rows[2 + 2 * pair], rows[3 + 2 * pair]) = (*normal, *tangent);
    }
    let (x, left) = Elimination::new(6, rows.as_flattened()).solve(&right);
    let along = |v: &[f64; 2]| v[0] * x[0] + v[1] * x[1];
    let obeys = |(pair, (closed, side)): (usize, (bool, f64))| {
        let [normal, tangent] = frames[pair].each_ref().map(along);
        let [pressing, friction] = [-x[2 + 2 * pair], x[3 + 2 * pair]];
        match closed {
            false => normal <= 1e-9,
            true if side == 0.0 => {
                pressing >= -1e-9 && friction.abs() <= mu[pair] * pressing + 1e-9
            }
            true => pressing >= -1e-9 && side * (tangent - slip[pair]) >= -1e-9,
        }
    };
    left < 1e-9 && states.into_iter().enumerate().all(obeys)
}

/// A node on springs between two planes that nearly face each other, with the slip of a step before. All states of both pairs are tried:
/// where one of them is a solution, the default finds one. Rounds that take any solution of each would miss a tenth.
#[test]
fn the_default_finds_a_solution_between_planes_if_there_is_one() {
    let mut without = 0;
    for seed in 0..1000 {
        let rng = &mut Rng::with_seed(seed);
        let axis = vector(rng, 2);
        let frame = |side: f64| {
            let across: [f64; 2] =
                std::array::from_fn(|i| side * axis[i] + uniform(rng, -0.3, 0.3));
            let length = across[0].hypot(across[1]);
            let [x, y] = across.map(|a| a / length);
            [[x, y], [-y, x]]
        };
        let frames = [1.0, -1.0].map(frame);
        let mut host = node_on_planes(&frames.map(|[normal, _]| normal));
        host.tangents = Some(frames.map(|[_, tangent]| tangent).concat());
        let coupling = uniform(rng, -1.0, 1.0);
        host.stiffness = vec![uniform(rng, 2.0, 8.0), coupling, coupling, uniform(rng, 2.0, 8.0)];
        let (load, mu) = (vector(rng, 2), [uniform(rng, 0.0, 0.8), uniform(rng, 0.0, 0.8)]);
        let slip = [uniform(rng, -0.1, 0.1), uniform(rng, -0.1, 0.1)];
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &[0.0; 2],
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: Some(&slip),
        };
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let found = host.model().unwrap().solve(&case, &settings, None, monitor).unwrap();
        let pairs = STATES.into_iter().flat_map(|one| STATES.map(|other| [one, other]));
        let data = ((&host.stiffness[..], &load[..]), (&mu, &slip));
        let exists = pairs.into_iter().any(|states| is_solution(states, data.0, &frames, data.1));
        assert_eq!(found.status == Status::Solved, exists, "{seed}: {}", found.message);
        without += u32::from(!exists);
    }
    // The planes wedge the node with the slip of the step before.
    assert!((100..300).contains(&without), "{without}");
}

/// Another order of nodes and pairs gives the same displacements.
#[test]
fn numbering_does_not_matter() {
    for seed in 0..100 {
        let rng = &mut Rng::with_seed(seed);
        let mut host = independent(rng);
        // A second pair on the first node of the first one: dependent or not, as chance has it.
        let node = host.rows[0][0].0;
        host.rows.push(vec![(node, 1.0)]);
        host.rows.push(vec![(node, 1.0)]);
        host.normals.extend(vector(rng, 2 * host.dim));
        let (dim, pairs, n) = (host.dim, host.rows.len(), host.size());
        let load = vector(rng, n);
        let gap: Vec<f64> = vector(rng, pairs).iter().map(|gap| gap.abs()).collect();
        let first = checked(&host, &load, &gap, 0.1);

        let (mut nodes, mut order): (Vec<usize>, Vec<usize>) =
            ((0..n / dim).collect(), (0..pairs).collect());
        rng.shuffle(&mut nodes);
        rng.shuffle(&mut order);
        let dof = |i: usize| dim * nodes[i / dim] + i % dim;
        let mut other = host.clone();
        let mut moved = vec![0.0; n];
        for i in 0..n {
            moved[dof(i)] = load[i];
            (0..n).for_each(|j| other.stiffness[dof(i) + n * dof(j)] = host.stiffness[i + n * j]);
        }
        let renamed =
            |pair: usize| host.rows[pair].iter().rev().map(|&(k, w)| (nodes[k], w)).collect();
        other.rows = order.iter().map(|&pair| renamed(pair)).collect();
        other.normals = order
            .iter()
            .flat_map(|&pair| host.normals[dim * pair..dim * (pair + 1)].to_vec())
            .collect();
        let gaps: Vec<f64> = order.iter().map(|&pair| gap[pair]).collect();
        let second = checked(&other, &moved, &gaps, 0.1);
        assert_eq!(first.status, Status::Solved, "seed {seed}: {}", first.message);
        assert_eq!(second.status, Status::Solved, "seed {seed}: {}", second.message);
        let same: Vec<f64> =
            order.iter().flat_map(|&pair| first.d[dim * pair..dim * (pair + 1)].to_vec()).collect();
        let error = largest(&difference(&second.d, &same));
        assert!(error <= 1e-8 * largest(&same), "seed {seed}: {error:e}");
    }
}
