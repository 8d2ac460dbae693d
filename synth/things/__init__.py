"""Things that are no rocks: rulers, cables, parts of a rover."""
