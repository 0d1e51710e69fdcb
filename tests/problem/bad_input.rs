//! Bad input is refused, with the argument and the entry named.

use signorini::{
    Argument, ContactData, ContactProblem, Error, FrictionLaw, Lcp, Method, Monitor, Settings,
    solve, solve_lcp,
};

/// Two pairs in 2D that nothing is wrong with.
const K: [f64; 16] = [
    4.0, 1.0, 0.5, 0.0, //
    1.0, 3.0, 0.0, 0.5, //
    0.5, 0.0, 4.0, -1.0, //
    0.0, 0.5, -1.0, 3.0,
];

const GOOD: ContactData<'static> = ContactData {
    dim: 2,
    pairs: 2,
    stiffness: &K,
    ld: 4,
    load: &[1.0, 0.5, 1.0, -0.5],
    gap: &[0.0, 0.1],
    law: FrictionLaw::Coulomb(&[0.3, 0.3]),
    reference_slip: Some(&[0.0, 0.1]),
};

fn expect(error: Option<Error>, argument: Argument, parts: &[&str]) {
    match error {
        Some(Error::Invalid { argument: named, message }) => {
            assert_eq!(named, argument, "{message}");
            for part in parts {
                assert!(message.contains(part), "'{message}' does not say '{part}'");
            }
        }
        other => panic!("expected {argument:?} {parts:?}, got {other:?}"),
    }
}

fn refuses(data: ContactData<'_>, argument: Argument, parts: &[&str]) {
    expect(ContactProblem::new(data).err(), argument, parts);
}

/// `K` with some entries replaced.
fn k_with(entries: &[(usize, usize, f64)]) -> Vec<f64> {
    let mut k = K.to_vec();
    for &(i, j, value) in entries {
        k[i + 4 * j] = value;
    }
    k
}

/// The sentence on wrong data.
fn said(data: ContactData<'_>) -> String {
    ContactProblem::new(data).expect_err("it is wrong").message().to_string()
}

fn of_law(law: FrictionLaw<'_>) -> String {
    said(ContactData { law, ..GOOD })
}

/// Numbers with an exponent where decimals would be many, so that the reason after them is told.
#[test]
fn numbers_in_sentences_are_short() {
    for (mu, told) in [(-0.5, "-0.5"), (-1e300, "-1e300"), (-3e-310, "-3e-310"), (-1e15, "-1e15")] {
        let message = of_law(FrictionLaw::Coulomb(&[mu, 0.3]));
        assert_eq!(message, format!("mu[0] is {told}, it must not be negative"));
    }
    let stiffness = &k_with(&[(0, 0, -1e300)]);
    let message = said(ContactData { stiffness, ..GOOD });
    assert_eq!(message, "K[0,0] is -1e300, it must be positive");
    assert_eq!(
        of_law(FrictionLaw::Cohesive(&[0.5, 1e-320, 1e200].repeat(2))),
        "friction[1] (b of pair 0) is 1e-320, it must be at least mu a = 0.5 * 1e200 = 5e199: friction \
         would be negative under the tension a"
    );
    assert_eq!(
        of_law(FrictionLaw::ByPair(&[1.0, 0.3, 0.2, 0.0].repeat(2))),
        "friction[2] (p2 of pair 0) is 0.2, it must be 0: the pair has Coulomb's law: mu, and \
         no more parameters"
    );
    let settings = Settings { time_limit: -1e-310, ..Settings::default() };
    assert_eq!(
        settings.validate().unwrap_err().message().to_string(),
        "settings: time_limit is -1e-310, it must be 0 (none) or a number of seconds"
    );
}

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

#[test]
fn refuses_dimensions_that_are_not() {
    assert!(ContactProblem::new(GOOD).is_ok());
    for dim in [0, 1, 4, usize::MAX] {
        refuses(ContactData { dim, ..GOOD }, Argument::Dimension, &[&dim.to_string()]);
    }
    for pairs in [usize::MAX, usize::MAX / 2, 1 << 40] {
        refuses(ContactData { pairs, ..GOOD }, Argument::Size, &[&pairs.to_string()]);
    }
}

