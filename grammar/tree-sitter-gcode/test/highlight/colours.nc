N10 G1 X10 F200 M3 T1
; <- label
;   ^ keyword
;      ^ variable.parameter
;       ^ number
;          ^ property
;               ^ function.builtin
;                  ^ type
N20 G17 CYCLE800(1,"TC") TRAORI
;   ^ keyword
;       ^ function.call
;                  ^ string
;                        ^ function.builtin
IF R1<5 GOTOF NEXT_ONE
; <- keyword.conditional
;    ^ operator
;       ^ keyword.return
;             ^ label
NEXT_ONE: #100=[#<_depth> MOD 2]
; <- label
;         ^ variable
;                         ^ keyword.operator
o<drill> call [1] (bracket)
; <- function
;        ^ keyword.function
;                 ^ comment
