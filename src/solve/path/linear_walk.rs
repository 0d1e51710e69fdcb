//! One way along the linear path, from piece to piece.

use crate::law::{Contact, Linearised, Piece, PieceExit, Planar};
use crate::linalg::factor::GoesOn;
use crate::linalg::tolerances::SINGULAR_BASIS;
use crate::linalg::vector::{NormSum, largest_of};
use crate::monitor::{Monitor, Stop};
use crate::solve::pieces::{Equations, System, Updated};

/// A pivot below this part of one is taken for zero: the error of all that went through it would be as
/// large as what is looked for.
const SMALL_PIVOT: f64 = 1e-9;

/// A step so many times longer than all coordinates may be a ray.
const FAR: f64 = 1e6;

/// Where the factor does not stay in a cache, columns are made in blocks of so many: with those of a change those of the
/// pairs whose boundaries are the next ones on the way. Most of these change before the system is factorised again, many of
/// them more than once.
const BLOCK: usize = 48;

/// Up to so many components the factor stays in a cache.
const IN_CACHE: usize = 400;

/// How far a walk may go.
#[derive(Clone, Copy)]
pub struct Rules {
    /// Events after which it is given up.
    pub most: usize,
    /// Events after which the system is factorised again.
    pub age: usize,
}

/// How a walk ended.
pub enum WalkEnd {
    /// At the loads of the problem.
    Arrived,
    /// Below the loads of the start for ever; the system of a piece is singular; too many events.
    Lost,
    /// On a ray with a rigid motion.
    Ray(Vec<f64>),
    /// A budget is used up, or the callback cancelled.
    Stopped(Stop),
}

/// The data that all walks of a problem share.
pub struct PathProblem<'p> {
    /// The problem.
    pub contact: &'p Contact<'p>,
    /// Its equations.
    pub equations: &'p Equations<'p>,
    /// Roots of the diagonal of `K`.
    pub root: &'p [f64],
    /// `r`.
    pub load: &'p [f64],
    /// `|r|`, each force in the unit that its diagonal entry of `K` gives it.
    pub size: f64,
}

/// A walk: `K v + P = r_s` for all `s` on the way, `r_s = r_0 + s (r - r_0)`.
pub struct Walk<'p> {
    problem: &'p PathProblem<'p>,
    system: Updated<'p>,
    /// The pieces of today.
    pieces: Vec<Piece>,
    /// `r_0` and `r - r_0`.
    first: Vec<f64>,
    change: Vec<f64>,
    /// Coordinates, and their change with `s`.
    y: Vec<f64>,
    rate: Vec<f64>,
    s: f64,
    /// Changes of a piece so far.
    pub events: u64,
    /// Factorisations so far.
    pub factorisations: u64,
}

impl<'p> Walk<'p> {
    /// Operations of [`Self::new`].
    pub fn work(problem: &PathProblem<'_>, start: &[Planar]) -> f64 {
        let pairs = problem.contact.pairs().iter().zip(start);
        let pieces: Vec<Piece> = pairs.map(|(law, y)| law.piece(&[y[0], y[1], 0.0])).collect();
        System::work(problem.equations, &linearised(problem.contact, &pieces))
    }

