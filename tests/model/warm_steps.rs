//! Steps of a series in which no pair changes its state: the factor of the step before serves, so that nothing is
//! factorised, and the results are those of a problem that stands alone.

use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Starts, State, Status};

use crate::common::dense::{difference, largest};
use crate::common::wavy::Wavy;

/// Loads grow in proportion from a gap of zero: displacements and forces grow with them, and states stay. The
/// tolerance is that of `eta`, times a condition of 1e3.
#[test]
fn steps_without_a_change_of_state_factorise_nothing() {
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    for (wavy, mu, ties) in [
        (Wavy::plane(64), 0.3, usize::MAX),
        (Wavy::plane(64), 0.0, usize::MAX),
        (Wavy::plane(64), 0.3, 7),
        (Wavy::space(9), 0.0, usize::MAX),
        (Wavy::space(9), 0.3, usize::MAX),
        (Wavy::space(9), 0.3, 7),
    ] {
        let model = wavy.model(&settings);
        let gap = vec![0.0; model.pairs()];
        // Coulomb's law, and a tie after so many pairs.
        let of_pair =
            |pair: usize| if pair % ties == 1 { [7.0, 0.0, 0.0, 0.0] } else { [1.0, mu, 0.0, 0.0] };
        let laws: Vec<f64> = (0..model.pairs()).flat_map(of_pair).collect();
        let of_all = vec![mu; model.pairs()];
        let law = match ties {
            usize::MAX => FrictionLaw::Coulomb(&of_all),
            _ => FrictionLaw::ByPair(&laws),
        };
        let scaled = |part: f64| wavy.load.iter().map(|f| part * f).collect::<Vec<f64>>();
        let prescribed = |part: f64| {
            let scaled = |values: &Vec<f64>| values.iter().map(|u| part * u).collect::<Vec<f64>>();
            wavy.prescribed.as_ref().map(scaled)
        };
        let mut series = model.series();
        let mut before: Option<(f64, Vec<f64>, Vec<State>)> = None;
        for part in [1.0, 1.1, 1.25, 1.3] {
            let (load, values) = (scaled(part), prescribed(part));
            let case = LoadCase {
                load: &load,
                prescribed: values.as_deref(),
                gap: &gap,
                law,
                reference_slip: None,
            };
            let warm = series.solve_cases(&[case], &settings, Starts::Previous(None), None);
            let warm = warm.into_iter().next().unwrap().unwrap();
            let alone =
                model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
            assert_eq!([warm.status, alone.status], [Status::Solved; 2]);
            assert!(largest(&difference(&warm.d, &alone.d)) <= 1e-9 * largest(&alone.d));
            if let Some((last, d, states)) = &before {
                let expected: Vec<f64> = d.iter().map(|d| d * part / last).collect();
                assert!(largest(&difference(&warm.d, &expected)) <= 1e-9 * largest(&expected));
                assert_eq!(&warm.certificate.states, states);
                assert_eq!(warm.factorisations, 0, "mu {mu}, step {part}");
            }
            assert!(alone.factorisations > 0);
            before = Some((part, warm.d, warm.certificate.states));
        }
    }
}
