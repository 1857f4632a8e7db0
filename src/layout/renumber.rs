//! New block numbers, with every jump, return and contour that names one changed too. Refused where a target is not known for
//! certain. Proved by running both texts, and by checking that each reference points to the same block as before.
use crate::data_entry::{data_entries, is_data};
use crate::proof::first_difference;
use crate::references::{Call, Found, Obstacle, Reference, begins_program, own_number, read};
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};
use trunnion_dialect::Dialect;
use trunnion_interp::Setup;
use trunnion_same::Difference;
use trunnion_syntax::{BlockId, Format, Program, TextEdit, TextRange, apply_edits, parse};

/// Most digits of a block number: OSP four (NC-PB/gEdit, syntax-okuma.md, 3.1), RS274/NGC 99999, others eight digits.
const MOST_OSP: i64 = 9999;
const MOST_NGC: i64 = 99_999;
const MOST: i64 = 99_999_999;

/// First number and distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Numbers {
    /// Number of the first block that has one.
    pub start: u32,
    /// Distance to the next, 1 at least.
    pub step: u32,
}

/// The outcome of new block numbers.
#[derive(Clone, Debug, PartialEq)]
pub enum Renumbered {
    /// No block has a number.
    NoNumbers,
    /// The new text, proved.
    Changed {
        /// The text.
        text: Vec<u8>,
        /// How many blocks have a number.
        blocks: usize,
        /// How many references were followed.
        references: usize,
        /// Programs that are called and are not in this file: if they return to a block by its number, that is not followed.
        called_outside: Vec<i64>,
    },
    /// Numbers must stay.
    Refused(Obstacle),
    /// The run of the new text differs.
    Differs(Difference),
}

/// A place that names a block by its number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BlockReference {
    /// Bytes of the number.
    pub digits: TextRange,
    /// The number.
    pub number: i64,
    /// The block with it, and the bytes of its digits there; `None` where it is not certain which one is meant.
    pub target: Option<(BlockId, TextRange)>,
}

/// Everything in a file that names blocks and programs by number.
#[derive(Clone, Debug, Default)]
pub struct BlockReferences {
    /// Jumps, returns, contours.
    pub references: Vec<BlockReference>,
    /// What keeps block numbers from being changed.
    pub obstacles: Vec<Obstacle>,
    /// Those of them that may name a block of this file and are not followed: texts, words next to codes that are not known.
    pub unread: Vec<Obstacle>,
    /// Programs that are called by number.
    pub calls: Vec<Call>,
}

/// Reads everything that names blocks and programs by number.
pub fn block_references(program: &Program, dialect: &Dialect) -> BlockReferences {
    let survey = Survey::new(program, dialect);
    let one = |reference: &Reference| {
        let target = survey.target(program, reference).ok();
        BlockReference {
            digits: reference.digits,
            number: reference.number,
            target: target.and_then(|block| Some((block, own_number(&program.block(block))?.0))),
        }
    };
    let references = survey.found.references.iter().map(one).collect();
    let unread: Vec<Obstacle> = survey.unread().cloned().collect();
    BlockReferences {
        references,
        obstacles: survey
            .found
            .obstacles
            .into_iter()
            .chain(unread.iter().cloned())
            .collect(),
        unread,
        calls: survey.found.calls,
    }
}

/// One program of the file.
#[derive(Default)]
struct Part {
    /// Its O number.
    name: i64,
    /// Blocks that have the number; more than one where it is there twice. Numbers of data are among them: a search for a number stops there.
    blocks: BTreeMap<i64, Vec<BlockId>>,
}

/// Everything that refers to block numbers.
struct Survey {
    parts: Vec<Part>,
    /// The part of each block.
    part_of: Vec<u32>,
    /// The parts that call a program, by its number.
    callers: BTreeMap<i64, Vec<usize>>,
    /// Blocks whose number is data.
    data: Vec<Range<u32>>,
    found: Found,
}

