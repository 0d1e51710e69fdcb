//! One way along the linear path, from piece to piece.

use crate::law::{Linearised, Piece, PieceExit, Planar, by_pairs};
use crate::linalg::vector::largest_of;
use crate::monitor::Watch;
use crate::solve::pieces::{Equations, System, Updated};
use crate::solve::result::Ending;

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

/// The end of a walk below the loads of the start for ever, on a piece whose system is singular, or after too many events.
pub const LOST: Ending = Ending::Stalled("the path does not arrive");

/// A walk: `K v + P = r_s` for all `s` on the way, `r_s = r_0 + s (r - r_0)`.
pub struct Walk<'p> {
    equations: &'p Equations<'p>,
    monitor: &'p dyn Watch,
    /// Length of the loads `r` of the problem.
    size: f64,
    system: Updated<'p>,
    /// The pieces of today.
    pub pieces: Vec<Piece>,
    /// `r_0` and `r - r_0`.
    first: Vec<f64>,
    change: Vec<f64>,
    /// Coordinates, and their change with `s`.
    y: Vec<f64>,
    rate: Vec<f64>,
    s: f64,
    /// Factorisations so far.
    pub factorisations: u64,
}

impl<'p> Walk<'p> {
    /// Begins at the coordinates `start`, to go to the loads `load`. `Err`: the system there is singular, or there is no
    /// time for it.
    pub fn new(
        equations: &'p Equations<'p>,
        load: &[f64],
        start: &[Planar],
        monitor: &'p dyn Watch,
    ) -> Result<Self, Ending> {
        let (mut v, mut first, mut pieces) = (Vec::new(), Vec::new(), Vec::new());
        for (law, y) in equations.laws.iter().zip(start) {
            let y = [y[0], y[1], 0.0];
            let ((d, push), reference) = (law.point(&y), law.reference());
            pieces.push(law.piece(&y));
            v.extend((0..2).map(|c| d[c] - reference[c]));
            first.extend_from_slice(&push[..2]);
        }
        equations.matrix.add_product(&v, &mut first);
        let change: Vec<f64> = load.iter().zip(&first).map(|(r, first)| r - first).collect();
        let mut system = factorised(equations, &pieces, monitor)?;
        let rate = system.solve(&change);
        Ok(Walk {
            equations,
            monitor,
            size: equations.length(load),
            system,
            pieces,
            first,
            change,
            y: start.concat(),
            rate,
            s: 0.0,
            factorisations: 1,
        })
    }

    /// Goes on to the loads of the problem, with the sign of `det J`: downwards at first where that is negative, and below the
    /// loads of the start if the way leads there. `Err`: it ends elsewhere, as on a ray with a rigid motion.
    pub fn follow(&mut self, rules: Rules) -> Result<(), Ending> {
        for _ in 0..rules.most {
            self.monitor.step()?;
            let sign = f64::from(self.system.sign());
            let exit = self.exits(sign).min_by(|a, b| a.1.step.total_cmp(&b.1.step));
            let left = if sign > 0.0 { 1.0 - self.s } else { f64::INFINITY };
            let step = exit.as_ref().map_or(left, |(_, exit)| exit.step.min(left));
            if !step.is_finite() {
                return Err(LOST);
            }
            if step * self.equations.length(&self.rate)
                > FAR * (self.equations.length(&self.y) + self.size)
                && let Some(motion) = self.rigid(&self.rate, sign)
            {
                return Err(Ending::Recession(motion));
            }
            for (y, rate) in self.y.iter_mut().zip(&self.rate) {
                *y += sign * step * rate;
            }
            self.s += sign * step;
            let Some((pair, exit)) = exit.filter(|(_, exit)| exit.step < left) else {
                return Ok(());
            };
            self.pass(pair, &exit, rules)?;
        }
        Err(LOST)
    }

    /// The next boundary of each pair that comes to one on the way.
    fn exits(&self, sign: f64) -> impl Iterator<Item = (usize, PieceExit)> {
        let pairs = self.equations.laws.iter().zip(&self.pieces);
        let ways = self.y.chunks_exact(2).zip(self.rate.chunks_exact(2));
        pairs.zip(ways).enumerate().filter_map(move |(pair, ((law, piece), (y, rate)))| {
            let rate = [sign * rate[0], sign * rate[1]];
            law.planar_exit(*piece, [y[0], y[1]], rate).map(|exit| (pair, exit))
        })
    }

    /// Passes the boundary of a pair.
    fn pass(&mut self, pair: usize, exit: &PieceExit, rules: Rules) -> Result<(), Ending> {
        let beyond = self.equations.laws[pair].linearised_on(exit.beyond);
        if self.y.len() > IN_CACHE && self.system.lacks_columns(pair, &beyond) {
            self.prepare((pair, beyond))?;
        }
        let change = self.system.change(pair, beyond, &mut self.monitor.asking()).ok_or(LOST)?;
        self.pieces[pair] = exit.beyond;
        let singular = change.pivot.abs() < SMALL_PIVOT;
        if !singular {
            self.system.make(change, &mut self.rate);
        } else if let Some(motion) = self.rigid(&change.z, 1.0) {
            return Err(Ending::Recession(motion));
        }
        if singular || self.system.age() >= rules.age {
            self.refactorise()?;
        }
        Ok(())
    }

