%
O0001 (BPRNT IS FOUR BYTES A VALUE)
(258648 is 0003F258 hexadecimal: no printing bytes in between would show, so digits of zero places)
(EXPECT PRINT C AAAA/BBBB)
#100=1094795.585
#101=1111638594
POPEN
BPRNT[C*#100[3]/#101[0]]
PCLOS
M30
%