/// Gives a program new block numbers.
pub fn renumber(program: &Program, dialect: &Dialect, setup: &Setup, numbers: Numbers) -> Renumbered {
    if !program.options().format.has_words() {
        let why = match program.options().format {
            Format::Klartext => "the control numbers the blocks of a Klartext program itself",
            Format::Apt | Format::Iso | Format::Osp => "APT statements have no block numbers",
        };
        return refused(TextRange::default(), why.to_owned());
    }
    let survey = Survey::new(program, dialect);
    let (new, blocks) = match new_numbers(program, dialect, numbers, &survey) {
        Ok(new) => new,
        Err(obstacle) => return Renumbered::Refused(obstacle),
    };
    if blocks == 0 {
        return Renumbered::NoNumbers;
    }
    if let Some(obstacle) = survey.found.obstacles.first().or_else(|| survey.unread().next()) {
        return Renumbered::Refused(obstacle.clone());
    }
    let targets = match survey.resolve(program) {
        Ok(targets) => targets,
        Err(obstacle) => return Renumbered::Refused(obstacle),
    };
    let mut edits: Vec<TextEdit> = new.iter().map(|(_, edit)| edit.clone()).collect();
    for (reference, target) in survey.found.references.iter().zip(&targets) {
        let Ok(at) = new.binary_search_by_key(target, |(block, _)| *block) else {
            continue;
        };
        edits.push(TextEdit {
            range: reference.digits,
            new_text: new[at].1.new_text.trim_start_matches('0').to_owned(),
        });
    }
    edits.sort_by_key(|edit| edit.range);
    let Some(text) = apply_edits(program.source(), &edits) else {
        let range = TextRange::default();
        return refused(range, "the same number is read in two ways".to_owned());
    };
    let after = parse(text, program.options());
    let again = Survey::new(&after, dialect);
    if again.resolve(&after).ok().as_ref() != Some(&targets) {
        return refused(
            TextRange::default(),
            "the new numbers would not refer to the same blocks".to_owned(),
        );
    }
    if let Some(difference) = first_difference(program, &after, dialect, setup, true) {
        return Renumbered::Differs(difference);
    }
    Renumbered::Changed {
        text: after.source().to_vec(),
        blocks,
        references: targets.len(),
        called_outside: survey.called_outside(),
    }
}

fn refused(range: TextRange, why: String) -> Renumbered {
    Renumbered::Refused(Obstacle { range, why })
}

/// The new number of each block that has one, as an edit.
fn new_numbers(
    program: &Program,
    dialect: &Dialect,
    numbers: Numbers,
    survey: &Survey,
) -> Result<(Vec<(BlockId, TextEdit)>, usize), Obstacle> {
    let most = match dialect.lex.format {
        Format::Osp => MOST_OSP,
        _ if dialect.lex.blanks_in_numbers => MOST_NGC,
        _ => MOST,
    };
    let own: Vec<_> = program
        .blocks()
        .filter(|block| !is_data(&survey.data, block.id().0))
        .filter_map(|block| Some((block.id(), own_number(&block)?.0)))
        .collect();
    // numbers with leading zeros keep their width, but get no more digits than the highest number
    let padded = own.iter().find(|(_, range)| program.bytes(*range).starts_with(b"0"));
    let digits = most.ilog10() + 1;
    let width = padded.map_or(0, |(_, range)| (range.end - range.start).min(digits) as usize);
    let (mut next, mut part) = (i64::from(numbers.start), None);
    let mut new = Vec::with_capacity(own.len());
    for (block, range) in own {
        let here = survey.part_of[block.0 as usize];
        if part.replace(here).is_some_and(|last| last != here) {
            next = i64::from(numbers.start);
        }
        if next > most {
            let why = format!("this block would be N{next}, and N{most} is the highest number; choose a smaller step");
            return Err(Obstacle { range, why });
        }
        let new_text = format!("{next:0width$}");
        new.push((block, TextEdit { range, new_text }));
        next += i64::from(numbers.step.max(1));
    }
    let count = new.len();
    Ok((new, count))
}

