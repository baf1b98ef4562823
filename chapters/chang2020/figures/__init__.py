"""Figures of Chang et al. 2020: printed figures by their number, others by their content.

x is the rise of the ring above the unstretched riser, a the rise of the platform, X = x - a the displacement
of the piston.
"""
