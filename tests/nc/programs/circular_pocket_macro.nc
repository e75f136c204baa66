%
O0001 (CIRCULAR POCKET MACRO)
(G65 P9100: X Y centre, R pocket radius, Z depth, Q most step, D tool radius, F feed)
(10 deep in steps of 3: FUP gives 4 levels of 2.5, each a helix of one turn and a full circle)
(EXPECT #101 = 4.)
(EXPECT #102 = 2.5)
(EXPECT #103 = 25.)
(EXPECT MOVES 13)
(EXPECT LAST G0 X10. Y5. Z50.)
G90 G17 G54 G21
G0 Z50.
G65 P9100 X10. Y5. R30. Z10. Q3. D5. F400.
M30
O9100
IF[#7 EQ #0]GOTO900
IF[#7 GE #18]GOTO900
#101=FUP[#26/#17]
#102=#26/#101
#103=#18-#7
G0 X#24 Y#25
Z2.
G1 Z0. F#9
G1 X[#24+#103]
#1=0
WHILE[#1 LT #101]DO1
#1=#1+1
G3 I-#103 Z[-#1*#102]
END1
G3 I-#103
N800 G1 X#24
G0 Z2.
G0 Z50.
G0 Z50.
M99
N900 #3000=1(TOOL TOO LARGE FOR POCKET)
%
