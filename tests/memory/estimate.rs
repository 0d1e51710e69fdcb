//! A solution's peak of memory stays below what [`signorini::memory`] tells before, for every method, law
//! and question, and is a fair part of it.
//!
//! Chains of nodes: each tied to the next by springs of stiffness 1 and to the ground by weak ones, pressed
//! and dragged by loads without a pattern.

use crate::counted;
use fastrand::Rng;
use signorini::certificate::{certify, prove};
use signorini::reduce::{self, Indices, SparseMatrix, Triangle};
use signorini::{
    ContactData, ContactProblem, FlexibilityData, FlexibilityProblem, FrictionLaw, Lcp, LoadCase,
    Method, Model, Monitor, Search, Settings, Starts, memory, memory_flexibility, solve,
    solve_flexibility, solve_lcp,
};

/// Most that the estimate may be of what is held, where the problem is large enough that matrices decide and
/// the call asks for all that the estimate is for.
const MOST: f64 = 4.0;

struct Chain {
    dim: usize,
    pairs: usize,
    k: Vec<f64>,
    load: Vec<f64>,
    gap: Vec<f64>,
    mu: Vec<f64>,
    ellipses: Vec<f64>,
    cohesion: Vec<f64>,
    /// A tie, and Coulomb's law of the other pairs.
    ties: Vec<f64>,
}

impl Chain {
    fn new(dim: usize, pairs: usize, ground: f64) -> Self {
        let mut rng = Rng::with_seed(7);
        let n = dim * pairs;
        let mut k = vec![0.0; n * n];
        for i in 0..n {
            k[i + n * i] += ground;
            if i + dim < n {
                let other = i - i % dim + (i + 1) % dim;
                let (at, strain) = ([i, i + dim, other, other + dim], [-1.0, 1.0, -0.25, 0.25]);
                for (a, x) in at.iter().zip(strain) {
                    for (b, y) in at.iter().zip(strain) {
                        k[a + n * b] += x * y;
                    }
                }
            }
        }
        let mut draw = |low: f64, high: f64| low + (high - low) * rng.f64();
        let load = (0..n).map(|i| if i % dim == 0 { draw(-0.4, 1.6) } else { draw(-0.5, 0.5) });
        let load = load.collect();
        let gap = (0..pairs).map(|_| draw(0.0, 0.2)).collect();
        let mu = (0..pairs).map(|_| draw(0.0, 0.6)).collect();
        let ellipses = (0..pairs).flat_map(|_| [0.2, 0.4, 0.3]).collect();
        let cohesion = (0..pairs).flat_map(|_| [0.3, 0.1, 0.05]).collect();
        let tied = |pair: usize| if pair == 0 { [7.0, 0.0] } else { [1.0, 0.3] };
        let ties = (0..pairs).flat_map(|pair| [tied(pair)[0], tied(pair)[1], 0.0, 0.0]).collect();
        Chain { dim, pairs, k, load, gap, mu, ellipses, cohesion, ties }
    }

    /// Springs that nearly hold every second pair along its second tangent.
    fn held_across(mut self) -> Self {
        let n = self.n();
        (2..n).step_by(6).for_each(|i| self.k[i + n * i] += 1e4);
        self
    }

    fn n(&self) -> usize {
        self.dim * self.pairs
    }

    fn problem<'a>(&'a self, law: FrictionLaw<'a>) -> ContactProblem<'a> {
        ContactProblem::new(ContactData {
            dim: self.dim,
            pairs: self.pairs,
            stiffness: &self.k,
            ld: self.n(),
            load: &self.load,
            gap: &self.gap,
            law,
            reference_slip: None,
        })
        .expect("a valid problem")
    }

    fn laws(&self) -> Vec<(&'static str, FrictionLaw<'_>)> {
        let mut laws = vec![
            ("frictionless", FrictionLaw::Frictionless),
            ("Coulomb", FrictionLaw::Coulomb(&self.mu)),
            ("Tresca", FrictionLaw::Tresca(&self.mu)),
            ("cohesive", FrictionLaw::Cohesive(&self.cohesion)),
            ("tied in part", FrictionLaw::ByPair(&self.ties)),
        ];
        if self.dim == 3 {
            laws.push(("orthotropic", FrictionLaw::Orthotropic(&self.ellipses)));
        }
        laws
    }
}

/// Memory beside the estimate: peak over estimate, and peak over the bytes of `K`.
struct Shares {
    worst: f64,
    least: f64,
}

