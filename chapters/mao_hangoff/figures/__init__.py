"""Figures of the chapter, one file per subject.

`towed` draws Figs 4 and 7 to 9 of the paper, and `towed_sweeps` Figs 10 to 14.
"""
