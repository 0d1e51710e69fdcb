//! The law's decisions stand in `src/law` alone: a search for them everywhere else.
//!
//! Refused outside the room: a comparison with a gap, a threshold, a bound, a coefficient, a slope or a
//! reference slip; `INFINITY` in a condition or a pattern; the sign of a force; a choice by the variants
//! of a friction law, of a state or of a branch.

use crate::sources::{Kind, Token, compares, left_operand, right_operand, sources, tokens};

/// Names of what the law compares with.
const LAW: [&str; 21] = [
    "gap",
    "gaps",
    "threshold",
    "thresholds",
    "bound",
    "bounds",
    "mu",
    "slope",
    "slip0",
    "offset",
    "reference_slip",
    "slip",
    "friction",
    "lower",
    "lower_bounds",
    "clearance",
    "penetration",
    "tension",
    "cone_excess",
    "coefficient",
    "clearances",
];

/// Names of forces and pressures, whose sign the law knows.
const FORCES: [&str; 9] =
    ["force", "forces", "raw", "pressure", "pressures", "f_n", "p_n", "reaction", "reactions"];

/// Methods that compare.
const METHODS: [&str; 9] = [
    "min",
    "max",
    "clamp",
    "total_cmp",
    "partial_cmp",
    "signum",
    "is_sign_negative",
    "is_sign_positive",
    "minimum",
];

/// Methods that ask for infinity.
const FINITE: [&str; 2] = ["is_finite", "is_infinite"];

/// Infinity, as "no obstacle".
const INFINITE: [&str; 2] = ["INFINITY", "NEG_INFINITY"];

/// The variants of a friction law.
const LAWS: [&str; 8] = [
    "Frictionless",
    "Coulomb",
    "Tresca",
    "Cohesive",
    "Orthotropic",
    "OrthotropicCollinear",
    "ByPair",
    "Tied",
];

/// Types whose variants only the law may choose by.
const CHOICES: [(&str, &[&str]); 4] = [
    ("FrictionLaw", &LAWS),
    ("Law", &LAWS),
    ("State", &["Open", "Slip", "Stick"]),
    ("Tangential", &["Free", "Slip", "Stick"]),
];

/// Where the data pass in or out, or where a name means something else: the place, what is allowed
/// there, and why.
const ALLOWED: [(&str, &str, &str); 10] = [
    ("problem/friction_law.rs", "Law ::", "the arrays of a law: their number and range"),
    ("problem/arguments.rs", "gap == f64 :: NEG_INFINITY", "input: a gap is a number or +inf"),
    ("problem/units.rs", "gap", "units: the size of a gap, and a gap beyond doubles"),
    ("problem/bounded_lcp.rs", "self . lower", "the bound of an LCP's variable"),
    ("problem/symmetric_matrix.rs", "lower", "an entry below the diagonal"),
    ("linalg/", "lower [", "a lower triangular factor"),
    ("linalg/nnls.rs", "slope", "the slope of a sum of squares"),
    ("problem/law_table.rs", "Law ::", "the laws and their parameters"),
    ("file/read.rs", "Law ::", "the laws that version 1 of the format has"),
    ("ffi/", "State ::", "states to constants of C"),
];

/// Decisions of the text that only the law may take, with the line.
fn decisions(text: &[Token]) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (at, token) in text.iter().enumerate() {
        let mut refuse =
            |what: &str| found.push((token.line, format!("{what}: {}", near(text, at))));
        let is = |at: usize, wanted: &str| text.get(at).is_some_and(|token| token.text == wanted);
        let called = at > 0 && is(at - 1, ".") && is(at + 1, "(");
        let method = |methods: &[&str]| called && methods.contains(&token.text.as_str());
        if compares(token) || method(&METHODS) {
            let (left, right) = if called {
                (
                    &text[left_operand(text, at)],
                    &text[at + 1..=crate::sources::closing(text, at + 1)],
                )
            } else {
                (&text[left_operand(text, at)], &text[right_operand(text, at)])
            };
            let names = |names: &[&str]| names_any(left, names) || names_any(right, names);
            let sign = method(&METHODS) && right.len() == 2;
            if names(&INFINITE) {
                refuse("infinity");
            } else if names(&LAW) {
                refuse("a comparison with what the law compares with");
            } else if names(&FORCES) && (sign || is_zero(left) || is_zero(right))
                || has_component(left)
                || has_component(right)
            {
                refuse("the sign of a force");
            }
        } else if method(&FINITE) && names_any(&text[left_operand(text, at)], &LAW) {
            refuse("infinity");
        } else if token.text == "matches" && is(at + 1, "!") {
            if names_any(&text[at + 2..crate::sources::closing(text, at + 2)], &INFINITE) {
                refuse("infinity");
            }
        } else if INFINITE.contains(&token.text.as_str()) && (is(at + 1, "=>") || is(at + 1, "|")) {
            refuse("infinity");
        } else if let Some((_, variants)) = CHOICES.iter().find(|(name, _)| token.text == *name)
            && is(at + 1, "::")
            && variants.contains(&text[at + 2].text.as_str())
        {
            refuse("a choice by a variant");
        }
    }
    found
}

