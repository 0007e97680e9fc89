"""The model of Gago et al. 2019: 39 sentences by heart."""
