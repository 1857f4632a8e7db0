//! What a Klartext block contains apart from motions.
use crate::comments::comment;
use crate::events::{BlockEvents, Cannot};
use trunnion_interp::{SentenceWord, sentence_words};
use trunnion_syntax::Block;

/// The events of a block.
pub(crate) fn said(block: &Block<'_>) -> Result<BlockEvents, Cannot> {
    let mut said = BlockEvents::default();
    let program = block.program();
    let sentence = block.sentence();
    let text = sentence.as_ref().map(trunnion_syntax::Sentence::text);
    let words: Vec<SentenceWord> = text.iter().flat_map(|text| sentence_words(text)).collect();
    let first = words.first().map_or("", |word| word.name.as_str());
    // in cycles comments are the names of the parameters
    if !matches!(first, "CYCL" | "CYCLE") {
        for found in block.comments() {
            said.before.extend(comment(&program.text(found.inner)));
        }
    }
    let Some(sentence) = sentence else { return Ok(said) };
    if sentence.skips {
        let message = "block delete: whether the block runs depends on a switch; remove the `/` or the block";
        return Err((sentence.range, message.to_owned()));
    }
    match first {
        "TOOL" => {
            let call = words.get(1).filter(|word| word.name == "CALL");
            // TOOL CALL "NAME" Z: the text is a word without a name
            let named = words.get(2).is_some_and(|word| word.name.is_empty());
            said.tool_change = call.is_some_and(|call| call.has_value || named);
        }
        "BEGIN" => {
            let text = program.text(sentence.range);
            let name = text
                .split_whitespace()
                .nth(2)
                .filter(|name| !["MM", "INCH"].contains(name));
            said.name = name.map(str::to_owned);
        }
        _ => {}
    }
    Ok(said)
}
