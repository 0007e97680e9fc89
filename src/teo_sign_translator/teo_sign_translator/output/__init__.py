"""What the translator says: glosses, tokens, spelling, messages."""
