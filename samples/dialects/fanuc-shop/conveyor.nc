%
O0010 (trunnion: tool 1 ball diameter 10 length 80)
(trunnion: machine mill-3axis)
G21 G90 G17 G94 G54
T1 M6
G0 G43 H1 Z50.
S3000 M3
M70 (chip conveyor on)
M88 Q40 (through-spindle coolant at 40 bar)
G0 X0. Y0. Z5.
G1 Z-1. F200.
X50. F500.
G0 Z50.
M71 (chip conveyor off)
M5
M30
%
