"""Letters and numbers of the LSE manual alphabet, from measured postures of one hand."""
