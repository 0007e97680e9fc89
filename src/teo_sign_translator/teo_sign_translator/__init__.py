"""Spanish text to Spanish Sign Language (LSE) tokens: normalisation, sequence-to-sequence models, translator node."""
