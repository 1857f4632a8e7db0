// HEIDENHAIN Klartext for editors: blocks, their first words, and what follows as words with values. What a block means, and which
// words belong into it, is for the language server; ../../src/syntax/klartext.rs is the lexer of Trunnion.

/** A keyword in any case, compared with whole names. */
const word = (text) => {
  const letters = [...text].map((letter) => `[${letter}${letter.toLowerCase()}]`);
  return alias(token(prec(1, new RegExp(letters.join('')))), text);
};

const PATHS = ['L', 'C', 'CR', 'CT', 'CP', 'CTP', 'LP', 'LN', 'RND', 'CHF', 'APPR', 'DEP', 'FL', 'FC', 'FLT', 'FCT', 'FPOL'];

module.exports = grammar({
  name: 'klartext',

  // "~" at the end of a line: the block goes on in the next
  extras: ($) => [/[ \t\x01-\x08\x0B\x0C\x0E-\x1F\x7F\uFEFF]/, /~[ \t]*(\r?\n|\r)/, $.comment],
  word: ($) => $._name,

  rules: {
    program: ($) => seq(repeat(seq(optional($.block), $._newline)), optional($.block)),
    _newline: () => /\r?\n|\r/,

    block: ($) =>
      choice(
        seq($._prefix, optional(choice($._statement, $.heading, alias($.whole_comment, $.comment)))),
        $._statement, $.heading, alias($.whole_comment, $.comment),
      ),
    _prefix: ($) => choice(seq($.skip, optional($.block_number)), $.block_number),
    skip: () => token(prec(1, '/')),
    block_number: () => token(prec(1, /[0-9]+/)),
    heading: () => token(prec(2, /\*([^\r\n~]|~[^\r\n])*/)),
    // a comment that is a block of its own goes on behind "~"
    whole_comment: () => token(prec(2, /;([^\r\n~]|~[^\r\n]|~(\r\n|\n|\r))*/)),
    comment: () => /;[^\r\n~]*/,

    _statement: ($) => choice($.program_mark, $.path, $.tool, $.cycle, $.label, $.call, $.function, $.assignment, $.statement),

    program_mark: ($) => seq(choice(word('BEGIN'), word('END')), word('PGM'), alias($._to_end, $.text)),
    _to_end: () => token(prec(-1, /[^\r\n;~ \t][^\r\n;~]*/)),
    path: ($) => prec.right(seq(field('kind', $.kind), repeat($._item))),
    kind: () => choice(...PATHS.map(word)),
    tool: ($) => prec.right(seq(word('TOOL'), choice(word('CALL'), word('DEF')), repeat($._item))),
    cycle: ($) => prec.right(seq(choice(word('CYCL'), word('CYCLE')), choice(word('DEF'), word('CALL')), repeat($._item))),
    label: ($) => prec.right(seq(word('LBL'), $._label_name)),
    _label_name: ($) => prec(2, choice($.number, $.string, $.parameter)),
    call: ($) => prec.right(seq(word('CALL'), choice(seq(word('LBL'), $._label_name), word('PGM')), repeat($._item))),
    // FN 12: IF +Q1 LT +5 GOTO LBL 1
    function: ($) => prec.right(seq(word('FN'), optional($.number), ':', repeat($._item))),
    assignment: ($) => prec.right(2, seq(field('target', $.parameter), '=', repeat($._item))),
    // CC, BLK FORM, PLANE, FUNCTION, STOP, M words, TCH PROBE, and whatever else a control has
    statement: ($) => prec.right(-1, repeat1($._item)),

    _item: ($) =>
      choice($.word, $.number, $.parameter, $.string, $.group, $.file, $.jump, $._operator, $.joined_word),
    word: ($) => prec.right(1, seq(field('letter', alias($._name, $.name)), optional(field('value', choice($.number, $._signed, $.sign))))),
    _signed: ($) => prec(1, seq(choice('+', '-'), $.parameter)),
    sign: () => prec(-1, choice('+', '-')),
    // FQ207, IDXQ3: a word whose value is a parameter
    joined_word: () => token(prec(1, /[A-PR-Za-pr-z][A-Za-z]*[Qq][LlRrSs]?[0-9]+/)),
    jump: ($) => prec.right(seq(word('GOTO'), word('LBL'), $._label_name)),
    group: ($) => seq('(', repeat($._item), ')'),
    _operator: () => choice('=', '*', '/', '^', ':', ',', '.', '<', '>', '!', '%', '#', '|', '&', '?', "'", '\\', '[', ']', '+', '-'),

    _name: () => /[A-Za-z_\u00C0-\u024F\uFFFD]+/,
    parameter: () => token(prec(1, /[Qq][LlRrSs]?[ ]*[0-9]+/)),
    number: () => token(choice(/[+-]?[0-9]+([.,][0-9]*)?/, /[+-]?[.,][0-9]+/)),
    string: () => token(choice(/"[^"\r\n]*"/, /'[^'\r\n]*'/)),
    // TNC:\folder\part.h
    file: () => token(prec(1, /[A-Za-z]+:\\[^\r\n;~ ]*/)),
  },
});
