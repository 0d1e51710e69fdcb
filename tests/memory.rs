//! How much memory a solution takes beside the stiffness matrix `K` that it is given.
//!
//! The bar on the plane (paper, section 4.1) with friction, its elements refined with the contact line.
//! Lemke's method works on a tableau of three unknowns for each pair where `K` has two: 2.25 times
//! `K`, and nothing else may be of that size.

#[allow(dead_code)] // Every user uses a part.
#[path = "common/mesh.rs"]
mod mesh;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use mesh::{Mesh, Pairs, steps};
use signorini::{FrictionLaw, LoadCase, Method, Model, Monitor, Settings, Status};

/// Most bytes of a solution, as a multiple of those of `K`.
const MOST: f64 = 3.0;

const SIZE: f64 = 40.0;

/// A tolerance below the rounding of the problem.
const UNATTAINABLE: f64 = 1e-15;

/// Counts the bytes that are allocated, and the most that were.
struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn grown(by: usize) {
    PEAK.fetch_max(NOW.fetch_add(by, Relaxed) + by, Relaxed);
}

// SAFETY: all calls go to the system's allocator with the arguments that came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        grown(layout.size());
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        grown(layout.size());
        // SAFETY: the caller's.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // Both are there while one is copied to the other.
        grown(size);
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's.
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

struct Bar {
    model: Model,
    load: Vec<f64>,
}

impl Bar {
    /// Half of the bar, with square elements along the contact line and rows that grow away from it.
    fn new(columns: usize) -> Bar {
        let mut heights = vec![SIZE / columns as f64];
        while heights.iter().sum::<f64>() < SIZE {
            heights.push(1.5 * heights[heights.len() - 1]);
        }
        let stretch = SIZE / heights.iter().sum::<f64>();
        let mut lines = vec![0.0];
        for height in &heights {
            lines.push(lines[lines.len() - 1] + stretch * height);
        }
        let mut mesh = Mesh::default();
        let block = mesh.block(&steps(0.0, SIZE, columns), &lines, (13000.0, 0.2));
        let mut load = vec![0.0; mesh.size()];
        mesh.traction(&block.row(block.rows), [0.0, -5.0], &mut load);
        mesh.traction(&block.column(0), [10.0, 0.0], &mut load);
        let fixed: Vec<usize> = block.column(columns).iter().map(|node| 2 * node).collect();
        let pairs = Pairs::on_obstacle(&block.row(0), [0.0, -1.0]);
        Bar { model: mesh.stiffness().model(&fixed, &pairs).expect("a valid model"), load }
    }

    /// Peak of what a solution allocates, as a multiple of `K`, and its iterations.
    ///
    /// With [`UNATTAINABLE`] rounding keeps all attempts from it, so that Lemke's method goes through
    /// all that it has, a tableau that is refactorised at every check among them.
    fn peak(&self, method: Method, (mu, gap): (f64, &[f64]), tolerance: f64) -> (f64, u64) {
        let mu = vec![mu; self.model.pairs()];
        let case = LoadCase {
            load: &self.load,
            prescribed: None,
            gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        let settings = Settings { method, tolerance, ..Settings::default() };
        let before = NOW.load(Relaxed);
        PEAK.store(before, Relaxed);
        let monitor = &mut Monitor::new(&settings, None);
        let solution = self.model.solve(&case, &settings, None, monitor).expect("a valid case");
        let peak = PEAK.load(Relaxed) - before;
        let solved = if tolerance == UNATTAINABLE { Status::Stalled } else { Status::Solved };
        assert_eq!(solution.status, solved, "{}", solution.message);
        let matrix = size_of_val(self.model.stiffness());
        (peak as f64 / matrix as f64, solution.iterations)
    }
}

/// One test, since the counts are those of the whole program.
#[test]
fn a_solution_takes_at_most_three_times_the_memory_of_its_matrix() {
    let check = |what: &str, (peak, iterations): (f64, u64)| {
        println!("{what}: {peak:.2} K, {iterations} iterations");
        assert!(peak <= MOST, "{what}: {peak} times K");
    };
    for pairs in [513, 1025] {
        let bar = Bar::new(pairs - 1);
        let gap = vec![0.0; pairs];
        // A component without contact force is condensed.
        let mut without = gap.clone();
        without[pairs / 3] = f64::INFINITY;
        for mu in [0.1, 1.0] {
            let what = format!("{pairs} pairs, mu {mu}");
            check(&format!("{what}, Lemke"), bar.peak(Method::Lemke, (mu, &gap), 1e-10));
            check(&format!("{what}, auto"), bar.peak(Method::Auto, (mu, &gap), 1e-10));
            let peak = bar.peak(Method::Lemke, (mu, &without), 1e-10);
            check(&format!("{what}, one of them without an obstacle, Lemke"), peak);
        }
    }
    let peak = Bar::new(512).peak(Method::Lemke, (0.1, &[0.0; 513]), UNATTAINABLE);
    check("513 pairs, mu 0.1, Lemke with all refactorisations", peak);
}
