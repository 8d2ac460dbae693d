"""Self-checks of the validation: oracle, shuffled truth and mutations."""
