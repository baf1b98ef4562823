"""Figures of the chapter, one file per subject.

Figures of the paper are in `statics` (Figs 9 and 10), `static_shapes` (11 and 12), `heave` (13 to 15),
`motion` (16 to 20) and `waves` (21 to 24).
"""
