"""What benches of signs share: tracks of performed signs, baselines, errors, a check by other code."""
