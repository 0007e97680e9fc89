"""Spanish text to Spanish Sign Language (LSE) tokens."""
