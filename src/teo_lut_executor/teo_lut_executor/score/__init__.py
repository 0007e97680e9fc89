"""Sign scores: signs written down by their form, and brought onto TEO's arms and hands."""
