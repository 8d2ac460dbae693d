"""Sources of pictures with known masks, a file each."""