#[test]
fn refuses_leading_dimensions_too_small_or_too_large() {
    for ld in [0, 3] {
        refuses(ContactData { ld, ..GOOD }, Argument::LeadingDimension, &[&ld.to_string(), "4"]);
    }
    refuses(ContactData { ld: usize::MAX, ..GOOD }, Argument::LeadingDimension, &[]);
    refuses(ContactData { ld: 5, ..GOOD }, Argument::Matrix, &["K", "16", "19"]);
    refuses(ContactData { ld: 0, pairs: 0, ..GOOD }, Argument::LeadingDimension, &["0", "1"]);
}

#[test]
fn refuses_arrays_that_are_too_short() {
    refuses(ContactData { stiffness: &K[..15], ..GOOD }, Argument::Matrix, &["K", "15", "16"]);
    refuses(ContactData { load: &[1.0; 3], ..GOOD }, Argument::Load, &["f", "3", "4"]);
    refuses(ContactData { gap: &[0.0], ..GOOD }, Argument::Gap, &["gap", "1", "2"]);
    for friction in [FrictionLaw::Coulomb(&[0.1]), FrictionLaw::Tresca(&[0.1])] {
        refuses(ContactData { law: friction, ..GOOD }, Argument::Law, &["1", "2"]);
    }
    let reference_slip = Some(&[0.0][..]);
    refuses(ContactData { reference_slip, ..GOOD }, Argument::ReferenceSlip, &["slip", "1", "2"]);
}

#[test]
fn refuses_numbers_that_are_not_finite() {
    for bad in NOT_FINITE {
        let (k, load) = (k_with(&[(3, 2, bad)]), [1.0, 1.0, bad, 1.0]);
        refuses(ContactData { stiffness: &k, ..GOOD }, Argument::Matrix, &["K[3,2]"]);
        refuses(ContactData { load: &load, ..GOOD }, Argument::Load, &["f[2]"]);
        let pair = [0.0, bad];
        let data = ContactData { reference_slip: Some(&pair), ..GOOD };
        refuses(data, Argument::ReferenceSlip, &["slip0[1]"]);
        let data = ContactData { law: FrictionLaw::Coulomb(&pair), ..GOOD };
        refuses(data, Argument::Law, &["mu[1]"]);
        let data = ContactData { law: FrictionLaw::Tresca(&pair), ..GOOD };
        refuses(data, Argument::Law, &["g[1]"]);
        if bad != f64::INFINITY {
            refuses(ContactData { gap: &pair, ..GOOD }, Argument::Gap, &["gap[1]"]);
        }
    }
    assert!(ContactProblem::new(ContactData { gap: &[0.0, f64::INFINITY], ..GOOD }).is_ok());
}

#[test]
fn refuses_negative_friction() {
    let friction = FrictionLaw::Coulomb(&[0.3, -0.25]);
    refuses(ContactData { law: friction, ..GOOD }, Argument::Law, &["mu[1]", "-0.25"]);
    let friction = FrictionLaw::Tresca(&[-1e-300, 0.0]);
    refuses(ContactData { law: friction, ..GOOD }, Argument::Law, &["g[0]"]);
    let friction = FrictionLaw::Coulomb(&[-0.0, 0.0]);
    assert!(ContactProblem::new(ContactData { law: friction, ..GOOD }).is_ok());
}

