"""Views of a packed bed: from straight above, and obliquely."""
