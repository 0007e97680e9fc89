"""Making the models of the zoo: from a corpus to weights, with PyTorch. Nothing that translates needs it."""
