//! Load cases of a model in a series, which share what depends on the stiffness alone, beside each one alone:
//! blocks of bricks on a hollow obstacle, where the contact moves from case to case and some pairs stay open.

use crate::common::brick::{Brick, Support};
use crate::common::dense::{difference, largest};
use fastrand::Rng;
use signorini::{
    FrictionLaw, LoadCase, Method, Model, Monitor, Search, Settings, Solution, Starts, Status,
};

/// More than a block of 32.
const CASES: usize = 37;

/// Along an edge: 81 pairs.
const CELLS: usize = 8;

/// The tolerance of 1e-12 times a condition of 1e3.
const SAME: f64 = 1e-9;

fn settings() -> Settings {
    Settings { tolerance: 1e-12, ..Settings::default() }
}

/// A block with its load cases.
struct Block {
    model: Model,
    loads: Vec<Vec<f64>>,
    prescribed: Option<Vec<Vec<f64>>>,
    gaps: Vec<Vec<f64>>,
    slips: Vec<Vec<f64>>,
}

impl Block {
    /// Held above, or by contact alone. The obstacle is a bowl whose lowest point is at the middle, beside
    /// it, and far from it on either side, for some cases each; loads differ from case to case.
    fn new(support: Support) -> Block {
        let brick = Brick::new([CELLS, CELLS, 4], [1.0, 1.0, 0.6], support);
        let mut rng = Rng::with_seed(5);
        let (mut loads, mut values, mut gaps) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..CASES {
            let lowest = [0.0, 0.04, 0.3, -0.3][k / 9 % 4];
            let [down, along] = [1.0 + 0.1 * rng.f64(), 0.3 * rng.f64() - 0.15];
            if let Support::Free = support {
                loads.push(pressed(&brick, lowest, along));
            } else {
                let plate = [along, 0.1, -down].map(|u| 1e-2 * u);
                let (load, moved) = brick.moved(|_| plate);
                loads.push(load);
                values.extend(moved);
            }
            let places = (0..brick.pairs()).map(|pair| brick.place(pair));
            let gap = places.map(|[x, y, _]| 0.06 * ((x - lowest).powi(2) + y * y));
            gaps.push(gap.collect());
        }
        let slip = |_| (0..2 * brick.pairs()).map(|_| 1e-5 * rng.f64()).collect();
        let slips = (0..CASES).map(slip).collect();
        let prescribed = (!values.is_empty()).then_some(values);
        Block { model: brick.model(), loads, prescribed, gaps, slips }
    }

    fn cases<'a>(&'a self, law: FrictionLaw<'a>) -> Vec<LoadCase<'a>> {
        let case = |k: usize| LoadCase {
            load: &self.loads[k],
            prescribed: self.prescribed.as_ref().map(|values| &values[k][..]),
            gap: &self.gaps[k],
            law,
            reference_slip: (k % 2 == 1).then_some(&self.slips[k][..]),
        };
        (0..CASES).map(case).collect()
    }

    fn alone(&self, case: &LoadCase<'_>, settings: &Settings) -> Solution {
        self.model.solve(case, settings, None, &mut Monitor::new(settings, None)).unwrap()
    }
}

/// Loads on the upper nodes: together -0.02 downwards, off the middle by `offset`, and a part along x that
/// friction holds.
fn pressed(brick: &Brick, offset: f64, along: f64) -> Vec<f64> {
    let mut load = vec![0.0; brick.size()];
    let count = brick.top().len() as f64;
    // The second moment of the places of the nodes along x, over their number.
    let second: f64 = brick.top().map(|node| brick.nodes[node][0].powi(2)).sum::<f64>() / count;
    for node in brick.top() {
        let share = 0.02 / count;
        load[3 * node] = share * along;
        load[3 * node + 2] = -share * (1.0 + offset * brick.nodes[node][0] / second);
    }
    load
}

fn solved(found: Vec<Result<Solution, signorini::Error>>) -> Vec<Solution> {
    found.into_iter().map(|solution| solution.unwrap()).collect()
}

/// Laws with their parameters.
struct Laws {
    coulomb: Vec<f64>,
    tresca: Vec<f64>,
    cohesive: Vec<f64>,
    ellipses: Vec<f64>,
}

impl Laws {
    fn new(pairs: usize) -> Laws {
        Laws {
            coulomb: vec![0.3; pairs],
            tresca: vec![1e-4; pairs],
            cohesive: [0.3, 2e-6, 1e-6].repeat(pairs),
            ellipses: [0.2, 0.4, 0.3].repeat(pairs),
        }
    }

    fn all(&self) -> [FrictionLaw<'_>; 5] {
        [
            FrictionLaw::Frictionless,
            FrictionLaw::Coulomb(&self.coulomb),
            FrictionLaw::Tresca(&self.tresca),
            FrictionLaw::Cohesive(&self.cohesive),
            FrictionLaw::Orthotropic(&self.ellipses),
        ]
    }
}

