"""The simulation of one scene: equilibrium, time steps, refinement to the tolerance, audit."""
