"""Parameters of the truth that is written beside the default one."""

from msgspec import Struct


class TruthSpec(Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """Further truth of rocks. Families that have it anyway write it whatever is asked."""

    caliper: bool = False  # half-axes L >= I >= S of Sneed and Folk
    form: bool = False  # form, roundness and roughness apart
