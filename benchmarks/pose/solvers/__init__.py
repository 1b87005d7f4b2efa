"""One file each, which registers itself."""
