%
O0001 (BLANK INSIDE A CODE)
(EXPECT ALARM 4)
(EXPECT TEXT a blank inside a number?)
G 0 1 X1.
M30
%
