%
O0001 (ARGUMENTS ONE AND TWO MIXED)
(the later one of I5. and D7. for #7 counts, I J K count up)
(EXPECT #101 = 1.)
(EXPECT #104 = 4.)
(EXPECT #107 = 7.)
(EXPECT #108 = 8.)
(EXPECT #110 = 10.)
G65 P9 A1. I4. I5. D7. J8. I10.
M30
O9
#101=#1
#104=#4
#107=#7
#108=#8
#110=#10
M99
%
