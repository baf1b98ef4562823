"""Liu et al. 2020: derived datasets, figures and claims."""
