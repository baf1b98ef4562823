"""Figures of Liu et al. 2017: the printed ones by number, others by what they show.

Axis ranges are not printed: the first 100 s are shown, up to the largest surge of about 150 m.
"""