#[test]
fn refuses_wrong_parameters_of_a_law_that_has_three() {
    let cohesive = |numbers: &[f64; 6], parts: &[&str]| {
        refuses(ContactData { law: FrictionLaw::Cohesive(numbers), ..GOOD }, Argument::Law, parts);
    };
    cohesive(&[0.3, 1.0, 1.0, 0.3, 0.25, 1.0], &["friction[4]", "b of pair 1", "0.25", "0.3"]);
    cohesive(&[0.3, -1.0, 0.0, 0.3, 1.0, 1.0], &["friction[1]", "b of pair 0", "negative"]);
    cohesive(&[0.3, 1.0, 1.0, 0.3, 1.0, -1.0], &["friction[5]", "a of pair 1", "negative"]);
    cohesive(&[-0.3, 1.0, 1.0, 0.3, 1.0, 1.0], &["friction[0]", "mu of pair 0", "negative"]);
    cohesive(&[0.3, 1.0, 1.0, 0.3, 1.0, f64::NAN], &["friction[5]", "not finite"]);
    let short = FrictionLaw::Cohesive(&[0.3, 1.0, 1.0, 0.3]);
    refuses(ContactData { law: short, ..GOOD }, Argument::Law, &["friction", "4", "6"]);
    // The rounded product: 0.1 * 0.3 is above 0.03 in the last bit.
    let rounded = FrictionLaw::Cohesive(&[0.1, 0.03, 0.3, 0.0, 0.0, 0.0]);
    assert!(ContactProblem::new(ContactData { law: rounded, ..GOOD }).is_ok());

    let space = ContactData {
        dim: 3,
        pairs: 1,
        stiffness: &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0],
        ld: 3,
        load: &[1.0; 3],
        gap: &[0.0],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    };
    for like in [FrictionLaw::Orthotropic(&[]), FrictionLaw::OrthotropicCollinear(&[])] {
        let law = |numbers: &'static [f64]| like.with_values(numbers);
        for (numbers, parts) in [
            (&[0.0, 0.5, 0.0], ["friction[0]", "mu1 of pair 0", "positive"]),
            (&[0.5, -0.5, 0.0], ["friction[1]", "mu2 of pair 0", "positive"]),
            (&[0.5, f64::INFINITY, 0.0], ["friction[1]", "mu2 of pair 0", "not finite"]),
            (&[0.5, 0.5, f64::NAN], ["friction[2]", "angle of pair 0", "not finite"]),
        ] {
            refuses(ContactData { law: law(numbers), ..space }, Argument::Law, &parts);
        }
        assert!(ContactProblem::new(ContactData { law: law(&[0.5, 0.1, -7.0]), ..space }).is_ok());
        let planar = ContactData { law: law(&[0.5; 6]), ..GOOD };
        refuses(planar, Argument::LawChoice, &["orthotropic", "dim is 2", "Coulomb's law"]);
    }
}

/// A difference across the diagonal of more than 1e-9 of what the diagonal allows is found wherever it is, beside many that
/// are allowed too; 75 pairs fill no block of any size.
#[test]
fn one_difference_across_the_diagonal_is_found_among_many() {
    const SIZE: usize = 150;
    let zeros = [0.0; SIZE];
    let root = |i: usize| 10_f64.powi(i as i32 % 5);
    // Each column, scaled, has entries of .4 to the power of the distance: definite (Kac, Murdock and Szegö 1953).
    let entry = |i: usize, j: usize| 0.4_f64.powi(i.abs_diff(j) as i32) * root(i) * root(j);
    let matrix = |above: f64| -> Vec<f64> {
        let shift = |i: usize, j: usize| if i < j { above * root(i) * root(j) } else { 0.0 };
        (0..SIZE * SIZE)
            .map(|k| (k % SIZE, k / SIZE))
            .map(|(i, j)| entry(i, j) + shift(i, j))
            .collect()
    };
    let checked = |k: &[f64]| {
        let law = FrictionLaw::Frictionless;
        let (load, gap) = (&zeros[..], &zeros[..SIZE / 2]);
        let data = ContactData {
            pairs: SIZE / 2,
            stiffness: k,
            ld: SIZE,
            load,
            gap,
            law,
            reference_slip: None,
            ..GOOD
        };
        ContactProblem::new(data).err()
    };
    for many in [0.0, 0.5e-9, -0.9e-9] {
        let k = matrix(many);
        assert_eq!(checked(&k), None, "{many}");
        for (i, j) in [(1, 0), (64, 63), (149, 0), (149, 148), (71, 8)] {
            let with = |below: f64| {
                let mut k = k.clone();
                k[i + SIZE * j] += below * root(i) * root(j);
                checked(&k)
            };
            assert_eq!(with(many - 0.9e-9), None, "{many}, K[{i},{j}]");
            let parts = [format!("K[{i},{j}]"), format!("K[{j},{i}]"), "not symmetric".into()];
            let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
            expect(with(many - 1.1e-9), Argument::Matrix, &parts);
            let both = [(i, j), (j, i)].iter().fold(k.clone(), |mut k, &(i, j)| {
                k[i + SIZE * j] = 1.1 * root(i) * root(j);
                k
            });
            expect(
                checked(&both),
                Argument::Matrix,
                &[&format!("K[{i},{j}]"), "positive semi-definite"],
            );
        }
    }
}

