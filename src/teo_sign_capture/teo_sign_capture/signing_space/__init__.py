"""Directions in words, places of articulation, points of a hand that meet them."""
