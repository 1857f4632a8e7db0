; Later patterns win.
(comment) @comment
(heading) @markup.heading
(string) @string
(text) @string
(file) @string.special.path
(number) @number
(parameter) @variable
(word letter: (name) @variable.parameter)
((word letter: (name) @function.builtin) @_word (#match? @_word "^[Mm][0-9]+$"))
(joined_word) @variable.parameter
(path kind: (kind) @keyword)
(block_number) @label
(label (number) @label)
(label (string) @label)
(jump (number) @label)
(jump (string) @label)
(skip) @keyword.directive
(sign) @operator
[ "=" "*" "/" "^" "+" "-" "<" ">" ] @operator
[ "(" ")" ] @punctuation.bracket
[ "BEGIN" "END" "PGM" ] @module
[ "TOOL" "CYCL" "CYCLE" "DEF" "CALL" ] @keyword.function
[ "LBL" "FN" "GOTO" ] @keyword
