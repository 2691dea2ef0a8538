(A groove along the foot of rib.stl, 60 mm beside the rib)
G21 G90 G94
T1 M6
S12000 M3
G0 X-130 Y0 Z20
G1 Z-5 F300
G1 X130 F1200
G0 Z20
M30
