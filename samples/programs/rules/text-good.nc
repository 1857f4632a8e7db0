(Text: the same moves as text-bad.nc, written so that nothing is found)
(trunnion: machine mill-3axis)
(trunnion: dialect iso-6983)
(trunnion: tool 1 flat diameter 10 length 80)
N10 G17 G21 G40 G54 G90 G94
N20 T1 M6
N30 S5000 M3
N40 G0 G43 H1 Z10
N50 X1.5 Y0
N60 G1 Z-1.25 F300
N70 X20
N80 Y20 (corner)
N90 X0
N100 G0 Z10
N110 M5
N120 M30