impl Survey {
    fn new(program: &Program, dialect: &Dialect) -> Self {
        let mut survey = Self {
            parts: vec![Part {
                name: -1,
                ..Part::default()
            }],
            part_of: Vec::with_capacity(program.block_count()),
            callers: BTreeMap::new(),
            data: data_entries(program, dialect),
            found: Found::default(),
        };
        let split = !program.options().blanks_in_numbers;
        for block in program.blocks() {
            if let Some(name) = begins_program(&block).filter(|_| split) {
                survey.parts.push(Part {
                    name,
                    ..Part::default()
                });
            }
            let at = survey.parts.len() - 1;
            survey.part_of.push(at as u32);
            let calls = survey.found.calls.len();
            read(&block, dialect, &mut survey.found);
            for call in &survey.found.calls[calls..] {
                let callers = survey.callers.entry(call.number).or_default();
                if callers.last() != Some(&at) {
                    callers.push(at);
                }
            }
            if let Some((_, Some(number))) = own_number(&block) {
                survey.parts[at].blocks.entry(number).or_default().push(block.id());
            }
        }
        survey
    }

    /// The block that each reference points to.
    fn resolve(&self, program: &Program) -> Result<Vec<BlockId>, Obstacle> {
        self.found
            .references
            .iter()
            .map(|reference| self.target(program, reference))
            .collect()
    }

    /// Places that may name a block of this file and are not followed.
    fn unread(&self) -> impl Iterator<Item = &Obstacle> {
        let numbers = self.parts.iter().flat_map(|part| part.blocks.keys().copied());
        let numbers: BTreeSet<i64> = numbers.collect();
        let found = self.found.unread.iter();
        found
            .filter(move |unread| {
                let exists = |number| numbers.contains(&number);
                unread.number.map_or(!numbers.is_empty(), exists)
            })
            .map(|unread| &unread.obstacle)
    }

    fn target(&self, program: &Program, reference: &Reference) -> Result<BlockId, Obstacle> {
        let own = self.part_of[reference.block.0 as usize] as usize;
        let callers = if reference.of_caller { self.callers(own) } else { &[] };
        let places = if callers.is_empty() { &[own] } else { callers };
        let number = reference.number;
        let refuse = |what: String| {
            let block = program.text(program.block(reference.block).range()).trim().to_owned();
            Err(Obstacle {
                range: reference.digits,
                why: format!("`{block}`: {what}"),
            })
        };
        let mut target = None;
        for part in places {
            match self.parts[*part].blocks.get(&number).map(Vec::as_slice) {
                None if reference.of_caller => {
                    return refuse(format!(
                        "no program of this file that calls this one contains N{number}"
                    ));
                }
                None => return refuse(format!("block N{number} does not exist in this program")),
                Some([block]) if is_data(&self.data, block.0) => {
                    return refuse(format!(
                        "N{number} is a number of data between G10 and G11, and no block"
                    ));
                }
                Some([block]) => {
                    if target.replace(*block).is_some_and(|other| other != *block) {
                        return refuse(format!("several programs call this one and have a block N{number}"));
                    }
                }
                Some(_) => {
                    return refuse(format!(
                        "N{number} exists more than once, so it is not certain which one is meant"
                    ));
                }
            }
        }
        match target {
            Some(block) => Ok(block),
            None => refuse(format!("block N{number} does not exist")),
        }
    }

    /// Programs of the file that call a part.
    fn callers(&self, part: usize) -> &[usize] {
        let name = Some(self.parts[part].name).filter(|name| *name >= 0);
        name.and_then(|name| self.callers.get(&name)).map_or(&[], Vec::as_slice)
    }

    fn called_outside(&self) -> Vec<i64> {
        let names: BTreeSet<i64> = self.parts.iter().map(|part| part.name).collect();
        let inside = |number: &i64| names.contains(number);
        let mut outside: Vec<i64> = self
            .found
            .calls
            .iter()
            .map(|call| call.number)
            .filter(|number| !inside(number))
            .collect();
        outside.sort_unstable();
        outside.dedup();
        outside
    }
}
