//! Frames in remarks: `$$*CATIA0`, a name and three rows of four numbers; `$$-> CSYS /` with twelve.
//!
//! Sources: CATIA V5 help, APT import (the rows are the machining axis system in the absolute one) and Machining Axis Change (points are
//! written in the current system); Creo Pro/CLfile output for the form of `$$-> CSYS`.
use crate::apt::Apt;
use crate::{Fault, FaultKind, Sink};
use trunnion_syntax::{Block, TextRange};

/// The rows of a machining axis that were read so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Started {
    is_named: bool,
    numbers: Vec<f64>,
}

/// The numbers of a text, separated by blanks, commas and continuation signs; `None`: something else is there.
fn numbers(text: &str) -> Option<Vec<f64>> {
    let parts = text.split(|sign: char| sign.is_whitespace() || sign == ',' || sign == '$');
    parts
        .filter(|part| !part.is_empty())
        .map(|part| part.parse::<f64>().ok().filter(|value| value.is_finite()))
        .collect()
}

impl Apt<'_> {
    /// The remarks of a block, as far as they hold frames.
    pub(crate) fn frame_remarks(&mut self, block: &Block<'_>, sink: &mut impl Sink) {
        for comment in block.comments() {
            let text = block.program().text(comment.range).trim().to_ascii_uppercase();
            let Some(inside) = text.strip_prefix("$$") else {
                continue;
            };
            let why = self.frame_remark(inside);
            say_remark(why, comment.range, block, sink);
        }
        if self.kept.remark.is_some() && block.record().is_some() {
            self.kept.remark = None;
            self.machining_axis(None);
            say_remark(
                Some("$$*CATIA0 without its three rows of four numbers"),
                block.range(),
                block,
                sink,
            );
        }
    }

    /// What of a remark is not known.
    fn frame_remark(&mut self, text: &str) -> Option<&'static str> {
        if text.starts_with("*CATIA0") {
            self.kept.remark = Some(Started::default());
            return None;
        }
        if let Some(system) = text
            .strip_prefix("->")
            .map(str::trim)
            .and_then(|text| text.strip_prefix("CSYS"))
        {
            let system = system.trim_start().strip_prefix('/').and_then(numbers);
            let plain = self.creo_system(system.as_deref());
            return (!plain).then_some("$$-> CSYS: whether the points after it are in this system or in the machine's");
        }
        let started = self.kept.remark.as_mut()?;
        match numbers(text) {
            Some(row) if row.len() == 4 => started.numbers.extend(row),
            _ if !started.is_named && started.numbers.is_empty() => started.is_named = true,
            _ => {
                self.kept.remark = None;
                self.machining_axis(None);
                return Some("$$*CATIA0 without its three rows of four numbers");
            }
        }
        if started.numbers.len() == 12 {
            let rows = self.kept.remark.take()?.numbers;
            let known = self.machining_axis(Some(&rows));
            return (!known).then_some("$$*CATIA0: its rows are no right-handed system");
        }
        None
    }
}

/// Reports what of a remark is not known.
fn say_remark(why: Option<&str>, range: TextRange, block: &Block<'_>, sink: &mut impl Sink) {
    if let Some(why) = why {
        let what = why.to_owned();
        sink.fault(Fault {
            place: None,
            block: block.id(),
            range,
            kind: FaultKind::NotModelled { what },
        });
    }
}
