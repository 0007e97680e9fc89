"""How near a retriever comes to the truth: takes, methods beside ours, errors, and what was tuned on."""
