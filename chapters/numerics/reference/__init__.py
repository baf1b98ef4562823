"""Reference solutions as data: computed once, kept with the scene's digest, read by the studies."""
