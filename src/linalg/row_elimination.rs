//! Sparse linear equations `sum a_k u_k = delta_i`, solved for one unknown each: which unknown an equation
//! gives, and which equations follow from the others.
//!
//! Equations with an unknown of their own come first: they change no other one. The rest is eliminated
//! in the order of what is left of their coefficients, and the short ones first among equals: what an equation
//! with little left hands on is enlarged rounding. An equation of which too little is left follows from the others and from the
//! unknowns that are left in it; below [`AGREES`] these are the rounding of the host's numbers, and none.

use std::collections::{BTreeMap, BTreeSet};

use super::tolerances::{AGREES, ROUNDING};

/// Coefficients of unknowns, or of equations' right sides.
pub type Terms = Vec<(usize, f64)>;

/// An unknown of its own gives an equation only if its coefficient is at least this part of the largest:
/// smaller ones enlarge rounding more than they spare work.
pub const LEAST_PIVOT: f64 = 0.1;

/// An unknown in terms of others: `u = sum of unknowns + sum of right sides`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Expression {
    /// Unknowns that no equation gives.
    pub unknowns: Terms,
    /// Right sides of independent equations.
    pub right_sides: Terms,
}

/// The outcome of equations.
pub struct Solved {
    /// The unknowns that equations give, in terms of the others.
    pub given: Vec<(usize, Expression)>,
    /// For each equation `None` if it is independent; otherwise its right side, in terms of unknowns that no equation gives
    /// and of right sides of independent equations.
    pub dependent: Vec<Option<Expression>>,
}

/// Solves `equations` for unknowns that may be chosen. An equation of which at most `least` of its largest coefficient is left
/// gives none. Coefficients of each unknown are compared beside its `unit`: those of angles are arms, in the host's unit of length.
pub fn solve(equations: &[Terms], units: &[f64], may_choose: &[bool], least: f64) -> Solved {
    let in_units = |equation: &Terms| equation.iter().map(|&(k, a)| (k, a / units[k])).collect();
    let equations: Vec<Terms> = equations.iter().map(in_units).collect();
    let mut state = Elimination::new(&equations, may_choose, least);
    state.take_singletons();
    state.eliminate();
    let mut solved = state.solved();
    let dependent = solved.dependent.iter_mut().flatten();
    for (unit, expression) in dependent
        .map(|expression| (1.0, expression))
        .chain(solved.given.iter_mut().map(|(k, expression)| (units[*k], expression)))
    {
        expression.unknowns.iter_mut().for_each(|(k, a)| *a *= units[*k] / unit);
        expression.right_sides.iter_mut().for_each(|(_, a)| *a /= unit);
    }
    solved
}

struct Elimination<'c> {
    count: usize,
    may_choose: &'c [bool],
    /// An equation gives no unknown whose coefficient is at most this part of its largest one.
    least: f64,
    /// Each equation as a sum that is zero: unknowns, then right sides from `count` on; ascending.
    sums: Vec<Terms>,
    /// Largest coefficient that each equation ever had.
    scale: Vec<f64>,
    is_open: Vec<bool>,
    /// Open equations that have each unknown, with some that no longer have it.
    having: Vec<Vec<usize>>,
    /// Equations that give an unknown, in this order.
    order: Vec<(usize, usize)>,
}

impl<'c> Elimination<'c> {
    fn new(equations: &[Terms], may_choose: &'c [bool], least: f64) -> Self {
        let count = may_choose.len();
        let mut having = vec![Vec::new(); count];
        let mut sums = Vec::with_capacity(equations.len());
        for (i, equation) in equations.iter().enumerate() {
            let mut sum = gathered(equation.clone());
            sum.iter().for_each(|&(k, _)| having[k].push(i));
            sum.push((count + i, -1.0));
            sums.push(sum);
        }
        // The right side comes last.
        let scale = sums.iter().map(|sum| largest(&sum[..sum.len() - 1])).collect();
        let is_open = vec![true; sums.len()];
        let order = Vec::new();
        Elimination { count, may_choose, least, sums, scale, is_open, having, order }
    }

