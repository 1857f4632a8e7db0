// G-code for editors: ISO 6983 and the languages that controls built on it (Fanuc Macro B, LinuxCNC, Sinumerik, Okuma OSP, grbl, Marlin).
//
// One grammar for all of them, because the extension of a file rarely says which control it is for. What a code means is not decided
// here but by the dialect tables (../dialects); the lexer and parser of Trunnion are ../../src/syntax.
//
// A bracket "(" opens arguments directly after a name, and an expression where a value is expected; anywhere else it opens a comment.

const PREC = { or: 1, and: 2, compare: 3, add: 4, multiply: 5, power: 6, unary: 7 };

/**
 * A keyword in any case: "IF" matches if, If, IF. It is shown as the anonymous node "IF". The precedence makes the generator compare it
 * with whole names: DO is no part of DOOR.
 */
const word = (text) => {
  const letters = [...text].map((letter) => (/[A-Z]/.test(letter) ? `[${letter}${letter.toLowerCase()}]` : letter));
  return alias(token(prec(1, new RegExp(letters.join('')))), text);
};

const list = (separator, rule) => seq(optional(rule), repeat(seq(separator, optional(rule))));

/** A name; its digits are a token of their own, so that GOTO10 is a jump and END1 an end. */
const identifier = ($) =>
  choice(seq($._name, optional(token.immediate(/[0-9][A-Za-z0-9_]*/))), token(/[A-Za-z][0-9]+_[A-Za-z0-9_]*/));

