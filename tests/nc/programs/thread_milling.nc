%
O0001 (THREAD MILLING)
(M16 x 2: an entry arc of half a turn and half a millimetre up, three turns of pitch 2, an exit arc)
(EXPECT MOVE G0 X20. Y0. Z0.)
(EXPECT MOVE G0 X20. Y0. Z-12.)
(EXPECT MOVE G3 X24. Y0. Z-11. I22. J0. K-12.)
(EXPECT MOVE G3 X24. Y0. Z-9. I20. J0. K-11.)
(EXPECT MOVE G3 X24. Y0. Z-7. I20. J0. K-9.)
(EXPECT MOVE G3 X24. Y0. Z-5. I20. J0. K-7.)
(EXPECT MOVE G3 X20. Y0. Z-4. I22. J0. K-5.)
(EXPECT MOVE G0 X20. Y0. Z10.)
G90 G17 G54
G0 X20. Y0.
#1=2.
#2=4.
Z-12.
G91
G3 X#2 Z[#1/2] I[#2/2] F200.
#3=0
WHILE[#3LT3]DO1
G3 I-#2 Z#1
#3=#3+1
END1
G3 X-#2 Z[#1/2] I[-#2/2]
G90 G0 Z10.
M30
%
