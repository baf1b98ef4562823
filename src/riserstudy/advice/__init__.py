"""Advice on one scene: what accuracy costs, what its effects change and cost, which it needs."""
