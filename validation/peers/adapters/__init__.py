"""Peer packages: their shape measures, evaluated on the same masks as ours.

Each adapter names a few of the peer's numbers and the traits they rise with; nothing is tuned.
"""

_HERE = "validation.peers.adapters"
ADAPTERS = {
    "scikit-image": f"{_HERE}.scikit_image:measure",
    "fast_rs": f"{_HERE}.fast_rs:measure",
    "imea": f"{_HERE}.imea:measure",
    "partimorph": f"{_HERE}.partimorph:measure",
}
