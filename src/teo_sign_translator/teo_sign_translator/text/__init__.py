"""From typed text to words: cleaning, sentences, numbers, short forms."""
