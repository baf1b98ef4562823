"""Figures of the Hamilton-principle riser paper: the printed ones by number, others by what they show.

Filled: envelope of the Hermite beam, the paper's own method. Dashed lines of the same colour: lumped
masses. Heights count along the riser from its lower end.
"""
