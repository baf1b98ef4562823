"""A scene on a mesh: the state, and the effects with their records and the reason for each."""
