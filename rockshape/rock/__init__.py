"""One rock of an image: its pixels, its visibility and the fits that measures share."""
