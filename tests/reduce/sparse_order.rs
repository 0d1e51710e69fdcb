//! The condensation in any order of elimination, within limits, and ended before its end.

use std::ops::ControlFlow;

use crate::common::brick::{Brick, Support};
use crate::common::dense::condensed;
use crate::common::mesh::Stiffness;
use crate::common::stack::close;
use fastrand::Rng;
use signorini::{Argument, Error, Limit, Model, Monitor, Progress, Settings};

/// A clamped block in contact below, with its matrix.
struct Block {
    brick: Brick,
    stiffness: Stiffness,
}

impl Block {
    fn new(cells: [usize; 3]) -> Block {
        let mut brick = Brick::new(cells, [1.0; 3], Support::Clamped);
        brick.tangents = None;
        Block { stiffness: brick.stiffness(), brick }
    }

    /// Degrees of freedom in contact, which come first, and all that are not fixed, which come last.
    fn counts(&self) -> (usize, usize) {
        (3 * self.brick.pairs(), self.stiffness.size - self.brick.fixed().len())
    }

    fn within(
        &self,
        order: Option<&[usize]>,
        settings: &Settings,
        progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Model, Error> {
        let mut progress = |now: &Progress| progress(now);
        let monitor = &mut Monitor::new(settings, Some(&mut progress));
        self.brick.model_within(&self.stiffness, order, monitor)
    }

    fn ordered(&self, order: Option<&[usize]>) -> Model {
        let go_on = &mut |_: &Progress| ControlFlow::Continue(());
        self.within(order, &Settings::default(), go_on).unwrap()
    }
}

/// Sums of a few hundred terms with condition numbers below 1e3: 1e-13 of the largest entry is some
/// hundred roundings.
const ROUNDINGS: f64 = 1e-13;

/// The dense elimination of the test, in the axes of the block; frames turn it to the pairs.
#[test]
fn schur_complement_is_that_of_a_dense_elimination() {
    for cells in [[1, 1, 1], [2, 2, 3], [3, 4, 3], [5, 5, 4]] {
        let block = Block::new(cells);
        let (size, (contact, free)) = (block.stiffness.size, block.counts());
        let kept: Vec<usize> = (contact..free).chain(0..contact).collect();
        let dense = block.stiffness.dense();
        let matrix: Vec<f64> = kept
            .iter()
            .flat_map(|&j| kept.iter().map(move |&i| (i, j)))
            .map(|(i, j)| dense[i + size * j])
            .collect();
        let (schur, _) = condensed(&matrix, &vec![0.0; kept.len()], kept.len() - contact);
        let model = block.ordered(None);
        let frames = Brick::frames(&model);
        let turned = |p: usize, a: usize, q: usize, b: usize| -> f64 {
            let entry = |i: usize, j: usize| schur[3 * p + i + contact * (3 * q + j)];
            let (left, right) = (frames[p][a], frames[q][b]);
            (0..9).map(|k| left[k / 3] * entry(k / 3, k % 3) * right[k % 3]).sum()
        };
        let expected: Vec<f64> = (0..contact * contact)
            .map(|k| (k % contact, k / contact))
            .map(|(i, j)| turned(i / 3, i % 3, j / 3, j % 3))
            .collect();
        close(model.stiffness(), &expected, ROUNDINGS, &format!("{cells:?}"));
    }
}

/// Random, natural and reversed. The wide blocks have supernodes of more columns than a panel, and the
/// largest has so many vertices that nested dissection orders it; it has no random order, which fills all.
#[test]
fn order_does_not_matter() {
    for (cells, orders) in [([3, 3, 3], 3), ([9, 9, 8], 3), ([19, 19, 19], 1)] {
        let block = Block::new(cells);
        let size = block.stiffness.size;
        let reference = block.ordered(None);
        let mut rng = Rng::with_seed(7);
        let load: Vec<f64> = (0..size).map(|_| rng.f64() - 0.5).collect();
        let f = reference.condensed_load(&load, None).unwrap();
        let d: Vec<f64> = f.iter().map(|_| rng.f64() - 0.5).collect();
        let u = reference.recover(Some(&load), None, &d).unwrap();
        let mut random: Vec<usize> = (0..size).collect();
        rng.shuffle(&mut random);
        let all: [Vec<usize>; 3] = [(0..size).collect(), (0..size).rev().collect(), random];
        for order in &all[..orders] {
            let model = block.ordered(Some(order));
            close(model.stiffness(), reference.stiffness(), ROUNDINGS, "K_rel");
            close(&model.condensed_load(&load, None).unwrap(), &f, 1e-12, "f_rel");
            close(&model.recover(Some(&load), None, &d).unwrap(), &u, 1e-12, "u");
        }
    }
}

/// Recovered displacements balance the loads wherever nothing is fixed or in contact: that is their definition.
#[test]
fn displacements_balance_the_loads() {
    let block = Block::new([6, 5, 4]);
    let size = block.stiffness.size;
    let mut rng = Rng::with_seed(11);
    let load: Vec<f64> = (0..size).map(|_| rng.f64() - 0.5).collect();
    let model = block.ordered(None);
    let (contact, free) = block.counts();
    let d: Vec<f64> = (0..contact).map(|_| rng.f64() - 0.5).collect();
    let u = model.recover(Some(&load), None, &d).unwrap();
    let forces = block.stiffness.times(&u);
    for dof in contact..free {
        assert!((forces[dof] - load[dof]).abs() <= 1e-12, "{dof}: {} {}", forces[dof], load[dof]);
    }
}

#[test]
fn order_that_is_no_permutation_is_refused() {
    let block = Block::new([2, 2, 2]);
    let size = block.stiffness.size;
    let identity: Vec<usize> = (0..size).collect();
    let (mut twice, mut absent) = (identity.clone(), identity.clone());
    twice[5] = 3;
    absent[4] = size;
    for (order, said) in [
        (&identity[..size - 1], "has 80 entries"),
        (&twice, "order[5] is 3, as order[3] is"),
        (&absent, "order[4] is 81, there is no such"),
    ] {
        let go_on = &mut |_: &Progress| ControlFlow::Continue(());
        let refused = block.within(Some(order), &Settings::default(), go_on).err();
        let Some(Error::Invalid { argument, message }) = refused else { panic!("{refused:?}") };
        assert_eq!(argument, Argument::Order);
        assert!(message.contains(said), "{message}");
    }
}

/// The callback ends the reduction at its first question, at the announcement, and in the middle of the
/// factorisation; the same arrays then give the same model.
#[test]
fn a_cancelled_reduction_can_be_begun_again() {
    let block = Block::new([13, 13, 13]);
    let reference = block.ordered(None);
    let mut questions = Vec::new();
    let model = block.within(None, &Settings::default(), &mut |now| {
        questions.push((now.reduced, now.memory));
        ControlFlow::Continue(())
    });
    assert_eq!(model.unwrap().stiffness(), reference.stiffness());
    assert!(questions.len() > 3, "{questions:?}");
    assert!(questions.windows(2).all(|w| w[0].0 <= w[1].0), "shares fall: {questions:?}");
    // The first questions come before anything is known; all later ones tell one estimate.
    assert_eq!(questions[0].1, 0);
    let known = questions.iter().position(|q| q.1 > 0).unwrap();
    assert!(questions[known..].iter().all(|q| q.1 == questions[known].1 && q.0 <= 1.0));
    for last in [0, 1, known, questions.len() / 2, questions.len() - 1] {
        let mut asked = 0;
        let stopped = block.within(None, &Settings::default(), &mut |_| {
            asked += 1;
            if asked > last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let stopped = stopped.err();
        let Some(Error::Stopped { limit, message }) = stopped else { panic!("{stopped:?}") };
        assert_eq!((limit, asked), (Limit::Cancelled, last + 1), "{message}");
    }
    assert_eq!(block.ordered(None).stiffness(), reference.stiffness());
}

#[test]
fn limits_are_respected() {
    let block = Block::new([8, 8, 8]);
    let mut told = 0;
    let mut go_on = |now: &Progress| {
        told = told.max(now.memory);
        ControlFlow::Continue(())
    };
    block.within(None, &Settings::default(), &mut go_on).unwrap();
    let within = |settings: Settings| {
        block.within(None, &settings, &mut |_: &Progress| ControlFlow::Continue(())).map(|_| ())
    };
    let memory = |memory_limit| Settings { memory_limit, ..Settings::default() };
    assert_eq!(within(memory(told)), Ok(()));
    let refused = within(memory(told - 1));
    assert!(matches!(refused, Err(Error::Stopped { limit: Limit::Memory, .. })), "{refused:?}");
    let late = within(Settings { time_limit: f64::MIN_POSITIVE, ..Settings::default() });
    assert!(matches!(late, Err(Error::Stopped { limit: Limit::Time, .. })), "{late:?}");
}
