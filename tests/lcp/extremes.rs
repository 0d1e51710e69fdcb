//! LCPs whose numbers overflow or underflow: every answer consists of numbers, and what is called solved or
//! infeasible is so by sums that keep their exponents apart.

use crate::common::bare::Bare;
use fastrand::Rng;
use signorini::{LcpSolution, Method, Settings, Status};

/// `mantissa 2^exponent`, of any size.
#[derive(Clone, Copy)]
struct Wide {
    mantissa: f64,
    exponent: i32,
}

impl Wide {
    fn new(mantissa: f64, exponent: i32) -> Self {
        if mantissa == 0.0 {
            return Wide { mantissa, exponent: -100_000 };
        }
        // Subnormal numbers are brought up first.
        let mantissa = mantissa * 2_f64.powi(200);
        if !mantissa.is_finite() {
            let mantissa = mantissa * 0.0;
            panic!("{mantissa}: use `of`");
        }
        let shift = mantissa.abs().log2().floor() as i32;
        Wide { mantissa: mantissa / 2_f64.powi(shift), exponent: exponent + shift - 200 }
    }

    /// A double.
    fn of(x: f64) -> Self {
        if x.abs() > 1.0 { Wide::new(x / 2_f64.powi(600), 600) } else { Wide::new(x, 0) }
    }

    fn times(self, other: Wide) -> Self {
        Wide::new(self.mantissa * other.mantissa, self.exponent + other.exponent)
    }

    fn plus(self, other: Wide) -> Self {
        let (large, small) =
            if self.exponent >= other.exponent { (self, other) } else { (other, self) };
        let shift = (small.exponent - large.exponent).max(-1000);
        Wide::new(large.mantissa + small.mantissa * 2_f64.powi(shift), large.exponent)
    }

    /// `true` if `|self| <= part |other|`.
    fn is_within(self, part: f64, other: Wide) -> bool {
        let bound = Wide::of(part).times(other);
        let rest = Wide::new(bound.mantissa.abs(), bound.exponent)
            .plus(Wide::new(-self.mantissa.abs(), self.exponent));
        rest.mantissa >= 0.0
    }
}

fn sum(terms: impl IntoIterator<Item = Wide>) -> Wide {
    terms.into_iter().fold(Wide::of(0.0), Wide::plus)
}

fn larger(a: Wide, b: Wide) -> Wide {
    if a.is_within(1.0, b) { b } else { a }
}

/// Part of the scale that a residual may have: the tolerance 1e-10, the largest entry in the place of norms
/// of at most 5 entries, and the rounding of the sums here.
const MOST: f64 = 1e-9;

/// Part of the largest of at most 5 terms that 8 units in the last digits of all entries explain, and the rounding of the sums
/// here.
const LAST_DIGITS: f64 = 5.0 * 10.0 * f64::EPSILON;

/// Why the answer is wrong.
fn flaw(data: &Bare, solution: &LcpSolution) -> Option<String> {
    let n = data.n;
    let LcpSolution { w, z, .. } = solution;
    if w.iter().chain(z).any(|x| !(*x >= 0.0 && x.is_finite())) || !solution.eta.is_finite() {
        return Some("not numbers".into());
    }
    match solution.status {
        Status::Solved => {
            let low = |j: usize| solution.z_low.get(j).copied().unwrap_or(0.0);
            let term = |i: usize, j: usize| {
                let parts = [z[j], low(j)].map(Wide::of);
                Wide::of(data.m[i + j * n]).times(parts[0].plus(parts[1]))
            };
            let load = (0..n).fold(Wide::of(0.0), |s, i| larger(s, Wide::of(data.q[i])));
            (0..n).find_map(|i| {
                let product = sum((0..n).map(|j| term(i, j)));
                let own = product.plus(Wide::of(data.q[i])).plus(Wide::of(-w[i]));
                // The sums here are rounded relative to their largest term.
                let most = (0..n).fold(Wide::of(0.0), |s, j| larger(s, term(i, j)));
                let rounding = Wide::of(8.0 * f64::EPSILON).times(most);
                let scale = larger(Wide::of(MOST).times(load), rounding);
                let wrong = !own.is_within(1.0, scale) || (w[i] != 0.0 && z[i] != 0.0);
                wrong.then(|| format!("row {i} does not hold"))
            })
        }
        Status::NoEquilibrium => {
            let Some(y) = &solution.infeasible_by else { return Some("no proof".into()) };
            let term = |j: usize, i: usize| Wide::of(data.m[i + j * n]).times(Wide::of(y[i]));
            let work = sum((0..n).map(|i| Wide::of(data.q[i]).times(Wide::of(y[i]))));
            let holds = (0..n).all(|j| {
                let all = sum((0..n).map(|i| term(j, i)));
                let size = (0..n).fold(Wide::of(0.0), |s, i| larger(s, term(j, i)));
                all.mantissa <= 0.0 || all.is_within(LAST_DIGITS, size)
            });
            (!(holds && work.mantissa < 0.0)).then(|| "its proof proves nothing".into())
        }
        _ => None,
    }
}