impl Shares {
    fn note(&mut self, what: &str, n: usize, peak: usize, estimate: u64) {
        let share = peak as f64 / estimate as f64;
        println!("{what}: {:.2} K, {share:.2} of the estimate", peak as f64 / (8 * n * n) as f64);
        assert!(share <= 1.0, "{what}: {peak} bytes, estimated {estimate}");
        self.worst = self.worst.max(share);
        self.least = self.least.min(share);
    }
}

const METHODS: [Method; 7] = [
    Method::Auto,
    Method::SorNested,
    Method::SorDiagonal,
    Method::Lemke,
    Method::BlockPivoting,
    Method::Newton,
    Method::Path,
];

/// Every method and law, with and without the search for other solutions and a proof.
fn solutions(chain: &Chain, shares: &mut Shares) {
    for (name, law) in chain.laws() {
        let problem = chain.problem(law);
        for method in METHODS {
            for (search, proof) in
                [(Search::Off, false), (Search::Others, false), (Search::Off, true)]
            {
                // The search costs several solutions: of one method.
                if search == Search::Others && method != Method::Auto {
                    continue;
                }
                let settings =
                    Settings { method, search, proof, max_iterations: 3000, ..Settings::default() };
                let monitor = &mut Monitor::new(&settings, None);
                let (peak, result) = counted::peak(|| solve(&problem, &settings, None, monitor));
                // A method that is not for this law refuses it.
                let Ok(solution) = result else { continue };
                let what = format!(
                    "{}D, {} pairs, {name}, {method:?}, {search:?}, proof {proof}, {:?}",
                    chain.dim, chain.pairs, solution.status
                );
                // The matrix of the pairs that are not tied.
                let ties = if law.has_ties() { 8 * chain.n().pow(2) as u64 } else { 0 };
                shares.note(&what, chain.n(), peak, memory(chain.n()) + ties);
            }
        }
    }
}

