"""Skeletons for others: messages, markers, JSON, MCAP files, pictures and films."""
