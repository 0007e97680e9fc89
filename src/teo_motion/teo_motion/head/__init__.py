"""The head's part in a sentence, laid over a plan."""
