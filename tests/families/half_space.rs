//! Contacts of an elastic half-space with a rigid body, against closed forms on the exact disc of
//! friction: H. Hertz; C. Cattaneo (1938) and R. D. Mindlin (1949) for a shift; J. L. Lubkin (1951) for a
//! twist, where the slip of every point has another direction; punches that spin, and one that is bonded.
//!
//! The body moves by given amounts: down through the gaps, along the surface through the reference slip.
//! The error of uniform tractions on squares remains. It comes from the rim, where tractions
//! begin with a vertical tangent, and from the circles that squares cannot follow: it falls with the side
//! of the squares. `--nocapture` shows it.

use std::f64::consts::PI;

use crate::common::dense::{difference, largest, norm};
use crate::common::half_space::{Grid, HalfSpace, elliptic};
use crate::common::problems::{Case, Law};
use signorini::{Method, Settings, Solution, State, Status};

/// Radius of the contact, in a half-space of the shear modulus 1; the coefficient of friction.
const A: f64 = 0.75;
const MU: f64 = 0.3;

/// Squares that a sphere may touch: those beyond it stay open, which `touches_within` checks.
const REACH: f64 = A + 0.2;

/// Squares along an edge of [-1, 1]²: the errors must fall from one to the next.
const GRIDS: [usize; 2] = [16, 24];

/// Neither pressure nor Poisson's contraction moves the surface along itself: what the theory of
/// Cattaneo and Mindlin takes for granted.
const UNCOUPLED: HalfSpace = HalfSpace { shear: 1.0, poisson: 0.0, coupled: false };

/// Pressures do not move the surface of an incompressible material along itself.
const INCOMPRESSIBLE: HalfSpace = HalfSpace { shear: 1.0, poisson: 0.5, coupled: true };

/// A solved contact: tractions on the squares.
struct Contact {
    grid: Grid,
    solution: Solution,
    pressure: Vec<f64>,
    shear: Vec<[f64; 2]>,
}

impl Contact {
    /// A body at the height `gap` of radius, moved along the surface by `motion` of a point.
    fn new(
        body: &HalfSpace,
        grid: Grid,
        gap: impl Fn(f64) -> f64,
        motion: impl Fn([f64; 2]) -> [f64; 2],
        mu: f64,
    ) -> Contact {
        let pairs = grid.centres.len();
        let case = Case {
            dim: 3,
            pairs,
            k: body.stiffness(&grid),
            f: vec![0.0; 3 * pairs],
            gap: grid.radii().map(gap).collect(),
            law: Law::Coulomb(vec![mu; pairs]),
            slip: Some(grid.centres.iter().flat_map(|&at| motion(at)).collect()),
        };
        let settings = Settings { method: Method::Auto, tolerance: 1e-11, ..Settings::default() };
        let solution = case.solve(&settings);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let force = solution.certificate.force.chunks_exact(3);
        let pressure = force.clone().map(|f| -f[0] / grid.area()).collect();
        let shear = force.map(|f| [f[1] / grid.area(), f[2] / grid.area()]).collect();
        Contact { grid, solution, pressure, shear }
    }

    /// A sphere of the radius 1, pressed until Hertz's contact has the radius `A`.
    fn sphere(body: &HalfSpace, n: usize, motion: impl Fn([f64; 2]) -> [f64; 2]) -> Contact {
        let contact = Contact::new(body, Grid::new(n, REACH), |r| r * r / 2.0 - A * A, motion, MU);
        contact.touches_within(REACH - contact.grid.side);
        contact
    }

    fn touches_within(&self, radius: f64) {
        let touching = self.grid.radii().zip(&self.pressure).filter(|(_, p)| **p > 0.0);
        assert!(touching.fold(0.0, |most: f64, (r, _)| most.max(r)) < radius);
    }

    fn resultant(&self, values: impl Iterator<Item = f64>) -> f64 {
        values.sum::<f64>() * self.grid.area()
    }

    fn press(&self) -> f64 {
        self.resultant(self.pressure.iter().copied())
    }

    fn push(&self) -> f64 {
        self.resultant(self.shear.iter().map(|q| q[0]))
    }

    fn torque(&self) -> f64 {
        let centres = self.grid.centres.iter();
        self.resultant(centres.zip(&self.shear).map(|([x, y], q)| x * q[1] - y * q[0]))
    }

    /// Radius of the disc with the area of the squares in these states.
    fn radius(&self, states: &[State]) -> f64 {
        let all = &self.solution.certificate.states;
        self.grid.radius_of(all.iter().filter(|state| states.contains(state)).count())
    }

    /// `|values - exact(r)| / |exact(r)|` in L2.
    fn distance(&self, values: &[f64], exact: impl Fn(f64) -> f64) -> f64 {
        let exact: Vec<f64> = self.grid.radii().map(exact).collect();
        norm(&difference(values, &exact)) / norm(&exact)
    }
}

