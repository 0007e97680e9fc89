"""Sign scores.

Signs written down by their form, read, brought onto the robot, or performed by the synthetic signer.
"""
