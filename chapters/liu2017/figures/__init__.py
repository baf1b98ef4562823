"""Figures of Liu et al. 2017, named by their number in the paper, or else by their content.

No axis ranges are published: the figures show the first 100 s, up to the largest surge of about 150 m.
`drive_off` draws Figs 4 to 7.
"""
