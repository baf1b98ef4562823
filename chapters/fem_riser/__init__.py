"""The finite-element riser: derived datasets, figures and claims."""
