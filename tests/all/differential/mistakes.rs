//! One word of a random program is changed: mostly into a mistake, whose message and line must be the control's.
use super::generate::Program;

/// Words that are put somewhere.
const WORDS: [&str; 44] = [
    "R1", "Q2", "H5", "L0", "P-1", "P1.5", "$1", "G91", "M9", "G1", "G80", "G53", "D2", "E1", "I1", "J1", "K1", "X1",
    "A1", "U1", "F0", "S-1", "T99", "G41", "G43", "G4", "G28", "G10", "G92", "M3", "M5", "M6", "M2", "@1", "^10", "N1",
    "O1", "G33", "G54", "G61", "#1=2", "(a", "!", "G1000",
];

/// What numbers are changed into.
const NUMBERS: [&str; 20] = [
    "",
    "-",
    "+",
    ".",
    "1.2.3",
    "[1",
    "1]",
    "[]",
    "#",
    "#0",
    "#<no>",
    "#99999",
    "1e3",
    "--1",
    "[1/0]",
    "[SQRT[-1]]",
    "0",
    "-1",
    "1.5",
    "1000000",
];

impl Program {
    /// Changes a word of the program.
    pub(crate) fn spoil(&mut self) {
        let mut lines: Vec<String> = self.case.text.lines().map(str::to_owned).collect();
        let place = self.random.below(lines.len());
        let mut words: Vec<String> = lines[place].split(' ').map(str::to_owned).collect();
        let word = self.random.below(words.len());
        match self.random.below(6) {
            0 => {
                words.remove(word);
            }
            1 => {
                let again = words[word].clone();
                words.insert(word, again);
            }
            2 => {
                let new = self.random.pick(&WORDS).to_owned();
                words.insert(word, new);
            }
            3 => {
                let new = self.random.pick(&WORDS).to_owned();
                words.push(new);
            }
            4 => {
                let number = self.random.pick(&NUMBERS);
                let letter = words[word].chars().next().map(String::from).unwrap_or_default();
                words[word] = letter + number;
            }
            _ => {
                let letter = char::from(b'A' + self.random.below(26) as u8);
                let rest: String = words[word].chars().skip(1).collect();
                words[word] = format!("{letter}{rest}");
            }
        }
        lines[place] = words.join(" ");
        self.case.text = lines.join("\n") + "\n";
    }
}
