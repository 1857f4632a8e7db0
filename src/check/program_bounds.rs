//! The first and the last block of a Klartext program.
pub(crate) use trunnion_interp::{is_program_end as is_end, program_bound as bound};

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;

    /// M30 ends the program; what stands between it and END PGM is left out all the same.
    #[test]
    fn the_end_after_m30_is_not_left_out() {
        let blocks = |text: &str| {
            let found = Fixture::parse("gcode heidenhain-klartext", text).check();
            let coverage = found.expect("checked").coverage;
            (coverage.blocks, coverage.blocks_run, coverage.not_run.len())
        };
        assert_eq!(
            blocks("0 BEGIN PGM A MM\n1 L X+1 FMAX\n2 M30\n3 END PGM A MM\n"),
            (3, 3, 0)
        );
        assert_eq!(
            blocks("0 BEGIN PGM A MM\n1 M30\n2 L X+1 FMAX\n3 END PGM A MM\n"),
            (3, 2, 1)
        );
    }
}
