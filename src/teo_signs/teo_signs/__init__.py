"""A sign and the table of signs: file, schema, evidence, tokens, lexicon, mirroring, likeness."""
