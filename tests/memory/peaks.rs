//! How much memory a solution takes beside the stiffness matrix `K` that it is given.
//!
//! The bar on the plane (paper, section 4.1) with friction, its elements refined with the contact line.
//! Lemke's method works on a tableau of three unknowns for each pair where `K` has two: 2.25 times
//! `K`, and nothing else may be of that size. In space, blocks of bricks: what is eliminated, its Schur
//! complement and a system of what is left make at most twice `K`.

use crate::common::blocks::{LOADINGS, block, loaded};
use crate::common::brick::Support;
use crate::counted;
use crate::graded_bar::GradedBar;
use signorini::{FrictionLaw, LoadCase, Method, Monitor, Settings, Status};

/// Most bytes of a solution, as a multiple of those of `K`.
const MOST: f64 = 3.0;

/// A tolerance below the rounding of the problem: only refinement in twice the precision attains it.
const BELOW_ROUNDING: f64 = 1e-15;

/// Peak of what a solution allocates, as a multiple of `K`, and its iterations.
///
/// With [`BELOW_ROUNDING`] rounding keeps all attempts from it, so that Lemke's method goes through all
/// that it has, a tableau that is refactorised at every check among them; its last candidate is refined.
fn peak(bar: &GradedBar, method: Method, (mu, gap): (f64, &[f64]), tolerance: f64) -> (f64, u64) {
    let mu = vec![mu; bar.model.pairs()];
    let case = LoadCase {
        load: &bar.load,
        prescribed: None,
        gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    };
    let settings = Settings { method, tolerance, ..Settings::default() };
    let monitor = &mut Monitor::new(&settings, None);
    let (peak, solution) = counted::peak(|| bar.model.solve(&case, &settings, None, monitor));
    let solution = solution.expect("a valid case");
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    let matrix = size_of_val(bar.model.stiffness());
    (peak as f64 / matrix as f64, solution.iterations)
}

/// [`peak`] of blocks in space under all loadings.
fn peak_in_space(method: Method, mu: f64) -> (f64, u64) {
    let brick = block(15, Support::Clamped);
    let model = brick.model();
    let mut worst = (0.0_f64, 0);
    for loading in LOADINGS {
        let case = loaded(&brick, &model, loading, mu);
        let (peak, solution) = counted::peak(|| case.solve_by(method));
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let peak = peak as f64 / size_of_val(&case.k[..]) as f64;
        worst = (worst.0.max(peak), worst.1.max(solution.iterations));
    }
    worst
}

/// One test, since the counts are those of the whole program.
#[test]
fn a_solution_takes_at_most_three_times_the_memory_of_its_matrix() {
    let _alone = counted::alone();
    let check = |what: &str, (peak, iterations): (f64, u64)| {
        println!("{what}: {peak:.2} K, {iterations} iterations");
        assert!(peak <= MOST, "{what}: {peak} times K");
    };
    for pairs in [513, 1025] {
        let bar = GradedBar::new(pairs - 1);
        let gap = vec![0.0; pairs];
        // A component without contact force is condensed.
        let mut without = gap.clone();
        without[pairs / 3] = f64::INFINITY;
        for mu in [0.1, 1.0] {
            let what = format!("{pairs} pairs, mu {mu}");
            check(&format!("{what}, Lemke"), peak(&bar, Method::Lemke, (mu, &gap), 1e-10));
            check(&format!("{what}, auto"), peak(&bar, Method::Auto, (mu, &gap), 1e-10));
            let peak = peak(&bar, Method::Lemke, (mu, &without), 1e-10);
            check(&format!("{what}, one of them without an obstacle, Lemke"), peak);
        }
    }
    for mu in [0.1, 1.0, 3.0] {
        for method in [Method::Auto, Method::Path] {
            check(&format!("225 pairs in space, mu {mu}, {method:?}"), peak_in_space(method, mu));
        }
    }
    let peak = peak(&GradedBar::new(512), Method::Lemke, (0.1, &[0.0; 513]), BELOW_ROUNDING);
    check("513 pairs, mu 0.1, Lemke with all refactorisations", peak);
}
