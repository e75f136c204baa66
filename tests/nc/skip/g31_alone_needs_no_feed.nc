%
O0001 (A BARE G31 IS NO MOVE)
(EXPECT MOVES 1) (Z stands at its second reference point)
(EXPECT #100 = 12.)
G91 G30 Z0
G90 G0 X12.
G31
#100=#5061
M30
