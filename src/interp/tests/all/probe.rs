use crate::support::*;
#[test]
fn probe() {
    let file = std::env::var("PROBE").unwrap_or_default();
    let dialect = std::env::var("DIALECT").unwrap_or("sinumerik-840d".into());
    let Ok(source) = std::fs::read(&file) else { return };
    let (program, log) = run_bytes(&dialect, &source, &Default::default());
    for f in log.faults.iter().take(40) {
        println!("{}", fault_line(&program, f));
    }
    println!("{} faults {} motions", log.faults.len(), log.motions.len());
    for m in log.motions.iter().take(30) {
        println!("{} {}", m.block.0 + 1, line(m));
    }
}
