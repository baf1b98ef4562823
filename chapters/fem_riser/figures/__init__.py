"""Figures of the Hamilton-principle riser paper: printed figures have numbers, further figures have names.

Filled: envelope of the Hermite beam, the paper's method. Dashed lines of equal colour: lumped masses. Heights
are measured along the riser from its lower end.

Files: `motion` (Figs 3 to 5) and `trends` (6 to 8).
"""
