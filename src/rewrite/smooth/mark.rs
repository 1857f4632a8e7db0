//! The comment that records how far tool axes were turned: `trunnion: turned DEG`. Without it, each further run could turn them by the whole
//! tolerance again.
use trunnion_interp::turned_deg;
use trunnion_syntax::{BlockId, Format, Program, TextEdit, TextRange};

/// What the comments of a program say: the first byte of each block that has one, and the angle, deg.
pub(crate) struct Marks(Vec<(u32, f64)>);

impl Marks {
    /// Of a whole program.
    pub(crate) fn of(program: &Program) -> Self {
        let found = trunnion_interp::directives(program).into_iter();
        Self(
            found
                .filter_map(|(range, directive)| match directive {
                    trunnion_interp::Directive::Turned(deg) => Some((range.start, deg)),
                    _ => None,
                })
                .collect(),
        )
    }

    /// The largest angle that is recorded in the blocks `first..=last`, deg, and where.
    pub(crate) fn within(&self, program: &Program, first: BlockId, last: BlockId) -> Option<(u32, f64)> {
        let (start, end) = (program.block(first).range().start, program.block(last).range().end);
        let at = self.0.partition_point(|&(byte, _)| byte < start);
        let inside = self.0[at..].iter().take_while(|&&(byte, _)| byte <= end);
        inside.copied().max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// The edit that records `deg` at the first of the blocks that has room for a comment: one that ends its line and has no other, unless
/// comments are bracketed.
pub(crate) fn mark(program: &Program, blocks: impl Iterator<Item = BlockId>, deg: f64) -> Option<TextEdit> {
    let options = program.options();
    let (open, close) = if options.format == Format::Apt {
        ("$$ ", "")
    } else if options.paren_comment {
        // a semicolon is read as a comment too where it ends the block on the control
        ("(", ")")
    } else if options.semicolon_comment {
        ("; ", "")
    } else {
        return None;
    };
    let text = format!("{open}trunnion: turned {deg}{close}");
    let edit = |id: BlockId| {
        let block = program.block(id);
        let known = block
            .comments()
            .find(|comment| turned_deg(&program.text(comment.inner)).is_some());
        if let Some(comment) = known {
            return Some(TextEdit {
                range: comment.range,
                new_text: text.clone(),
            });
        }
        let end = block.range().end;
        let ends_line = matches!(program.source().get(end as usize), None | Some(b'\n' | b'\r'));
        let free =
            block.comments().next().is_none() || close == ")" && program.source()[..end as usize].ends_with(b")");
        (ends_line && free).then(|| TextEdit {
            range: TextRange::new(end, end),
            new_text: format!(" {text}"),
        })
    };
    blocks.into_iter().find_map(edit)
}
