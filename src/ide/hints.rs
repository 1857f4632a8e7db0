//! Hints between the words: values of expressions, what is in effect where a tool begins, and the time that its operation takes.
use crate::{Node, NodeKind};
use trunnion_check::{BlockInfo, Session, Settings, Variables};
use trunnion_dialect::Language;
use trunnion_formula::{Cursor, Formula, Grammar, Name, ValueError, value};
use trunnion_interp::{FeedMode, ModalState};
use trunnion_syntax::{Address, Block, BlockId, Program, TextRange, Value};

/// So many blocks are described for the hints of one range, no more.
const MOST_DESCRIBED: usize = 400;

/// No more are once these have cost so much: blocks that ran again, and entries of lists that were copied. Where programs declare hundreds of
/// thousands of tools or variables one block costs as much as hundreds do elsewhere.
const MOST_COST: u64 = 5_000_000;

/// What a hint says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HintKind {
    /// The value of an expression.
    Value,
    /// What is in effect.
    Modal,
}

/// One hint: text that is shown behind a byte.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hint {
    /// Where.
    pub at: u32,
    /// What it says.
    pub text: String,
    /// What kind.
    pub kind: HintKind,
}

/// The hints of a range of bytes.
pub fn hints(
    program: &Program,
    settings: &Settings<'_>,
    session: &Session,
    outline: &[Node],
    range: TextRange,
    wanted: &dyn Fn(HintKind) -> bool,
) -> Vec<Hint> {
    let (Some(first), Some(last)) = (
        program.block_at(range.start),
        program.block_at(range.end.min(program.source().len() as u32)),
    ) else {
        return Vec::new();
    };
    let mut starts = Vec::new();
    operations(outline, &mut starts);
    starts.sort_unstable();
    let mut found = Vec::new();
    let (mut described, mut cost) = (0, 0);
    for id in (first.0..=last.0).map(BlockId) {
        let block = program.block(id);
        let computed = wanted(HintKind::Value) && has_expression(&block);
        let begins = wanted(HintKind::Modal) && starts.binary_search(&block.range().start).is_ok();
        if !(computed || begins) || !session.reaches(id) {
            continue;
        }
        if described == MOST_DESCRIBED || cost > MOST_COST {
            break;
        }
        let info = session.describe(program, settings, id);
        (described, cost) = (described + 1, cost + info.cost);
        if !info.runs {
            continue;
        }
        if computed {
            values(program, settings, &block, &info, &mut found);
        }
        if begins {
            let end = block.range().start + program.bytes(block.range()).trim_ascii_end().len() as u32;
            found.push(Hint {
                at: end,
                text: in_effect(&info.after),
                kind: HintKind::Modal,
            });
        }
    }
    found.sort_by_key(|hint| hint.at);
    found
}

fn operations(nodes: &[Node], starts: &mut Vec<u32>) {
    for node in nodes {
        if node.kind == NodeKind::Operation {
            starts.push(node.range.start);
        }
        operations(&node.children, starts);
    }
}

/// Unit, distance mode, zero point and feed mode in words.
fn in_effect(state: &ModalState) -> String {
    let unit = if state.coordinates.unit_mm() == 1.0 {
        "mm"
    } else {
        "inch"
    };
    let sense = if state.coordinates.incremental() {
        "incremental"
    } else {
        "absolute"
    };
    let offset = state.zero.offset().unwrap_or("no work offset");
    let feed = match state.feed.mode() {
        FeedMode::PerMinute => "per minute",
        FeedMode::PerRevolution => "per revolution",
        FeedMode::InverseTime => "inverse time",
    };
    let tcp = if state.tool_axis.tcp() { ", TCP" } else { "" };
    format!("{unit}, {sense}, {offset}, feed {feed}{tcp}")
}

fn has_expression(block: &Block<'_>) -> bool {
    let bytes = block.program().bytes(block.range());
    bytes.iter().any(|byte| matches!(byte, b'#' | b'='))
        && block.words().any(|word| matches!(word.value, Value::Expression(_)))
}

/// The value behind each computed word. An assignment shows what the variable is afterwards.
fn values(program: &Program, settings: &Settings<'_>, block: &Block<'_>, info: &BlockInfo, found: &mut Vec<Hint>) {
    let grammar = match settings.dialect.quirks.language {
        Language::Linuxcnc | Language::Words => Grammar::Rs274,
        Language::MacroB => Grammar::MacroB,
        Language::Sinumerik | Language::UserTask => {
            return sinumerik(program, block, info, found);
        }
    };
    for word in block.words() {
        let Value::Expression(range) = word.value else { continue };
        let number = match assigned(program, &word.address) {
            Some(name) => info.variables.value(&name)[1],
            None => value(&mut Cursor::new(program.source(), range), grammar)
                .ok()
                .and_then(|formula| evaluate(&formula, &info.variables)),
        };
        push(number, word.range, found);
    }
}

fn sinumerik(program: &Program, block: &Block<'_>, info: &BlockInfo, found: &mut Vec<Hint>) {
    for word in block.words() {
        let Value::Expression(range) = word.value else { continue };
        let number = match word.address {
            Address::Indexed(letter, number) => info.variables.value(&format!("{}{number}", char::from(letter)))[1],
            Address::Letter(_) | Address::Named(_) => info.variables.value(program.text(range).trim())[0],
        };
        push(number, word.range, found);
    }
}

/// The variable that a word assigns, as it is written.
fn assigned(program: &Program, address: &Address) -> Option<String> {
    match address {
        Address::Named(range) => Some(program.text(*range).trim().trim_end_matches('=').trim().to_owned())
            .filter(|text| text.starts_with('#')),
        _ => None,
    }
}

fn push(value: Option<f64>, range: TextRange, found: &mut Vec<Hint>) {
    if let Some(value) = value.filter(|value| value.is_finite()) {
        found.push(Hint {
            at: range.end,
            text: format!("= {}", plain(value)),
            kind: HintKind::Value,
        });
    }
}

/// A number as people write it, six decimals at most.
fn plain(value: f64) -> String {
    let digits = format!("{value:.6}");
    match digits.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_owned(),
        digits => digits.to_owned(),
    }
}

struct Before<'v>(&'v Variables);

impl trunnion_formula::Variables for Before<'_> {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        self.0.value(&format!("#{index}"))[0].ok_or(ValueError::NotDefined)
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        self.0.value(&format!("#<{name}>"))[0].ok_or(ValueError::NotDefined)
    }
    fn named_as(&self, name: &Name) -> Result<f64, ValueError> {
        self.named(name)
    }
    fn exists(&self, name: &str) -> bool {
        self.named(name).is_ok()
    }
}

fn evaluate(formula: &Formula, variables: &Variables) -> Option<f64> {
    formula.eval(&Before(variables)).ok()
}