    /// Begins at the coordinates `start`; `None` if the system there is singular.
    pub fn new(
        problem: &'p PathProblem<'p>,
        start: &[Planar],
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let contact = problem.contact;
        let (mut v, mut first, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
        for (law, y) in contact.pairs().iter().zip(start) {
            let y = [y[0], y[1], 0.0];
            let ((d, push), reference) = (law.point(&y), law.reference());
            pieces.push(law.piece(&y));
            v.extend((0..2).map(|c| d[c] - reference[c]));
            first.extend_from_slice(&push[..2]);
        }
        contact.problem().stiffness().add_product(&v, &mut first);
        let change: Vec<f64> =
            problem.load.iter().zip(&first).map(|(r, first)| r - first).collect();
        let pairs = linearised(contact, &pieces);
        let mut system = Updated::new(problem.equations, pairs, SINGULAR_BASIS, goes_on)?;
        let rate = system.solve(&change);
        Some(Walk {
            problem,
            system,
            pieces,
            first,
            change,
            y: start.concat(),
            rate,
            s: 0.0,
            events: 0,
            factorisations: 1,
        })
    }

    /// Goes on to the end, with the sign of `det J`: downwards at first where that is negative, and below the loads of the
    /// start if the way leads there.
    pub fn follow(&mut self, rules: Rules, monitor: &mut Monitor<'_>) -> WalkEnd {
        for _ in 0..rules.most {
            if let Err(stop) = monitor.step() {
                return WalkEnd::Stopped(stop);
            }
            let sign = f64::from(self.system.sign());
            let exit = self.next_exit(sign);
            let left = if sign > 0.0 { 1.0 - self.s } else { f64::INFINITY };
            let step = exit.as_ref().map_or(left, |(_, exit)| exit.step.min(left));
            if !step.is_finite() {
                return WalkEnd::Lost;
            }
            if step * self.length(&self.rate) > FAR * (self.length(&self.y) + self.problem.size)
                && let Some(motion) = self.rigid(&self.rate, sign)
            {
                return WalkEnd::Ray(motion);
            }
            for (y, rate) in self.y.iter_mut().zip(&self.rate) {
                *y += sign * step * rate;
            }
            self.s += sign * step;
            let Some((pair, exit)) = exit.filter(|(_, exit)| exit.step < left) else {
                return WalkEnd::Arrived;
            };
            if let Err(end) = self.pass(pair, &exit, rules, monitor) {
                return end;
            }
        }
        WalkEnd::Lost
    }

    /// The first boundary on the way, and whose it is.
    fn next_exit(&self, sign: f64) -> Option<(usize, PieceExit)> {
        self.exits(sign).min_by(|a, b| a.1.step.total_cmp(&b.1.step))
    }

    /// The next boundary of each pair that comes to one on the way.
    fn exits(&self, sign: f64) -> impl Iterator<Item = (usize, PieceExit)> {
        let pairs = self.problem.contact.pairs().iter().zip(&self.pieces);
        let ways = self.y.chunks_exact(2).zip(self.rate.chunks_exact(2));
        pairs.zip(ways).enumerate().filter_map(move |(pair, ((law, piece), (y, rate)))| {
            let rate = [sign * rate[0], sign * rate[1]];
            law.planar_exit(*piece, [y[0], y[1]], rate).map(|exit| (pair, exit))
        })
    }

    /// Passes the boundary of a pair.
    fn pass(
        &mut self,
        pair: usize,
        exit: &PieceExit,
        rules: Rules,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), WalkEnd> {
        self.events += 1;
        let laws = self.problem.contact.pairs();
        let beyond =
            |(pair, exit): (usize, PieceExit)| (pair, laws[pair].linearised_on(exit.beyond));
        let change = [beyond((pair, *exit))];
        if self.y.len() > IN_CACHE && self.system.lacks_columns(&change) {
            let others =
                self.exits(f64::from(self.system.sign())).filter(|(other, _)| *other != pair);
            let mut likely: Vec<(usize, PieceExit)> = others.collect();
            likely.sort_by(|a, b| a.1.step.total_cmp(&b.1.step));
            likely.insert(0, (pair, *exit));
            let likely: Vec<(usize, Linearised)> = likely.into_iter().map(beyond).collect();
            self.system.prepare(&likely, BLOCK);
        }
        let change = self.system.change(&change);
        self.pieces[pair] = exit.beyond;
        let singular = change.pivot().abs() < SMALL_PIVOT;
        let ray = if singular { change.direction().to_vec() } else { Vec::new() };
        let made = self.system.make(change).map(|()| self.system.follow(&mut self.rate));
        if singular && let Some(motion) = self.rigid(&ray, 1.0) {
            return Err(WalkEnd::Ray(motion));
        }
        if singular || made.is_none() || self.system.age() >= rules.age {
            let pairs = linearised(self.problem.contact, &self.pieces);
            let work = System::work(self.problem.equations, &pairs);
            monitor.affords(work).map_err(WalkEnd::Stopped)?;
            return self.refactorise(&mut monitor.asking()).ok_or(WalkEnd::Lost);
        }
        Ok(())
    }

    /// Factorises the system of today's pieces, and puts the coordinates back on the path.
    fn refactorise(&mut self, goes_on: GoesOn<'_>) -> Option<()> {
        let contact = self.problem.contact;
        self.factorisations += 1;
        let pairs = linearised(contact, &self.pieces);
        self.system = Updated::new(self.problem.equations, pairs, SINGULAR_BASIS, goes_on)?;
        // J y = r_s - c + K c_t / k, with P = D y + c on a piece.
        let mut side: Vec<f64> =
            self.first.iter().zip(&self.change).map(|(r, change)| r + self.s * change).collect();
        let mut constant = vec![0.0; side.len()];
        let pairs = contact.pairs().iter().zip(&self.pieces);
        for (pair, (law, piece)) in pairs.enumerate() {
            let (i, push) = (2 * pair, law.constant(*piece));
            side[i] -= push[0];
            side[i + 1] -= push[1];
            // A tension is no part of `k v = y - P'`.
            constant[i + 1] = push[1] / self.problem.root[i + 1].powi(2);
        }
        contact.problem().stiffness().add_product(&constant, &mut side);
        self.y = self.system.solve(&side);
        self.rate = self.system.solve(&self.change);
        let finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
        (finite(&self.y) && finite(&self.rate)).then_some(())
    }

    /// The motion of the coordinates' direction `sign way`, if it is rigid. Below the start a ray says nothing of the
    /// loads of the problem.
    fn rigid(&self, way: &[f64], sign: f64) -> Option<Vec<f64>> {
        if self.s < 0.0 {
            return None;
        }
        let mut motion = self.system.motion(way);
        motion.iter_mut().for_each(|motion| *motion *= sign);
        let internal = self.problem.contact.problem().internal_force(&motion);
        let pairs = || motion.iter().zip(self.problem.root);
        let size = largest_of(pairs().map(|(motion, root)| motion * root));
        let resisted = internal.iter().zip(self.problem.root).map(|(force, root)| force / root);
        (size > 0.0 && largest_of(resisted) <= SMALL_PIVOT * size).then_some(motion)
    }

    /// Norm of coordinates, each in its unit.
    fn length(&self, y: &[f64]) -> f64 {
        let mut sum = NormSum::default();
        y.iter().zip(self.problem.root).for_each(|(y, root)| sum.add(y / root));
        sum.root()
    }

    /// The pieces of today.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// The displacements of today.
    pub fn displacements(&self) -> Vec<f64> {
        let pairs = self.problem.contact.pairs().iter().zip(self.y.chunks_exact(2));
        pairs.flat_map(|(law, y)| law.point(&[y[0], y[1], 0.0]).0[..2].to_vec()).collect()
    }
}

/// The pairs on their pieces, to first order.
fn linearised(contact: &Contact<'_>, pieces: &[Piece]) -> Vec<Linearised> {
    contact.pairs().iter().zip(pieces).map(|(law, b)| law.linearised_on(*b)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{ContactData, ContactProblem, FrictionLaw};
    use crate::settings::Settings;

    /// One pair with `K = [2 1; 1 1]` and `mu = 2`. The loads (1, 1.5) hold it stuck with the pressure 1 and the friction
    /// 1.5, slipping by 0.5 under the pressure 0.5, and open at `K⁻¹ (1, 1.5) = (-0.5, 2)`; the loads (-1, 0) only open,
    /// at (-1, 1). On the line between them the stuck point ends where the friction is twice the pressure, the slipping one
    /// there and where both are equal, below (1, 1.5): paths from all three points arrive (theorem I).
    #[test]
    fn a_path_goes_on_below_its_start() {
        let (stiffness, load) = ([2.0, 1.0, 1.0, 1.0], [-1.0, 0.0]);
        let problem = ContactProblem::new(ContactData {
            dim: 2,
            pairs: 1,
            stiffness: &stiffness,
            ld: 2,
            load: &load,
            gap: &[0.0],
            law: FrictionLaw::Coulomb(&[2.0]),
            reference_slip: None,
        });
        let problem = problem.expect("the data is valid");
        let (contact, settings) = (Contact::new(&problem), Settings::default());
        let root = problem.unit_roots();
        let equations = Equations::of(&contact);
        let problem = PathProblem {
            contact: &contact,
            equations: &equations,
            root: &root,
            load: &load,
            size: 1.0,
        };
        let (stuck, slipping, open) = ([1.0, 1.5], [0.5, 1.5], [-1.0, 2.0]);
        for (start, sign, events) in [(stuck, 1.0, 2), (slipping, -1.0, 1), (open, 1.0, 0)] {
            let mut monitor = Monitor::new(&settings, None);
            let mut walk =
                Walk::new(&problem, &[start], &mut || true).expect("each piece is regular");
            // K v + P is (1, 1.5) at all three; powers of two and few digits leave no rounding.
            assert_eq!(walk.first, [1.0, 1.5]);
            assert_eq!(f64::from(walk.system.sign()), sign);
            let end = walk.follow(Rules { most: 10, age: 60 }, &mut monitor);
            assert!(matches!(end, WalkEnd::Arrived), "from {start:?}");
            assert_eq!(walk.events, events, "from {start:?}");
            let d = walk.displacements();
            assert!((d[0] + 1.0).abs() < 1e-14 && (d[1] - 1.0).abs() < 1e-14, "{d:?}");
        }
    }
}