    /// Unknowns of an equation that may be chosen.
    fn choices(&self, i: usize) -> impl Iterator<Item = (usize, f64)> {
        let unknowns = self.sums[i].iter().copied().take_while(|(k, _)| *k < self.count);
        unknowns.filter(|(k, _)| self.may_choose[*k])
    }

    fn largest_choice(&self, i: usize) -> f64 {
        self.choices(i).map(|(_, a)| a.abs()).fold(0.0, f64::max)
    }

    /// Takes equations that have an unknown of their own, until there is none.
    fn take_singletons(&mut self) {
        let mut counts: Vec<usize> = self.having.iter().map(Vec::len).collect();
        let mut waiting: Vec<usize> = (0..self.sums.len()).rev().collect();
        while let Some(i) = waiting.pop() {
            let (least, largest) = (self.least * self.scale[i], self.largest_choice(i));
            let own = self.choices(i).filter(|(k, a)| {
                // An unknown that is an equation's own once others are taken out is given by others in turn: in chains
                // coefficients grow like a power. Rows of 50 masters under 20 nodes that are held lose all digits unless two
                // links enlarge as one pivot may.
                let is_own = self.having[*k].len() == 1;
                let part = if is_own { LEAST_PIVOT } else { LEAST_PIVOT.sqrt() };
                counts[*k] == 1 && a.abs() >= least.max(part * largest)
            });
            let best = own.max_by(|(k, a), (l, b)| a.abs().total_cmp(&b.abs()).then(l.cmp(k)));
            let Some((unknown, _)) = best.filter(|_| self.is_open[i]) else { continue };
            self.is_open[i] = false;
            self.order.push((i, unknown));
            for &(k, _) in self.sums[i].iter().take_while(|(k, _)| *k < self.count) {
                counts[k] -= 1;
                if counts[k] == 1 {
                    waiting.extend(self.having[k].iter().filter(|&&other| self.is_open[other]));
                }
            }
        }
    }

    /// The place of an equation in the queue: by how often the part that is left of its coefficients has
    /// been halved, then short before long. Equations that nearly follow from others come late, and what
    /// is divided by a small pivot is not handed on.
    fn rank(&self, i: usize) -> (i32, usize, usize) {
        let left = self.largest_choice(i) / self.scale[i];
        let halvings = -left.max(f64::MIN_POSITIVE).log2().round();
        (halvings as i32, self.sums[i].len(), i)
    }

    /// Eliminates among the equations that are left.
    fn eliminate(&mut self) {
        let left = (0..self.sums.len()).filter(|&i| self.is_open[i]);
        let mut queue: BTreeSet<_> = left.map(|i| self.rank(i)).collect();
        while let Some((_, _, i)) = queue.pop_first() {
            self.is_open[i] = false;
            let largest = self.largest_choice(i);
            if largest <= AGREES * self.scale[i] {
                // The host has said the equation before: nothing is left but the rounding of its numbers.
                let keeps = |k: &usize| *k >= self.count || !self.may_choose[*k];
                let sum = self.sums[i].iter().copied().filter(|(k, _)| keeps(k)).collect();
                self.sums[i] = sum;
            }
            if largest <= self.least * self.scale[i] {
                continue;
            }
            let Some((unknown, pivot)) = self.choices(i).find(|(_, a)| a.abs() == largest) else {
                continue;
            };
            self.order.push((i, unknown));
            let row = self.sums[i].clone();
            for other in std::mem::take(&mut self.having[unknown]) {
                if !self.is_open[other] {
                    continue;
                }
                let Ok(place) = self.sums[other].binary_search_by_key(&unknown, |(k, _)| *k) else {
                    continue;
                };
                queue.remove(&self.rank(other));
                let share = -self.sums[other][place].1 / pivot;
                let sum = std::mem::take(&mut self.sums[other]);
                self.sums[other] = self.added((other, &sum), &row, share, unknown);
                queue.insert(self.rank(other));
            }
        }
    }

