"""Gravel beds seen from above: height fields of grains that rest on one another, and pictures.

The parts, in the order data flows through them: `relief` makes bodies, ground and heights,
`picture` lights and photographs them, `make` puts a tile together, `tiles` makes many, `write`
keeps them as a dataset, `stage` hands a bed to the renderers.
"""
