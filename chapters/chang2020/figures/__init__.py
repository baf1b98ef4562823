"""Figures of Chang et al. 2020, named by their number in the paper, or else by their content.

x is the height of the ring above its position on the unstretched riser, a is the upward displacement of the
platform, and X = x - a is the displacement of the piston.
"""