fn checked(data: &Bare, method: Method) -> LcpSolution {
    let settings = Settings { method, max_iterations: 5000, ..Settings::default() };
    let solution = data.solve(&settings);
    assert_eq!(flaw(data, &solution), None, "{method:?} {data:?}\n{solution:?}");
    solution
}

const METHODS: [Method; 3] = [Method::Auto, Method::Lemke, Method::BlockPivoting];

/// `w_0 = q_0 < 0` for all `z`: infeasible, though `|q|` overflows.
#[test]
fn a_norm_that_overflows_hides_no_infeasibility() {
    for size in [1.0, 1.3e308, 5e-324, 1e-310] {
        let data = Bare { n: 2, m: vec![0.0, 0.0, 0.0, 1.0], q: vec![-size, size] };
        for method in [Method::Auto, Method::Lemke] {
            let solution = checked(&data, method);
            assert_eq!(solution.status, Status::NoEquilibrium, "{size} {solution:?}");
        }
        assert_ne!(checked(&data, Method::BlockPivoting).status, Status::Solved);
    }
}

/// Both corners `z = (10, 0)` and `(0, 10)` need `w = 1e309`; `z = (1e-307, 1e-307)` is a solution in numbers.
#[test]
fn a_result_beyond_the_largest_number_is_not_solved() {
    let data = Bare { n: 2, m: vec![1.0, 1e308, 1e308, 1.0], q: vec![-10.0, -10.0] };
    for method in METHODS {
        let solution = checked(&data, method);
        assert!(matches!(solution.status, Status::Solved | Status::Stalled), "{solution:?}");
    }
    // z = 1e310.
    let data = Bare { n: 2, m: vec![1.0, 0.0, 0.0, 1e-300], q: vec![-1.0, -1e10] };
    for method in METHODS {
        let solution = checked(&data, method);
        assert_eq!(solution.status, Status::Stalled, "{solution:?}");
        let told = solution.message.starts_with("z[1] is beyond");
        assert!(told || method == Method::BlockPivoting, "{solution:?}");
    }
}

/// A diagonal problem of any size has the solution `z_i = -q_i / m_i` where `q_i < 0`.
#[test]
fn diagonal_problems_of_any_size_are_solved() {
    for e in (-320..=300).step_by(10) {
        // As `powi` would divide by infinity.
        let power = |e: i32| format!("1e{e}").parse::<f64>().unwrap();
        let m = power(e);
        for f in [-320, -300, -150, 0, 150, 300] {
            let q = power(f);
            if !(-290..300).contains(&(f - e)) {
                continue;
            }
            let data = Bare { n: 2, m: vec![m, 0.0, 0.0, m], q: vec![-q, q] };
            for method in METHODS {
                let solution = checked(&data, method);
                assert_eq!(solution.status, Status::Solved, "{e} {f} {solution:?}");
            }
        }
    }
}

/// Entries of any exponent, and any signs: solved, infeasible or neither, and never wrong.
#[test]
fn no_answer_is_wrong_or_no_number() {
    let mut counts = [0; 3];
    for seed in 0..20_000 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=5);
        let range = [20, 200, 308][rng.usize(0..3)];
        let definite = rng.bool();
        let entry = |rng: &mut Rng| match rng.u8(0..8) {
            0 => 0.0,
            1 => [f64::MAX, f64::MIN_POSITIVE, 5e-324][rng.usize(0..3)],
            _ => (2.0 * rng.f64() - 1.0) * 10_f64.powi(rng.i32(-range..=range)),
        };
        let mut m: Vec<f64> = (0..n * n).map(|_| entry(&mut rng)).collect();
        for i in 0..n {
            if definite {
                m[i + i * n] = m[i + i * n].abs();
            }
        }
        let data = Bare { n, m, q: (0..n).map(|_| entry(&mut rng)).collect() };
        for method in METHODS {
            counts[match checked(&data, method).status {
                Status::Solved => 0,
                Status::NoEquilibrium => 1,
                _ => 2,
            }] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}: one-sided");
}
