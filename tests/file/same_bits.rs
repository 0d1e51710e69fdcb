//! Problem files: the same bits come back.

use std::fs;

use crate::common::folder::{Folder, SMALL};
use signorini::file::{self, Kind, Law};
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Lcp, LoadCase, Model, Monitor, Settings, solve,
};

/// Numbers that text may spoil, and random bits.
fn number(random: &mut fastrand::Rng) -> f64 {
    const ODD: [f64; 10] = [
        0.0,
        -0.0,
        5e-324,
        -2.225_073_858_507_201e-308,
        f64::MIN_POSITIVE,
        1e308,
        f64::MAX,
        f64::MIN,
        0.1,
        1.0 + f64::EPSILON,
    ];
    match random.u8(0..4) {
        0 => ODD[random.usize(..ODD.len())],
        1 => random.f64() - 0.5,
        _ => {
            let number = f64::from_bits(random.u64(..));
            if number.is_finite() { number } else { 1.0 / 3.0 }
        }
    }
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

/// A symmetric matrix that the library accepts, with entries of many digits.
fn stiffness(n: usize, ld: usize, random: &mut fastrand::Rng) -> Vec<f64> {
    let mut k = vec![f64::NAN; ld * n];
    for j in 0..n {
        for i in 0..=j {
            let entry = if i == j { n as f64 + random.f64() } else { random.f64() - 0.5 };
            (k[i + ld * j], k[j + ld * i]) = (entry, entry);
        }
    }
    k
}

#[test]
fn contact_problems_come_back_bit_for_bit() {
    let folder = Folder::new("contact");
    let mut random = fastrand::Rng::with_seed(1);
    for round in 0..60 {
        let (dim, pairs) = (2 + round % 2, round % 5);
        let n = dim * pairs;
        let ld = n + 1 + round % 3;
        let k = stiffness(n, ld, &mut random);
        let mut numbers =
            |count: usize| (0..count).map(|_| number(&mut random)).collect::<Vec<_>>();
        let (load, slip) = (numbers(n), numbers(n - pairs));
        let mut friction: Vec<_> = numbers(pairs).into_iter().map(f64::abs).collect();
        let mut gap = numbers(pairs);
        for gap in gap.iter_mut().skip(round % 3).step_by(3) {
            *gap = f64::INFINITY;
        }
        let planar = [Law::Coulomb, Law::Frictionless, Law::Cohesive, Law::Tresca, Law::ByPair];
        let spatial =
            [Law::Cohesive, Law::Orthotropic, Law::OrthotropicCollinear, Law::Coulomb, Law::ByPair];
        let kind = if dim == 2 { planar[round / 2 % 5] } else { spatial[round / 2 % 5] };
        if kind == Law::ByPair {
            let own = [
                [7.0, 0.0, 0.0, 0.0],
                [1.0, random.f64(), 0.0, 0.0],
                [3.0, 1.0, 4.0, random.f64()],
            ];
            friction = (0..pairs).flat_map(|pair| own[(pair + round) % 3]).collect();
        } else if kind.with(&[]).parameters() == 3 {
            // Positive coefficients, a cohesion above mu a, and any bits that such numbers have.
            friction = (0..3 * pairs)
                .map(|i| if i % 3 == 1 { 4.0 } else { 1.0 } * (1.0 + random.f64()))
                .collect();
        } else if kind.parameters().is_empty() {
            friction.clear();
        }
        let problem = ContactProblem::new(ContactData {
            dim,
            pairs,
            stiffness: &k,
            ld,
            load: &load,
            gap: &gap,
            law: kind.with(&friction),
            reference_slip: (round % 5 > 0).then_some(&slip[..]),
        })
        .unwrap();
        let remark = ["", "a remark", "kind: lcp, % dim: 7", "Bolzen \u{f8} 12"][round % 4];
        file::write(&folder.file(), &problem, Some(remark)).unwrap();
        let back = file::read(&folder.file()).unwrap();

        assert_eq!(back.kind, Kind::Contact(kind));
        assert_eq!((back.dim, back.pairs, back.size), (dim, pairs, n));
        let tight: Vec<f64> = (0..n).flat_map(|j| k[ld * j..ld * j + n].to_vec()).collect();
        assert_eq!(bits(&back.matrix), bits(&tight));
        assert_eq!(bits(&back.load), bits(&load));
        assert_eq!(bits(&back.gap), bits(&gap));
        assert_eq!(bits(&back.friction), bits(&friction));
        let slip = if round % 5 > 0 { slip } else { vec![0.0; n - pairs] };
        assert_eq!(bits(&back.reference_slip), bits(&slip));
        assert_eq!(back.covering, None);
        assert_eq!(back.remark, remark);
        assert!(ContactProblem::new(back.contact().unwrap()).is_ok());
    }
    assert_eq!(folder.names(), ["problem.mtx"], "parts are left");
}

/// A law of three parameters has three columns, pair by pair in the rows.
#[test]
fn the_parameters_of_a_law_stand_in_columns() {
    let folder = Folder::new("columns");
    let numbers = "% dim: 2\n% pairs: 2\n4 10\n".to_owned()
        + &(0..16).map(|k| if k % 5 == 0 { "1\n" } else { "0\n" }).collect::<String>()
        + &"0\n".repeat(8)
        + "0.25\n0\n0.5\n0\n1\n0\n2\n0\n3\n0\n4\n0\n"
        + &"0\n".repeat(4);
    let head = "%%MatrixMarket matrix array real general\n% signorini problem 2\n% kind: contact\n";
    let text = format!("{head}% law: cohesive\n{numbers}");
    let back = folder.load(text.as_bytes()).unwrap();
    assert_eq!(back.kind, Kind::Contact(Law::Cohesive));
    assert_eq!(back.friction, [0.25, 1.0, 3.0, 0.5, 2.0, 4.0]);
    let problem = ContactProblem::new(back.contact().unwrap()).unwrap();
    file::write(&folder.file(), &problem, None).unwrap();
    let written = fs::read_to_string(folder.file()).unwrap();
    assert!(written.contains("f, gap, mu, b and a in normal rows"), "{written}");
}

#[test]
fn complementarity_problems_come_back_bit_for_bit() {
    let folder = Folder::new("lcp");
    let mut random = fastrand::Rng::with_seed(2);
    for n in 0..12 {
        let mut numbers =
            |count: usize| (0..count).map(|_| number(&mut random)).collect::<Vec<_>>();
        let (m, q) = (numbers(n * n), numbers(n));
        let cover: Vec<_> = numbers(n).iter().map(|x| x.abs().max(5e-324)).collect();
        let cover = (n % 2 == 1).then_some(&cover[..]);
        let lcp = Lcp::new(n, &m, n.max(1), &q, cover).unwrap();
        file::write_lcp(&folder.file(), &lcp, None).unwrap();
        let back = file::read(&folder.file()).unwrap();
        assert_eq!((back.kind, back.size), (Kind::Lcp, n));
        assert_eq!(bits(&back.matrix), bits(&m));
        assert_eq!(bits(&back.load), bits(&q));
        assert_eq!(back.covering.as_deref().map(bits), cover.map(bits));
        assert!(back.contact().is_none() && back.remark.is_empty());
    }
}

/// A model and the replay of its file give the same numbers.
#[test]
fn the_case_of_a_model_is_solved_again_with_the_same_bits() {
    let folder = Folder::new("case");
    let mut random = fastrand::Rng::with_seed(3);
    let (dim, pairs) = (2, 4);
    let n = dim * pairs;
    let (k_a, k_b) = (stiffness(n, n, &mut random), stiffness(n, n, &mut random));
    let model = Model::two_body(dim, pairs, (&k_a, n), (&k_b, n)).unwrap();
    let load: Vec<f64> = (0..2 * n).map(|_| 2.0 * random.f64() - 0.5).collect();
    let case = LoadCase {
        load: &load,
        prescribed: None,
        gap: &[0.0, 0.01, f64::INFINITY, -0.02],
        law: FrictionLaw::Coulomb(&[0.3, 0.0, 0.5, 0.1]),
        reference_slip: Some(&[0.0, 0.01, 0.0, -0.01]),
    };
    let settings = Settings::default();
    let expected = model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();

    model.write_case(&folder.file(), &case, Some("two bodies")).unwrap();
    let back = file::read(&folder.file()).unwrap();
    let problem = ContactProblem::new(back.contact().unwrap()).unwrap();
    let again = solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
    assert_eq!(again.status, expected.status);
    assert_eq!(bits(&again.d), bits(&expected.d));
    assert_eq!(bits(&again.certificate.force), bits(&expected.certificate.force));
}

/// Version 1 of the format: the kind is the law.
#[test]
fn files_of_version_1_are_read() {
    let folder = Folder::new("old");
    for (law, other) in [("coulomb", "tresca"), ("tresca", "coulomb")] {
        let new = SMALL.replace("law: coulomb", &format!("law: {law}"));
        let old = new
            .replace("problem 2", "problem 1")
            .replace("kind: contact", &format!("kind: {law}"))
            // Version 1 skipped this line as any other comment.
            .replace(&format!("law: {law}"), &format!("law: {other}"));
        let old = folder.load(old.as_bytes()).unwrap();
        assert_eq!(old, folder.load(new.as_bytes()).unwrap());
    }
    let head = |version| {
        format!(
            "%%MatrixMarket matrix array real general\n% signorini problem {version}\n% kind: lcp\n"
        )
    };
    let numbers = "1 3\n2e0\n-1e0\n4e0\n";
    let old = folder.load((head(1) + numbers).as_bytes()).unwrap();
    assert_eq!(old.covering.as_deref(), Some(&[4.0][..]));
    assert_eq!(old, folder.load((head(2) + numbers).as_bytes()).unwrap());
}

#[test]
fn the_format_is_what_it_is_said_to_be() {
    let folder = Folder::new("format");
    let back = folder.load(SMALL.as_bytes()).unwrap();
    assert_eq!((back.dim, back.pairs, back.size), (2, 1, 2));
    assert_eq!(back.matrix, [4.0, 1.0, 1.0, 4.0]);
    assert_eq!(back.load, [2.0, 1.25]);
    assert_eq!(back.gap, [f64::INFINITY]);
    assert_eq!(back.friction, [0.3]);
    assert_eq!(back.reference_slip, [-0.7]);
    assert_eq!(back.remark, "one pair");

    let problem = ContactProblem::new(back.contact().unwrap()).unwrap();
    file::write(&folder.file(), &problem, Some("one pair")).unwrap();
    let written = fs::read_to_string(folder.file()).unwrap();
    let but_comments = |text: &str| -> Vec<String> {
        text.lines().filter(|line| !line.starts_with("% Written")).map(Into::into).collect()
    };
    let mut lines = but_comments(&written);
    lines.retain(|line| !line.starts_with("% Columns"));
    assert_eq!(lines, but_comments(SMALL));
}
