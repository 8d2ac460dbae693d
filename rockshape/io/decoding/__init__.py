"""Decoding that several formats share: Pillow's images, TIFF, NumPy's arrays and label images."""
