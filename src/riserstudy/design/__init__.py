"""Design checks before a riser is deployed: tension, offsets, watch circles."""
