"""Where signs are made: directions in words, places of articulation, points of a hand that meet them."""
