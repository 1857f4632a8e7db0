; SYNTAX TEST "source.gcode" "words, joined or not"
; the row of the pole flip
N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595 F2000
;<----- entity.name.tag.block-number.gcode
;     ^^ keyword.control.motion.gcode
;        ^ variable.parameter.axis.gcode
;         ^^^^^^^^^ constant.numeric.gcode
;                   ^ variable.parameter.axis.gcode
;                             ^ variable.parameter.axis.gcode
;                                       ^ variable.parameter.axis.gcode
;                                        ^^^^^ constant.numeric.gcode
;                                              ^ variable.parameter.axis.gcode
;                                               ^^^^^^ constant.numeric.gcode
;                                                      ^ variable.parameter.gcode
;                                                       ^^^^ constant.numeric.gcode
; nothing between the words
N10G1X10Y-2.5F.5
;<--- entity.name.tag.block-number.gcode
;  ^^ keyword.control.motion.gcode
;    ^ variable.parameter.axis.gcode
;     ^^ constant.numeric.gcode
;       ^ variable.parameter.axis.gcode
;        ^^^^ constant.numeric.gcode
;            ^ variable.parameter.gcode
;             ^^ constant.numeric.gcode
; lower case, leading zeros, signs, a point at the end
n5 g01 x1. y+2 i0.5 r3
;<-- entity.name.tag.block-number.gcode
;  ^^^ keyword.control.motion.gcode
;      ^ variable.parameter.axis.gcode
;       ^^ constant.numeric.gcode
;          ^ variable.parameter.axis.gcode
;           ^^ constant.numeric.gcode
;              ^ variable.parameter.arc.gcode
;                   ^ variable.parameter.arc.gcode
; blanks inside words
G 1 X 10
;<--- keyword.control.motion.gcode
;   ^ variable.parameter.axis.gcode
;     ^^ constant.numeric.gcode
; motion, settings, and what no dialect knows
G0 G17 G43.4 G68.2 G999 G5.9
;<-- keyword.control.motion.gcode
;  ^^^ keyword.other.preparatory.gcode
;      ^^^^^ keyword.other.preparatory.gcode
;            ^^^^^ keyword.other.preparatory.gcode
;                  ^^^^ invalid.illegal.unknown-code.gcode
;                       ^^^^ invalid.illegal.unknown-code.gcode
; tool and miscellaneous
T1 M6 M03 S12000 M999
;<- entity.name.type.tool.gcode
;  ^^ entity.name.function.miscellaneous.gcode
;     ^^^ entity.name.function.miscellaneous.gcode
;         ^ variable.parameter.gcode
;          ^^^^^ constant.numeric.gcode
;                ^^^^ entity.name.function.machine-builder.gcode
; block delete, plain and numbered
/N10 G0
;<- keyword.control.skip.gcode
;^^^ entity.name.tag.block-number.gcode
;    ^^ keyword.control.motion.gcode
/1 N20 G0
;<-- keyword.control.skip.gcode
;  ^^^ entity.name.tag.block-number.gcode
; the tape mark
%
;<- keyword.control.program.gcode
