//! Faults of a whole sparse matrix, its supports and its pairs are told by value, place and
//! remedy.

use crate::common::stack::{Stack, close, solved};
use signorini::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};
use signorini::{Argument, Error, FrictionLaw, LoadCase, Model, Monitor, Settings, Status};

/// Three nodes in the plane, springs between components, one pair: node 0 on node 1, normal -y.
#[derive(Clone)]
struct Input {
    size: usize,
    col_start: Vec<i64>,
    row: Vec<i64>,
    values: Vec<f64>,
    index_base: i64,
    triangle: Triangle,
    /// Hands over `col_start` and `row` as integers of 4 bytes.
    narrow: bool,
    fixed: Vec<usize>,
    slaves: Vec<usize>,
    master_start: Vec<usize>,
    masters: Vec<usize>,
    weights: Vec<f64>,
    normals: Vec<f64>,
    tangents: Option<Vec<f64>>,
}

impl Input {
    fn new() -> Input {
        Input {
            size: 6,
            col_start: vec![0, 2, 3, 4, 5, 7, 8],
            row: vec![0, 1, 1, 2, 3, 4, 5, 5],
            values: vec![3.0, 1.0, 3.0, 3.0, 3.0, 3.0, -1.0, 3.0],
            index_base: 0,
            triangle: Triangle::Lower,
            narrow: false,
            fixed: vec![],
            slaves: vec![0, 1],
            master_start: vec![0, 1],
            masters: vec![2, 3],
            weights: vec![1.0],
            normals: vec![0.0, -1.0],
            tangents: None,
        }
    }

    fn with(change: impl FnOnce(&mut Input)) -> Input {
        let mut input = Input::new();
        change(&mut input);
        input
    }

    fn model(&self) -> Result<Model, Error> {
        let narrow = |values: &[i64]| values.iter().map(|&v| v as i32).collect::<Vec<i32>>();
        let (narrow_start, narrow_row) = (narrow(&self.col_start), narrow(&self.row));
        let (col_start, row) = if self.narrow {
            (Indices::Narrow(&narrow_start), Indices::Narrow(&narrow_row))
        } else {
            (Indices::Wide(&self.col_start), Indices::Wide(&self.row))
        };
        let matrix = SparseMatrix {
            size: self.size,
            col_start,
            row,
            values: &self.values,
            index_base: self.index_base,
            triangle: self.triangle,
        };
        let pairs = ContactPairs {
            dim: 2,
            count: self.slaves.len() / 2,
            slaves: &self.slaves,
            master_start: &self.master_start,
            masters: &self.masters,
            weights: &self.weights,
            normals: &self.normals,
            tangents: self.tangents.as_deref(),
            ..ContactPairs::default()
        };
        Model::sparse(&matrix, &self.fixed, &pairs)
    }

    /// All entries in the place of one triangle.
    fn full(&mut self) {
        self.triangle = Triangle::Full;
        self.col_start = vec![0, 2, 4, 5, 6, 8, 10];
        self.row = vec![0, 1, 0, 1, 2, 3, 4, 5, 4, 5];
        self.values = vec![3.0, 1.0, 1.0, 3.0, 3.0, 3.0, 3.0, -1.0, -1.0, 3.0];
    }
}

/// The pair is refused with a sentence that has all `parts`.
fn refused(argument: Argument, parts: &[&str], change: impl FnOnce(&mut Input)) {
    match Input::with(change).model() {
        Ok(_) => panic!("{parts:?}: accepted"),
        Err(Error::Invalid { argument: named, message }) => {
            assert_eq!(named, argument, "{message}");
            for part in parts {
                assert!(message.contains(part), "'{part}' is not in '{message}'");
            }
        }
        Err(error) => panic!("{parts:?}: {error}"),
    }
}

fn matrix(message: &str, change: impl FnOnce(&mut Input)) {
    refused(Argument::Matrix, &[message], change);
}

fn pairs(message: &str, change: impl FnOnce(&mut Input)) {
    refused(Argument::Pairs, &[message], change);
}

