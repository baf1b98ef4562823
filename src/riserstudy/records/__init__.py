"""Records that travel from room to room, each defined once: no part of them is read out of a sentence."""