#[test]
fn a_call_holds_no_more_than_was_estimated() {
    let _alone = counted::alone();
    // The first solution of a thread makes what the thread keeps for matrix products.
    let first = Chain::new(2, 40, 0.05);
    let settings = Settings { method: Method::SorNested, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let warm = solve(&first.problem(FrictionLaw::Frictionless), &settings, None, monitor);
    assert!(warm.is_ok());
    let mut shares = Shares { worst: 0.0, least: f64::INFINITY };
    for (dim, pairs, ground) in
        [(2, 3, 0.5), (2, 40, 0.05), (3, 30, 0.05), (2, 250, 0.05), (3, 150, 0.05), (2, 150, 0.0)]
    {
        let chain = Chain::new(dim, pairs, ground);
        solutions(&chain, &mut shares);
        others(&chain, &mut shares);
        flexibilities(&chain, &mut shares);
        sparse_flexibility(&chain, &mut shares);
    }
    for ground in [0.05, 0.0] {
        solutions(&Chain::new(3, 120, ground).held_across(), &mut shares);
    }
    println!("shares from {:.3} to {:.3}", shares.least, shares.worst);
    assert!(shares.worst >= 1.0 / MOST, "the estimate is {} times the most", 1.0 / shares.worst);
}

/// Calls that solve no contact problem.
fn others(chain: &Chain, shares: &mut Shares) {
    let n = chain.n();
    let problem = chain.problem(FrictionLaw::Coulomb(&chain.mu));
    let d = vec![0.01; n];
    let estimate = memory(n);
    let (peak, certificate) = counted::peak(|| certify(&problem, &d));
    shares.note("certify", n, peak, estimate);
    let (peak, _) = counted::peak(|| prove(&problem, &d, &certificate.states));
    shares.note("prove", n, peak, estimate);
    let lcp = Lcp::new(n, &chain.k, n, &chain.load, None).expect("a valid LCP");
    for method in [Method::Auto, Method::BlockPivoting, Method::Lemke] {
        let settings = Settings { method, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let (peak, _) = counted::peak(|| solve_lcp(&lcp, &settings, monitor));
        shares.note(&format!("LCP, {method:?}"), n, peak, estimate);
    }
    let (peak, _) = counted::peak(|| Model::condensed(chain.dim, chain.pairs, &chain.k, n).is_ok());
    shares.note("condensed model", n, peak, reduce::memory(n));
    series(chain, shares);
    let both = ((&chain.k[..], n), (&chain.k[..], n));
    let (peak, _) =
        counted::peak(|| Model::two_body(chain.dim, chain.pairs, both.0, both.1).is_ok());
    shares.note("two bodies", n, peak, reduce::memory(n));
}

/// The flexibility form: the matrix of the chain as `W`, every method and law.
fn flexibilities(chain: &Chain, shares: &mut Shares) {
    let n = chain.n();
    for (name, law) in chain.laws() {
        for method in METHODS {
            let data = FlexibilityData {
                dim: chain.dim,
                pairs: chain.pairs,
                flexibility: (&chain.k[..], n),
                free: &chain.load,
                gap: &chain.gap,
                law,
                reference_slip: None,
            };
            let problem = FlexibilityProblem::from_flexibility(data).expect("a valid problem");
            let settings = Settings { method, max_iterations: 3000, ..Settings::default() };
            let monitor = &mut Monitor::new(&settings, None);
            let (peak, result) =
                counted::peak(|| solve_flexibility(&problem, &settings, None, monitor));
            // A method that is not for this law refuses it.
            let Ok(solution) = result else { continue };
            let what = format!(
                "flexibility, {}D, {} pairs, {name}, {method:?}, {:?}",
                chain.dim, chain.pairs, solution.status
            );
            shares.note(&what, n, peak, memory_flexibility(&problem));
        }
    }
}

/// The matrix of the chain as a sparse `W` that is cut behind a third of the pairs, beside the host's arrays.
fn sparse_flexibility(chain: &Chain, shares: &mut Shares) {
    let (n, cut) = (chain.n(), chain.dim * (chain.pairs / 3));
    let (mut col_start, mut row, mut values) = (vec![0_i64], vec![], vec![]);
    for j in 0..n {
        for i in (j..n).filter(|i| (*i < cut) == (j < cut)) {
            if chain.k[i + n * j] != 0.0 {
                row.push(i as i64);
                values.push(chain.k[i + n * j]);
            }
        }
        col_start.push(row.len() as i64);
    }
    for (name, law) in chain.laws() {
        let data = FlexibilityData {
            dim: chain.dim,
            pairs: chain.pairs,
            flexibility: SparseMatrix {
                size: n,
                col_start: Indices::Wide(&col_start),
                row: Indices::Wide(&row),
                values: &values,
                index_base: 0,
                triangle: Triangle::Lower,
            },
            free: &chain.load,
            gap: &chain.gap,
            law,
            reference_slip: None,
        };
        let mut estimate = 0;
        let (peak, _) = counted::peak(|| {
            let problem = FlexibilityProblem::from_sparse(data).expect("a valid problem");
            estimate = memory_flexibility(&problem);
            let settings = Settings { max_iterations: 3000, ..Settings::default() };
            let monitor = &mut Monitor::new(&settings, None);
            solve_flexibility(&problem, &settings, None, monitor).expect("valid settings")
        });
        let what = format!("sparse flexibility, {}D, {} pairs, {name}", chain.dim, chain.pairs);
        shares.note(&what, n, peak, estimate);
    }
}

/// Load cases that share what one has worked out, a few: what they hold at a time is that of one, and their
/// solutions.
fn series(chain: &Chain, shares: &mut Shares) {
    let n = chain.n();
    let Ok(model) = Model::condensed(chain.dim, chain.pairs, &chain.k, n) else { return };
    let loads: Vec<Vec<f64>> = [1.0, 0.8, -1.0, 1.2]
        .iter()
        .map(|by| chain.load.iter().map(|load| by * load).collect())
        .collect();
    for (search, proof) in [(Search::Off, false), (Search::Others, false), (Search::Off, true)] {
        let settings = Settings { search, proof, max_iterations: 3000, ..Settings::default() };
        let case = |load| LoadCase {
            load,
            prescribed: None,
            gap: &chain.gap,
            law: FrictionLaw::Coulomb(&chain.mu),
            reference_slip: None,
        };
        let cases: Vec<_> = loads.iter().map(|load| case(load)).collect();
        let before = counted::held();
        let mut series = model.series();
        let (peak, found) = counted::peak(|| {
            series.solve_cases(&cases, &settings, Starts::Previous(None), None).len()
        });
        assert_eq!(found, cases.len());
        let what = format!("{}D, {} pairs, a series, {search:?}", chain.dim, chain.pairs);
        shares.note(&what, n, peak, model.memory());
        // The header allows 32 N N bytes for what a series keeps; beside them stand some vectors of N numbers.
        let kept = counted::held().saturating_sub(before);
        assert!(kept <= 32 * n * n + 800 * n, "{what}: {kept} bytes are kept");
        println!("{what}: {:.2} K are kept", kept as f64 / (8 * n * n) as f64);
    }
}
