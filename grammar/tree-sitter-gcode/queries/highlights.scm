; What the parts of a program are. Later patterns win.

(comment) @comment
(string) @string
(message) @string
(text_output) @string
(number) @number
(name) @variable

; words: X Y Z and other addresses, feed and speed, preparatory and miscellaneous codes, tools
(word letter: (letter) @variable.parameter)
(word letter: (feed_or_speed) @property)
(word letter: (g) @keyword value: (number) @keyword)
(word letter: (m) @function.builtin value: (number) @function.builtin)
(word letter: (t) @type value: (number) @type)

(block_number) @label
(label (name) @label)
(jump (name) @label)
(jump (number) @label)
(jump (word) @label)
(repeat_label (name) @label)
(tape_mark) @module
(skip) @keyword.directive
(continuation) @keyword.directive
(checksum) @attribute

; names, variables, subprograms
(variable) @variable
(parameter) @variable
(system_variable) @variable.builtin
(setting) @variable.builtin
(address (letter) @variable.parameter)
(address (feed_or_speed) @property)
(call name: (name) @function.call)
(block (name) @function.builtin)
(path) @function.call
(procedure name: (name) @function)
(o_word) @function
(indexed (name) @function.call)

(binary operator: _ @operator)
[ "=" "+" "-" "<<" ] @operator
[ "(" ")" "[" "]" ] @punctuation.bracket
[ "," ":" ] @punctuation.delimiter

[ "AND" "OR" "XOR" "NOT" "B_AND" "B_OR" "B_XOR" "B_NOT" "MOD" "DIV" "EQ" "NE" "GT" "GE" "LT" "LE" ] @keyword.operator
[ "IF" "THEN" "ENDIF" "ELSEIF" "CASE" "OF" "DEFAULT" ] @keyword.conditional
(else) @keyword.conditional
[ "WHILE" "ENDWHILE" "FOR" "TO" "ENDFOR" "LOOP" "ENDLOOP" "REPEAT" "REPEATB" "UNTIL" "ENDREPEAT" "BREAK" "CONTINUE" ] @keyword.repeat
(do_mark) @keyword.repeat
(end_mark) @keyword.repeat
[ "GOTO" "GOTOF" "GOTOB" "GOTOC" "GOTOS" "RETURN" ] @keyword.return
[ "SUB" "ENDSUB" "CALL" "PROC" "EXTERN" "DEF" "DEFINE" "AS" ] @keyword.function
[ "WHEN" "WHENEVER" "EVERY" "FROM" "DO" ] @keyword
