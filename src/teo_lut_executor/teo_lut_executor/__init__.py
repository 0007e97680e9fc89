"""Look-up table of signs and the executor that turns sign tokens into smooth joint trajectories."""
