(A step 4 mm wide and 3 mm deep along the rim of a plate of 800 x 500 mm; zero in the middle of its top, mill of 16 mm)
G21 G90 G94
T1 M6
S12000 M3
G0 X-270 Y-404 Z20
G1 Z-3 F1200
G1 X254 F4800
Y404
X-254
Y-404
G0 Z20
M30
