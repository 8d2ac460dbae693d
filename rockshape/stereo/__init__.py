"""Range of a stereo pair: rectification, block matching, and the point seen at each left pixel."""
