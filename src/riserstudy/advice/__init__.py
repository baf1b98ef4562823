"""Advice on one scene: cost of accuracy, change and cost of each effect, and which effects it needs."""