#[test]
fn refuses_matrices_that_no_structure_has() {
    let refuses_matrix = |entries: &[(usize, usize, f64)], parts: &[&str]| {
        let k = k_with(entries);
        refuses(ContactData { stiffness: &k, ..GOOD }, Argument::Matrix, parts);
    };
    // Not symmetric: an index slipped, a sign, the seventh digit.
    refuses_matrix(&[(1, 0, 0.0)], &["symmetric", "K[1,0]", "K[0,1]"]);
    refuses_matrix(&[(3, 2, 1.0)], &["symmetric", "K[3,2]", "K[2,3]"]);
    refuses_matrix(&[(2, 0, 0.5 + 1e-7)], &["symmetric", "K[2,0]", "K[0,2]"]);
    // Diagonals.
    refuses_matrix(&[(2, 2, 0.0)], &["K[2,2]", "positive"]);
    refuses_matrix(&[(1, 1, -3.0)], &["K[1,1]", "-3", "positive"]);
    let row: Vec<_> = (0..4).flat_map(|i| [(i, 3, 0.0), (3, i, 0.0)]).collect();
    // A component that a free body moves without a force is no fault; without any stiffness there is no
    // unit for displacements.
    let k = k_with(&row);
    assert!(ContactProblem::new(ContactData { stiffness: &k, ..GOOD }).is_ok());
    let all: Vec<_> = (0..16).map(|k| (k % 4, k / 4, 0.0)).collect();
    refuses_matrix(&all, &["K is zero"]);
    // Larger than its diagonal allows: K_ij² <= K_ii K_jj holds for every structure.
    refuses_matrix(&[(1, 0, 4.0), (0, 1, 4.0)], &["semi-definite", "K[1,0]"]);
    // Rounding of a host's condensation is no fault.
    let k = k_with(&[(1, 0, 1.0 + 1e-12)]);
    assert!(ContactProblem::new(ContactData { stiffness: &k, ..GOOD }).is_ok());
}

#[test]
fn refuses_settings_out_of_range() {
    let refuses = |settings: Settings, parts: &[&str]| {
        expect(settings.validate().err(), Argument::Settings, parts);
        let problem = ContactProblem::new(GOOD).unwrap();
        let error = solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).err();
        expect(error, Argument::Settings, parts);
        let lcp = Lcp::new(1, &[1.0], 1, &[-1.0], None).unwrap();
        let error = solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None)).err();
        expect(error, Argument::Settings, parts);
    };
    let good = Settings::default;
    assert!(good().validate().is_ok());
    for tolerance in [0.0, -1e-10, 1e-16, 0.2, f64::NAN, f64::INFINITY] {
        refuses(Settings { tolerance, ..good() }, &["tolerance"]);
    }
    for omega in [-0.1, 2.0, 3.0, f64::NAN, f64::INFINITY] {
        refuses(Settings { omega, ..good() }, &["omega"]);
    }
    for damping in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        refuses(Settings { damping, ..good() }, &["damping"]);
    }
    for time_limit in [-1.0, f64::NAN, f64::NEG_INFINITY] {
        refuses(Settings { time_limit, ..good() }, &["time_limit"]);
    }
    refuses(Settings { max_iterations: 0, ..good() }, &["max_iterations"]);
}

