(Text: each comment "expect RULE" names what is found in the next line; text-good.nc has the same moves written right)
(trunnion: machine mill-3axis)
(trunnion: dialect iso-6983)
(trunnion: tool 1 flat diameter 10 length 80)
(expect modal-group-conflict)
N10 G17 G20 G21 G40 G54 G90 G94
N20 T1 M6
N30 S5000 M3
N40 G0 G43 H1 Z10
(expect decimal-comma position-unknown)
N50 X1,5 Y0
(expect bad-number position-unknown)
N60 G1 Z-1.2.5 F300
(expect unknown-code)
N70 G77 X20
(expect unclosed-comment)
N80 Y20 (corner
(expect repeated-word position-unknown)
N90 X10 X0
(expect syntax-error)
N100 G0 Z10 !
(expect unknown-word)
N110 Z10 AB=5
N120 M5
N130 M30
