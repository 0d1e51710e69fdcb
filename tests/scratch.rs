mod common;
use common::problems::*;
use fastrand::Rng;
use signorini::{Method, Settings, Status};
#[test]
fn scratch() {
    for method in [Method::Auto] {
        for pairs in [2usize, 5, 12, 20, 40, 60] {
            for mu in [0.3, 1.0, 3.0, 5.0] {
                let (mut ok, mut its) = (0, 0);
                let mut why = std::collections::BTreeMap::new();
                let count = 100;
                let begin = std::time::Instant::now();
                for seed in 0..count {
                    let mut rng = Rng::with_seed(seed);
                    let condition = decades(&mut rng, 6.0);
                    let k = definite(&mut rng, 2 * pairs, condition);
                    let law = coulomb(&mut rng, pairs, mu);
                    let case = loaded(&mut rng, 2, k, law);
                    let s = case.solve(&Settings { method, ..Settings::default() });
                    ok += u32::from(s.status == Status::Solved);
                    its += s.iterations;
                    let m =
                        s.message.split(';').next().unwrap().split(':').next().unwrap().to_string()
                            + &format!(" {:?} {:?}", s.method, s.fallback);
                    *why.entry(m).or_insert(0) += 1;
                    if s.status != Status::Solved && method == Method::Auto {
                        println!("seed {seed} {:?}", s.message);
                    }
                }
                println!(
                    "{method:?} {pairs} mu {mu}: {ok}/{count} its {} {:.2} ms each {why:?}",
                    its / count,
                    begin.elapsed().as_secs_f64() * 1e3 / count as f64
                );
            }
        }
    }
}
