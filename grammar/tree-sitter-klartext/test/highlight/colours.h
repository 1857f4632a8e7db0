1 L X+10 M3
; <- label
; ^ keyword
;   ^ variable.parameter
;     ^ number
;        ^ function.builtin
2 CYCL DEF 200 DRILLING
; ^ keyword.function
;          ^ number
3 Q1 = Q2 + 5
; ^ variable
;    ^ operator
;           ^ number
