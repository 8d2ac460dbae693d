"""Rough ground: relief at all scales, its skin of soil, dust, rock and pebbles, and its horizon.

`layers` makes the relief of the field as periodic maps, `hills` what rises beyond it, `elevation`
reads a height model, `tails` lays drifts in the lee of rocks, `grid` holds the heights as
triangles, `skin` has their colours and what is finer than the triangles, `make` puts a ground
together.
"""
