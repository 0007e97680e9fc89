"""A sentence before and after planning: its form and rhythm, the postures it passes, the plan."""