/// Largest pressure, pressure, and resultant of Hertz.
fn hertz(body: &HalfSpace) -> (f64, impl Fn(f64) -> f64, f64) {
    let modulus = body.contact_modulus();
    let most = 2.0 * A * modulus / PI;
    (most, move |r| most * ellipse(r, A), 4.0 / 3.0 * modulus * A.powi(3))
}

/// `(1 - r²/a²)^½`, zero outside.
fn ellipse(r: f64, a: f64) -> f64 {
    (1.0 - (r / a).powi(2)).max(0.0).sqrt()
}

/// A quantity, its relative errors on the grids, and the most that is allowed on the finest.
type Row = (&'static str, [f64; 2], f64);

/// Prints the errors, checks those of the finest grid, and that each is smaller than on the coarse one.
fn check(name: &str, measure: impl Fn(usize) -> Vec<(&'static str, f64, f64)>) {
    let [coarse, fine] = GRIDS.map(measure);
    let row = |(a, b): (&(&'static str, f64, f64), &(&'static str, f64, f64))| -> Row {
        (a.0, [a.1, b.1], b.2)
    };
    for (what, [before, after], most) in coarse.iter().zip(&fine).map(row) {
        println!("{name:28} {what:24} {:8.3} % {:8.3} %", 100.0 * before, 100.0 * after);
        assert!(after.abs() <= most, "{name}, {what}: {after:e}, at most {most:e}");
        assert!(after.abs() < before.abs(), "{name}, {what} does not fall");
    }
}

fn error(value: f64, exact: f64) -> f64 {
    value / exact - 1.0
}

#[test]
fn sphere_that_is_pressed_and_shifted() {
    check("Hertz, Cattaneo and Mindlin", |n| {
        let (p0, p, press) = hertz(&UNCOUPLED);
        let c = A / 2.0;
        let push = MU * press * (1.0 - (c / A).powi(3));
        let factor = (2.0 - UNCOUPLED.poisson) / UNCOUPLED.shear;
        let shift = 3.0 * MU * press / (16.0 * A) * factor * (1.0 - (c / A).powi(2));
        let contact = Contact::sphere(&UNCOUPLED, n, |_| [shift, 0.0]);
        let shear: Vec<f64> = contact.shear.iter().map(|q| q[0]).collect();
        // Nothing couples the two tangents: the second carries rounding.
        let aside = largest(&contact.shear.iter().map(|q| q[1]).collect::<Vec<f64>>());
        assert!(aside <= 1e-12 * p0, "traction across the shift: {aside:e} of {p0}");
        let q = |r| MU * p0 * (ellipse(r, A) - c / A * ellipse(r, c));
        // A radius from the area of squares is off by about half a square over the radius at most.
        vec![
            ("P", error(contact.press(), press), 0.003),
            ("p0", error(largest(&contact.pressure), p0), 0.01),
            ("p in L2", contact.distance(&contact.pressure, p), 0.04),
            ("a", error(contact.radius(&[State::Stick, State::Slip]), A), 0.04),
            ("Q", error(contact.push(), push), 0.003),
            ("q in L2", contact.distance(&shear, q), 0.04),
            ("c", error(contact.radius(&[State::Stick]), c), 0.05),
        ]
    });
}

/// Rotation for which the radius `c` sticks, and its moment, by the superposition of rigid discs.
fn torsion(p0: f64, c: f64) -> (f64, f64) {
    // a [K - E] of the modulus (1 - s²/a²)^½.
    let twist = |s: f64| {
        let (first, second) = elliptic(ellipse(s, A));
        A * (first - second)
    };
    // Simpson's rule of 3 s² I(s) from c to a, smooth there: 200 steps are exact to 1e-9.
    let steps = 200;
    let step = (A - c) / f64::from(steps);
    let integral: f64 = (0..=steps)
        .map(|i| {
            let s = c + step * f64::from(i);
            let weight = if i == 0 || i == steps { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            weight * step / 3.0 * 3.0 * s * s * twist(s)
        })
        .sum();
    let moment = 8.0 / 3.0 * MU * p0 / A * (c.powi(3) * twist(c) + integral);
    (MU * p0 / (2.0 * INCOMPRESSIBLE.shear) * twist(c) / A, moment)
}

#[test]
fn sphere_that_is_pressed_and_twisted() {
    let (p0, _, press) = hertz(&INCOMPRESSIBLE);
    // Where nothing sticks the moment is that of the friction: 3 pi/16 mu P a.
    let all = torsion(p0, 1e-6 * A).1;
    assert!(error(all, 3.0 * PI / 16.0 * MU * press * A).abs() < 1e-6, "{all}");
    check("Hertz, torsion", |n| {
        let (_, p, _) = hertz(&INCOMPRESSIBLE);
        let c = A / 2.0;
        let (turn, moment) = torsion(p0, c);
        let contact = Contact::sphere(&INCOMPRESSIBLE, n, |[x, y]| [-turn * y, turn * x]);
        let slipping = contact.solution.certificate.states.iter().zip(&contact.pressure);
        let slipping =
            slipping.zip(&contact.shear).filter(|((state, _), _)| **state == State::Slip);
        for ((_, p), q) in slipping {
            assert!(error(q[0].hypot(q[1]), MU * p).abs() <= 1e-9, "the disc of friction is exact");
        }
        vec![
            ("P", error(contact.press(), press), 0.003),
            ("p in L2", contact.distance(&contact.pressure, p), 0.04),
            ("M", error(contact.torque(), moment), 0.003),
            ("c", error(contact.radius(&[State::Stick]), c), 0.05),
        ]
    });
    check("Hertz, spin", |n| {
        let turn = 100.0 * MU * p0;
        let contact = Contact::sphere(&INCOMPRESSIBLE, n, |[x, y]| [-turn * y, turn * x]);
        let moment = 3.0 * PI / 16.0 * MU * press * A;
        vec![("M", error(contact.torque(), moment), 0.003)]
    });
}

/// Depth of the surface under a uniform pressure 1 on the disc of radius `A`, within it (Love).
fn depth_under_uniform_pressure(body: &HalfSpace, r: f64) -> f64 {
    4.0 * A / (PI * body.contact_modulus()) * elliptic(r / A).1
}

#[test]
fn punches_that_spin() {
    // Turns that no elastic displacement, all below 1, resists.
    let spin = 100.0;
    let turned = |turn: f64| move |[x, y]: [f64; 2]| [-turn * y, turn * x];
    // A punch of the shape that a uniform pressure gives to the surface. The disc of squares has the
    // area of a disc to some 1e-3, and its pressure is not uniform at the rim.
    check("spin, uniform pressure", |n| {
        let gap = |r: f64| -depth_under_uniform_pressure(&INCOMPRESSIBLE, r);
        let contact = Contact::new(&INCOMPRESSIBLE, Grid::new(n, A), gap, turned(spin), MU);
        let press = contact.press();
        vec![
            ("P", error(press, PI * A * A), 0.003),
            ("M/(mu P a)", error(contact.torque() / (MU * press * A), 2.0 / 3.0), 0.003),
        ]
    });
    // The pressure of a flat punch is infinite at the rim: the squares have errors of the order of
    // their side, a ninth of the radius, with a small factor.
    check("spin, flat punch", |n| {
        let contact = Contact::new(&INCOMPRESSIBLE, Grid::new(n, A), |_| -1.0, turned(spin), MU);
        let press = contact.press();
        vec![
            ("P", error(press, 2.0 * A * INCOMPRESSIBLE.contact_modulus()), 0.02),
            ("M/(mu P a)", error(contact.torque() / (MU * press * A), PI / 4.0), 0.02),
        ]
    });
    check("twist of a bonded disc", |n| {
        // The ratio of the tractions is the angle times the radius: all stick.
        let turn = 1e-3;
        let contact = Contact::new(&INCOMPRESSIBLE, Grid::new(n, A), |_| -1.0, turned(turn), 1.0);
        let states = &contact.solution.certificate.states;
        assert!(states.iter().all(|&state| state == State::Stick));
        vec![("M", error(contact.torque(), 16.0 / 3.0 * A.powi(3) * turn), 0.03)]
    });
}

/// A flat punch to whose face the surface sticks as it goes down: V. I. Mossakovskii (1954),
/// `P = 4 G a delta ln(3 - 4 nu) / (1 - 2 nu)`; without friction `4 G a delta / (1 - nu)`. The ratio,
/// 1.10 and 1.03, hardly depends on how squares follow the rim. Pressure and shear act on each other here.
#[test]
fn flat_punch_that_sticks() {
    for poisson in [0.0, 0.3] {
        let body = HalfSpace { shear: 1.0, poisson, coupled: true };
        check(&format!("bonded punch, nu {poisson}"), |n| {
            // Friction that holds at every point.
            let press = |mu: f64| {
                let contact = Contact::new(&body, Grid::new(n, A), |_| -1.0, |_| [0.0; 2], mu);
                let states = &contact.solution.certificate.states;
                assert!(mu == 0.0 || states.iter().all(|&state| state == State::Stick));
                contact.press()
            };
            let exact = (1.0 - poisson) * (3.0 - 4.0 * poisson).ln() / (1.0 - 2.0 * poisson);
            vec![("P/P without friction", error(press(10.0) / press(0.0), exact), 0.005)]
        });
    }
}
