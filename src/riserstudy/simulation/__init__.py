"""One scene solved: equilibrium, steps, refinement to the accuracy asked for, audit."""
