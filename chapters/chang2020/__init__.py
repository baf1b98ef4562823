"""Chang, Wu, Zhang, Chen 2020: derived datasets, figures and checks."""
