%
O0001 (CROSSING TWO BLOCKS AHEAD)
(the short side and the wall behind the next corner: no side runs backwards)
(SET TOOL 1 = 0. 5.)
(EXPECT ALARM 41)
(EXPECT MOVES 1)
G41 D1 G1 X0. Y5. F100.
Y-10.
X-10.
X2. Y-30.
X6. Y0.
G40 Y20.
M30
%