/// `true` if one of the names stands in the operand.
fn names_any(operand: &[Token], names: &[&str]) -> bool {
    operand.iter().any(|token| token.kind == Kind::Word && names.contains(&token.text.as_str()))
}

/// `true` if a component of a force stands in the operand: `force[i]`.
fn has_component(operand: &[Token]) -> bool {
    let pairs = operand.windows(2);
    pairs.into_iter().any(|pair| pair[1].text == "[" && FORCES.contains(&pair[0].text.as_str()))
}

/// `true` if the operand is zero, also as the only argument of a method.
fn is_zero(operand: &[Token]) -> bool {
    let inner: Vec<&Token> =
        operand.iter().filter(|token| !matches!(token.text.as_str(), "(" | ")" | "-")).collect();
    matches!(inner[..], [zero] if zero.kind == Kind::Number
        && zero.text.trim_end_matches(['f', '6', '4', '_']).trim_matches(['0', '.']).is_empty())
}

/// The line around a token, as it is found.
fn near(text: &[Token], at: usize) -> String {
    let line = text[at].line;
    let words: Vec<&str> =
        text.iter().filter(|token| token.line == line).map(|token| token.text.as_str()).collect();
    words.join(" ")
}

#[test]
fn the_laws_decisions_stand_in_its_room() {
    let mut found = Vec::new();
    let mut used = [false; ALLOWED.len()];
    for source in sources().iter().filter(|source| source.room() != "law") {
        for (line, what) in decisions(&source.tokens) {
            let allowed = ALLOWED
                .iter()
                .position(|(place, part, _)| source.path.starts_with(place) && what.contains(part));
            match allowed {
                Some(entry) => used[entry] = true,
                None => found.push(format!("src/{}:{line}: {what}", source.path)),
            }
        }
    }
    assert!(found.is_empty(), "decisions of the law outside its room:\n{}", found.join("\n"));
    for (used, (place, part, _)) in used.iter().zip(ALLOWED) {
        assert!(used, "{part} is allowed in src/{place} and does not stand there");
    }
}

#[test]
fn the_search_finds_decisions() {
    for line in [
        "let open = problem.gap(pair) < f64::INFINITY;",
        "if force[n] > 0.0 { push(n) }",
        "let pulled = (0..n).filter(|&i| 0.0 < force[i]);",
        "let p = (-force[i]).max(0.0);",
        "let closed = force[i] < -margin;",
        "match problem.law() { FrictionLaw::Coulomb(mu) => mu, _ => &[] }",
        "if let FrictionLaw::Frictionless = problem.law() {}",
        "if matches!(gap[pair], f64::INFINITY) {}",
        "match law.gap { f64::INFINITY => 0.0, gap => gap }",
        "if mu[pair] == 0.0 { continue; }",
        "let slides = length(t) > threshold;",
        "let stopped = d[i].min(gap[pair]);",
        "while d[n] - gap[n / 2] > 0.0 {}",
        "let none = gap.is_infinite();",
        "if state == State::Stick {}",
        "let slid = (d_t - slip0).abs() > tiny;",
        "let lifts = matches!(branch.tangential, Tangential::Stick);",
        "let sign = force.signum();",
        "let far = x[i] > bound.offset;",
        "if p_n <= 0. { open() }",
    ] {
        assert!(!decisions(&tokens(line)).is_empty(), "not found: {line}");
    }
}

#[test]
fn the_search_leaves_other_lines_alone() {
    for line in [
        "// gap < f64::INFINITY",
        "/* force[n] > 0.0 */ let a = 1;",
        "let message = \"gap > 0.0\";",
        "let mut best = (f64::INFINITY, x);",
        "let first = ratios.fold(f64::INFINITY, f64::min);",
        "fn gaps(gap: &[f64]) -> Vec<f64> { gap.to_vec() }",
        "let motion: Vec<f64> = force.iter().map(|f| -f).collect();",
        "if force < ROUNDING * self.largest_force {}",
        "let law = problem.law(); let is = law.touches(d[i]);",
        "if eta < best.eta { best.force.clone_from(&force); }",
        "let count = certificate.count(state);",
        "if law.has_obstacle() { normal.push(i) }",
    ] {
        assert_eq!(decisions(&tokens(line)), [], "found in: {line}");
    }
}
