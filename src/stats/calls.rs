//! Which programs a text calls, as written: M98 and G65 with P, `o<name> call`, CALL and its like.
use std::{
    collections::{HashMap, hash_map::Entry},
    hash::Hash,
};
use trunnion_syntax::{Address, Block, Item, LineIndex, Program, Value};

/// A program that is called.
#[derive(Clone, Debug)]
pub struct Call {
    /// As written, upper case: `M98 P1000`.
    pub name: String,
    /// How often it is written.
    pub count: u64,
    /// Where first, from 1.
    pub line: u32,
}

/// All calls in the order of their first line.
pub(crate) fn calls(program: &Program, lines: &LineIndex) -> Vec<Call> {
    let written = program.blocks().flat_map(|block| {
        let start = block.range().start;
        of_block(program, &block).into_iter().map(move |name| (name, start))
    });
    let call = |(name, count, start): (String, u64, u32)| {
        let (line, _) = lines.line_column(program.source(), start);
        Call { name, count, line }
    };
    counted(written).into_iter().map(call).collect()
}

/// Each name once, in the order of first places: how often it comes, and where first.
fn counted<N: Eq + Hash + Clone>(names: impl Iterator<Item = (N, u32)>) -> Vec<(N, u64, u32)> {
    let mut found: Vec<(N, u64, u32)> = Vec::new();
    let mut places: HashMap<N, usize> = HashMap::new();
    for (name, start) in names {
        match places.entry(name) {
            Entry::Occupied(place) => found[*place.get()].1 += 1,
            Entry::Vacant(place) => {
                found.push((place.key().clone(), 1, start));
                place.insert(found.len() - 1);
            }
        }
    }
    found
}

fn of_block(program: &Program, block: &Block<'_>) -> Vec<String> {
    let text = |range| program.text(range).split_whitespace().collect::<String>();
    let (mut calls, mut code, mut label, mut parameter) = (Vec::new(), None, None, None);
    for item in block.items() {
        match item {
            Item::Word(word) => match (word.address, word.value) {
                (Address::Letter(letter @ (b'G' | b'M')), Value::Number(number)) => {
                    let number = number.to_integer();
                    let is_call = matches!((letter, number), (b'M', Some(97 | 98 | 198)) | (b'G', Some(65 | 66)));
                    code = if is_call {
                        number.map(|n| format!("{}{n}", char::from(letter)))
                    } else {
                        code
                    };
                }
                (Address::Letter(b'O'), _) => label = Some(text(word.range).to_ascii_lowercase()),
                (Address::Letter(b'P'), _) => parameter = Some(text(word.range).to_ascii_uppercase()),
                _ => {}
            },
            Item::Call(call) => match (text(call.name).to_ascii_uppercase().as_str(), call.arguments, &label) {
                ("CALL", _, Some(label)) => calls.push(label.clone()),
                (name @ ("CALL" | "PCALL" | "EXTCALL"), Some(arguments), None) => {
                    calls.push(format!("{name} {}", text(arguments)));
                }
                _ => {}
            },
            _ => {}
        }
    }
    if let (Some(code), Some(parameter)) = (code, parameter) {
        calls.push(format!("{code} {parameter}"));
    }
    calls
}

#[cfg(test)]
mod tests {
    use super::counted;
    use std::{cell::Cell, hash::Hash, rc::Rc};

    /// A name that counts how often it is compared.
    #[derive(Clone)]
    struct Name(u32, Rc<Cell<u64>>);

    impl PartialEq for Name {
        fn eq(&self, other: &Self) -> bool {
            self.1.set(self.1.get() + 1);
            self.0 == other.0
        }
    }
    impl Eq for Name {}
    impl Hash for Name {
        fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
            self.0.hash(state);
        }
    }

    #[test]
    fn a_name_is_not_compared_with_all_others() {
        let compared = Rc::new(Cell::new(0));
        let names = (0..20_000).map(|i| (Name(i % 10_000, Rc::clone(&compared)), i));
        let found = counted(names);
        assert_eq!(found.len(), 10_000);
        assert!(
            found
                .iter()
                .zip(0..)
                .all(|((name, count, start), i)| (name.0, *count, *start) == (i, 2, i))
        );
        // a table compares again where two names share a part of their hash
        assert!(compared.get() < 100_000, "{} comparisons", compared.get());
    }
}
