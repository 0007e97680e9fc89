"""Making the models: from a corpus, or the paper's pairs, to weights. Only this room needs PyTorch."""
