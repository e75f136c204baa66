%
O0001 (SLOT TOO NARROW)
(the floor is where the cutter does not fit)
(SET TOOL 1 = 0. 15.)
(EXPECT ALARM 41 LINE 8)
G42 D1 G1 X10. F100.
Y20.
X30.
Y0.
G40 X20. Y-20.
M30
%
