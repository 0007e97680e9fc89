"""Signs as motions in the formats of programs that play motions."""