#[test]
fn the_input_is_valid() {
    assert!(Input::new().model().is_ok());
    assert!(Input::with(Input::full).model().is_ok());
}

#[test]
fn a_wrong_index_base_is_named() {
    let one = |values: &mut Vec<i64>| values.iter_mut().for_each(|v| *v += 1);
    matrix(
        "col_start[0] is 1, but index_base is 0: set index_base to 1, or count from 0",
        |input| {
            one(&mut input.col_start);
            one(&mut input.row);
        },
    );
    matrix(
        "col_start[0] is 0, but index_base is 1: set index_base to 0, or count from 1",
        |input| input.index_base = 1,
    );
    matrix("col_start[0] is 2, it must be index_base, which is 0", |input| input.col_start[0] = 2);
    matrix("but nnz is 8: size, here 0, must be the number of degrees of freedom", |input| {
        input.size = 0;
        input.col_start = vec![0];
    });
    matrix("index_base is 2, it must be 0 or 1", |input| input.index_base = 2);
    matrix("index_base is -1", |input| input.index_base = -1);
    // Rows alone.
    matrix("row[6], in column 4, is 6: size is 6 and index_base 0", |input| one(&mut input.row));
}

/// Integers of one width read as the other, on a little-endian machine.
#[test]
fn a_wrong_width_is_named() {
    let halves = |values: &[i64]| -> Vec<i64> {
        values.chunks(2).map(|two| two[0] + (two.get(1).unwrap_or(&7) << 32)).collect()
    };
    let parts: &[&str] = &["col_start[0] is 8589934592", "4 bytes", "index_bytes 8?"];
    refused(Argument::Matrix, parts, |input| {
        let mut read = halves(&input.col_start);
        read.resize(7, 1 << 40);
        input.col_start = read;
    });
    matrix(
        "col_start[1] is 4294967296: are these integers of 4 bytes, and index_bytes 8?",
        |input| input.col_start[1] = 1 << 32,
    );
    matrix(
        "row[0], in column 0, is 4294967296: are these integers of 4 bytes, and index_bytes 8?",
        |input| input.row[0] = 1 << 32,
    );
    for base in [0, 1] {
        let parts: &[&str] = &["is 0", "are these integers of 8 bytes, and index_bytes 4?"];
        refused(Argument::Matrix, parts, |input| {
            input.narrow = true;
            input.index_base = base;
            let shifted = input.col_start.iter().flat_map(|start| [start + base, 0]);
            input.col_start = shifted.take(7).collect();
        });
    }
}

#[test]
fn a_wrong_start_of_a_column_is_named_by_its_value() {
    matrix("col_start[3] is 2, less than col_start[2], which is 3", |input| input.col_start[3] = 2);
    matrix("col_start[2] is -1, less than", |input| input.col_start[2] = -1);
    matrix("col_start[2] is 9, beyond the stored entries: nnz is 8", |input| {
        input.col_start[2] = 9;
    });
    // The size is the number of nodes; an entry too few.
    let parts: &[&str] =
        &["the columns hold 4 entries (col_start[3] is 4", "nnz is 8", "size, here 3"];
    refused(Argument::Matrix, parts, |input| {
        input.size = 3;
        input.col_start.truncate(4);
    });
    let parts: &[&str] = &["the columns hold 8 entries (col_start[6] is 8", "nnz is 7", "here 6"];
    refused(Argument::Matrix, parts, |input| {
        input.row.pop();
        input.values.pop();
    });
    let parts: &[&str] = &["hold 8 entries (col_start[6] is 9, index_base is 1)", "nnz is 7"];
    refused(Argument::Matrix, parts, |input| {
        input.index_base = 1;
        input.col_start.iter_mut().for_each(|start| *start += 1);
        input.row.pop();
        input.values.pop();
    });
    matrix("col_start has 4 entries, it must have size + 1, and size is 6", |input| {
        input.col_start.truncate(4);
    });
    matrix("row has 7 entries, but there are 8 values", |input| {
        input.row.pop();
    });
}