    /// The sum of an open equation plus `share` of another one, both ascending, without the unknown that
    /// cancels. Takes note of unknowns that are new to the equation, and of its largest coefficient.
    fn added(
        &mut self,
        (equation, one): (usize, &Terms),
        other: &Terms,
        share: f64,
        cancelled: usize,
    ) -> Terms {
        let share_of_other = other.iter().map(|(k, a)| (*k, share * a));
        let both = one.iter().copied().chain(share_of_other).filter(|(k, _)| *k != cancelled);
        let sum = gathered(both.collect());
        for &(k, a) in sum.iter().take_while(|(k, _)| *k < self.count) {
            self.scale[equation] = self.scale[equation].max(a.abs());
            if one.binary_search_by_key(&k, |(k, _)| *k).is_err() {
                self.having[k].push(equation);
            }
        }
        sum
    }

    /// The unknowns that equations give, from the last one back: each contains those that come later.
    fn solved(self) -> Solved {
        let mut found: BTreeMap<usize, Terms> = BTreeMap::new();
        let mut given = Vec::with_capacity(self.order.len());
        let mut dependent: Vec<Option<Terms>> = self.sums.iter().cloned().map(Some).collect();
        for &(i, unknown) in self.order.iter().rev() {
            dependent[i] = None;
            let sum = &self.sums[i];
            let own = |&&(k, _): &&(usize, f64)| k == unknown;
            let pivot = sum.iter().find(own).map_or(1.0, |(_, a)| *a);
            let others = sum.iter().filter(|(k, _)| *k != unknown);
            let terms = replaced(others.map(|(k, a)| (*k, -a / pivot)), &found);
            given.push((unknown, self.split(&terms)));
            found.insert(unknown, terms);
        }
        let of_dependent = |(i, sum): (usize, Option<Terms>)| {
            let own = self.count + i;
            let terms = sum?.into_iter().filter(|(k, _)| *k != own);
            Some(self.split(&replaced(terms, &found)))
        };
        let dependent = dependent.into_iter().enumerate().map(of_dependent).collect();
        Solved { given, dependent }
    }

    fn split(&self, terms: &[(usize, f64)]) -> Expression {
        let unknowns = terms.iter().copied().filter(|(k, _)| *k < self.count).collect();
        let right_sides = terms.iter().filter(|(k, _)| *k >= self.count);
        let right_sides = right_sides.map(|(k, a)| (k - self.count, *a)).collect();
        Expression { unknowns, right_sides }
    }
}

/// The largest size of a coefficient.
pub fn largest(terms: &[(usize, f64)]) -> f64 {
    terms.iter().map(|(_, a)| a.abs()).fold(0.0, f64::max)
}

/// Terms in which the unknowns that are found are replaced.
pub fn replaced(
    terms: impl IntoIterator<Item = (usize, f64)>,
    found: &BTreeMap<usize, Terms>,
) -> Terms {
    let mut sum = Terms::new();
    for (k, a) in terms {
        match found.get(&k) {
            Some(expression) => sum.extend(expression.iter().map(|(l, b)| (*l, a * b))),
            None => sum.push((k, a)),
        }
    }
    gathered(sum)
}

/// Ascending, one term for each number; a sum that has cancelled but for rounding is none.
pub fn gathered(mut terms: Terms) -> Terms {
    terms.sort_by_key(|(k, _)| *k);
    let sum = |terms: &[(usize, f64)]| {
        let parts = || terms.iter().map(|(_, a)| *a);
        let (sum, size): (f64, f64) = (parts().sum(), parts().map(f64::abs).sum());
        (sum.abs() > ROUNDING * size).then_some((terms[0].0, sum))
    };
    terms.chunk_by(|one, other| one.0 == other.0).filter_map(sum).collect()
}
