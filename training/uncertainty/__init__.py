"""Error models of the robust values, fitted to made rocks whose true values are known."""