#[test]
fn wrong_rows_are_named() {
    matrix("column 4: row 4 is listed twice, in row[5] and row[6]: sum the values", |input| {
        input.row[6] = 4;
    });
    matrix(
        "column 4: row 4 stands after row 5, in row[6]: row indices must be strictly",
        |input| {
            input.row[5] = 5;
            input.row[6] = 4;
        },
    );
    matrix("row[6], in column 4, is 6", |input| input.row[6] = 6);
    matrix("row[6], in column 4, is -1", |input| input.row[6] = -1);
    matrix("K[0,1] is not in the triangle", |input| input.row[2] = 0);
    matrix("K[0,0] is 1e308: sums of such entries overflow; choose units", |input| {
        input.values[0] = 1e308;
    });
}

/// One triangle in single precision: the tolerance and the remedies are named. Larger differences
/// have another cause, which no average heals.
#[test]
fn single_precision_is_recognised() {
    let third = 1.0 / 3.0;
    let remedy = "hand over one triangle (SIGNORINI_TRIANGLE_LOWER), or average the two";
    let parts: &[&str] = &["K is not symmetric: K[1,0] is 0.3", "1e-9 is allowed", remedy];
    refused(Argument::Matrix, parts, |input| {
        input.full();
        input.values[1] = third;
        input.values[2] = f64::from(third as f32);
    });
    matrix("they differ by 3e-9 of the diagonal, 1e-9 is allowed: hand over one", |input| {
        input.full();
        input.values[1] = 1.0 + 9e-9;
    });
    let Err(error) = Input::with(|input| {
        input.full();
        input.values[1] = 1.001;
    })
    .model() else {
        panic!("accepted")
    };
    assert!(error.to_string().ends_with("by 3e-4 of the diagonal, 1e-9 is allowed"), "{error}");

    // The host's condensed matrix.
    let rounded = [3.0, third, f64::from(third as f32), 3.0];
    let Err(error) = Model::condensed(2, 1, &rounded, 2) else { panic!("accepted") };
    for part in [
        "K is not symmetric: K[1,0] is 0.3",
        "1e-9 is allowed: average K[1,0] and K[0,1], or compute both in double precision",
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
}

/// A degree of freedom without stiffness, as a rotation that no element uses: it may be fixed. If it
/// is not, that is the remedy. A zero on the diagonal beside an entry is another matter.
#[test]
fn a_degree_of_freedom_without_stiffness_may_be_fixed() {
    let stored_zero = |input: &mut Input| {
        input.values[6] = 0.0;
        input.values[7] = 0.0;
    };
    let missing = |input: &mut Input| {
        input.row.truncate(6);
        input.values.truncate(6);
        input.col_start[5] = 6;
        input.col_start[6] = 6;
    };
    let reference = Input::with(|input| {
        input.values[6] = 0.0;
        input.fixed = vec![5];
    })
    .model()
    .unwrap();
    for change in [&stored_zero as &dyn Fn(&mut Input), &missing] {
        matrix(
            "nothing resists degree of freedom 5: list it in fixed, or give it stiffness",
            change,
        );
        let model = Input::with(|input| {
            change(input);
            input.fixed = vec![5];
        })
        .model()
        .unwrap();
        assert_eq!(model.stiffness(), reference.stiffness());
        // Its value moves nothing else: (a, b) of the master minimises the energy with the slave at
        // (a, b - 1/2), 6 a + b = 1/2 and a + 6 b = 3/2.
        let u = model.recover(None, Some(&[2.0]), &[0.5, 0.0]).unwrap();
        let exact = [1.5, -9.0, 1.5, 8.5, 0.0, 70.0].map(|u| u / 35.0);
        close(&u, &exact, 1e-15, "u");
    }
    matrix("K[5,5] is 0, it must be positive: K[5,4] is -1", |input| {
        input.values[7] = 0.0;
        input.fixed = vec![5];
    });
    matrix("K[5,5] is missing, it must be positive: K[5,4] is -1", |input| {
        input.row.pop();
        input.values.pop();
        input.col_start[6] = 7;
        input.fixed = vec![5];
    });
    matrix("K[5,5] is -3, it must be positive", |input| {
        input.values[7] = -3.0;
        input.fixed = vec![5];
    });
}

/// Everything at the pair is fixed and the frame inclined, with and without masters: the pair rests.
#[test]
fn a_pair_whose_nodes_are_fixed_rests() {
    for masters in [true, false] {
        let input = Input::with(|input| {
            input.normals = vec![-1.0, -1.0];
            input.fixed = vec![0, 1, 2, 3];
            if !masters {
                input.master_start = vec![0, 0];
                input.masters.clear();
                input.weights.clear();
            }
        });
        let model = input.model().expect("a model");
        for gap in [0.0, 0.5] {
            let case = LoadCase {
                load: &[3.0, -1.0, 2.0, 5.0, 1.0, 1.0],
                prescribed: None,
                gap: &[gap],
                law: FrictionLaw::Coulomb(&[0.3]),
                reference_slip: None,
            };
            let settings = Settings::default();
            let monitor = &mut Monitor::new(&settings, None);
            let found = model.solve(&case, &settings, None, monitor).expect("a valid case");
            assert_eq!(found.status, Status::Solved);
            assert_eq!((&found.d, &found.certificate.force), (&vec![0.0; 2], &vec![0.0; 2]));
        }
    }
}

#[test]
fn pairs_that_nothing_can_move_are_named_with_the_remedy() {
    let named = "pair 0: its weights cancel, so that no node moves it: leave the pair out";
    pairs(named, |input| input.masters = vec![0, 1]);
    refused(Argument::Fixed, &["fixed: degree of freedom 5 is listed twice"], |input| {
        input.fixed = vec![5, 5];
    });
    refused(Argument::Fixed, &["fixed: there is no degree of freedom 6"], |input| {
        input.fixed = vec![6];
    });
}

#[test]
fn what_needs_a_stiffness_of_dependent_pairs_is_refused_by_their_names() {
    // The slave is fixed along x, and the frame is inclined: one motion for two components.
    let model = Input::with(|input| {
        input.normals = vec![-1.0, -1.0];
        input.fixed = vec![0, 2];
    })
    .model()
    .unwrap();
    assert_eq!(model.dependent_pairs(), [0]);
    assert!(model.stiffness().is_empty());
    let named =
        "the rows of pair 0 follow from those of other pairs or from supports: no stiffness";
    match model.condensed_load(&[0.0; 6], None) {
        Err(Error::Invalid { argument: Argument::Matrix, message }) => {
            assert!(message.contains(named), "{message}");
        }
        other => panic!("{other:?}"),
    }
}

/// A plane of symmetry x = 0: the slave is held along x with its masters. Weights that an inverse map
/// leaves (1e-17), on masters that are free, and normals of seven digits are what FE codes hand over.
#[test]
fn rounding_of_weights_and_normals_is_accepted() {
    let exact = Input::with(|input| {
        input.fixed = vec![0, 2];
        input.tangents = Some(vec![1.0, 0.0]);
    })
    .model()
    .unwrap();
    for weight in [1e-17, -3e-16, 1e-13] {
        let model = Input::with(|input| {
            input.fixed = vec![0, 2];
            input.tangents = Some(vec![1.0, 0.0]);
            input.master_start = vec![0, 2];
            input.masters = vec![2, 3, 4, 5];
            input.weights = vec![1.0, weight];
        })
        .model()
        .unwrap_or_else(|error| panic!("weight {weight}: {error}"));
        close(model.stiffness(), exact.stiffness(), 1e-12, "K_rel");
    }
    for inclination in [1e-7, -1.5e-6, 4e-6] {
        let model = Input::with(|input| {
            input.fixed = vec![0, 2];
            input.normals = vec![inclination, -1.0];
        })
        .model()
        .unwrap_or_else(|error| panic!("inclination {inclination}: {error}"));
        assert_eq!(model.stiffness(), exact.stiffness());
        assert_eq!(model.frames(), Some(&[0.0, -1.0, 1.0, 0.0][..]));
    }
}

#[test]
fn wrong_masters_are_named() {
    pairs("pair 0: its weights sum to 0.5, not to 1", |input| input.weights[0] = 0.5);
    pairs("pair 0: its weights sum to NaN", |input| input.weights[0] = f64::NAN);
    pairs("pair 0: its slave has degree of freedom 0 twice", |input| input.slaves[1] = 0);
    pairs("master_start has 3 entries, it must have 2", |input| input.master_start.push(1));
    pairs("pair 0: its masters begin at 1", |input| input.master_start[0] = 1);
    pairs("the pairs have 2 masters, there are 1 weights", |input| input.master_start[1] = 2);
}

/// No equilibrium: which degrees of freedom move, which pair in which direction, how much drives it,
/// and what to look at. The upper block is pulled off by 3 at 1: the resultant is 3.
#[test]
fn a_motion_of_escape_is_told_in_words() {
    let stack = Stack::new([2, 2], [2000.0, 500.0]);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    let load = stack.load(-1.0, 0.0);
    let case = LoadCase {
        load: &load,
        prescribed: None,
        gap: &[0.0; 3],
        law: FrictionLaw::Coulomb(&[0.3; 3]),
        reference_slip: None,
    };
    let settings = Settings::default();
    let monitor = &mut Monitor::new(&settings, None);
    let solution = model.solve(&case, &settings, None, monitor).unwrap();
    assert_eq!(solution.status, Status::NoEquilibrium);
    let upper: Vec<usize> = stack.upper.nodes().collect();
    // Upwards.
    let (first, last) = (2 * upper[0] + 1, 2 * upper[upper.len() - 1] + 1);
    for part in [
        "no equilibrium exists",
        &format!("of the degrees of freedom {first} to {last}, most of all degree of freedom"),
        "the slave of pair",
        "(0.000, 1.000) relative to what it faces",
        "the resultant of the loads along it is 3.000e0",
        "are a support, friction, or a pair missing, is a gap infinite, or is a normal, a load or the sign of gap turned round?",
    ] {
        assert!(solution.message.contains(part), "'{part}': {}", solution.message);
    }
}

/// Frames are those of the normals, and the condensed load is that of the equation that is solved.
#[test]
fn frames_and_condensed_loads_are_handed_out() {
    let stack = Stack::new([2, 2], [2000.0, 500.0]);
    let model = stack.mesh.stiffness().model(&stack.bottom(), &stack.pairs()).unwrap();
    assert_eq!(model.frames(), Some(&[0.0, -1.0, 1.0, 0.0].repeat(3)[..]));
    let load = stack.load(7.0, 1.0);
    let solution = solved(&model, &load, 0.3);
    let relative = model.condensed_load(&load, None).unwrap();
    let carried = crate::common::dense::product(model.stiffness(), &solution.d);
    let force = crate::common::dense::difference(&carried, &relative);
    close(&force, &solution.certificate.force, 1e-12, "F = K d - f");
    assert!(Model::condensed(2, 1, &[2.0, 0.0, 0.0, 2.0], 2).unwrap().frames().is_none());
    match model.condensed_load(&load[1..], None) {
        Err(Error::Invalid { argument, .. }) => assert_eq!(argument, Argument::Load),
        other => panic!("{other:?}"),
    }
}

/// Nothing at all: no degree of freedom, no pair.
#[test]
fn nothing_is_a_model() {
    let model = Input::with(|input| {
        let nothing = Input {
            size: 0,
            col_start: vec![0],
            row: vec![],
            values: vec![],
            slaves: vec![],
            master_start: vec![0],
            masters: vec![],
            weights: vec![],
            normals: vec![],
            ..Input::new()
        };
        *input = nothing;
    })
    .model()
    .unwrap();
    assert_eq!(model.recover(Some(&[]), None, &[]).unwrap(), [0.0; 0]);
    // A matrix without pairs, all of it fixed.
    let model = Input::with(|input| {
        input.fixed = (0..6).collect();
        input.slaves.clear();
        input.master_start = vec![0];
        input.masters.clear();
        input.weights.clear();
        input.normals.clear();
    })
    .model()
    .unwrap();
    let u = model.recover(None, Some(&[1.0; 6]), &[]).unwrap();
    assert_eq!(u, [1.0; 6]);
}
