%
O0001 (POLAR LINE MIDWAY)
(hypothetical Y grows, the tool goes straight from 50 0 to 0 50: midway the radius is 35.36)
(EXPECT HALFWAY X35.355339059 C45.)
G0 X50.
G12.1
G1 X0. C50. F100.
G13.1
M30
%
