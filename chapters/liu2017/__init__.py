"""Liu et al. 2017: datasets derived from its runs, figures, and checks of its claims."""