#[test]
fn refuses_methods_that_do_not_fit() {
    let identity: Vec<f64> = (0..36).map(|k| f64::from(u8::from(k % 7 == 0))).collect();
    let space = ContactData {
        dim: 3,
        stiffness: &identity,
        ld: 6,
        load: &[1.0; 6],
        reference_slip: None,
        ..GOOD
    };
    let refuses = |data: ContactData<'_>, friction, method, parts: &[&str]| {
        let problem = ContactProblem::new(ContactData { law: friction, ..data }).unwrap();
        let settings = Settings { method, ..Settings::default() };
        let error = solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).err();
        expect(error, Argument::Settings, parts);
    };
    let (mu, g) = (FrictionLaw::Coulomb(&[0.0, 0.1]), FrictionLaw::Tresca(&[0.1, 0.0]));
    refuses(space, mu, Method::Lemke, &["frictionless", "friction in 2D"]);
    refuses(space, g, Method::Lemke, &["frictionless", "2D"]);
    refuses(GOOD, mu, Method::BlockPivoting, &["block pivoting", "every mu must be 0"]);
    refuses(GOOD, g, Method::BlockPivoting, &["block pivoting", "every g must be 0"]);
    refuses(GOOD, g, Method::SorDiagonal, &["thresholds"]);

    let lcp = Lcp::new(1, &[1.0], 1, &[-1.0], None).unwrap();
    for method in [Method::SorNested, Method::SorDiagonal, Method::Newton] {
        let settings = Settings { method, ..Settings::default() };
        let error = solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None)).err();
        expect(error, Argument::Settings, &["auto, block pivoting and Lemke"]);
    }
}

#[test]
fn refuses_starts_that_do_not_fit() {
    let problem = ContactProblem::new(GOOD).unwrap();
    for method in [Method::SorNested, Method::SorDiagonal] {
        let settings = Settings { method, ..Settings::default() };
        let run = |start: &[f64]| {
            solve(&problem, &settings, Some(start), &mut Monitor::new(&settings, None)).err()
        };
        expect(run(&[0.0; 3]), Argument::Start, &["3", "4"]);
        expect(run(&[0.0; 5]), Argument::Start, &["5", "4"]);
        expect(run(&[]), Argument::Start, &["0", "4"]);
        for bad in NOT_FINITE {
            expect(run(&[0.0, 0.0, 0.0, bad]), Argument::Start, &["d[3]"]);
        }
    }
}

#[test]
fn refuses_bad_complementarity_problems() {
    const M: [f64; 4] = [2.0, 1.0, 1.0, 2.0];
    fn refuses(
        size: usize,
        m: &[f64],
        ld: usize,
        q: &[f64],
        covering: Option<&[f64]>,
        argument: Argument,
        parts: &[&str],
    ) {
        expect(Lcp::new(size, m, ld, q, covering).err(), argument, parts);
    }
    let q = [-1.0, 1.0];
    assert!(Lcp::new(2, &M, 2, &q, Some(&[1.0, 3.0])).is_ok());
    refuses(2, &M, 1, &q, None, Argument::LeadingDimension, &["1", "2"]);
    refuses(0, &M, 0, &q, None, Argument::LeadingDimension, &["0", "1"]);
    refuses(2, &M[..3], 2, &q, None, Argument::Matrix, &["3"]);
    refuses(2, &M, 3, &q, None, Argument::Matrix, &["4"]);
    refuses(usize::MAX, &M, usize::MAX, &q, None, Argument::LeadingDimension, &[]);
    refuses(2, &M, 2, &q[..1], None, Argument::Load, &["q", "2"]);
    refuses(2, &M, 2, &q, Some(&[1.0]), Argument::Covering, &["cover", "2"]);
    for bad in NOT_FINITE {
        refuses(2, &[2.0, 1.0, bad, 2.0], 2, &q, None, Argument::Matrix, &["M[0,1]"]);
        refuses(2, &M, 2, &[-1.0, bad], None, Argument::Load, &["q[1]"]);
        refuses(2, &M, 2, &q, Some(&[1.0, bad]), Argument::Covering, &["cover[1]"]);
    }
    for bad in [0.0, -1.0] {
        refuses(2, &M, 2, &q, Some(&[bad, 1.0]), Argument::Covering, &["cover[0]"]);
    }
}
