"""From a model's hypotheses to signs: nothing lost, nothing invented, everything signable."""
