"""Sentence models that read words with their readings: what they answer, how they are trained and run."""

from teo_sign_translator.pointer.sentence_model import Hypothesis, OutputGloss, SentenceModel
from teo_sign_translator.pointer.store import load_sentence_model

__all__ = ["Hypothesis", "OutputGloss", "SentenceModel", "load_sentence_model"]
