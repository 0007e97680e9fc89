"""The default model: an encoder-decoder with attention that copies words."""
