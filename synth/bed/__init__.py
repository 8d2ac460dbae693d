"""Gravel beds from above or obliquely: grains that rest on one another, and pictures of them.

The parts, in the order data flows through them: `relief` makes bodies, ground and heights, `view`
tells what a camera sees of them, `packed` puts these together, `picture` lights and photographs
them, `make` makes a tile, `tiles` makes many, `write` keeps them as a dataset, `stage` hands a bed
to the renderers.
"""
