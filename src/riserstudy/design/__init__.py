"""What is signed before a riser is run: tension, offsets, watch circles."""
