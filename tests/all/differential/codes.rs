//! Lines of random codes and random words: what belongs together, what a code needs, what nothing uses, and which of several mistakes the
//! control tells.
use super::generate::Program;

/// What is in effect before.
const BEFORE: [&str; 40] = [
    "F10",
    "S100 M3",
    "G18",
    "G19",
    "G91",
    "G93",
    "G95",
    "G7",
    "G8",
    "T1 M6",
    "T2 M6",
    "G43",
    "G41 D1",
    "G42.1 D.2",
    "G41.1 D0",
    "G90.1",
    "G20",
    "G0 X1 Y2 Z3",
    "G1 X2 F5",
    "G17.1",
    "G18.1",
    "G99",
    "G98",
    "G81 X1 Z-1 R1 F9",
    "G2 X1 I.5 F9",
    "G5.2 X1 Y1 P1 F9",
    "G96 D100 S10",
    "G54",
    "G92 X1",
    "G52 Y2",
    "G10 L2 P1 R30",
    "G80",
    "M52",
    "#1=2",
    "G43.1 Z1",
    "G33 K1 Z1 S9",
    "G61",
    "M19 R10",
    "G76 P1 Z-5 I-1 J.1 K.5 F9",
    "G38.2 Z-5 F1",
];
const G: [&str; 68] = [
    "0", "1", "2", "3", "4", "5", "5.1", "5.2", "5.3", "7", "8", "10", "17", "18", "19", "17.1", "18.1", "20", "21",
    "28", "28.1", "30", "30.1", "33", "33.1", "38.2", "38.5", "40", "41", "41.1", "42", "42.1", "43", "43.1", "43.2",
    "49", "51", "52", "53", "54", "55", "59.3", "61", "61.1", "64", "70", "71", "72", "73", "74", "76", "80", "81",
    "82", "83", "84", "85", "86", "87", "88", "89", "90.1", "91", "92", "92.1", "93", "95", "96",
];
const M: [&str; 32] = [
    "0", "1", "2", "3", "4", "5", "6", "7", "8", "9", "19", "30", "48", "49", "50", "51", "52", "53", "60", "61", "62",
    "63", "64", "65", "66", "67", "68", "70", "71", "72", "73", "99",
];
const LETTERS: &[u8] = b"XYZABCUVWIJKRFSTPQDHLE$@^";
const VALUES: [&str; 31] = [
    "-2.8", "-2", "-1", "-0.5", "0", "0.4", "0.5", "0.9999", "1", "1.0001", "1.5", "2", "2.5", "3", "4", "5", "9",
    "9.5", "10", "11", "20", "40", "99", "100", "400", "-400", "1000", "#1", "#5420", "[1/3]", "-0.0001",
];

impl Program {
    /// Some of such lines.
    pub(crate) fn codes(&mut self) {
        for _ in 0..self.random.below(4) {
            let before = self.random.pick(&BEFORE);
            self.line(before);
        }
        for _ in 0..=self.random.below(2) {
            let line = self.words_of_a_line();
            self.line(&line);
        }
    }

    fn words_of_a_line(&mut self) -> String {
        let mut words = Vec::new();
        let which = self.random.below(10);
        if which < 8 {
            words.push(format!("G{}", self.random.pick(&G)));
        }
        if which > 5 {
            words.push(format!("M{}", self.random.pick(&M)));
        }
        if self.random.one_in(8) {
            words.push(format!("G{}", self.random.pick(&G)));
        }
        let mut letters = LETTERS.to_vec();
        for _ in 0..self.random.below(6) {
            let letter = letters.swap_remove(self.random.below(letters.len()));
            words.push(format!("{}{}", char::from(letter), self.random.pick(&VALUES)));
        }
        let first = self.random.below(words.len().max(1));
        words.rotate_left(first);
        words.join(" ")
    }
}
