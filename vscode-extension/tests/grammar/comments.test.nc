; SYNTAX TEST "source.gcode" "comments and what is none"
N1 (tool 1, G0) G1 (left open
;  ^^^^^^^^^^^^ comment.block.parentheses.gcode
;               ^^ keyword.control.motion.gcode
;                  ^^^^^^^^^^ comment.block.parentheses.gcode
; the line after an open bracket is code again
G0 X1 ; the rest G1
;<-- keyword.control.motion.gcode
;     ^^^^^^^^^^^^^ comment.line.semicolon.gcode
; over several lines
 /* one G1
;^^^^^^^^^ comment.block.gcode
 two */ G2
;^^^^^^ comment.block.gcode
;       ^^ keyword.control.motion.gcode
; what this program reads from comments
 (trunnion: allow pole-flip because it is out of the cut)
; ^^^^^^^^^^^^^^^ keyword.control.directive.gcode
;                 ^^^^^^^^^ comment.block.parentheses.gcode
; no comment inside a text
MSG("a ; b ( c") G1
;<--- entity.name.function.gcode
;   ^^^^^^^^^^^ string.quoted.double.gcode
;                ^^ keyword.control.motion.gcode
