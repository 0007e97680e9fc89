"""What a depth camera sends.

Its model with distortion, colour and depth from messages and files, and which depth image belongs to
which colour image.
"""
