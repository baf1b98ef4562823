"""Figures of Chang et al. 2020, named by their number in the paper, or else by their content.

x is the height of the ring above its position on the unstretched riser, a is the upward displacement of the
platform, and X = x - a is the displacement of the piston.

Files: `cylinder` (Figs 5, 6 and 9), `histories` (8, 10 to 12) and `sweeps` (13 and 14).
"""
