"""Simulated joint driver of TEO: validates, interpolates and limits joint trajectories and publishes joint states."""
