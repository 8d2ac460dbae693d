"""Multi-view experiments: the same rocks seen from several views."""
