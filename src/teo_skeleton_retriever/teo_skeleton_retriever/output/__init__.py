"""Skeletons for others: messages, markers, JSON, bags, pictures and films."""
