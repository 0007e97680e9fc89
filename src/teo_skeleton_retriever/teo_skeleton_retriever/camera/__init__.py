"""What a depth camera sends: its model, colour, depth and which images belong together."""
