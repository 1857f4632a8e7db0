//! What a block does apart from its motions, in the words that other languages use for the same.
use super::Klartext;
use super::words::{Said, Word, Words};
use crate::tools::Chosen;
use crate::{Argument, Effect, MotionKind, Reach};
use trunnion_syntax::{BlockId, Program};

/// First words of blocks that are in the motions and the modal state, or that do nothing.
const HELD: [&str; 22] = [
    "L", "LN", "C", "CR", "CT", "LP", "CP", "CTP", "CC", "RND", "APPR", "DEP", "TOOL", "PLANE", "BEGIN", "END", "LBL",
    "CALL", "FN", "BLK", "STOP", "CYCL",
];

/// M codes that are in the motions, or in effects of their own.
const CODES: [u32; 20] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 14, 30, 89, 91, 92, 99, 126, 127, 128];

/// The setting of M128 F.
const COMPENSATING_FEED: &str = "feed of compensating motions";

impl Klartext<'_> {
    #[cold]
    pub(crate) fn block_effects(&mut self, text: &[u8], block: BlockId, other: bool, skips: bool) {
        let own = block;
        let block = self.core.main_block(block);
        let mut words = Words::new(text);
        let Some(first) = words.next() else { return };
        let name = String::from_utf8_lossy(first.name()).into_owned();
        let mut unmodelled = other;
        let mut after = Vec::new();
        self.surface_normal(&first, words.clone(), block);
        if first.is("TOOL") {
            self.tool_effects(words.clone(), block);
        } else if first.is("STOP") {
            // no source says whether the spindle stops
            after.extend([Effect::Event(vec![Argument::code("STOP")]), Effect::left("spindle")]);
        } else if first.is("CYCL") || first.is("CYCLE") {
            unmodelled |= self.cycle_effects(text, block);
        } else if first.is("TRANS") && words.clone().next().is_some_and(|word| word.is("DATUM")) {
            // a shift is in the motions; a form that is not followed has said so
        } else if let Said::Parameter(_, target) = first.value {
            // known values are compared where they are used; those that outlive the program at its end
            unmodelled |= !first.name().is_empty() || !self.memory.parameters.is_known(target);
        } else if first.is("FN") {
            // `FN 1: Q5 = ...`
            let target = words.clone().find_map(|word| match word.value {
                Said::Parameter(_, target) if word.name().is_empty() => Some(target),
                _ => None,
            });
            unmodelled |= target.is_some_and(|target| !self.memory.parameters.is_known(target));
        } else if !HELD.contains(&name.as_str()) && !is_words(&name) {
            unmodelled = true;
        }
        words.at = 0;
        while let Some(word) = words.next() {
            let code = word.is("M").then(|| self.memory.parameters.of(word.value)).flatten();
            let Some(code) = code.map(|code| code as u32) else {
                continue;
            };
            self.code_effects(code, block, &mut after, &mut unmodelled);
            match code {
                128 => unmodelled |= !self.compensating_feed(words.clone(), block),
                129 => self.core.effects.add(block, Effect::set(COMPENSATING_FEED, [])),
                _ => {}
            }
        }
        // what begins with the block acts before its motions
        let begun = self.core.effects.count();
        for motion in self.out.iter_mut().filter(|motion| motion.block == own) {
            motion.effects = begun;
        }
        let unknown = self.out.iter().any(|motion| {
            matches!(
                motion.kind,
                MotionKind::Arc(None) | MotionKind::Unknown | MotionKind::Dwell(None)
            ) || motion.says_way & !motion.end.known != 0
        });
        // a block that the operator may skip
        let may_skip = skips && self.core.setup.control.block_delete.is_none();
        if unmodelled || unknown || may_skip {
            let canonical = canonical_words(text);
            let mut arguments = vec![Argument::text("", &canonical)];
            self.add_read(text, &mut arguments);
            self.core.effects.add(block, Effect::Unmodelled(arguments));
        }
        for effect in after {
            // the control goes on from where it was
            self.core.effects.add_with(block, effect, Reach::Itself);
        }
        if self.core.state.ended {
            let end = Effect::End(vec![Argument::code("M30")]);
            self.core.effects.add(block, end);
        }
    }

    /// M128 F: how fast the linear axes may move to keep the tip in its place (TNC 640 user's manual, M128). Whether its F is known.
    fn compensating_feed(&mut self, mut words: Words<'_>, block: BlockId) -> bool {
        let Some(feed) = words.next().filter(|word| word.is("F")) else {
            return true;
        };
        let unit = self.core.state.coordinates.unit_mm();
        let Some(feed) = self.memory.parameters.of(feed.value) else {
            return false;
        };
        let to = [Argument::number("mm/min", feed * unit)];
        self.core.effects.add(block, Effect::set(COMPENSATING_FEED, to));
        true
    }

    fn code_effects(&mut self, code: u32, block: BlockId, after: &mut Vec<Effect>, unmodelled: &mut bool) {
        let on = || [Argument::code("on")];
        let effects = &mut self.core.effects;
        match code {
            3 | 13 => effects.add(block, Effect::set("spindle", [Argument::code("M3")])),
            4 | 14 => effects.add(block, Effect::set("spindle", [Argument::code("M4")])),
            5 => after.push(Effect::set("spindle", [Argument::code("M5")])),
            _ => {}
        }
        match code {
            8 | 13 | 14 => effects.add(block, Effect::set("flood coolant", on())),
            7 => effects.add(block, Effect::set("mist coolant", on())),
            9 => {
                after.push(Effect::set("flood coolant", []));
                after.push(Effect::set("mist coolant", []));
            }
            0 => after.extend(stop()),
            1 => after.extend([Effect::Event(vec![Argument::code("M1")]), Effect::left("spindle")]),
            6 => after.extend([Effect::Event(vec![Argument::code("M6")]), Effect::left("spindle")]),
            _ => {}
        }
        *unmodelled |= !CODES.contains(&code) && !matches!(code, 129 | 136 | 137 | 140);
    }

    /// Deltas of the tool table act along it.
    fn surface_normal(&mut self, first: &Word<'_>, words: Words<'_>, block: BlockId) {
        let mut normal = Vec::new();
        // NX of PLANE VECTOR is a normal of the plane
        for word in words.filter(|_| first.name() == b"LN") {
            if let name @ (b"NX" | b"NY" | b"NZ") = word.name() {
                let name = String::from_utf8_lossy(name).into_owned();
                normal.push(match self.memory.parameters.of(word.value) {
                    Some(value) => Argument::number(name, value),
                    None => Argument::text(name, "unknown"),
                });
            }
        }
        let path = matches!(
            first.name(),
            b"L" | b"LN" | b"C" | b"CR" | b"CT" | b"LP" | b"CP" | b"CTP"
        );
        let has = !normal.is_empty();
        if has || path && self.memory.had_normal {
            self.core.effects.add(block, Effect::set("surface normal", normal));
            self.memory.had_normal = has;
        }
    }

    /// The values of the parameters that a block reads: those that it names, and all of them where a file of masks names them (FN 16).
    fn add_read(&self, text: &[u8], arguments: &mut Vec<Argument>) {
        let parameters = &self.memory.parameters;
        let mut words = Words::new(text);
        let prints = words
            .next()
            .is_some_and(|first| first.is("FN") && first.value == Said::Number(16.0));
        if prints {
            return arguments.extend(parameters.arguments());
        }
        for word in Words::new(text) {
            let Said::Parameter(_, parameter) = word.value else {
                continue;
            };
            if let Some(value) = parameters.get(parameter) {
                arguments.push(Argument::number(parameter.to_string(), value));
            } else if let Some(text) = parameters.text(parameter) {
                arguments.push(Argument::text(parameter.to_string(), text));
            }
        }
    }

    fn tool_effects(&mut self, mut words: Words<'_>, block: BlockId) {
        let Some(kind) = words.next() else { return };
        let named = kind.is("CALL")
            && (kind.value != Said::Nothing
                || words.clone().next().is_some_and(|word| {
                    let names = matches!(word.value, Said::Text(_) | Said::Parameter(..));
                    names && word.name().is_empty()
                }));
        let by_text = words.clone().next().and_then(|word| match word.value {
            Said::Parameter(_, parameter) => self.memory.parameters.text(parameter),
            _ => None,
        });
        let unread = by_text.unwrap_or("unknown").to_owned();
        let effects = &mut self.core.effects;
        if named {
            let tool = match self.core.tools.in_spindle() {
                Chosen::Number(number) => Argument::number("T", f64::from(*number)),
                Chosen::Named(name) => Argument::text("T", name),
                Chosen::Nothing | Chosen::Unread => Argument::text("T", &unread),
            };
            effects.add(block, Effect::set("tool prepared", [tool.clone()]));
            effects.add(block, Effect::set("tool in use", [tool]));
            effects.add(block, Effect::Event(vec![Argument::code("tool change")]));
            // whether the spindle stops where the tool is in it already is left to the machine
            effects.add(block, Effect::left("spindle"));
        }
        if kind.is("DEF") {
            return self.definition_effects(kind.value, words, block);
        }
        let effects = &mut self.core.effects;
        let mut deltas = Vec::new();
        for word in words {
            match (word.name(), self.memory.parameters.of(word.value)) {
                (b"S", Some(speed)) if kind.is("CALL") => {
                    effects.add(block, Effect::set("speed", [Argument::number("S", speed)]));
                }
                (name @ (b"DL" | b"DR" | b"DR2"), Some(value)) if value != 0.0 => {
                    deltas.push(Argument::number(String::from_utf8_lossy(name).into_owned(), value));
                }
                (name @ (b"DL" | b"DR" | b"DR2"), None) => {
                    deltas.push(Argument::text(String::from_utf8_lossy(name).into_owned(), "unknown"));
                }
                _ => {}
            }
        }
        deltas.sort_by(|a, b| a.name.cmp(&b.name));
        if kind.is("CALL") {
            effects.add(block, Effect::set("tool deltas", deltas));
        }
    }

    /// The first block of a program is BEGIN PGM and the last one END PGM (HEIDENHAIN TNC 620, Klartext programming 10/2017, p. 154): what the control
    /// does with a text that has only some of them is not known.
    #[cold]
    pub(crate) fn head_effects(&mut self, main: &Program) {
        let all = || (0..main.block_count() as u32).map(BlockId);
        let first = all().find_map(|id| main.block(id).sentence());
        let last = all().rev().find_map(|id| main.block(id).sentence());
        if first.is_none() {
            // blank lines are no program, and do nothing
            return;
        }
        let is = |sentence: Option<trunnion_syntax::Sentence<'_>>, name: &str| {
            sentence.is_some_and(|sentence| {
                let text = sentence.text();
                let mut words = Words::new(&text);
                let first = words.next().is_some_and(|word| word.is(name));
                first && words.next().is_some_and(|word| word.is("PGM"))
            })
        };
        for (is_there, what) in [
            (is(first, "BEGIN"), "a program without BEGIN PGM"),
            (is(last, "END"), "a program without END PGM"),
        ] {
            if !is_there {
                let effect = Effect::Unmodelled(vec![Argument::code(what)]);
                self.core.effects.add_with(BlockId(0), effect, Reach::Itself);
            }
        }
    }

    /// TOOL DEF prepares a tool; with L and R it writes the data of one, which its next call reads.
    fn definition_effects(&mut self, number: Said<'_>, words: Words<'_>, block: BlockId) {
        let unit = self.core.state.coordinates.unit_mm();
        let said = |name: &'static str, value: Option<f64>| match value {
            Some(value) => Argument::number(name, value),
            None => Argument::text(name, "unknown"),
        };
        let tool = said("T", self.memory.parameters.of(number));
        let mut data = Vec::new();
        for word in words {
            let name = match word.name() {
                b"L" => "L",
                b"R" => "R",
                _ => continue,
            };
            data.push(said(
                name,
                self.memory.parameters.of(word.value).map(|value| value * unit),
            ));
        }
        if data.is_empty() {
            self.core.effects.add(block, Effect::set("tool prepared", [tool]));
            return;
        }
        data.sort_by(|a, b| a.name.cmp(&b.name));
        let words = [Argument::code("TOOL DEF"), tool].into_iter().chain(data);
        self.core
            .effects
            .add_with(block, Effect::Event(words.collect()), Reach::Itself);
    }

    /// Whether more than the motions of holes and the frames hold is in the block.
    fn cycle_effects(&mut self, text: &[u8], block: BlockId) -> bool {
        use super::hole::Cycle;
        let upper = text.to_ascii_uppercase();
        let defines = upper.windows(3).any(|found| found == b"DEF");
        if !defines {
            return false;
        }
        let to: Vec<Argument> = match &self.memory.cycle {
            Cycle::Hole(hole) if hole.taps() => {
                let pitch = hole.pitch.map(|pitch| Argument::number("pitch", pitch));
                std::iter::once(Argument::code("tap")).chain(pitch).collect()
            }
            _ => Vec::new(),
        };
        self.core.effects.add(block, Effect::set("cycle", to));
        // tolerances, oriented stops, contours, and cycles whose words are not read
        let digits = upper
            .iter()
            .skip_while(|byte| !byte.is_ascii_digit())
            .take_while(|byte| byte.is_ascii_digit());
        let number = digits.fold(0u32, |all, digit| {
            all.saturating_mul(10).saturating_add(u32::from(digit - b'0'))
        });
        match &self.memory.cycle {
            Cycle::Hole(hole) if number >= 200 && number == hole.cycle => !self.is_followed(hole),
            _ => !matches!(number, 7..=11 | 19 | 26 | 247),
        }
    }
}

