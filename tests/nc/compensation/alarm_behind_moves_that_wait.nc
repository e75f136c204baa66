%
O0001 (ALARM BEHIND MOVES THAT WAIT)
(what was worked out goes out, the side without a next one does not)
(SET TOOL 1 = 0. 5.)
(EXPECT ALARM 10 LINE 13)
(EXPECT MOVE G1 X5. Y0.)
(EXPECT MOVE G1 X5. Y25.)
(EXPECT MOVE G1 X25. Y25.)
G41 D1 G1 X10. F100.
Y20.
X30.
Y40.
G777
M30
%
