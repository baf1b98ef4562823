"""Studies of the engine itself: what stays stable, and what each effect changes and costs."""