/// Whatever the law, the start and what holds the block.
#[test]
fn a_series_has_the_solutions_of_its_cases() {
    for support in [Support::Clamped, Support::Free] {
        let block = Block::new(support);
        let laws = Laws::new(block.model.pairs());
        // Without friction a block that nothing holds is not held along the obstacle.
        let first = usize::from(matches!(support, Support::Free));
        for law in &laws.all()[first..] {
            let name = format!("{law:?}").chars().take(7).collect::<String>();
            let cases = block.cases(*law);
            let alone: Vec<_> = cases.iter().map(|case| block.alone(case, &settings())).collect();
            for starts in [Starts::Cold, Starts::Previous(None)] {
                let series = solved(block.model.solve_cases(&cases, &settings(), starts, None));
                for (k, (one, other)) in series.iter().zip(&alone).enumerate() {
                    let context = format!("{support:?}, {name}, {starts:?}, case {k}");
                    compare(one, other, &context);
                }
            }
        }
    }
}

fn compare(one: &Solution, other: &Solution, context: &str) {
    assert_eq!(other.status, Status::Solved, "{context}: {}", other.message);
    assert_eq!(one.status, Status::Solved, "{context}: {}", one.message);
    for (one, other) in [(&one.d, &other.d), (&one.certificate.force, &other.certificate.force)] {
        let apart = largest(&difference(one, other)) / largest(other);
        assert!(apart <= SAME, "{context}: {apart:e}");
    }
    assert_eq!(one.certificate.states, other.certificate.states, "{context}");
}

/// The path and Newton's method by themselves, and further questions about each solution.
#[test]
fn methods_and_questions_in_a_series() {
    let block = Block::new(Support::Clamped);
    let laws = Laws::new(block.model.pairs());
    let cases = block.cases(FrictionLaw::Coulomb(&laws.coulomb));
    let cases = [&cases[8..10], &cases[26..28]].concat();
    for settings in [
        Settings { method: Method::Newton, ..settings() },
        Settings { method: Method::Path, ..settings() },
        Settings { proof: true, ..settings() },
        Settings { search: Search::Others, ..settings() },
    ] {
        let series = solved(block.model.solve_cases(&cases, &settings, Starts::Cold, None));
        for (k, (one, case)) in series.iter().zip(&cases).enumerate() {
            let alone = block.alone(case, &settings);
            let context = format!("{settings:?}, case {k}");
            compare(one, &alone, &context);
            let proved = [one, &alone].map(|solution| std::mem::discriminant(&solution.existence));
            assert_eq!(proved[0], proved[1], "{context}");
        }
    }
}

/// A series gives the same bits again, in one call or in several; a case alone has those that it has without
/// a series. The model is one that the host has condensed: nothing is worked out for several loads at once.
#[test]
fn the_same_series_has_the_same_bits() {
    let mut block = Block::new(Support::Clamped);
    let laws = Laws::new(block.model.pairs());
    let law = FrictionLaw::Coulomb(&laws.coulomb);
    let condensed: Vec<Vec<f64>> = (block.cases(law).iter())
        .map(|case| block.model.condensed_load(case.load, case.prescribed).unwrap())
        .collect();
    let (pairs, k) = (block.model.pairs(), block.model.stiffness().to_vec());
    let model = Model::condensed(3, pairs, &k, 3 * pairs).unwrap();
    (block.model, block.loads, block.prescribed) = (model, condensed, None);
    let cases = block.cases(law);
    for starts in [Starts::Cold, Starts::Previous(None)] {
        let all = solved(block.model.solve_cases(&cases, &settings(), starts, None));
        let mut series = block.model.series();
        for (k, (one, case)) in all.iter().zip(&cases).enumerate() {
            let next = solved(series.solve_cases(&[*case], &settings(), starts, None)).remove(0);
            assert_eq!(bits(one), bits(&next), "{starts:?}, case {k}");
        }
    }
    let alone = solved(block.model.solve_cases(&cases[8..9], &settings(), Starts::Cold, None));
    assert_eq!(bits(&alone[0]), bits(&block.alone(&cases[8], &settings())));
}

fn bits(solution: &Solution) -> Vec<u64> {
    let force = &solution.certificate.force;
    solution.d.iter().chain(force).map(|number| number.to_bits()).collect()
}

/// A load case that the model has kept changes nothing: displacements are those of a model that has
/// solved nothing, whatever was condensed last.
#[test]
fn recovery_does_not_depend_on_what_was_solved_before() {
    let [block, fresh] = [0, 1].map(|_| Block::new(Support::Clamped));
    let laws = Laws::new(block.model.pairs());
    let cases = block.cases(FrictionLaw::Coulomb(&laws.coulomb));
    let recovered = |model: &Model, k: usize, d: &[f64]| -> Vec<u64> {
        let u = model.recover(Some(cases[k].load), cases[k].prescribed, d).unwrap();
        u.into_iter().map(f64::to_bits).collect()
    };
    for [solved, asked] in [[0, 0], [1, 1], [2, 1], [3, 2], [20, 20]] {
        let found = block.alone(&cases[solved], &settings());
        let [one, other] = [&block.model, &fresh.model].map(|m| recovered(m, asked, &found.d));
        assert_eq!(one, other, "{solved} solved, {asked} recovered");
    }
}
