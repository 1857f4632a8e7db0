//! The arguments of an APT record.
use trunnion_syntax::{AptArg, Program, Record, TextRange};

/// The arguments of a record: up to sixteen numbers in order, and the minor words.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Args {
    numbers: [f64; 16],
    count: usize,
    words: [TextRange; 8],
    word_count: usize,
    /// For each word, how many numbers come before it.
    before: [usize; 8],
    /// Something is neither a number nor a word.
    pub(crate) odd: bool,
    /// Bytes of the first argument to the last.
    pub(crate) range: TextRange,
}

impl Args {
    pub(crate) fn new(record: &Record<'_>) -> Self {
        let mut args = Self {
            numbers: [0.0; 16],
            count: 0,
            words: [TextRange::default(); 8],
            word_count: 0,
            before: [0; 8],
            odd: false,
            range: record.range,
        };
        let mut whole: Option<TextRange> = None;
        for arg in record.args() {
            let range = match arg {
                AptArg::Number(decimal, range) => {
                    let value = decimal.to_f64();
                    if args.count == args.numbers.len() || value.abs() > 1e12 {
                        args.odd = true;
                    } else {
                        args.numbers[args.count] = value;
                        args.count += 1;
                    }
                    range
                }
                AptArg::Word(range) => {
                    if args.word_count < args.words.len() {
                        args.words[args.word_count] = range;
                        args.before[args.word_count] = args.count;
                        args.word_count += 1;
                    } else {
                        args.odd = true;
                    }
                    range
                }
                AptArg::Other(range) => {
                    args.odd = true;
                    range
                }
            };
            whole = Some(whole.map_or(range, |whole| whole.cover(range)));
        }
        if let Some(whole) = whole {
            args.range = whole;
        }
        args
    }
    pub(crate) fn numbers(&self) -> &[f64] {
        &self.numbers[..self.count]
    }
    /// Minor words, upper case comparison is [`Args::has`].
    pub(crate) fn words(&self) -> &[TextRange] {
        &self.words[..self.word_count]
    }
    pub(crate) fn has(&self, program: &Program, word: &str) -> bool {
        self.words().iter().any(|&range| is(program, range, word))
    }
    /// The number that follows a minor word.
    pub(crate) fn after(&self, program: &Program, word: &str) -> Option<f64> {
        let at = self.words().iter().position(|&range| is(program, range, word))?;
        self.numbers().get(self.before[at]).copied()
    }
}

/// Whether a range is this word, in either case.
pub(crate) fn is(program: &Program, range: TextRange, word: &str) -> bool {
    program
        .source()
        .get(range.as_usize())
        .is_some_and(|text| text.eq_ignore_ascii_case(word.as_bytes()))
}
