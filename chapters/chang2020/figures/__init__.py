"""Figures of Chang et al. 2020: the printed ones by number, others by what they show.

x is the rise of the ring above the unstretched riser, a that of the platform, X = x - a the piston's.
"""
