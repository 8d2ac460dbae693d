"""Plug-ins: records that other distributions add by entry points."""