/// The words of a block, each as it is compared, with one blank between them.
fn canonical_words(text: &[u8]) -> String {
    let mut words = Words::new(text);
    let (mut said, mut from) = (Vec::new(), 0);
    loop {
        let more = words.next().is_some();
        let to = if more { words.at } else { text.len() };
        let word = crate::written::packed(&String::from_utf8_lossy(text.get(from..to).unwrap_or_default()));
        // numbers in one spelling; `=`: NX is no block number here, and brackets are no comments
        let word = match crate::canonical_text(&format!("={word}")).strip_prefix('=') {
            Some(same) if !word.contains(['(', ')', ';']) => same.to_owned(),
            _ => word,
        };
        if !word.is_empty() {
            said.push(word);
        }
        if !more {
            return said.join(" ");
        }
        from = to;
    }
}

/// M0: the spindle and the coolant stop as well.
fn stop() -> [Effect; 4] {
    [
        Effect::Event(vec![Argument::code("M0")]),
        Effect::set("spindle", [Argument::code("M5")]),
        Effect::set("flood coolant", []),
        Effect::set("mist coolant", []),
    ]
}

/// Words that may stand alone in a block: axes, F, M, R.
fn is_words(name: &str) -> bool {
    matches!(
        name,
        "X" | "Y"
            | "Z"
            | "A"
            | "B"
            | "IX"
            | "IY"
            | "IZ"
            | "IA"
            | "IB"
            | "IC"
            | "F"
            | "FMAX"
            | "M"
            | "R"
            | "U"
            | "V"
            | "W"
    )
}
