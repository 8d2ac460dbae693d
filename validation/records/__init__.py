"""Records: measured rocks joined with their truth, and their pictures."""