    /// Makes the columns of the change of a pair with those of the pairs that come to their boundaries next.
    fn prepare(&mut self, first: (usize, Linearised)) -> Result<(), Ending> {
        let mut exits: Vec<(usize, PieceExit)> = self
            .exits(f64::from(self.system.sign()))
            .filter(|(pair, _)| *pair != first.0)
            .collect();
        exits.sort_by(|a, b| a.1.step.total_cmp(&b.1.step));
        let laws = &self.equations.laws;
        let others =
            exits.into_iter().map(|(pair, exit)| (pair, laws[pair].linearised_on(exit.beyond)));
        let likely: Vec<(usize, Linearised)> = std::iter::once(first).chain(others).collect();
        self.system.prepare(&likely, BLOCK, &mut self.monitor.asking()).ok_or(LOST)
    }

    /// Factorises the system of today's pieces, and puts the coordinates back on the path.
    fn refactorise(&mut self) -> Result<(), Ending> {
        self.factorisations += 1;
        self.system = factorised(self.equations, &self.pieces, self.monitor)?;
        // J y = r_s - c + K c_t / k, with P = D y + c on a piece.
        let mut side: Vec<f64> =
            self.first.iter().zip(&self.change).map(|(r, change)| r + self.s * change).collect();
        let mut constant = vec![0.0; side.len()];
        for (pair, (law, piece)) in self.equations.laws.iter().zip(&self.pieces).enumerate() {
            let (i, push) = (2 * pair, law.constant(*piece));
            side[i] -= push[0];
            side[i + 1] -= push[1];
            // A tension is no part of `k v = y - P'`.
            constant[i + 1] = push[1] / self.equations.root[i + 1].powi(2);
        }
        self.equations.matrix.add_product(&constant, &mut side);
        self.y = self.system.solve(&side);
        self.rate = self.system.solve(&self.change);
        let finite = self.y.iter().chain(&self.rate).all(|x| x.is_finite());
        if finite { Ok(()) } else { Err(LOST) }
    }

    /// The motion of the coordinates' direction `sign way`, if it is rigid. Below the start a ray says nothing of the
    /// loads of the problem.
    fn rigid(&self, way: &[f64], sign: f64) -> Option<Vec<f64>> {
        if self.s < 0.0 {
            return None;
        }
        let mut motion = self.system.motion(way);
        motion.iter_mut().for_each(|motion| *motion *= sign);
        let root = &self.equations.root;
        let size = largest_of(motion.iter().zip(root).map(|(motion, root)| motion * root));
        let internal = self.equations.matrix.product(&motion);
        let resisted = internal.iter().zip(root).map(|(force, root)| force / root);
        (size > 0.0 && largest_of(resisted) <= SMALL_PIVOT * size).then_some(motion)
    }

    /// The displacements of today.
    pub fn displacements(&self) -> Vec<f64> {
        self.equations.values(&self.pieces, &by_pairs(self.equations.dim, &self.y)).0
    }
}

/// The system of pairs on their pieces. `Err`: it is singular, or there is no time for it.
fn factorised<'p>(
    equations: &'p Equations<'p>,
    pieces: &[Piece],
    monitor: &dyn Watch,
) -> Result<Updated<'p>, Ending> {
    let pairs = equations.laws.iter().zip(pieces);
    let pairs: Vec<Linearised> = pairs.map(|(law, piece)| law.linearised_on(*piece)).collect();
    monitor.affords(System::work(equations, &pairs))?;
    Updated::new(equations, pairs, &mut monitor.asking()).ok_or(LOST)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Contact;
    use crate::monitor::Monitor;
    use crate::problem::{ContactProblem, FrictionLaw};
    use crate::settings::Settings;

    /// One pair with `K = [2 1; 1 1]` and `mu = 2`. The loads (1, 1.5) hold it stuck with the pressure 1 and the friction
    /// 1.5, slipping by 0.5 under the pressure 0.5, and open at `K⁻¹ (1, 1.5) = (-0.5, 2)`; the loads (-1, 0) only open,
    /// at (-1, 1). On the line between them the stuck point ends where the friction is twice the pressure, the slipping one
    /// there and where both are equal, below (1, 1.5): paths from all three points arrive (theorem I).
    #[test]
    fn a_path_goes_on_below_its_start() {
        let (stiffness, load) = ([2.0, 1.0, 1.0, 1.0], [-1.0, 0.0]);
        let of_pairs = (&[0.0][..], FrictionLaw::Coulomb(&[2.0]), None);
        let problem = ContactProblem::of_test(2, (&stiffness, &load), of_pairs);
        let (contact, settings) = (Contact::new(&problem), Settings::default());
        let equations = Equations::of(&contact);
        let (stuck, slipping, open) = ([1.0, 1.5], [0.5, 1.5], [-1.0, 2.0]);
        for (start, sign, events) in [(stuck, 1.0, 2), (slipping, -1.0, 1), (open, 1.0, 0)] {
            let monitor = Monitor::new(&settings, None);
            let walk = Walk::new(&equations, &load, &[start], &monitor);
            let Ok(mut walk) = walk else { panic!("each piece is regular") };
            // K v + P is (1, 1.5) at all three; powers of two and few digits leave no rounding.
            assert_eq!(walk.first, [1.0, 1.5]);
            assert_eq!(f64::from(walk.system.sign()), sign);
            let end = walk.follow(Rules { most: 10, age: 60 });
            assert_eq!(end, Ok(()), "from {start:?}");
            // A step to each event, and one to the end.
            assert_eq!(monitor.iterations(), events + 1, "from {start:?}");
            let d = walk.displacements();
            assert!((d[0] + 1.0).abs() < 1e-14 && (d[1] - 1.0).abs() < 1e-14, "{d:?}");
        }
    }
}
