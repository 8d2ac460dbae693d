"""Array types and robust statistics that all parts of the package share."""
