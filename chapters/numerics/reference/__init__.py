"""Reference solutions as data: computed once, stored with the scene's digest, read by the studies."""
