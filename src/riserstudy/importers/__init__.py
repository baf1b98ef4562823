"""Files of other programs become scenes, or tables that scenes read."""
