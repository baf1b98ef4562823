"""Plots that fit any grid of simulations: dataset in, figure out."""
