"""Simulated joint driver of TEO: executes joint trajectories as the robot would, or says why not."""
