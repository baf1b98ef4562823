"""Files and folders: caches, whole files and their seals, CSV, chapters, digests of sources."""