module.exports = grammar({
  name: 'gcode',

  extras: ($) => [/[ \t\x01-\x08\x0B\x0C\x0E-\x1F\x7F\uFEFF]/, $.comment],

  // src/scanner.c
  externals: ($) => [$.comment, $._open, $._call_open, $._recovery],

  word: ($) => $._name,

  // `o1 while` inside `o1 do` closes it, or begins a loop of its own: what follows decides.
  conflicts: ($) => [[$.o_do, $.o_while]],

  rules: {
    program: ($) => seq(repeat($._line), optional(choice($.block, $._structure))),

    _line: ($) => choice($._newline, seq(choice($.block, $._structure), $._newline)),
    _newline: () => /\r?\n|\r/,

    // ---- blocks

    block: ($) => choice(seq($._prefix, repeat($._item)), repeat1($._item), seq(optional($._prefix), choice($.tape_mark, $.message))),
    _prefix: ($) => repeat1(choice($.skip, $.block_number, $.continuation)),
    continuation: () => '$', // Okuma: the block goes on from the line before
    skip: () => token(seq('/', optional(/[0-9]/))),
    block_number: ($) => prec(1, seq(alias(/[Nn]/, $.letter), $.number)),
    // `%`, `%_N_PART_MPF`, `%O1234`, `$PART.MIN%`: what stands behind the mark is text
    tape_mark: () => token(prec(1, choice(/%[^\r\n(;]*/, /\$[A-Za-z0-9][^%\r\n]*%/))),
    // M117 and M118 (Marlin) show the rest of the line
    message: () => token(prec(2, /[Mm]0*11[78][ \t][^\r\n;]*/)),

    _item: ($) =>
      choice(
        $.word, $.assignment, $.call, $.label, $.string, $.corner, $.checksum, $.subprogram, $.jump, $.if_line, $.case, $.declaration,
        $.definition, $.procedure, $.action, $.repeat_label, $.setting, $.text_output, $.variable, $.path, $.joined,
        alias($._identifier, $.name),
      ),

    // G1, X-.5, S[#1*2], Z-#2; a letter alone (G28 X Y of Marlin)
    word: ($) => prec.right(seq(field('letter', $._address_letter), optional(field('value', choice($.number, $._word_value))))),
    _word_value: ($) => choice($.variable, $.parameter, $.brackets, alias($._signed, $.unary)),
    _signed: ($) => seq(choice('+', '-'), choice($.variable, $.parameter, $.brackets, alias($._value_indexed, $.indexed))),
    _address_letter: ($) =>
      choice(
        alias(/[Gg]/, $.g), alias(/[Mm]/, $.m), alias(/[Tt]/, $.t), alias(/[FfSs]/, $.feed_or_speed), alias(/[Nn]/, $.letter),
        alias(/[A-EHI-LP-RU-Za-ehi-lp-ru-z@^?]/, $.letter),
      ),
    corner: ($) => seq(',', $.word), // ,R5 and ,C2 of Fanuc
    // CALL _NAME << _NUMBER
    joined: ($) => seq('<<', $._target),
    // PCALL /_N_MPF_DIR/SHAFT(1)
    path: () => /\/_[Nn]_[A-Za-z0-9_\/]+/,
    checksum: ($) => seq('*', $.number),
    setting: () => token(choice(/\$[0-9]+/, '$$', '$#', /\$[Rr][Ss][Tt]=[*#$]/)),
    string: () => token(choice(/"[^"\r\n]*"/, /'[^'\r\n]*'/, /[\u2018\u2019][^\u2018\u2019\r\n]*\u2019/)),
    // DPRNT[...] and BPRNT[...] of Macro B: the text is not an expression
    text_output: () => token(prec(2, /[BbDd][Pp][Rr][Nn][Tt][ \t]*\[[^\r\n]*\]/)),

    // ---- names, variables, expressions

    _variable_indexed: ($) => prec.right(1, seq(alias($._variable_name, $.name), $.brackets)),
    _name: () => /[A-Za-z_][A-Za-z_]+/,
    // CYCLE800, POCKET4, A1_LEFT, $AA_IM
    _identifier: identifier,
    // the same in an expression and after "#": where these stand decides what a bracket behind them means
    _value_name: identifier,
    _variable_name: identifier,
    system_variable: () => /\$[A-Za-z_][A-Za-z0-9_]*/,
    // LinuxCNC and grbl read blanks inside a number: X 1 . 5
    number: () => token(seq(optional(/[+-][ \t]*/), choice(/[0-9]+(\.[0-9]*|[ \t]*\.[ \t]*[0-9]+)?/, /\.[ \t]*[0-9]+/), optional(/[Ee][Xx][+-]?[0-9]+/))),

    variable: ($) =>
      prec.right(seq('#', choice(alias(/[0-9]+/, $.number), $.variable, $.parameter, $.brackets, alias($._variable_name, $.name), alias($._variable_indexed, $.indexed)))),
    parameter: () => token(seq('#', /[ \t]*/, /<[^<>\r\n]*>/)),
    brackets: ($) => seq('[', list(',', $._expression), ']'),
    group: ($) => seq(alias($._open, '('), list(',', $._expression), ')'),
    arguments: ($) => seq(alias($._open, '('), list(',', $._expression), ')'),
    _call_arguments: ($) => seq(alias($._call_open, '('), list(',', $._expression), ')'),
    indexed: ($) => prec.right(1, seq(choice(alias($._identifier, $.name), $.system_variable), $.brackets)),

    // an address of Sinumerik: X=, A3=, M1=
    _address: ($) => prec(1, seq($._address_letter, optional($.number))),
    assignment: ($) =>
      seq(
        field('target', choice($.variable, $.parameter, alias($._identifier, $.name), $.system_variable, $.indexed, $.setting, alias($._address, $.address), alias($._letter_o, $.address), alias($._indexed_letter, $.indexed))),
        '=',
        field('value', $._expression),
      ),
    _indexed_letter: ($) => seq($._address_letter, $.brackets),
    call: ($) => choice(
      seq(field('name', choice(alias($._identifier, $.name), $.path)), alias($._call_arguments, $.arguments)),
      $.indexed,
      $.system_variable,
    ),

    _expression: ($) => choice($._operand, $.unary, $.binary),
    _operand: ($) =>
      choice(
        $.number, $.variable, $.parameter, $.brackets, $.group, $.string, $.system_variable, alias($._value_indexed, $.indexed), alias($._value_call, $.call),
        alias($._value_name, $.name), alias($._value_word, $.word),
      ),
    _letter_o: ($) => alias(/[Oo]/, $.letter),
    _value_word: ($) => prec.right(seq(choice($._address_letter, $._letter_o), optional(choice($.number, $.brackets)))),
    _value_indexed: ($) => prec.right(1, seq(choice(alias($._value_name, $.name), $.system_variable), $.brackets)),
    _value_call: ($) => prec.right(2, seq(field('name', alias($._value_name, $.name)), $.arguments)),
    unary: ($) => prec(PREC.unary, seq(choice('+', '-', '<<', word('NOT'), word('B_NOT')), $._expression)),
    binary: ($) =>
      choice(
        ...[
          [PREC.or, choice(word('OR'), word('XOR'), word('B_OR'), word('B_XOR'))],
          [PREC.and, choice(word('AND'), word('B_AND'))],
          [PREC.compare, choice('==', '<>', '<', '>', '<=', '>=', word('EQ'), word('NE'), word('GT'), word('GE'), word('LT'), word('LE'))],
          [PREC.add, choice('+', '-', '<<', ':')],
          [PREC.multiply, choice('*', '/', word('MOD'), word('DIV'))],
          [PREC.power, '**'],
        ].map(([level, operator]) => prec.left(level, seq($._expression, field('operator', operator), $._expression))),
      ),

    // ---- labels and jumps

    label: ($) => seq(choice(alias($._identifier, $.name), seq(choice(word('END'), word('LOOP')), $.number)), ':'),
    jump: ($) => prec.right(seq(choice(...['GOTO', 'GOTOF', 'GOTOB', 'GOTOC', 'GOTOS'].map(word)), optional($._target))),
    _target: ($) => choice($.number, $.variable, $.parameter, $.brackets, $.string, alias($._identifier, $.name), alias($._block_name, $.word), $.indexed, alias($._end_target, $.name)),
    // N10, A1: without a blank, because a number may follow in a CASE
    _block_name: ($) => prec.right(seq(choice($._address_letter, $._letter_o), optional(alias(token.immediate(/[0-9]+/), $.number)))),
    _end_target: ($) => seq(choice(word('END'), word('LOOP')), $.number),
    if_line: ($) => prec.right(seq($._if_head, repeat1($._item))),
    _if_head: ($) => seq(word('IF'), field('condition', $._expression), optional(word('THEN'))),
    case: ($) => prec.right(seq(word('CASE'), $._expression, word('OF'), repeat1(seq(choice($.number, $.string, word('DEFAULT')), $.jump)))),
    repeat_label: ($) => prec.right(seq(choice(word('REPEAT'), word('REPEATB')), repeat1(alias($._identifier, $.name)))),
    do_mark: ($) => seq(word('DO'), $.number),
    end_mark: ($) => seq(word('END'), $.number),

    // ---- statements of Sinumerik

    declaration: ($) => prec.right(seq(word('DEF'), $._declarator, repeat(seq(',', $._declarator)))),
    _declarator: ($) =>
      prec.right(seq(
        repeat1(choice(alias($._identifier, $.name), $.indexed, alias($._value_word, $.word), $.string)),
        optional(seq('=', $._expression)),
      )),
    definition: ($) => prec.right(seq(word('DEFINE'), choice(alias($._identifier, $.name), alias($._value_word, $.word)), word('AS'), repeat1($._item))),
    procedure: ($) =>
      prec.right(seq(choice(word('PROC'), word('EXTERN')), field('name', alias($._value_name, $.name)), optional($.parameters))),
    parameters: ($) => seq(alias($._open, '('), list(',', $._declarator), ')'),
    action: ($) => prec.right(seq(optional(seq(choice(...['WHEN', 'WHENEVER', 'EVERY', 'FROM'].map(word)), $._expression)), word('DO'), repeat1($._item))),

    // ---- what spans several blocks

    _structure: ($) =>
      choice($.if, $.while, $.for, $.loop, $.repeat_until, $.do_loop, $.o_sub, $.o_if, $.o_while, $.o_do, $.o_repeat),

    if: ($) => seq(optional($._prefix), $._if_head, $._newline, repeat(choice($._line, $._else_line)), optional($._prefix), word('ENDIF')),
    _else_line: ($) => seq(optional($._prefix), choice($.else, $.elseif), $._newline),
    else: () => word('ELSE'),
    elseif: ($) => seq(choice(word('ELSEIF'), seq(word('ELSE'), word('IF'))), $._expression, optional(word('THEN'))),
    while: ($) => seq(optional($._prefix), $._while_head, $._newline, repeat($._line), optional($._prefix), word('ENDWHILE')),
    _while_head: ($) => seq(word('WHILE'), field('condition', $._expression)),
    // WHILE [...] DO1 ... END1 of Macro B
    do_loop: ($) =>
      seq(optional($._prefix), optional($._while_head), $.do_mark, $._newline, repeat($._line), optional($._prefix), $.end_mark),
    for: ($) =>
      seq(
        optional($._prefix), word('FOR'), $.assignment, word('TO'), $._expression, $._newline, repeat($._line),
        optional($._prefix), word('ENDFOR'),
      ),
    loop: ($) => seq(optional($._prefix), word('LOOP'), $._newline, repeat($._line), optional($._prefix), word('ENDLOOP')),
    repeat_until: ($) =>
      seq(optional($._prefix), word('REPEAT'), $._newline, repeat($._line), optional($._prefix), word('UNTIL'), $._expression),

    // O words of LinuxCNC; O1234 of Fanuc
    o_word: ($) => prec.right(seq(alias(/[Oo]/, $.letter), choice($.number, alias(/<[^<>\r\n]*>/, $.name), $.brackets, $.variable, $.parameter))),
    subprogram: ($) =>
      prec.right(choice(
        seq($.o_word, optional(choice(word('BREAK'), word('CONTINUE')))),
        seq($.o_word, word('RETURN'), optional($.brackets)),
        seq($.o_word, word('CALL'), repeat($.brackets)),
      )),
    o_sub: ($) =>
      seq(
        optional($._prefix), $.o_word, word('SUB'), $._newline, repeat($._line),
        optional($._prefix), $.o_word, word('ENDSUB'), optional($.brackets),
      ),
    o_if: ($) =>
      seq(
        optional($._prefix), $.o_word, word('IF'), $._expression, $._newline, repeat(choice($._line, $._o_else_line)),
        optional($._prefix), $.o_word, word('ENDIF'),
      ),
    _o_else_line: ($) => seq(optional($._prefix), $.o_word, choice($.else, $.elseif), $._newline),
    o_while: ($) =>
      seq(
        optional($._prefix), $.o_word, word('WHILE'), $._expression, $._newline, repeat($._line),
        optional($._prefix), $.o_word, word('ENDWHILE'),
      ),
    o_do: ($) =>
      seq(
        optional($._prefix), $.o_word, word('DO'), $._newline, repeat($._line),
        optional($._prefix), $.o_word, word('WHILE'), $._expression,
      ),
    o_repeat: ($) =>
      seq(
        optional($._prefix), $.o_word, word('REPEAT'), $._expression, $._newline, repeat($._line),
        optional($._prefix), $.o_word, word('ENDREPEAT'),
      ),

  },
});
