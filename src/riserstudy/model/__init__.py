"""A scene on a mesh: state, effects with their records, and why each is there."""
