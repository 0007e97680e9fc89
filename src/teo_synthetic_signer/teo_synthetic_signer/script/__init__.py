"""What a person does: key poses in words, the motion between them, scripts and their files."""
